// A window whose GPU chooses the pages of terrain: no message of the validation layer, nothing that stays
// away, and where the eye rests the picture that shot draws.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::Outcome;
using oro::test::run_orograph;

// Of the frames that were shown: those of a moving eye, and of these those whose pages the GPU chose.
struct ShownFrames {
    int moving{}, chosen{};
};
ShownFrames frames_in(const fs::path& trace) {
    ShownFrames frames;
    std::ifstream lines(trace);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("frame: ")) continue;
        frames.moving += line.find(" moving") != std::string::npos ? 1 : 0;
        frames.chosen += line.ends_with("moving, pages chosen by the GPU") ? 1 : 0;
    }
    return frames;
}

TEST(WindowPages, AreChosenByTheGpuWhileTheEyeMoves) {
    if (oro::test::run_program({"Xvfb", "-help"}).exit_code == 127 ||
        oro::test::run_program({"xdotool", "version"}).exit_code == 127)
        GTEST_SKIP() << "needs Xvfb and xdotool";
    const auto data = oro::test::real_data("alps");
    if (!data) GTEST_SKIP() << "needs alps";
    oro::test::Circumstances there;
    there.folder = oro::test::scratch_folder();
    there.environment = {"SCREEN_SIZE=400x300", "WAYLAND_DISPLAY", "OROGRAPH_VALIDATION=1"};
    const fs::path region = there.folder / "alps.oro";
    const Outcome baked =
        run_orograph({"bake", (*data / "N46E007.SRTMGL3.hgt.zip").string(),
                      (*data / "N46E008.SRTMGL3.hgt.zip").string(), "--out", region.string(), "-q"});
    ASSERT_EQ(baked.exit_code, 0) << baked.err;
    const fs::path script = fs::path(OROGRAPH_ON_DISPLAY).parent_path() / "window_pages.sh";
    const Outcome seen =
        oro::test::run_program({OROGRAPH_ON_DISPLAY, script.string(), OROGRAPH_PROGRAM, region.string(),
                                "--at", "46.65,7.95", "--above", "800", "--heading", "170", "--pipeline",
                                "compute", "--memory", "64", "--gpu-memory", "32"},
                               there);
    ASSERT_EQ(seen.exit_code, 0) << seen.out << seen.err;
    const ShownFrames frames = frames_in(there.folder / "states.txt");
    std::printf("%d frames of a moving eye, pages of %d chosen by the GPU\n", frames.moving, frames.chosen);
    EXPECT_GE(frames.chosen, 10);
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

// A view that takes more than the GPU's memory may hold: it says so, and does not load for ever.
TEST(WindowPages, SayThatMemoryIsFull) {
    if (oro::test::run_program({"Xvfb", "-help"}).exit_code == 127 ||
        oro::test::run_program({"xdotool", "version"}).exit_code == 127)
        GTEST_SKIP() << "needs Xvfb and xdotool";
    oro::test::Circumstances there;
    there.folder = oro::test::scratch_folder();
    there.environment = {"SCREEN_SIZE=640x400", "WAYLAND_DISPLAY"};
    const fs::path script = fs::path(OROGRAPH_ON_DISPLAY).parent_path() / "window_memory.sh";
    const Outcome seen = oro::test::run_program(
        {OROGRAPH_ON_DISPLAY, script.string(), OROGRAPH_PROGRAM,
         "made:fbm?seed=7&octaves=9&H=-200:4000&spacing=2s&box=8,46,9,47", "--at", "46.1,8.5", "--above",
         "3000", "--pitch", "-20", "--style", "relief", "--tau", "0", "--gpu-memory", "16"},
        there);
    ASSERT_EQ(seen.exit_code, 0) << seen.out << seen.err;
    std::ifstream trace(there.folder / "states.txt");
    std::string last;
    for (std::string line; std::getline(trace, line);)
        if (line.starts_with("state: ")) last = line;
    EXPECT_TRUE(last.starts_with("state: GPU memory is full: coarser than asked for  |")) << last;
}

}  // namespace
