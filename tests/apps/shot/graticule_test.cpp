// --graticule as users meet it.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
using namespace oro::test;
namespace fs = std::filesystem;

Outcome shoot_with(const fs::path& out, const Words& more) {
    return run_orograph(joined({"shot", bundled(), "--at", "36.5,-84.3", "--above", "3000", "--heading", "30",
                                "--pitch", "-40", "--size", "480x320", "--out", out, "-q"},
                               more));
}

// Share of the pixels that differ.
double share_of_others(const Pixels& one, const Pixels& other) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < one.rgb.size(); i += 3)
        count += one.rgb[i] != other.rgb[i] || one.rgb[i + 1] != other.rgb[i + 1] ||
                         one.rgb[i + 2] != other.rgb[i + 2]
                     ? 1U
                     : 0U;
    return 3.0 * static_cast<double>(count) / static_cast<double>(one.rgb.size());
}

TEST(ShotGraticule, LiesOverTheGroundAndComesBackWithTheView) {
    const fs::path folder = scratch_folder(), plain = folder / "plain.png", lined = folder / "lined.png";
    ASSERT_EQ(shoot_with(plain, {}).exit_code, 0);
    const Outcome drawn = shoot_with(lined, {"--graticule", "geographic"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const Pixels without = pixels_of(plain), with = pixels_of(lined);
    ASSERT_EQ(with.rgb.size(), without.rgb.size());
    const double share = share_of_others(without, with);
    std::printf("%.2f %% of the pixels are lines or their values\n", 100.0 * share);
    EXPECT_GT(share, 0.01);
    EXPECT_LT(share, 0.30) << "lines, and not all of it";
    const auto view = nlohmann::json::parse(view_in(lined));
    EXPECT_EQ(view.at("graticule"), "geographic");
    EXPECT_FALSE(nlohmann::json::parse(view_in(plain)).contains("graticule"));
    const Outcome again = run_orograph({"shot", "--view", lined, "--out", folder / "again.png", "-q"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(bytes_of(folder / "again.png") == bytes_of(lined));
}

TEST(ShotGraticule, IsNotForMaps) {
    expect_refusal(run_orograph({"shot", bundled(), "--ortho", "--graticule", "geographic", "--out",
                                 scratch_folder() / "map.png"}),
                   usage, {"--graticule", "--ortho"});
}

}  // namespace
