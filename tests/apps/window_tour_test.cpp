// A tour of the window over real ground: each of its pictures is what it was, block by block.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;

constexpr std::size_t columns = 24, rows = 15, block_px = 40;

// Mean codes of red, green, blue of blocks of 40 x 36 pixels.
using Blocks = std::vector<std::array<int, 3>>;

// The dump of a screen of 32 bits a pixel (X11/XWDFile.h): words of 4 bytes, the highest first.
Blocks blocks_of(const std::string& dump) {
    const auto byte = [&](std::size_t at) { return std::size_t{static_cast<unsigned char>(dump.at(at))}; };
    const auto word = [&](std::size_t i) {
        return byte(4 * i) << 24U | byte(4 * i + 1) << 16U | byte(4 * i + 2) << 8U | byte(4 * i + 3);
    };
    const std::size_t first = word(0) + 12 * word(19), row_bytes = word(12);
    const bool blue_first = word(7) == 0;
    Blocks blocks;
    constexpr std::size_t high = 36;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            std::array<std::size_t, 3> sum{};
            for (std::size_t y = row * high; y < (row + 1) * high; ++y)
                for (std::size_t x = column * block_px; x < (column + 1) * block_px; ++x)
                    for (std::size_t c = 0; c < 3; ++c)
                        sum[c] += byte(first + y * row_bytes + 4 * x + (blue_first ? 2 - c : c + 1));
            std::array<int, 3> mean{};
            for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<int>(sum[c] / (high * block_px));
            blocks.push_back(mean);
        }
    return blocks;
}

fs::path goldens() {
    return fs::path(__FILE__).parent_path() / "window_tour.txt";
}

// Lines of a stop's name and its blocks as hexadecimal digits, six a block.
std::map<std::string, Blocks> read_goldens() {
    std::map<std::string, Blocks> all;
    std::ifstream in(goldens());
    for (std::string name, digits; in >> name >> digits;) {
        Blocks blocks;
        for (std::size_t at = 0; at + 6 <= digits.size(); at += 6) {
            const int code = std::stoi(digits.substr(at, 6), nullptr, 16);
            blocks.push_back({code >> 16, code >> 8 & 255, code & 255});
        }
        all[name] = blocks;
    }
    return all;
}

void write_golden(std::ofstream& out, const std::string& name, const Blocks& blocks) {
    out << name << " ";
    std::array<char, 8> digits{};
    for (const auto& block : blocks) {
        std::snprintf(digits.data(), digits.size(), "%02x%02x%02x", static_cast<unsigned>(block[0]),
                      static_cast<unsigned>(block[1]), static_cast<unsigned>(block[2]));
        out << digits.data();
    }
    out << "\n";
}

// How many blocks of two pictures differ by more than some codes in one of their colours.
std::size_t others(const Blocks& one, const Blocks& other, int codes) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        bool differs = false;
        for (std::size_t c = 0; c < 3; ++c) differs = differs || std::abs(one[i][c] - other[i][c]) > codes;
        count += differs ? 1U : 0U;
    }
    return count;
}

// Other drivers round colours otherwise, and letters are another font's elsewhere: so blocks, and a share.
TEST(WindowTour, LooksAsItDid) {
    const auto data = oro::test::real_data("alps");
    if (!data) GTEST_SKIP() << "no real data";
    const fs::path folder = oro::test::scratch_folder();
    oro::test::Circumstances there;
    there.folder = folder;
    there.environment = {"SCREEN_SIZE=960x540", "WAYLAND_DISPLAY"};
    const auto tour = oro::test::run_program(
        {OROGRAPH_ON_DISPLAY, OROGRAPH_WINDOW_TOUR, OROGRAPH_PROGRAM, data->string()}, there);
    ASSERT_EQ(tour.exit_code, 0) << tour.out << tour.err;
    std::map<std::string, Blocks> shown;
    for (const std::string& name : oro::test::names_in(folder))
        if (name.ends_with(".xwd"))
            shown[name.substr(0, name.size() - 4)] = blocks_of(oro::test::bytes_of(folder / name));
    if (std::getenv("OROGRAPH_WRITE_GOLDENS") != nullptr) {
        std::ofstream out(goldens());
        for (const auto& [name, blocks] : shown) write_golden(out, name, blocks);
    }
    const auto expected = read_goldens();
    ASSERT_EQ(shown.size(), expected.size());
    constexpr int codes = 8;
    constexpr std::size_t most = columns * rows / 20;
    for (const auto& [name, blocks] : expected) {
        ASSERT_TRUE(shown.contains(name)) << name << " in\n" << tour.out;
        EXPECT_LE(others(shown[name], blocks, codes), most) << name << " looks otherwise";
    }
    // Each stop shows something else than the one before it.
    EXPECT_GT(others(shown["start"], shown["cell"], codes), most);
    EXPECT_GT(others(shown["cell"], shown["zoomed"], codes), most);
    EXPECT_GT(others(shown["zoomed"], shown["grabbed"], codes), most);
    EXPECT_GT(others(shown["grabbed"], shown["orbited"], codes), most);
    EXPECT_LE(others(shown["zoomed"], shown["undone"], codes), most) << "U leads back";
    EXPECT_LE(others(shown["start"], shown["home"], codes), most) << "Home is where a window starts";
    EXPECT_GT(others(shown["eiger"], shown["stood"], codes), most);
}

}  // namespace
