// The error of a picture against literal values: surfaces and depths whose errors are known by hand.
#include "core/truth/picture_error.h"
#include "core/measure/skyline_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/made_terrain.h"

namespace oro {
namespace {

// Depths whose distances floats hold exactly: 0.01 m / 2^-16 = 655.36 m, 0.01 m / 2^-17 = 1310.72 m.
constexpr float at_655_36_m = 0x1p-16F;
constexpr float at_1310_72_m = 0x1p-17F;

// The ellipsoid itself along the equator, 0.5 W to 1.5 E: the section of the Earth there is a circle of
// radius a = 6,378,137 m.
HeightField equator() {
    return test::made_field(0.1, -0.5, 60.0, 13, 121, [](double, double) { return 0.0F; });
}

// At 0 N 0 E, as high as asked, looking east; up is ECEF x and ahead is y. 1 x 1001 px and 90 degrees: 500.5
// px for a tangent of 1, the horizontal in the middle of row 500.
Camera eastward(double h_m) {
    Camera camera;
    camera.eye = {0.0, 0.0, h_m};
    camera.attitude = {90.0, 0.0, 0.0};
    camera.vertical_fov_deg = 90.0;
    camera.width_px = 1;
    camera.height_px = 1001;
    return camera;
}

class Equator : public testing::Test {
  protected:
    const HeightField field = equator();
    const TrueSurface surface{field, 1.0, 2};

    // Of a picture with ground in the middle pixel only.
    InteriorError with_one_point(const Camera& camera, float depth, const Air& air = {}) const {
        std::vector<float> depths(static_cast<std::size_t>(camera.height_px), 0.0F);
        depths[static_cast<std::size_t>(camera.height_px / 2)] = depth;
        return interior_error(surface, sight_from(camera.eye, air), camera, {depths, {0.5, 0.5}}, 2);
    }
};

TEST(ErrorSummary, TakesTheNearestRankOfAbsoluteValues) {
    // 20,000 values, 1 .. 20,000 with alternating signs: 99.99 % of them are 19,998, 99 % are 19,800.
    std::vector<double> values;
    for (int i = 1; i <= 20000; ++i) values.push_back(i % 2 == 0 ? i : -i);
    const ErrorSummary summary = summary_of(values);
    EXPECT_EQ(summary.count, 20000U);
    EXPECT_EQ(summary.largest, 20000.0);
    EXPECT_EQ(summary.p9999, 19998.0);
    EXPECT_EQ(summary.p99, 19800.0);
    EXPECT_EQ(summary.mean, 10000.5);
}

TEST(ErrorSummary, OfFewIsTheLargestAndOfNoneZero) {
    const ErrorSummary two = summary_of(std::vector<double>{-3.0, 1.0});
    EXPECT_EQ(two.largest, 3.0);
    EXPECT_EQ(two.p9999, 3.0);
    EXPECT_EQ(two.p99, 3.0);
    EXPECT_EQ(two.mean, 2.0);
    const std::vector<float> unmeasured{not_measured, -2.0F, not_measured};
    EXPECT_EQ(summary_of(unmeasured).count, 1U);
    EXPECT_EQ(summary_of(unmeasured).mean, 2.0);
    const ErrorSummary none = summary_of(std::vector<double>{});
    EXPECT_EQ(none.count, 0U);
    EXPECT_EQ(none.largest + none.p9999 + none.p99 + none.mean, 0.0);
}

// Drawn at 1310.72 m ahead of an eye 100 m up: at r = sqrt((a + 100)^2 + 1310.72^2) from the Earth's axis, so
// r - a = 100.1346756870 m too high. The true point at that longitude is (a (a + 100) / r, a 1310.72 / r),
// which is seen at the tangent (a + 100) (a - r) / (a 1310.72): 500.5 of that are 38.2371451951 px.
TEST_F(Equator, KnownHeightAtKnownDistance) {
    const InteriorError error = with_one_point(eastward(100.0), at_1310_72_m);
    EXPECT_EQ(error.drawn, 1U);
    EXPECT_EQ(error.beyond_data, 0U);
    EXPECT_NEAR(error.summary_m.largest, 100.1346756870, 1e-5);  // kept as float: steps of 8e-6
    EXPECT_NEAR(error.summary_px.largest, 38.2371451951, 2e-6);  // steps of 4e-6
    EXPECT_GT(error.height_m[500], 0.0F) << "above the surface is positive";
    EXPECT_EQ(error.height_m[499], not_measured);
    EXPECT_EQ(error.px[501], not_measured);
}

// A surface 2.5 m below what is drawn, straight below the eye: 2.5 m of error to 1e-6 m, and none in pixels,
// because both lie on one line of sight.
TEST_F(Equator, StraightDownHeightsDoNotShow) {
    Camera camera = eastward(655.36 + 2.5);
    camera.attitude.pitch_deg = -90.0;
    const InteriorError error = with_one_point(camera, at_655_36_m);
    EXPECT_NEAR(error.summary_m.largest, 2.5, 1e-6);
    EXPECT_NEAR(error.summary_px.largest, 0.0, 1e-6);
}

// 3.25 m of height ahead: drawn at the tangent t = 0 from an eye h above, the point lies 3.25 m up when h =
// sqrt((a + 3.25)^2 - 655.36^2) - a = 3.2163305671 m; on the picture 500.5 (a + h) 3.25 / (a 655.36) =
// 2.4820340 px, to 1e-6 of each.
TEST_F(Equator, SmallHeightToAMillionth) {
    const double a = wgs84_a_m;
    const double h_m = std::sqrt((a + 3.25) * (a + 3.25) - 655.36 * 655.36) - a;
    EXPECT_NEAR(h_m, 3.2163305671, 1e-8);
    const InteriorError error = with_one_point(eastward(h_m), at_655_36_m);
    EXPECT_NEAR(error.summary_m.largest, 3.25, 1e-6);
    EXPECT_NEAR(error.summary_px.largest, 2.4820340, 1e-6);
}

// The same as KnownHeightAtKnownDistance through air that bends light with k = 0.13: k falls to 0.13 exp(-100
// / 8434), R at the equator is a sqrt(1 - e2) = 6,356,752.3 m, and what is seen at 1310.72 m really lies
// 0.01735995 m lower: 100.1173157326 m too high. The true point below it is seen as much higher as its own
// distance asks for: 38.2305162758 px.
TEST_F(Equator, RefractionIsTakenOutBeforeHeightsAreCompared) {
    const InteriorError error = with_one_point(eastward(100.0), at_1310_72_m, standard_air);
    EXPECT_NEAR(error.summary_m.largest, 100.1173157326, 1e-5);
    EXPECT_NEAR(error.summary_px.largest, 38.2305162758, 2e-6);
}

// From 50 m below the surface straight down: drawn 705.36 m too low, and the true point is behind the eye.
// 705.36 m across the line of sight at 655.36 m would be 500.5 * 705.36 / 655.36 = 538.6851196289 px.
TEST_F(Equator, TruePointBehindTheEyeHasABound) {
    Camera camera = eastward(-50.0);
    camera.attitude.pitch_deg = -90.0;
    const InteriorError error = with_one_point(camera, at_655_36_m);
    EXPECT_NEAR(error.summary_m.largest, 705.36, 1e-4);
    EXPECT_LT(error.height_m[500], 0.0F) << "below the surface is negative";
    EXPECT_NEAR(error.summary_px.largest, 538.6851196, 1e-4);
}

// 0.01 m / 2^-25 = 335.5 km ahead is 3 degrees: the data end at 1.5.
TEST_F(Equator, PointsOverNoDataAreCounted) {
    const InteriorError error = with_one_point(eastward(100.0), 0x1p-25F);
    EXPECT_EQ(error.drawn, 1U);
    EXPECT_EQ(error.beyond_data, 1U);
    EXPECT_EQ(error.summary_m.count, 0U);
    EXPECT_EQ(error.height_m[500], not_measured);
}

// Looking down on the data's northern edge from the edge's own latitude: the middle of the picture is on it,
// and rounding may put it on either side.
TEST_F(Equator, TheEdgeIsInside) {
    for (const double lon_deg : {0.1, 0.2, 0.3, 0.7, 1.1}) {
        Camera camera = eastward(655.36);
        camera.eye.lat_deg = 0.1;
        camera.eye.lon_deg = lon_deg;
        camera.attitude.pitch_deg = -90.0;
        const InteriorError error = with_one_point(camera, at_655_36_m);
        EXPECT_EQ(error.beyond_data, 0U) << lon_deg;
        EXPECT_NEAR(error.summary_m.largest, 0.0, 1e-6);
    }
}

TEST_F(Equator, AnyNumberOfThreadsGivesTheSame) {
    Camera camera = eastward(100.0);
    camera.width_px = 7;
    const std::vector<float> depths(7U * 1001U, at_1310_72_m);
    const Sight sight = sight_from(camera.eye);
    const InteriorError one = interior_error(surface, sight, camera, {depths, {0.5, 0.5}}, 1);
    const InteriorError many = interior_error(surface, sight, camera, {depths, {0.5, 0.5}}, 5);
    EXPECT_EQ(one.height_m, many.height_m);
    EXPECT_EQ(one.px, many.px);
    EXPECT_EQ(one.summary_px.mean, many.summary_px.mean);
}

// Depths of one column with ground from some height downwards, at four heights within each pixel.
struct FourSamples {
    std::vector<std::vector<float>> depths;
    std::vector<DrawnDepths> samples;
    FourSamples(int rows, double ground_from_px) : depths(4) {
        for (std::size_t i = 0; i < 4; ++i) {
            const double y = (static_cast<double>(i) + 0.5) / 4.0;
            for (int row = 0; row < rows; ++row)
                depths[i].push_back(row + y >= ground_from_px ? 1.0e-5F : 0.0F);
        }
        // In any order.
        for (const std::size_t i : {2U, 0U, 3U, 1U})
            samples.push_back({depths[i], {0.5, (static_cast<double>(i) + 0.5) / 4.0}});
    }
};

Camera column_of(int rows) {
    Camera camera = eastward(100.0);
    camera.vertical_fov_deg = 2.0;
    camera.height_px = rows;
    return camera;
}

// The sea's horizon from 100 m: dip with tangent sqrt(2 a 100 + 100^2) / a. 101 rows in 2 degrees are 50.5 /
// tan 1 degree = 2893.11 px for a tangent of 1: the horizon lies at 50.5 + 16.20 = 66.7009 px.
TEST_F(Equator, SkylineIsFoundAndItsShiftMeasured) {
    const Camera camera = column_of(101);
    const Sight sight = sight_from(camera.eye);
    const Skyline truth = true_skyline(surface, sight, camera, 1);
    ASSERT_EQ(truth.y_px.size(), 1U);
    EXPECT_NEAR(truth.y_px[0], 66.7009, 1.0 / 128.0 + 1e-4);
    const auto error_px = [&](double ground_from_px) {
        const FourSamples drawn(101, ground_from_px);
        const SkylineError error = skyline_error(surface, sight, camera, drawn.samples, 1);
        EXPECT_EQ(error.in_one_only, 0U);
        EXPECT_EQ(error.summary_px.count, 1U);
        return error.summary_px.largest;
    };
    // Samples lie at .125, .375, .625 and .875: between .625 and .875 is where the horizon is.
    EXPECT_EQ(error_px(66.7), 0.0);
    EXPECT_NEAR(error_px(70.0), 69.875 - 66.7009, 1.0 / 128.0 + 1e-4);
    EXPECT_NEAR(error_px(60.0), 66.7009 - 60.125, 1.0 / 128.0 + 1e-4);
}

// Refraction lifts what is seen at s by c s^2 / 2, c = 0.13 exp(-100 / 8434) / (a sqrt(1 - e2)) = 2.02096e-8
// 1/m: the Earth looks 1 - c a = 0.8711 times as curved, and the dip shrinks by the root of that, from 16.20
// px to 15.1208 px (the largest tangent over the lifted circle, by search).
TEST_F(Equator, SkylineThroughBendingAir) {
    const Camera camera = column_of(101);
    const Skyline truth = true_skyline(surface, sight_from(camera.eye, standard_air), camera, 1);
    EXPECT_NEAR(truth.y_px[0], 50.5 + 15.1208, 1.0 / 128.0 + 1e-4);
}

TEST(SkylineError, CountsColumnsWithGroundInOneOnly) {
    const Camera camera = column_of(10);
    const FourSamples ground(10, 5.0), sky(10, 99.0), full(10, 0.0);
    const SkylineError drawn_only = skyline_error(Skyline{{not_measured}}, camera, ground.samples);
    EXPECT_EQ(drawn_only.in_one_only, 1U);
    EXPECT_EQ(drawn_only.summary_px.count, 0U);
    EXPECT_EQ(drawn_only.px[0], not_measured);
    EXPECT_EQ(skyline_error(Skyline{{5.0F}}, camera, sky.samples).in_one_only, 1U);
    EXPECT_EQ(skyline_error(Skyline{{not_measured}}, camera, sky.samples).in_one_only, 0U);
    // The last sample lies at 9.875: ground below it is in no drawn picture.
    EXPECT_EQ(skyline_error(Skyline{{9.8F}}, camera, sky.samples).in_one_only, 1U);
    EXPECT_EQ(skyline_error(Skyline{{9.9F}}, camera, sky.samples).in_one_only, 0U);
    // At the top in both: no skyline to compare.
    EXPECT_EQ(skyline_error(Skyline{{0.0F}}, camera, full.samples).summary_px.count, 0U);
    EXPECT_EQ(skyline_error(Skyline{{0.0F}}, camera, full.samples).in_one_only, 0U);
    // At the top in one: it is off by at least what is seen of it. Samples at 4.875 and 0.125 are the ends.
    EXPECT_EQ(skyline_error(Skyline{{0.0F}}, camera, ground.samples).summary_px.largest, 4.875);
    EXPECT_EQ(skyline_error(Skyline{{5.0F}}, camera, full.samples).summary_px.largest, 4.875);
}

}  // namespace
}  // namespace oro
