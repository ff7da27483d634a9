// A window over a world that nobody stores: its first picture waits for no measuring, nothing is measured by
// the thread that draws, and where the eye rests the picture is the one that shot draws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::Outcome;
using oro::test::run_orograph;

std::vector<std::string> lines_of(const fs::path& file) {
    std::vector<std::string> lines;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

// Red, green and blue of a dump of a screen of 32 bits a pixel (X11/XWDFile.h): words of 4 bytes, the highest
// first.
std::vector<unsigned char> colours_of(const std::string& dump, std::size_t width, std::size_t height) {
    const auto byte = [&](std::size_t at) { return std::size_t{static_cast<unsigned char>(dump.at(at))}; };
    const auto word = [&](std::size_t i) {
        return byte(4 * i) << 24U | byte(4 * i + 1) << 16U | byte(4 * i + 2) << 8U | byte(4 * i + 3);
    };
    const std::size_t first = word(0) + 12 * word(19), row_bytes = word(12);
    const bool blue_first = word(7) == 0;
    std::vector<unsigned char> rgb;
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                rgb.push_back(static_cast<unsigned char>(
                    byte(first + y * row_bytes + 4 * x + (blue_first ? 2 - c : c + 1))));
    return rgb;
}

std::size_t different(const std::vector<unsigned char>& one, const std::vector<unsigned char>& other) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < one.size(); ++i) count += one[i] != other[i] ? 1U : 0U;
    return count;
}

TEST(WindowWorld, ShowsAFirstPictureBeforeAnythingIsMeasuredAndTheSameAsShotAtRest) {
    if (oro::test::run_program({"Xvfb", "-help"}).exit_code == 127 ||
        oro::test::run_program({"xdotool", "version"}).exit_code == 127)
        GTEST_SKIP() << "needs Xvfb and xdotool";
    oro::test::Circumstances there;
    there.folder = oro::test::scratch_folder();
    there.environment = {"SCREEN_SIZE=320x200", "WAYLAND_DISPLAY"};
    const std::vector<std::string> view{
        "made:fbm?seed=7&octaves=12&H=-200:4000&spacing=1s&box=-179,-60,179,60",
        "--at",
        "46.5,8.3",
        "--above",
        "1200",
        "--pitch",
        "-6",
        "--style",
        "plain"};
    const fs::path script = fs::path(OROGRAPH_ON_DISPLAY).parent_path() / "window_world.sh";
    std::vector<std::string> command{OROGRAPH_ON_DISPLAY, script.string(), OROGRAPH_PROGRAM};
    command.insert(command.end(), view.begin(), view.end());
    const Outcome seen = oro::test::run_program(command, there);
    ASSERT_EQ(seen.exit_code, 0) << seen.out << seen.err;
    std::printf("%s", seen.out.c_str());
    const auto lines = lines_of(there.folder / "states.txt");
    const auto count = [&](const std::string& begin) {
        return std::ranges::count_if(lines, [&](const std::string& line) { return line.starts_with(begin); });
    };
    EXPECT_EQ(count("levels: "), 0) << "blocks of levels were measured by the thread that draws";
    EXPECT_GE(count("frame: "), 3);

    std::vector<std::string> shot{"shot"};
    shot.insert(shot.end(), view.begin(), view.end());
    for (const char* const word : {"--size", "320x200", "--tau", "0.5", "-q", "--out"})
        shot.emplace_back(word);
    shot.push_back((there.folder / "shot.png").string());
    const Outcome drawn = run_orograph(shot);
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const auto expected = oro::test::pixels_of(there.folder / "shot.png");
    const auto shown = [&](const char* file) {
        return colours_of(oro::test::bytes_of(there.folder / file), 320, 200);
    };
    EXPECT_EQ(different(shown("settled.xwd"), expected.rgb), 0U);
    EXPECT_GT(different(shown("first.xwd"), expected.rgb), 1000U) << "the first picture was coarse";
    int pictures = 0;
    for (const std::string& name : oro::test::names_in(there.folder)) {
        if (!name.starts_with("orograph-") || !name.ends_with(".png")) continue;
        ++pictures;
        const Outcome compared = run_orograph({"compare", (there.folder / name).string(), "--json", "-q"});
        ASSERT_EQ(compared.exit_code, 0) << compared.err;
        EXPECT_EQ(json::parse(compared.out)["pixels"]["differ"], 0) << name;
    }
    EXPECT_EQ(pictures, 1);
}

}  // namespace
