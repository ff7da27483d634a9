// What covers the ground by nature: pictures against the table's own numbers.
#include <array>
#include <cstdlib>
#include <functional>
#include <glm/vec3.hpp>

#include "tests/styles/drawn_style.h"

namespace oro {
namespace {

// At 46.5 N the snow line is at 2,700 m; grey 100 there, 1 of 255 more each 10 m.
std::string cover_style(const char* rock_deg, double shade_m, double level_m) {
    return R"({"colour_by": "cover", "light": "none", "background": "#000000",
        "tints": [{"above_snow_line_m": -1000, "colour": "#000000"},
                  {"above_snow_line_m": 1000, "colour": "#c8c8c8"}],
        "cover": {"snow_line": [{"lat_deg": 40, "H_m": 4000}, {"lat_deg": 50, "H_m": 2000}],
                  "rock": "#ff0000", "forest_m": -5000, )" +
           std::string(rock_deg) + R"(, "shade_m": )" + std::to_string(shade_m) + R"(, "level_m": )" +
           std::to_string(level_m) + "}}";
}
constexpr const char* never_rock = R"("rock_from_deg": 80, "rock_to_deg": 89)";

class Cover : public test::StyleTest {
  protected:
    // Of the middle of a slope in a style: rises by `rise` towards the north, and is 2,700 m + `H_m` high
    // there.
    glm::ivec3 seen(const std::string& text, double rise, double H_m) {
        return seen_over(
            text, [&](int row) { return 2700.0 + H_m + rise * 30.0 * (30 - row); }, false);
    }
    // Of the middle of ground whose height goes by the row, of posts 30 m apart.
    glm::ivec3 seen_over(const std::string& text, const std::function<double(int)>& H_m, bool means) {
        Region region{std::vector<RegionGrid>(1)};
        region.grids[0].field =
            test::square_field(46.5, 8.0, 30.0, 61, [&](int row, int) { return H_m(row); });
        const Camera camera = test::straight_down(region.grids[0].field, 30.0, 3.0, 17);
        const auto style = style_of(text, ".json", camera, region.grids[0].field);
        EXPECT_TRUE(style.ok()) << style.error().line();
        if (!style.ok()) return {};
        const auto picture = drawn(region, camera, *style, means);
        if (!picture) return {};
        const std::size_t pixel = 4 * (8 * 17 + 8);
        return {picture->rgba[pixel], picture->rgba[pixel + 1], picture->rgba[pixel + 2]};
    }
    void expect_grey(const glm::ivec3& colour, int grey) {
        // Half a pixel is 2.6 m, on a slope of 30 degrees 1.5 m of height; and rounding.
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(colour[i], grey, 1) << "of 255";
    }
};

TEST_F(Cover, GoesByHeightAboveTheSnowLine) {
    expect_grey(seen(cover_style(never_rock, 0, 0), 0.0, 0.0), 100);
    expect_grey(seen(cover_style(never_rock, 0, 0), 0.0, 500.0), 150);
    expect_grey(seen(cover_style(never_rock, 0, 0), 0.0, -700.0), 30);
}

TEST_F(Cover, SlopesTowardsThePoleLieLower) {
    const double slope_30 = std::tan(std::numbers::pi / 6.0);
    expect_grey(seen(cover_style(never_rock, 200, 0), -slope_30, 0.0), 120);  // falls to the north
    expect_grey(seen(cover_style(never_rock, 200, 0), slope_30, 0.0), 80);
}

TEST_F(Cover, LevelGroundHighUpIsIce) {
    expect_grey(seen(cover_style(never_rock, 0, 400), 0.0, 0.0), 140);
    expect_grey(seen(cover_style(never_rock, 0, 400), 0.0, -900.0), 10);  // not in the valley
    expect_grey(seen(cover_style(never_rock, 0, 400), 0.3, 0.0), 100);    // nor on a slope of 17 degrees
}

// By means: a level crest of 180 m between slopes of 27 degrees is none, level ground of a kilometre is.
TEST_F(Cover, IceLiesOnWideLevelGround) {
    std::string text = cover_style(never_rock, 0, 400);
    text.insert(1, R"("footprint": "mean", )");
    const auto crest = [](int row) { return 2700.0 - 15.0 * std::max(std::abs(row - 30) - 3, 0); };
    expect_grey(seen_over(text, crest, true), 100);
    expect_grey(seen_over(text, crest, false), 140);  // without them the place alone is known
    const auto wide = [](int row) { return 2700.0 - 15.0 * std::max(std::abs(row - 30) - 17, 0); };
    expect_grey(seen_over(text, wide, true), 140);
}

TEST_F(Cover, SteepGroundIsRock) {
    const char* const rock = R"("rock_from_deg": 30, "rock_to_deg": 40)";
    EXPECT_EQ(seen(cover_style(rock, 0, 0), std::tan(1.05), 0.0), glm::ivec3(255, 0, 0));  // 60 degrees
    expect_grey(seen(cover_style(rock, 0, 0), std::tan(0.5), 0.0), 100);                   // 29
}

}  // namespace
}  // namespace oro
