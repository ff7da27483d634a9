// The light of the styles `relief` and `contours`, on level ground and on slopes of one tint.
#include <cstdio>

#include "tests/styles/drawn_style.h"

namespace oro {
namespace {

// Mean codes (of red, green and blue together) of level ground, of slopes to the west and of slopes to the
// east.
struct ReliefCodes {
    double level{}, west{}, east{};
};

class ReliefLightTest : public test::StyleTest {
  protected:
    // Level ground in the north, ridges from north to south with slopes of 27 degrees in the south.
    static Region ridges() {
        Region region{std::vector<RegionGrid>(1)};
        region.grids[0].field = test::square_field(46.5, 8.0, 30.0, 80, [](int row, int column) {
            const int in_ridge = column % 16;
            return row < 40 ? 1500.0 : 1500.0 + 15.0 * std::min(in_ridge, 16 - in_ridge);
        });
        return region;
    }

    ReliefCodes seen_in(const char* style_name, const SunDirection& sun) {
        const Region region = ridges();
        View view;
        view.style = (test::bundled_data() / "styles" / (std::string(style_name) + ".json")).string();
        view.camera = test::straight_down(region.grids[0].field, 30.0, 70.0, 210);
        view.sun = sun;
        auto style = load_style(view, region.grids[0].field);
        EXPECT_TRUE(style.ok()) << style.error().line();
        gpu::FrameStyle& frame = style->frame;
        frame.tint_count = 1;  // one tint, and heights do not matter
        frame.tints[0].colour = gpu::vec3(0.7F, 0.7F, 0.6F);
        frame.relief_light.low_H_m = 100.0F;
        frame.relief_light.high_H_m = 200.0F;
        frame.contours.interval_m = 0.0F;
        const auto picture = drawn(region, view.camera, *style);
        EXPECT_TRUE(picture.has_value());
        ReliefCodes sum;
        int level = 0, west = 0, east = 0;
        for (std::size_t i = 0; picture && i < picture->points.size(); ++i) {
            const DrawnPoint& point = picture->points[i];
            if (point.background()) continue;
            const int codes = picture->rgba[4 * i] + picture->rgba[4 * i + 1] + picture->rgba[4 * i + 2];
            const double in_ridge = std::fmod(point.column, 16.0);
            const auto add = [codes](double& to, int& count) { to += codes, ++count; };
            if (point.row < 35.0) add(sum.level, level);
            if (point.row > 45.0 && in_ridge > 3.0 && in_ridge < 5.0) add(sum.west, west);
            if (point.row > 45.0 && in_ridge > 11.0 && in_ridge < 13.0) add(sum.east, east);
        }
        EXPECT_GT(std::min({level, west, east}), 500);
        sum = {sum.level / level, sum.west / west, sum.east / east};
        std::printf("%s, sun %.0f,%.0f: level %.1f, slopes to the west %.1f, to the east %.1f\n", style_name,
                    sun.azimuth_deg, sun.elevation_deg, sum.level, sum.west, sum.east);
        return sum;
    }
};

TEST_F(ReliefLightTest, SlopesTowardsTheSunAreLighterAndThoseAwayDarker) {
    for (const char* const name : {"relief", "contours"}) {
        const ReliefCodes seen = seen_in(name, {270.0, 30.0});
        EXPECT_GT(seen.west, seen.level + 10.0) << name;
        EXPECT_LT(seen.east, seen.level - 100.0) << name;
    }
}

// Found: a sun 3 degrees below the horizon lit slopes that faced it fully.
TEST_F(ReliefLightTest, BelowTheHorizonTheSunLightsNoSlope) {
    for (const char* const name : {"relief", "contours"}) {
        const ReliefCodes seen = seen_in(name, {270.0, -3.0}), day = seen_in(name, {270.0, 3.0});
        EXPECT_LT(seen.level, day.west - 100.0) << name;  // all is in shade,
        EXPECT_LE(seen.west, seen.level) << name;
        EXPECT_NEAR(seen.west, seen.east, 1.0) << name;   // ... on all sides alike,
        EXPECT_LT(seen.west, seen.level - 10.0) << name;  // ... and relief is seen
    }
}

}  // namespace
}  // namespace oro
