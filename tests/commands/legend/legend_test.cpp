// What a legend says and where its needle points: against figures worked out by hand.
#include "apps/legend/legend.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/legend/colour_key.h"
#include "tests/support/made_terrain.h"

namespace oro {
namespace {

View straight_down(double heading_deg) {
    View view;
    view.camera = {{46.0, 8.0, 10000.0}, {heading_deg, -90.0, 0.0}, 45.0, 400, 400};
    return view;
}
SeenPlace place(double lat_deg, double lon_deg, double away_m) {
    SeenPlace seen;
    seen.lat_deg = lat_deg;
    seen.lon_deg = lon_deg;
    seen.seen_distance_m = away_m;
    return seen;
}

// Straight down with north at heading 0 on top; the picture turns against the eye.
TEST(LegendNorth, TurnsAgainstTheEye) {
    const auto middle = place(46.0, 8.0, 10000.0);
    const auto off_deg = [&](double heading_deg, double expected_deg) {
        return std::abs(
            std::remainder(north_in_picture_deg(straight_down(heading_deg), middle) - expected_deg, 360.0));
    };
    EXPECT_LT(off_deg(0.0, 0.0), 1e-3);
    EXPECT_LT(off_deg(90.0, 270.0), 1e-3);
    EXPECT_LT(off_deg(205.0, 155.0), 1e-3);
}

// Level ground seen at 30 degrees down, looking east: north is to the left, exactly. Looking at N 45 E: north
// goes away to the left; its way up the picture is foreshortened by sin 30 = 1/2, so it leans atan(2) = 63.4
// degrees.
TEST(LegendNorth, IsForeshortenedAsTheGroundIs) {
    View view;
    const double down_m = 1000.0, level_m = down_m * std::sqrt(3.0);
    const double per_lat = 111132.0, per_lon = 111320.0 * std::cos(45.0 * M_PI / 180.0) * 1.0017;
    view.camera = {{45.0, 7.0, down_m}, {90.0, -30.0, 0.0}, 45.0, 400, 300};
    EXPECT_NEAR(north_in_picture_deg(view, place(45.0, 7.0 + level_m / per_lon, 2000.0)), 270.0, 0.3);
    view.camera.attitude.heading_deg = 45.0;
    const double each_m = level_m / std::sqrt(2.0);
    EXPECT_NEAR(north_in_picture_deg(view, place(45.0 + each_m / per_lat, 7.0 + each_m / per_lon, 2000.0)),
                360.0 - 63.435, 0.5);
    EXPECT_NEAR(north_in_picture_deg(view, {}), 315.0, 1e-9) << "no ground in the middle";
}

// From 5 m over a valley at N 46.62 E 8.04 up to a slope in the south-west, at 23.8 degrees: the plane
// through the slope is seen from below. North is then where a compass in the hand has it, behind the viewer
// to the right. With the camera 10 degrees clockwise the horizon leans the other way, and the compass, too.
TEST(LegendNorth, IsThatOfACompassWhereTheMiddleIsAboveTheEye) {
    View view;
    view.camera = {{46.62, 8.04, 1020.0}, {215.0, 23.8, 0.0}, 45.0, 640, 360};
    auto slope = place(46.58, 8.0, 5900.0);
    slope.h_m = 3400.0;
    EXPECT_NEAR(north_in_picture_deg(view, slope), 145.0, 1e-9);
    view.camera.attitude.roll_deg = 10.0;
    EXPECT_NEAR(north_in_picture_deg(view, slope), 135.0, 1e-9);
    view.camera.attitude = {0.0, 23.8, 0.0};
    EXPECT_NEAR(north_in_picture_deg(view, slope), 0.0, 1e-9) << "a view to the north";
}

// At 12 degrees down, to N 30 E: north leans atan(tan(30) / sin(12)) = 70.2 degrees to the left; at 8 degrees
// it would be 76.4, and a compass says 30.
TEST(LegendNorth, IsThatOfACompassAtGrazingAngles) {
    View view;
    view.camera = {{45.0, 7.0, 100.0}, {30.0, -12.0, 0.0}, 45.0, 400, 300};
    EXPECT_NEAR(north_in_picture_deg(view, place(45.004, 7.003, 500.0)), 360.0 - 70.2, 0.1);
    view.camera.attitude.pitch_deg = -8.0;
    EXPECT_NEAR(north_in_picture_deg(view, place(45.004, 7.003, 500.0)), 330.0, 1e-9);
}

// 2 tan(22.5 degrees) = 0.828427 of the distance fills 400 rows.
TEST(LegendScale, IsThatOfThePicturesMiddle) {
    EXPECT_NEAR(*metres_a_pixel(straight_down(0.0), place(46.0, 8.0, 10000.0)), 20.7107, 1e-4);
    EXPECT_FALSE(metres_a_pixel(straight_down(0.0), {}));
    EXPECT_EQ(round_length(1999.0), 1000.0);
    EXPECT_EQ(round_length(2000.0), 2000.0);
    EXPECT_EQ(round_length(7300.0), 5000.0);
    EXPECT_EQ(round_length(0.3), 0.2);
}

// Of a narrow picture, straight down from 10 km; its em is 11 px, its margin 15.4 px.
struct NarrowStrip {
    int width_px;
    std::vector<std::uint8_t> rgb;
    // Whether a row has nothing but paper in some columns.
    [[nodiscard]] bool is_paper(int row, int from, int to) const {
        for (int column = from; column < to; ++column)
            if (rgb[3 * static_cast<std::size_t>(row * width_px + column)] != 250) return false;
        return true;
    }
    [[nodiscard]] bool has_ink(int first_row, int end_row, int from, int to) const {
        for (int row = first_row; row < end_row; ++row)
            if (!is_paper(row, from, to)) return true;
        return false;
    }
};
NarrowStrip narrow_strip(int width_px, double heading_deg) {
    View view = straight_down(heading_deg);
    view.camera.width_px = width_px;
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::made_field(46.5, 7.5, 20.0, 20, 20, [](double, double) { return 0.0F; });
    Style style{};
    style.frame.colour_by = gpu::colour_by_slope;
    style.frame.tint_count = 2;
    style.frame.tints[1] = {60.0F, gpu::vec3(1.0F)};
    const auto ground = RegionGround::of(region, 1.0);
    EXPECT_TRUE(ground.ok());
    auto strip = legend_strip(view, region, style, place(46.0, 8.0, 10000.0), **ground);
    EXPECT_TRUE(strip.ok()) << strip.error().line();
    return {width_px, std::move(strip).value()};
}

// The title of the key begins 4.6 em below the margin, at 66 px, its letters 2 px farther down; where the
// needle pointed down, N reached to 68 px.
TEST(LegendStrip, LeavesRoomForTheNeedlesLetter) {
    const NarrowStrip south = narrow_strip(400, 180.0);
    EXPECT_TRUE(south.has_ink(56, 64, 0, 80)) << "N";
    EXPECT_TRUE(south.is_paper(66, 0, 80));
    EXPECT_TRUE(south.has_ink(68, 76, 0, 80)) << "the title";
}

TEST(LegendStrip, KeepsTheScalesCaptionOffItsRim) {
    const NarrowStrip strip = narrow_strip(least_legend_px, 0.0);
    for (int row = 2; row < 85; ++row) EXPECT_TRUE(strip.is_paper(row, 187, 200)) << row;
    // On more lines than one: something is written where one line would have ended, 4.6 em below the margin.
    EXPECT_TRUE(strip.has_ink(66, 80, 92, 187));
}

TEST(LegendLines, SayEyeSunAndData) {
    View view;
    view.camera = {{46.67, -8.06, 2500.0}, {205.0, -4.5, 0.0}, 45.0, 800, 400};
    view.tau_px = 0.5;
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field =
        test::made_field(47.0, -9.0, 20.0, 20, 30, [](double, double) { return 1000.0F; });
    SourceReport source;
    source.path = "tiles/N46W009.hgt";
    region.grids[0].sources.push_back(source);
    Style style{};
    style.sun = {315.0, 38.0, {}};
    const auto lines = legend_lines(view, region, style);
    ASSERT_EQ(lines.size(), 4U);
    EXPECT_EQ(
        lines[0],
        "Eye: 46.67000° N, 8.06000° W, 2,500 m above sea level, 1,500 m above the ground; looking south-west "
        "(205°), 4.5° down; angle of view 45°");
    EXPECT_EQ(lines[1], "Sun: from the north-west (315°), 38° above the horizon");
    EXPECT_EQ(lines[2], "Heights: N46W009.hgt");
    EXPECT_EQ(lines[3].substr(lines[3].find(';')),
              "; detail that is left out moves nothing by more than 0.5 px");
    style.sun = {141.5, 36.5, SunTime{"2026-03-20T09:35:26Z", 1773999326}, true};
    EXPECT_EQ(
        legend_lines(view, region, style)[1],
        "Sun: from the south-east (142°), 36.5° above the horizon, 2026-03-20T09:35:26Z (ten by the sun "
        "there; no time was asked for)");
    view.tells_paths = false;
    EXPECT_EQ(legend_lines(view, region, style)[2], "Heights: 1 file");
}

TEST(LegendColours, AreTheStyles) {
    View view;
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::made_field(
        47.0, 8.0, 20.0, 3, 3, [](double lat, double) { return lat > 46.99 ? 3000.0F : 500.0F; });
    Style style{};
    style.frame.tint_count = 2;
    style.frame.tints_as_codes = 1;
    style.frame.tints[0] = {0.0F, gpu::vec3(0.0F)};
    style.frame.tints[1] = {4000.0F, gpu::vec3(1.0F, 0.0F, 0.5F)};
    ColourKey key = colour_key(view, region, style);
    EXPECT_EQ(key.shape, KeyShape::bar);
    EXPECT_EQ(key.low, 500.0);
    EXPECT_EQ(key.high, 3000.0);
    EXPECT_EQ(key.ticks, (std::vector<double>{1000.0, 2000.0, 3000.0}));
    EXPECT_EQ(key.colour(2000.0), (StripColour{128, 0, 64}));
    EXPECT_EQ(key.colour(9000.0), (StripColour{255, 0, 128}));
    style.frame.colour_by = gpu::colour_by_aspect;
    EXPECT_EQ(colour_key(view, region, style).shape, KeyShape::wheel);
    style.frame.tint_count = 1;
    EXPECT_EQ(colour_key(view, region, style).shape, KeyShape::none);
}

// As in the style of contours: what differs by a hair from low to high ground is no scale.
TEST(LegendColours, ThatNobodyTellsApartAreNoScale) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = test::made_field(
        47.0, 8.0, 20.0, 3, 3, [](double lat, double) { return lat > 46.99 ? 2000.0F : 500.0F; });
    Style style{};
    style.frame.tint_count = 2;
    style.frame.tints_as_codes = 1;
    style.frame.tints[0] = {0.0F, gpu::vec3(0.90F)};
    style.frame.tints[1] = {4000.0F, gpu::vec3(1.0F)};
    const ColourKey key = colour_key(View(), region, style);
    EXPECT_EQ(key.shape, KeyShape::none);
    EXPECT_EQ(key.title, "");
    style.frame.tints[0] = {0.0F, gpu::vec3(0.5F)};
    EXPECT_EQ(colour_key(View(), region, style).shape, KeyShape::bar);
}

}  // namespace
}  // namespace oro
