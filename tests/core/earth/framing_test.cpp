#include "core/earth/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>
#include <vector>

namespace oro {
namespace {

// A square of 2 m across the line of sight, an angle of view of 90 degrees and no margin: from 1 m away it
// fills the picture. In a picture twice as wide it does from 1 m, too, and lies in its middle.
TEST(Framing, SquareFillsAPictureOfNinetyDegrees) {
    Camera camera;
    camera.vertical_fov_deg = 90.0;
    const glm::dmat3 unturned(1.0);
    for (const int width_px : {100, 200}) {
        camera.width_px = width_px;
        camera.height_px = 100;
        const std::vector<Ecef> square{{{1, 1, 5}}, {{3, 1, 5}}, {{1, 3, 5}}, {{3, 3, 5}}};
        const glm::dvec3 eye = eye_that_frames(camera, unturned, square, 0.0, 0.01).m;
        EXPECT_NEAR(eye.x, 2.0, 1e-12);
        EXPECT_NEAR(eye.y, 2.0, 1e-12);
        EXPECT_NEAR(eye.z, 6.0, 1e-12);
    }
}

// The same square may fill 90 % of the picture: tan 45 degrees is then 1 m / 0.9.
TEST(Framing, MarginTakesItsShareOfEachSide) {
    Camera camera;
    camera.vertical_fov_deg = 90.0;
    const std::vector<Ecef> square{{{-1, -1, 0}}, {{1, -1, 0}}, {{-1, 1, 0}}, {{1, 1, 0}}};
    EXPECT_NEAR(eye_that_frames(camera, glm::dmat3(1.0), square, 0.05, 0.01).m.z, 1.0 / 0.9, 1e-12);
}

TEST(Framing, OnePointIsAMetreAway) {
    const std::vector<Ecef> point{{{10, 20, 30}}};
    const glm::dvec3 eye = eye_that_frames(Camera{}, glm::dmat3(1.0), point, 0.05, 1.0).m;
    EXPECT_NEAR(glm::length(eye - point[0].m), 1.0, 1e-12);
}

TEST(Framing, AttitudeOfAxesIsThatOfACamera) {
    constexpr unsigned seed = 20261122;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    for (int i = 0; i < 200; ++i) {
        Camera camera;
        camera.eye = {89.0 * share(random), 180.0 * share(random), 1000.0};
        camera.attitude = {180.0 + 179.0 * share(random), 89.0 * share(random), 179.0 * share(random)};
        const glm::dmat3 axes = glm::transpose(camera.view_from_ecef());
        const Attitude found = attitude_of_axes(camera.eye, -axes[2], axes[0]);
        EXPECT_NEAR(found.heading_deg, camera.attitude.heading_deg, 1e-9);
        EXPECT_NEAR(found.pitch_deg, camera.attitude.pitch_deg, 1e-9);
        EXPECT_NEAR(found.roll_deg, camera.attitude.roll_deg, 1e-9);
    }
}

// Of any cloud of points, whatever the picture: none is nearer to a side than the margin, and one pair of
// sides is touched on both, unless the nearest point holds the eye back.
TEST(Framing, HoldsAnyCloudAndTouchesTwoSides) {
    constexpr unsigned seed = 20261123;
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    for (int i = 0; i < 300; ++i) {
        Camera camera;
        camera.eye = {90.0 * share(random), 180.0 * share(random), 0.0};
        camera.attitude = {180.0 * share(random), 90.0 * share(random), 180.0 * share(random)};
        camera.vertical_fov_deg = 60.0 + 59.0 * share(random);
        camera.width_px = 1 + static_cast<int>(1000.0 * std::abs(share(random)));
        camera.height_px = 1 + static_cast<int>(1000.0 * std::abs(share(random)));
        const double size_m = std::pow(10.0, 4.0 + 3.0 * share(random));
        const Ecef middle = ecef_from_geodetic(camera.eye);
        std::vector<Ecef> points;
        for (int k = 0; k < 50; ++k)
            points.push_back({middle.m + size_m * glm::dvec3(share(random), share(random), share(random))});
        const glm::dmat3 view_from_ecef = camera.view_from_ecef();
        const glm::dvec3 eye = eye_that_frames(camera, view_from_ecef, points, 0.05, 0.01 * size_m).m;
        const glm::dvec2 tangent = camera.half_fov_tangent();
        glm::dvec2 low(2.0), high(-2.0);
        double nearest_m = 1e12;
        for (const Ecef& point : points) {
            const glm::dvec3 view = view_from_ecef * (point.m - eye);
            ASSERT_LT(view.z, 0.0);
            nearest_m = std::min(nearest_m, -view.z);
            const glm::dvec2 at = glm::dvec2(view) / (-view.z * tangent);
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
        EXPECT_LE(std::max(-std::min(low.x, low.y), std::max(high.x, high.y)), 0.9 + 1e-6);
        const bool touches_x = low.x < -0.9 + 1e-6 && high.x > 0.9 - 1e-6;
        const bool touches_y = low.y < -0.9 + 1e-6 && high.y > 0.9 - 1e-6;
        EXPECT_TRUE(touches_x || touches_y || nearest_m < 0.01 * size_m + 1e-6);
    }
}

}  // namespace
}  // namespace oro
