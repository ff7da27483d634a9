// Bands in skies: how long a picture holds one value of 8 bits from one row to the next, from the zenith to
// the horizon. Prints the table of docs/commands/styles.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::Outcome;
using oro::test::Pixels;

constexpr int width_px = 1920, height_px = 1080;
// As wide as this one value makes a band that can be seen.
constexpr int strip_px = 32;

// One channel, row by row.
using Channel = std::vector<std::uint8_t>;

Channel channel_of(const Pixels& pixels, std::size_t c) {
    Channel values;
    for (std::size_t i = c; i < pixels.rgb.size(); i += 3) values.push_back(pixels.rgb[i]);
    return values;
}

// The same without its dither, which is of mean 0 along a row: the mean over 65 pixels around each, rounded.
Channel without_dither(const Channel& values) {
    constexpr int reach = 32;
    Channel smooth(values.size());
    for (int y = 0; y < height_px; ++y) {
        const auto* const row = &values[static_cast<std::size_t>(y * width_px)];
        int first = 0, sum = std::accumulate(row, row + 2 * reach + 1, 0);
        for (int x = 0; x < width_px; ++x) {
            const int from = std::clamp(x - reach, 0, width_px - 1 - 2 * reach);
            if (from > first) {
                sum += row[from + 2 * reach] - row[first];
                first = from;
            }
            smooth[static_cast<std::size_t>(y * width_px + x)] =
                static_cast<std::uint8_t>(std::lround(double(sum) / (2 * reach + 1)));
        }
    }
    return smooth;
}

// The most rows, one below the other, in which `wide` pixels side by side hold one value. Black and white are
// none: beyond them there is no light to show.
int longest_run(const Channel& values, int wide) {
    int longest = 0;
    for (int x = 0; x + wide <= width_px; ++x) {
        int run = 0, held = -1;
        for (int y = 0; y < height_px; ++y) {
            const auto* const row = &values[static_cast<std::size_t>(y * width_px + x)];
            const bool one = *row != 0 && *row != 255 &&
                             std::all_of(row + 1, row + wide, [&](std::uint8_t v) { return v == *row; });
            run = one && *row == held ? run + 1 : one ? 1 : 0;
            held = one ? *row : -1;
            longest = std::max(longest, run);
        }
    }
    return longest;
}

// The longest of the three channels.
struct Runs {
    int column{}, strip{};
    void widen(const Channel& values) {
        column = std::max(column, longest_run(values, 1));
        strip = std::max(strip, longest_run(values, strip_px));
    }
};

class SkyBands : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();

    // From over all ground of the bundled region to the north, horizon at the bottom and zenith at the top.
    Pixels sky(const std::string& style, const std::string& sun) const {
        const fs::path picture = folder / "sky.png";
        const Outcome outcome = oro::test::run_orograph(
            {"shot", oro::test::bundled_data() / "jacksboro.tif", "--style", style, "--sun=" + sun, "--at",
             "36.5,-84.2", "--altitude", "3000", "--pitch", "45", "--fov", "90", "--size",
             std::to_string(width_px) + "x" + std::to_string(height_px), "-q", "--overwrite", "--out",
             picture});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return oro::test::pixels_of(picture);
    }
};

TEST_F(SkyBands, AreBrokenUpByDither) {
    const auto runs = [&](const Pixels& pixels, bool smooth) {
        Runs all;
        for (std::size_t c = 0; c < 3; ++c)
            all.widen(smooth ? without_dither(channel_of(pixels, c)) : channel_of(pixels, c));
        return all;
    };
    const Pixels before = sky("default", "0,38");
    ASSERT_EQ(before.rgb.size(), std::size_t{3} * width_px * height_px);
    const Runs plain = runs(before, false);
    std::printf("rows of one value: in a column, in a strip %d px wide; in brackets without dither\n",
                strip_px);
    std::printf("style default: %d, %d\n", plain.column, plain.strip);
    EXPECT_GT(plain.strip, 200) << "the measure sees no bands";
    Runs most, most_smooth;
    for (const char* elevation : {"60", "20", "5", "-5"}) {
        for (const char* azimuth : {"0", "90"}) {
            const Pixels pixels = sky("natural", std::string(azimuth) + "," + elevation);
            ASSERT_EQ(pixels.rgb.size(), before.rgb.size());
            const Runs drawn = runs(pixels, false), smooth = runs(pixels, true);
            std::printf("sun at %s degrees, %s: %d (%d), %d (%d)\n", elevation,
                        *azimuth == '0' ? "ahead" : "to the right", drawn.column, smooth.column, drawn.strip,
                        smooth.strip);
            EXPECT_LT(drawn.column, smooth.column);
            EXPECT_LE(drawn.strip, 16) << "seen were 4 to 14";
            most.column = std::max(most.column, drawn.column);
            most_smooth.column = std::max(most_smooth.column, smooth.column);
            most_smooth.strip = std::max(most_smooth.strip, smooth.strip);
        }
    }
    EXPECT_LT(2 * most.column, most_smooth.column);
    EXPECT_GT(most_smooth.strip, 100) << "these skies would have no bands anyway";
}

}  // namespace
