// Predicted effects against what they are by hand.
#include "core/effects/effects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "tests/core/effects/effect_scene.h"

namespace oro {
namespace {

using test::half_way_down, test::sea_level, test::undulation;
using Scene = test::EffectScene;

// The margins that bounds carry (core/effects/effects.cpp).
constexpr double between_samples = 1.5;
constexpr double unlike_the_truth = 2.5;
constexpr double nearer = 1.3;

// The bound holds the true value and is no more than `margin` times it; the typical one is it; each to a
// share.
void expect_size(const EffectSize& size, double worst_m, double typical_m, double worst_px, double typical_px,
                 double margin, double share) {
    EXPECT_GE(size.worst_m, worst_m * (1.0 - share));
    EXPECT_LE(size.worst_m, worst_m * margin * (1.0 + share));
    EXPECT_NEAR(size.typical_m, typical_m, typical_m * share);
    EXPECT_GE(size.worst_px, worst_px * (1.0 - share));
    EXPECT_LE(size.worst_px, worst_px * margin * (1.0 + share));
    EXPECT_NEAR(size.typical_px, typical_px, typical_px * share);
}

// 100 m above it, eastward, a picture of one column and three rows whose pixels look 0.6, 0.8 and 1.0 degrees
// down: tan(fov / 2) = 1.5 tan(0.2 deg), and 1 / tan(0.2 deg) = 286.4777 pixels to a tangent.
Camera eastward_over_the_sea() {
    Camera camera;
    camera.eye = {0.0, 0.1, 100.0};
    camera.attitude = {90.0, -0.8, 0.0};
    camera.vertical_fov_deg =
        2.0 * std::atan(1.5 * std::tan(0.2 * std::numbers::pi / 180.0)) * 180.0 / std::numbers::pi;
    camera.height_px = 3;
    return camera;
}

// k' = 0.13 exp(-100 / 8434) = 0.128468 at the eye's 100 m; R = sqrt(N M) = b = 6,356,752.3 m on the equator.
// A sight line that falls by t is 100 m - t s + (1 / a - k' / R) s^2 / 2 above the sea: it meets it at
// 10,231.6, 7,431.6 and 5,863.5 m. k' s^2 / (2 R) there: 1.05783, 0.55808 and 0.34741 m, and that is seen
// from s. Source: Torge & Müller, Geodesy, 4th ed. 2012, section 5.1.1.2. Second order in s / R: good to 0.2
// %.
TEST(Effects, RefractionLeftOut) {
    const Scene scene(sea_level(), eastward_over_the_sea());
    EXPECT_NEAR(scene.prediction.nearest_m(), 5863.5, 1.5);
    EXPECT_NEAR(scene.prediction.median_distance_m(), 7431.6, 1.5);
    // A picture without refraction shows ground at 10,351 m.
    expect_size(scene.size(EffectKind::refraction), 1.0827, 0.55808, 286.4777 * 1.0827 / 10351.0,
                286.4777 * 0.55808 / 7431.6, between_samples, 0.002);
}

// The sea is seen at 10,231.6, 7,431.6 and 5,863.5 m (as above), and the plane has it s^2 / (2 a)
// higher: 8.2067, 4.3296 and 2.6953 m. (The plane's picture shows nearer ground: the lines meet the plane at
// 9,462.6 m.)
TEST(Effects, CurvatureLeftOut) {
    const Scene scene(sea_level(), eastward_over_the_sea());
    expect_size(scene.size(EffectKind::flat), 8.2067, 4.3296, 286.4777 * 8.2067 / 10231.6,
                286.4777 * 4.3296 / 7431.6, between_samples, 0.003);
}

// A degree along the equator is as much shorter as the sphere is smaller: 6,371,008.8 / 6,378,137 of what it
// is, or s * 1.11760e-3 nearer: 11.435, 8.3056 and 6.5531 m. So from 100 m the sea there is seen 100 m / s
// * 1.11885e-3 lower, and less by what the sphere bulges less, s / (2 a) * 1.1e-3 * 2: at 5,863.5 m 1.9082e-5
// + 0.0514e-5.
TEST(Effects, SphereForEllipsoid) {
    const Scene scene(sea_level(), eastward_over_the_sea());
    expect_size(scene.size(EffectKind::sphere), 11.435, 8.3056, 286.4777 * 1.9082e-5, 286.4777 * 1.5055e-5,
                between_samples, 0.02);
}

// N rises by 40 m a degree, 111,319.49 m along the equator: the sea does, too, and is met at 9,843.0, 7,231.1
// and 5,739.7 m from 100 m over N(eye) = 14 m. N(p) - N(eye) there: 3.5368, 2.5983 and 2.0624 m; on the
// picture the same angle everywhere: 286.4777 * 40 / 111,319.49 = 0.10294 px.
TEST(Effects, GeoidLeftOut) {
    HeightField field = sea_level();
    field.undulation = undulation(10.0, 40.0);
    Camera camera = eastward_over_the_sea();
    camera.eye.h_m = 114.0;
    const Scene scene(std::move(field), camera);
    expect_size(scene.size(EffectKind::geoid), 3.5368, 2.5983, 0.10294, 0.10294, unlike_the_truth, 0.003);
}

// Eye and ground are off by the same: on the picture what is left is second order; along the ground a smaller
// Earth is 50 m / a * 10,231.6 m = 0.0802 m shorter.
TEST(Effects, GeoidThatIsTheSameEverywhere) {
    HeightField field = sea_level();
    field.undulation = undulation(50.0, 0.0);
    Camera camera = eastward_over_the_sea();
    camera.eye.h_m = 150.0;
    const Scene scene(std::move(field), camera);
    EXPECT_NEAR(scene.size(EffectKind::geoid).worst_m, unlike_the_truth * 0.0802, 0.002);
    EXPECT_LT(scene.size(EffectKind::geoid).worst_px, 1.0e-4);
}

// 16 bits with a step of 2^11 / 2,048 m = 1 m: what a height is off them. 1.207107 * 0.25 / 2,000
// = 1.50889e-4 px. Steps of 1 / 2,048 m: half of one is 0.000244 m.
TEST(Effects, StepsOfHeights) {
    EarthParameters world;
    world.grids.front().sixteen = {true, 11, 0};
    // 0.25 m goes to the step of 0 m: 0.25 m off, everywhere.
    const Scene scene(test::level_at(0.25), half_way_down(), world);
    EXPECT_NEAR(scene.prediction.nearest_m(), 1414.0, 0.3);
    const EffectSize sixteen = scene.size(EffectKind::steps_i16);
    EXPECT_NEAR(sixteen.worst_m, nearer * 0.5, 1e-9) << "half a step at most";
    EXPECT_NEAR(sixteen.typical_m, 0.25, 0.00025);
    EXPECT_NEAR(sixteen.worst_px, nearer * 2.0 * 1.50889e-4, 3.0e-7);
    EXPECT_NEAR(sixteen.typical_px, 1.50889e-4, 1.5e-7);
    expect_size(scene.size(EffectKind::steps_f32), 0.000244141, 0.000244141, 1.47352e-7, 1.47352e-7, nearer,
                0.001);
    EXPECT_NEAR(scene.size(EffectKind::steps_f32).typical_m, 0.000244140625, 1e-15);
}

// A step is as fine as 65,534 of them allow: 4,000 m in steps of 2^-11 m are 8,192,000, 2^7 of them 125 to a
// code: shift 7, a step of 0.0625 m, at most 0.03125 m off.
TEST(Effects, SixteenBitsOfAKnownRange) {
    EarthParameters world;
    world.grids.front().sixteen = sixteen_bits(height_steps(0.0), height_steps(4000.0));
    ASSERT_EQ(world.grids.front().sixteen.shift, 7);
    // 0.02 m goes to 0, 0.05 m to 0.0625.
    const Scene low(test::level_at(0.02), half_way_down(), world),
        high(test::level_at(0.05), half_way_down(), world);
    EXPECT_NEAR(low.size(EffectKind::steps_i16).typical_m, 0.02, 1e-8);
    EXPECT_NEAR(high.size(EffectKind::steps_i16).typical_m, 0.0125, 1e-8);
}

// 3.2e-7 of 1,414.3 m and of a cell's diagonal, 131.2 m (docs/PLACEMENT.md); 4 * 2^-24 of
// 1,414.3 m, along the sight line; and a 256th of a pixel along each axis, sqrt(2) / 256 / 1.207107 of it.
TEST(Effects, RoundingWithTheDistance) {
    const Scene scene(sea_level(), half_way_down());
    const double placed_m = 4.9456e-4, placed_px = 1.207107 * placed_m / 1414.3;
    expect_size(scene.size(EffectKind::placement), placed_m, placed_m, placed_px, placed_px, nearer, 0.001);
    expect_size(scene.size(EffectKind::depth), 3.3720e-4, 3.3720e-4, 0.0, 0.0, nearer, 0.001);
    const EffectSize corners = scene.size(EffectKind::pixel_grid);
    EXPECT_NEAR(corners.typical_m, 6.47250, 0.007);
    EXPECT_NEAR(corners.typical_px, 0.00552427, 1e-8);
    EXPECT_NEAR(corners.worst_px, 0.00552427, 1e-8);
}

// Ground that rises by 3 in 4 to the east (0.75 * 111,319.49 m a degree): moved across, it is met 5/4 as far
// away.
TEST(Effects, SlopesMultiply) {
    Camera camera = half_way_down();
    camera.eye = {0.0, 0.5, 0.5 * 83489.6 + 1000.0};
    camera.attitude.pitch_deg = -90.0;
    const Scene scene(test::world_field(1200.0, 120, 0, 241, 1201,
                                        [](double, double lon_deg) { return 83489.6 * lon_deg; }),
                      camera);
    // At 42 km the parallel is 0.7 % longer, the slope as much less.
    EXPECT_NEAR(scene.size(EffectKind::pixel_grid).typical_m,
                1.25 * std::numbers::sqrt2 / 256.0 / 1.207107 * 1000.0, 0.04);
}

// The source's own figure, as it is stated; half of a normal distribution's errors are within 0.6745 / 1.6449
// = 0.41 of it. Source: M. Abramowitz, I. Stegun, Handbook of Mathematical Functions, 1964, table 26.5.
TEST(Effects, SourceSaysItsAccuracyOrNothing) {
    EarthParameters world;
    const Scene silent(sea_level(), half_way_down(), world);
    const auto none = silent.prediction.size(EffectKind::source, 1.0);
    ASSERT_TRUE(none.ok());
    EXPECT_FALSE(none.value().has_value());
    world.grids.front().source_le90_m = 16.0;
    const Scene scene(sea_level(), half_way_down(), world);
    const EffectSize size = scene.size(EffectKind::source);
    EXPECT_EQ(size.worst_m, 16.0);
    EXPECT_NEAR(size.typical_m, 6.56, 1e-9);
    // 1.207107 * 16 / 2,000 = 0.0096569 px; 16 m nearer by 0.8 %.
    EXPECT_GE(size.worst_px, 0.0096569);
    EXPECT_LE(size.worst_px, 0.0096569 * nearer * 1.01);
    EXPECT_NEAR(size.typical_px, 0.41 * 0.0096569, 5.0e-5);
}

// The sagitta of a triangle's longest edge: a / 8 times its angle squared, which is tall^2 + (wide cos
// lat)^2. A cell of a degree at the equator: 2 * (pi / 180)^2 / 8 * 6,378,137 m = 485.7 m. 3": 2 *
// (1.454441e-5)^2 / 8 * a = 0.3373 mm; at 60 N 1.25 / 2 of that, 0.2108 mm.
TEST(Effects, FlatTrianglesOfLargeAndSmallCells) {
    Camera camera = half_way_down();
    camera.eye = {0.3, 0.4, 1.0e6};
    camera.attitude.pitch_deg = -90.0;
    const Scene degrees(test::world_field(1.0, 2, -2, 5, 5, [](double, double) { return 0.0; }), camera);
    const EffectSize large = degrees.size(EffectKind::flat_cells);
    EXPECT_NEAR(large.typical_m, 485.7, 0.5);
    EXPECT_GE(large.worst_m, 485.2);
    EXPECT_LE(large.worst_m, 486.2 * nearer);
    // Straight up and down at the picture's centre: what is seen is sideways, sin(0.3 deg) (1/4 + 1/8) of
    // (pi / 180)^2 a: 3.815 m at 1e6 m.
    EXPECT_NEAR(large.worst_px, nearer * 1.207107 * 3.815 / 1.0e6, 2.0e-7);
    const Scene seconds(sea_level(), half_way_down());
    EXPECT_NEAR(seconds.size(EffectKind::flat_cells).typical_m, 3.373e-4, 1.0e-7);
    camera.eye = {59.95, 0.05, 1000.0};
    const Scene north(test::world_field(1200.0, 72000, 0, 121, 121, [](double, double) { return 0.0; }),
                      camera);
    // Sideways: sin(59.95 deg) (1/4 + cos(59.95 deg) / 8) of (3")^2 a = 1.34924 mm, 0.3651 mm; with 0.2109 mm
    // up 0.4216 mm.
    EXPECT_NEAR(north.size(EffectKind::flat_cells).typical_m, 4.216e-4, 1.0e-6);
}

// ECEF of some 6.4e6 m in float32: half a unit in the last place is 0.25 m along x at the equator (2^22 ..
// 2^23), at 46.5 N, 8.5 E along x and z, and 0.03 m along y (2^19 .. 2^20): 0.355 m at most on level ground.
// 1,234.567 m is at no float's place.
TEST(Effects, PostsInFloat32) {
    Camera camera;
    camera.eye = {46.9, 8.1, 2500.0};
    camera.attitude = {135.0, -30.0, 0.0};
    camera.width_px = 160;
    camera.height_px = 90;
    const Scene scene(
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 241, 241, [](double, double) { return 1234.567; }),
        camera);
    const EffectSize posts = scene.size(EffectKind::float32_posts),
                     view = scene.size(EffectKind::float32_view);
    EXPECT_GT(posts.worst_m, 0.1);
    EXPECT_LE(posts.worst_m, 3.0 * 0.355);
    EXPECT_GT(posts.typical_m, 0.01);
    EXPECT_LT(posts.typical_m, 0.355);
    // A product with a matrix rounds three times more, sums of up to 6.4e6 m: each 0.25 m at most, along
    // three axes.
    EXPECT_GE(view.worst_m, posts.worst_m);
    EXPECT_LE(view.worst_m, nearer * (0.355 + 8.0 * 0.38 * std::numbers::sqrt3));
}

// Ground that is off by its longitude's share of a degree, times 10 m: the worst and the median of what is
// seen, without a margin. From 45 degrees down one pixel of half a width sees 0.1 to 0.13 degrees.
TEST(Effects, WhatWasFoundHasNoMargin) {
    const Scene scene(sea_level(), half_way_down());
    const auto off_m = [](const ViewSample& sample) { return 10.0 * sample.point.lon_deg; };
    double worst_m = 0.0;
    const EffectSize found = scene.prediction.found_off_by([&](const ViewSample& sample) {
        EXPECT_EQ(sample.from_seen_px, 0.0);
        worst_m = std::max(worst_m, off_m(sample));
        return off_m(sample);
    });
    EXPECT_GT(worst_m, 1.0);
    EXPECT_EQ(found.worst_m, worst_m);
    EXPECT_GT(found.typical_m, 1.0);
    EXPECT_LE(found.typical_m, worst_m);
}

// H = 0.25 m (row - 60)^2: a post lies 0.25 m n^2 off the middle of those n rows to either side. Columns bend
// by nothing.
TEST(Effects, InterpolationBetweenPosts) {
    Camera camera = half_way_down();
    camera.eye = {0.06, 0.05, 2000.0};
    camera.attitude.pitch_deg = -90.0;
    camera.vertical_fov_deg = 10.0;
    camera.width_px = 40;
    camera.height_px = 30;
    const Scene scene(test::world_field(1200.0, 132, 0, 121, 121,
                                        [](double lat_deg, double) {
                                            const double row = std::round(132.0 - 1200.0 * lat_deg);
                                            return 0.25 * (row - 60.0) * (row - 60.0);
                                        }),
                      camera);
    for (const int apart : {1, 2, 4}) {
        const EffectSize size = scene.prediction.interpolation(apart);
        EXPECT_NEAR(size.worst_m, 0.25 * apart * apart, 1e-6) << apart;
        EXPECT_NEAR(size.typical_m, 0.125 * apart * apart, 1e-6) << apart;
    }
    EXPECT_NEAR(scene.prediction.interpolation_estimate(1).worst_m, between_samples * 0.25, 1e-6);
    EXPECT_NEAR(scene.size(EffectKind::interpolation).worst_m, between_samples * 0.25, 1e-6);
    // Farther apart than the region is wide nothing is known.
    EXPECT_EQ(scene.prediction.interpolation(1000).worst_m, 0.0);
}

}  // namespace
}  // namespace oro
