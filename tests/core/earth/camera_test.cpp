#include "core/earth/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

namespace oro {
namespace {

void expect_near(const glm::dvec3& got, const glm::dvec3& expected, double tolerance) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(got[axis], expected[axis], tolerance) << "axis " << axis;
}

// What the mesh shader and the rasteriser do: the point of the tile, pixels from its top left corner.
glm::dvec2 tile_point_px(const Projection& projection, const Tile& tile, const glm::dvec3& view) {
    const double w = -view.z;
    const glm::dvec2 ndc = (projection.scale * glm::dvec2(view) + projection.shift * w) / w;
    return (ndc + 1.0) * 0.5 * glm::dvec2(tile.width_px, tile.height_px);
}

TEST(Camera, AttitudeLiterals) {
    // At (0 N, 0 E): east +y, north +z, up +x.
    Camera camera;
    const auto forward = [&] { return -glm::transpose(camera.view_from_ecef())[2]; };
    const auto right = [&] { return glm::transpose(camera.view_from_ecef())[0]; };
    const auto up = [&] { return glm::transpose(camera.view_from_ecef())[1]; };
    expect_near(forward(), {0, 0, 1}, 1e-15);
    expect_near(right(), {0, 1, 0}, 1e-15);
    expect_near(up(), {1, 0, 0}, 1e-15);
    camera.attitude = {90.0, 0.0, 0.0};
    expect_near(forward(), {0, 1, 0}, 1e-15);
    expect_near(right(), {0, 0, -1}, 1e-15);
    camera.attitude = {0.0, -90.0, 0.0};
    expect_near(forward(), {-1, 0, 0}, 1e-15);
    expect_near(up(), {0, 0, 1}, 1e-15);
    camera.attitude = {0.0, 30.0, 0.0};
    expect_near(forward(), {0.5, 0, std::sqrt(0.75)}, 1e-15);
    // Roll clockwise: the right side goes down, a quarter turn puts east's side where the ground was.
    camera.attitude = {0.0, 0.0, 90.0};
    expect_near(forward(), {0, 0, 1}, 1e-15);
    expect_near(right(), {-1, 0, 0}, 1e-15);
    expect_near(up(), {0, 1, 0}, 1e-15);
}

TEST(Camera, IsARotation) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        Camera camera;
        camera.eye = {90.0 * unit(random), 180.0 * unit(random), 1000.0};
        camera.attitude = {360.0 * unit(random), 90.0 * unit(random), 180.0 * unit(random)};
        const glm::dmat3 m = camera.view_from_ecef();
        const glm::dmat3 one = m * glm::transpose(m);
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) ASSERT_NEAR(one[a][b], a == b ? 1.0 : 0.0, 2e-15);
        }
        ASSERT_NEAR(glm::determinant(m), 1.0, 2e-15);
        // The direction's heading and pitch come back.
        const Attitude back = attitude_of_direction(camera.eye, -glm::transpose(m)[2]);
        ASSERT_NEAR(std::remainder(back.heading_deg - camera.attitude.heading_deg, 360.0), 0.0, 1e-9);
        ASSERT_NEAR(back.pitch_deg, camera.attitude.pitch_deg, 1e-7);
        ASSERT_GE(back.heading_deg, 0.0);
        ASSERT_LT(back.heading_deg, 360.0);
    }
}

TEST(Camera, LooksAtItsTarget) {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        Camera camera;
        camera.width_px = 1920;
        camera.height_px = 1080;
        camera.eye = {89.0 * unit(random), 180.0 * unit(random), 5000.0 + 4900.0 * unit(random)};
        const Geodetic target{camera.eye.lat_deg + unit(random), camera.eye.lon_deg + unit(random), 0.0};
        camera.attitude = attitude_towards(camera.eye, target);
        EXPECT_EQ(camera.attitude.roll_deg, 0.0);
        const glm::dvec3 offset = ecef_from_geodetic(target).m - camera.eye_ecef().m;
        const glm::dvec3 seen = camera.ecef_direction_at({960.0, 540.0});
        ASSERT_LT(glm::length(glm::normalize(offset) - seen), 1e-13);
    }
    const Attitude north = attitude_towards({46.0, 8.0, 0.0}, {46.0001, 8.0, 0.0});
    EXPECT_NEAR(std::remainder(north.heading_deg, 360.0), 0.0, 1e-8);
    EXPECT_NEAR(north.pitch_deg, -0.00005, 1e-6);
    const Attitude down = attitude_towards({46.0, 8.0, 1000.0}, {46.0, 8.0, 0.0});
    EXPECT_EQ(down.heading_deg, 0.0);
    EXPECT_NEAR(down.pitch_deg, -90.0, 1e-4);
    const Attitude nowhere = attitude_towards({46.0, 8.0, 0.0}, {46.0, 8.0, 0.0});
    EXPECT_EQ(nowhere.pitch_deg, 0.0);
}

TEST(Camera, FieldOfView) {
    Camera camera;
    camera.vertical_fov_deg = 90.0;
    camera.width_px = 200;
    camera.height_px = 100;
    EXPECT_NEAR(camera.half_fov_tangent().y, 1.0, 1e-15);
    EXPECT_NEAR(camera.half_fov_tangent().x, 2.0, 1e-15);
    // The middle of the top edge looks 45 degrees up: at (0 N, 0 E) between north (+z) and up (+x).
    expect_near(camera.ecef_direction_at({100.0, 0.0}), {std::sqrt(0.5), 0.0, std::sqrt(0.5)}, 1e-15);
    // The right edge's middle: atan(2) to the east.
    expect_near(camera.ecef_direction_at({200.0, 50.0}), {0.0, 2.0 / std::sqrt(5.0), 1.0 / std::sqrt(5.0)},
                1e-15);
}

TEST(Projection, TilesOfAPictureAgreeWithTheWhole) {
    Camera camera;
    camera.width_px = 640;
    camera.height_px = 480;
    camera.eye = {46.5, 8.0, 3000.0};
    camera.attitude = {200.0, -5.0, 3.0};
    const Tile tiles[] = {{0, 0, 640, 480, {0.5, 0.5}},
                          {128, 64, 100, 50, {0.5, 0.5}},
                          {600, 470, 40, 10, {0.125, 0.875}},
                          {0, 0, 1, 1, {0.0, 0.0}}};
    for (const Tile& tile : tiles) {
        const Projection projection = projection_of_tile(camera, tile);
        for (int y = 0; y < tile.height_px; y += 7) {
            for (int x = 0; x < tile.width_px; x += 7) {
                // The ray of the wanted sample must come out in the middle of the tile's pixel, where the GPU
                // samples.
                const glm::dvec2 picture = glm::dvec2(tile.x_px + x, tile.y_px + y) + tile.sample_px;
                const glm::dvec3 view = camera.view_from_ecef() * camera.ecef_direction_at(picture) * 1234.0;
                const glm::dvec2 got = tile_point_px(projection, tile, view);
                ASSERT_NEAR(got.x, x + 0.5, 1e-9);
                ASSERT_NEAR(got.y, y + 0.5, 1e-9);
            }
        }
        EXPECT_EQ(projection.near_m, near_plane_m);
    }
}

TEST(Frustum, PlanesAgreeWithTheProjection) {
    const unsigned seed = 12;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    Camera camera;
    camera.width_px = 800;
    camera.height_px = 600;
    int inside_count = 0;
    for (int i = 0; i < 100000; ++i) {
        camera.vertical_fov_deg = 60.0 + 59.0 * unit(random);
        const Tile tile{100, 50, 300, 200 + i % 100, {0.25, 0.75}};
        const Projection projection = projection_of_tile(camera, tile);
        const auto planes = frustum_planes_view(projection);
        const glm::dvec3 view(unit(random), unit(random), unit(random));
        bool inside_planes = true;
        for (const Plane& plane : planes) {
            ASSERT_NEAR(glm::length(glm::dvec3(plane)), 1.0, 1e-14);
            inside_planes = inside_planes && glm::dot(glm::dvec3(plane), view) + plane.w >= 0.0;
        }
        const glm::dvec2 got = tile_point_px(projection, tile, view);
        const bool inside = -view.z >= projection.near_m && got.x >= 0.0 && got.x <= tile.width_px &&
                            got.y >= 0.0 && got.y <= tile.height_px;
        ASSERT_EQ(inside, inside_planes);
        inside_count += inside ? 1 : 0;
        // The order that the header gives: left, right, bottom, top, near.
        if (-view.z < projection.near_m) continue;
        ASSERT_EQ(got.x >= 0.0, glm::dot(glm::dvec3(planes[0]), view) >= 0.0);
        ASSERT_EQ(got.x <= tile.width_px, glm::dot(glm::dvec3(planes[1]), view) >= 0.0);
        ASSERT_EQ(got.y <= tile.height_px, glm::dot(glm::dvec3(planes[2]), view) >= 0.0);
        ASSERT_EQ(got.y >= 0.0, glm::dot(glm::dvec3(planes[3]), view) >= 0.0);
    }
    EXPECT_GT(inside_count, 1000);
}

}  // namespace
}  // namespace oro
