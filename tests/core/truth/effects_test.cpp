// Predicted effects against what they are by hand.
#include "core/truth/effects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "tests/core/truth/effect_scene.h"

namespace oro {
namespace {

using test::half_way_down, test::sea_level, test::undulation;
using Scene = test::EffectScene;

// The margins that bounds carry (core/truth/effects.cpp).
constexpr double between_samples = 2.5;
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
    expect_size(scene.size(EffectKind::refraction), 1.05783, 0.55808, 286.4777 * 1.05783 / 10231.6,
                286.4777 * 0.55808 / 7431.6, between_samples, 0.002);
}

// On the plane the same lines meet the sea where t s = 100 m + k' s^2 / (2 R), at 9,462.6, 7,124.8 and
// 5,710.1 m; the true sea is s^2 / (2 a) lower there: 7.0193, 3.9794 and 2.5560 m.
TEST(Effects, CurvatureLeftOut) {
    const Scene scene(sea_level(), eastward_over_the_sea());
    expect_size(scene.size(EffectKind::flat), 7.0193, 3.9794, 286.4777 * 7.0193 / 9462.6,
                286.4777 * 3.9794 / 7124.8, 1.6 * between_samples, 0.003);
}

// Along the equator the ellipsoid curves by 1 / 6,378,137 m and the sphere by 1 / 6,371,008.8 m, which puts
// what is seen s^2 / 2 times the difference lower: 9.1819 and 4.8441 mm at 10,231.6 and 7,431.6 m.
TEST(Effects, SphereForEllipsoid) {
    const Scene scene(sea_level(), eastward_over_the_sea());
    expect_size(scene.size(EffectKind::sphere), 0.0091819, 0.0048441, 286.4777 * 0.0091819 / 10231.6,
                286.4777 * 0.0048441 / 7431.6, between_samples, 0.01);
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
    expect_size(scene.size(EffectKind::geoid), 3.5368, 2.5983, 0.10294, 0.10294, between_samples, 0.003);
}

// Eye and ground are off by the same: what is left is second order, 50 m (s / a)^2 / 2 = 0.06 mm at 10 km.
TEST(Effects, GeoidThatIsTheSameEverywhere) {
    HeightField field = sea_level();
    field.undulation = undulation(50.0, 0.0);
    Camera camera = eastward_over_the_sea();
    camera.eye.h_m = 150.0;
    const Scene scene(std::move(field), camera);
    EXPECT_LT(scene.size(EffectKind::geoid).worst_m, 0.0005);
    EXPECT_LT(scene.size(EffectKind::geoid).worst_px, 1.0e-4);
}

// 16 bits with a step of 2^11 / 2,048 m = 1 m: what a height is off them. 1.207107 * 0.25 / 2,000
// = 1.50889e-4 px. Steps of 1 / 2,048 m: half of one is 0.000244 m.
TEST(Effects, StepsOfHeights) {
    TrueWorld world;
    world.sixteen = {true, 11, 0};
    // 0.25 m goes to the step of 0 m: 0.25 m off, everywhere.
    const Scene scene(test::level_at(0.25), half_way_down(), world);
    EXPECT_NEAR(scene.prediction.nearest_m(), 1414.0, 0.3);
    expect_size(scene.size(EffectKind::steps_i16), 0.25, 0.25, 1.50889e-4, 1.50889e-4, between_samples,
                0.001);
    expect_size(scene.size(EffectKind::steps_f32), 0.000244141, 0.000244141, 1.47352e-7, 1.47352e-7, nearer,
                0.001);
    EXPECT_NEAR(scene.size(EffectKind::steps_f32).typical_m, 0.000244140625, 1e-15);
}

// A step is as fine as 65,534 of them allow: 4,000 m in steps of 2^-11 m are 8,192,000, 2^7 of them 125 to a
// code: shift 7, a step of 0.0625 m, at most 0.03125 m off.
TEST(Effects, SixteenBitsOfAKnownRange) {
    TrueWorld world;
    world.sixteen = sixteen_bits(height_steps(0.0), height_steps(4000.0));
    ASSERT_EQ(world.sixteen.shift, 7);
    // 0.02 m goes to 0, 0.05 m to 0.0625.
    const Scene low(test::level_at(0.02), half_way_down(), world),
        high(test::level_at(0.05), half_way_down(), world);
    EXPECT_NEAR(low.size(EffectKind::steps_i16).typical_m, 0.02, 1e-8);
    EXPECT_NEAR(high.size(EffectKind::steps_i16).typical_m, 0.0125, 1e-8);
}

// 3.2e-7 of 1,414.3 m (docs/ARCHITECTURE.md, Placement); 4 * 2^-24 of it; and a 256th of a pixel along
// each axis: sqrt(2) / 256 / 1.207107 of it.
TEST(Effects, RoundingWithTheDistance) {
    const Scene scene(sea_level(), half_way_down());
    const auto share_px = [](double height_m) { return 1.207107 * height_m / 2000.0; };
    for (const auto& [kind, typical_m] :
         {std::pair(EffectKind::placement, 4.5258e-4), std::pair(EffectKind::depth, 3.3720e-4),
          std::pair(EffectKind::pixel_grid, 6.47250)}) {
        // Pixels of a height of metres are not in proportion to it: 0.6 %.
        expect_size(scene.size(kind), typical_m, typical_m, share_px(typical_m), share_px(typical_m), nearer,
                    0.006);
    }
}

// Ground that rises by 3 in 4 to the east (0.75 * 111,319.49 m a degree): heights are off by 5/4 of what lies
// across it.
TEST(Effects, SlopesMultiply) {
    Camera camera = half_way_down();
    camera.eye = {0.0, 0.5, 0.5 * 83489.6 + 1000.0};
    camera.attitude.pitch_deg = -90.0;
    const Scene scene(test::world_field(1200.0, 120, 0, 241, 1201,
                                        [](double, double lon_deg) { return 83489.6 * lon_deg; }),
                      camera);
    // At 42 km the parallel is 0.7 % longer, the slope as much less.
    EXPECT_NEAR(scene.size(EffectKind::placement).typical_m, 1.25 * 3.2e-7 * 1000.0, 3.0e-6);
}

// The source's own figure, as it is stated; half of a normal distribution's errors are within 0.6745 / 1.6449
// = 0.41 of it. Source: M. Abramowitz, I. Stegun, Handbook of Mathematical Functions, 1964, table 26.5.
TEST(Effects, SourceSaysItsAccuracyOrNothing) {
    TrueWorld world;
    const Scene silent(sea_level(), half_way_down(), world);
    const auto none = silent.prediction.size(EffectKind::source, 1.0);
    ASSERT_TRUE(none.ok());
    EXPECT_FALSE(none.value().has_value());
    world.source_le90_m = 16.0;
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
    // Straight up and down at the picture's centre: nothing is seen of it.
    EXPECT_LT(large.worst_px, 1.0e-9);
    const Scene seconds(sea_level(), half_way_down());
    EXPECT_NEAR(seconds.size(EffectKind::flat_cells).typical_m, 3.373e-4, 1.0e-7);
    camera.eye = {59.95, 0.05, 1000.0};
    const Scene north(test::world_field(1200.0, 72000, 0, 121, 121, [](double, double) { return 0.0; }),
                      camera);
    EXPECT_NEAR(north.size(EffectKind::flat_cells).typical_m, 2.108e-4, 5.0e-7);
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
    EXPECT_LE(view.worst_m, 3.0 * (0.355 + 5.0 * 0.25 * std::numbers::sqrt3));
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
    EXPECT_NEAR(scene.size(EffectKind::interpolation).worst_m, 0.25, 1e-6);
    // Farther apart than the region is wide nothing is known.
    EXPECT_EQ(scene.prediction.interpolation(1000).worst_m, 0.0);
}

}  // namespace
}  // namespace oro
