// Displacement and distance from the surface against literal values.
#include "core/measure/ground_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/core/measure/equator.h"

namespace oro {
namespace {

using test::eastward;

class GroundOnTheEquator : public test::Equator {
  protected:
    // Column of a place on the equator, so far east of the eye as seen from the Earth's middle.
    static double column(double east_m, double from_axis_m) {
        return (std::atan2(east_m, from_axis_m) * 180.0 / std::numbers::pi + 0.5) * 60.0;
    }
    static constexpr double row = 6.0;  // 0 N

    // Of a picture with ground in the middle pixel only.
    GroundErrors with_one_point(const Camera& camera, const DrawnPoint& point, const Air& air = {}) const {
        std::vector<DrawnPoint> points(static_cast<std::size_t>(camera.height_px));
        points[static_cast<std::size_t>(camera.height_px / 2)] = point;
        return ground_errors(surface, sight_from(camera.eye, air), camera, points, 2);
    }
};

// Drawn at 1310.72 m ahead of an eye 100 m up: at r = sqrt((a + 100)^2 + 1310.72^2) from the Earth's axis, so
// r - a = 100.1346756870 m too high. The ground point at that longitude is (a (a + 100) / r, a 1310.72 / r),
// which is seen at the tangent (a + 100) (a - r) / (a 1310.72): 500.5 of that are 38.2371451951 px.
TEST_F(GroundOnTheEquator, KnownHeightAtKnownDistance) {
    const DrawnPoint point{row, column(1310.72, wgs84_a_m + 100.0), 1310.72};
    const GroundErrors errors = with_one_point(eastward(100.0), point);
    EXPECT_EQ(errors.drawn, 1U);
    EXPECT_EQ(errors.beyond_data, 0U);
    EXPECT_NEAR(errors.summary_displacement_m.largest, 100.1346756870, 1e-5);  // kept as float: steps of 8e-6
    EXPECT_NEAR(errors.summary_displacement_px.largest, 38.2371451951, 2e-6);  // steps of 4e-6
    EXPECT_NEAR(errors.summary_surface_m.largest, 100.1346756870, 1e-5);
    EXPECT_EQ(errors.displacement_m[499], not_measured);
    EXPECT_EQ(errors.surface_px[501], not_measured);
}

// A ground point 2.5 m below where it is drawn, straight below the eye: 2.5 m of error to 1e-6 m, and none in
// pixels, because both lie on one line of sight.
TEST_F(GroundOnTheEquator, StraightDownHeightsDoNotShow) {
    Camera camera = eastward(655.36 + 2.5);
    camera.attitude.pitch_deg = -90.0;
    const GroundErrors errors = with_one_point(camera, {row, 30.0, 655.36});
    EXPECT_NEAR(errors.summary_displacement_m.largest, 2.5, 1e-6);
    EXPECT_NEAR(errors.summary_displacement_px.largest, 0.0, 1e-6);
}

// Straight below the eye, on the surface: but it is the ground point of a place 3 m to the east, which is
// seen 500.5 * 3 / 655.36 = 2.2911072 px away. Of the surface's height nothing is wrong.
TEST_F(GroundOnTheEquator, SidewaysIsDisplacement) {
    Camera camera = eastward(655.36);
    camera.attitude.pitch_deg = -90.0;
    const GroundErrors errors = with_one_point(camera, {row, column(3.0, wgs84_a_m), 655.36});
    EXPECT_NEAR(errors.summary_displacement_m.largest, 3.0, 1e-6);
    EXPECT_NEAR(errors.summary_displacement_px.largest, 2.2911072, 1e-5);
    EXPECT_NEAR(errors.summary_surface_m.largest, 0.0, 1e-6);
    EXPECT_NEAR(errors.summary_surface_px.largest, 0.0, 1e-6);
}

// The same as KnownHeightAtKnownDistance through air that bends light with k = 0.13: k falls to 0.13 exp(-100
// / 8434), R at the equator is a sqrt(1 - e2) = 6,356,752.3 m, and what is seen at 1310.72 m really lies
// 0.01735995 m lower: 100.1173157326 m too high. The ground point below it is seen as much higher as its own
// distance asks for: 38.2305162758 px.
TEST_F(GroundOnTheEquator, RefractionIsTakenOutBeforePlacesAreCompared) {
    const DrawnPoint point{row, column(1310.72, wgs84_a_m + 100.0 - 0.01735995), 1310.72};
    const GroundErrors errors = with_one_point(eastward(100.0), point, standard_air);
    EXPECT_NEAR(errors.summary_displacement_m.largest, 100.1173157326, 1e-5);
    EXPECT_NEAR(errors.summary_displacement_px.largest, 38.2305162758, 2e-6);
}

// From 50 m below the surface straight down: drawn 705.36 m too low, and the ground point is behind the eye.
// 705.36 m across the line of sight at 655.36 m would be 500.5 * 705.36 / 655.36 = 538.6851196289 px.
TEST_F(GroundOnTheEquator, GroundPointBehindTheEyeHasABound) {
    Camera camera = eastward(-50.0);
    camera.attitude.pitch_deg = -90.0;
    const GroundErrors errors = with_one_point(camera, {row, 30.0, 655.36});
    EXPECT_NEAR(errors.summary_displacement_m.largest, 705.36, 1e-4);
    EXPECT_NEAR(errors.summary_displacement_px.largest, 538.6851196, 1e-4);
}

TEST_F(GroundOnTheEquator, PointsOverNoDataAreCounted) {
    const GroundErrors errors = with_one_point(eastward(100.0), {row, 121.0, 1000.0});
    EXPECT_EQ(errors.drawn, 1U);
    EXPECT_EQ(errors.beyond_data, 1U);
    EXPECT_EQ(errors.summary_displacement_m.count, 0U);
    EXPECT_EQ(errors.displacement_m[500], not_measured);
}

// A triangle's shares add up to 1 by rounding only: a point of the last row or column may lie beside it.
TEST_F(GroundOnTheEquator, TheEdgeIsInside) {
    for (const double off : {-1e-12, 0.0, 1e-12}) {
        EXPECT_EQ(with_one_point(eastward(655.36), {off, 30.0, 655.36}).beyond_data, 0U) << off;
        EXPECT_EQ(with_one_point(eastward(655.36), {12.0 + off, 30.0, 655.36}).beyond_data, 0U) << off;
        EXPECT_EQ(with_one_point(eastward(655.36), {row, 120.0 + off, 655.36}).beyond_data, 0U) << off;
    }
}

// On a slope of 1 in 1 the distance is the way to the slope, not down it: 10 m above it 10 / sqrt(2) m.
TEST(GroundOnASlope, TheSurfaceIsNearerThanTheGroundBelow) {
    const HeightField field = test::made_field(0.1, -0.5, 60.0, 13, 61, [](double, double lon_deg) {
        return static_cast<float>(lon_deg * 111319.49);
    });
    const TrueSurface surface(field, 1.0, 1);
    Camera camera = eastward(1010.0);
    camera.attitude.pitch_deg = -90.0;
    // Drawn 10 m above the slope below the eye, as that ground point.
    const Sight sight = sight_from(camera.eye);
    const std::vector<DrawnPoint> points = [&] {
        std::vector<DrawnPoint> all(static_cast<std::size_t>(camera.height_px));
        all[500] = {6.0, 30.0, 1000.0};
        return all;
    }();
    const GroundErrors errors = ground_errors(surface, sight, camera, points, 1);
    EXPECT_NEAR(errors.summary_displacement_m.largest, 10.0, 1e-4);
    EXPECT_NEAR(errors.summary_surface_m.largest, 10.0 / std::numbers::sqrt2, 0.02);
}

TEST_F(GroundOnTheEquator, AnyNumberOfThreadsGivesTheSame) {
    Camera camera = eastward(100.0);
    camera.width_px = 7;
    const std::vector<DrawnPoint> points(7U * 1001U, DrawnPoint{row, 31.0, 1310.72});
    const Sight sight = sight_from(camera.eye);
    const GroundErrors one = ground_errors(surface, sight, camera, points, 1);
    const GroundErrors many = ground_errors(surface, sight, camera, points, 5);
    EXPECT_EQ(one.displacement_px, many.displacement_px);
    EXPECT_EQ(one.surface_m, many.surface_m);
    EXPECT_EQ(one.summary_displacement_px.mean, many.summary_displacement_px.mean);
}

}  // namespace
}  // namespace oro
