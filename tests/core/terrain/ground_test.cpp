#include "core/terrain/ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "core/earth/camera.h"
#include "core/truth/oracle.h"
#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

using Surface = std::function<double(double lat_deg, double lon_deg)>;

glm::dvec3 towards(const Geodetic& eye, double heading_deg, double pitch_deg) {
    Camera camera;
    camera.eye = eye;
    camera.attitude = {heading_deg, pitch_deg, 0.0};
    return camera.ecef_direction_at({0.5, 0.5});
}

std::optional<SightHit> first_ground_hit(const HeightField& field, const Ecef& eye,
                                         const glm::dvec3& direction, double reach_m,
                                         double exaggeration = 1.0) {
    const TrueSurface surface(field, exaggeration, 1);
    return first_hit(surface, {eye, {}}, direction, reach_m);
}

double above_m(const Geodetic& eye, const glm::dvec3& direction, double t_m, const Surface& surface) {
    const Geodetic point = geodetic_from_ecef(Ecef{ecef_from_geodetic(eye).m + t_m * direction});
    return point.h_m - surface(point.lat_deg, point.lon_deg);
}

// A surface that triangles reproduce exactly: linear in latitude and longitude.
double slope(double lat_deg, double lon_deg) {
    return 1000.0 + 9000.0 * (lat_deg - 46.5) - 7000.0 * (lon_deg - 8.5);
}

// N46E008, 3".
HeightField alpine_field(const Surface& surface) {
    return test::world_field(1200.0, 47 * 1200, 8 * 1200, 1201, 1201, surface);
}

// Rays from everywhere over a field: each hit lies on the surface, and no earlier place of the ray is on the
// other side of it.
int check_random_rays(const HeightField& field, const Surface& surface, unsigned seed, int rays) {
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const TrueSurface ground(field, 1.0, 1);
    int hits = 0;
    for (int i = 0; i < rays; ++i) {
        Geodetic eye{46.1 + 0.8 * unit(random), 8.1 + 0.8 * unit(random), 0.0};
        const double height_m = std::pow(10.0, 5.0 * unit(random) - 0.5) * (i % 5 == 0 ? -1.0 : 1.0);
        eye.h_m = surface(eye.lat_deg, eye.lon_deg) + height_m;
        const double pitch_deg = height_m > 0.0 ? 5.0 - 95.0 * unit(random) : 90.0 * unit(random);
        const glm::dvec3 direction = towards(eye, 360.0 * unit(random), pitch_deg);
        const auto hit = first_hit(ground, {ecef_from_geodetic(eye), {}}, direction, 3.0e5);
        const double reach_m = hit ? hit->distance_m - 0.01 : 2.0e4;
        for (int k = 0; k < 100; ++k) {
            const double t_m = reach_m * unit(random);
            const Geodetic at = geodetic_from_ecef(Ecef{ecef_from_geodetic(eye).m + t_m * direction});
            if (is_void(field.H_at_m(at.lat_deg, at.lon_deg))) continue;
            EXPECT_EQ(above_m(eye, direction, t_m, surface) > 0.0, height_m > 0.0) << i << " at " << t_m;
        }
        if (!hit) continue;
        ++hits;
        EXPECT_NEAR(hit->point.h_m, surface(hit->point.lat_deg, hit->point.lon_deg), 1e-3);
        const glm::dvec3 there = ecef_from_geodetic(eye).m + hit->distance_m * direction;
        EXPECT_LT(glm::length(ecef_from_geodetic(hit->point).m - there), 1e-6);
    }
    return hits;
}

TEST(Ground, RaysMeetAFlatField) {
    const Surface flat = [](double, double) { return 1234.5; };
    EXPECT_GT(check_random_rays(alpine_field(flat), flat, 31, 1000), 600);
}

TEST(Ground, RaysMeetASlopedField) {
    EXPECT_GT(check_random_rays(alpine_field(slope), slope, 32, 1000), 600);
}

TEST(Ground, UndulationAndExaggerationLiftTheGround) {
    HeightField field = alpine_field([](double, double) { return 1000.0; });
    field.undulation.lat = {1.0, 0.0, 47, -1, 2};
    field.undulation.lon = {1.0, 0.0, 8, +1, 2};
    field.undulation.N_m = {50.0F, 52.0F, 54.0F, 56.0F};
    EXPECT_NEAR(*ground_h_m(field, 46.5, 8.5), 1053.0, 1e-9);
    EXPECT_NEAR(*ground_h_m(field, 46.5, 8.5, 3.0), 3053.0, 1e-9);
    EXPECT_FALSE(ground_h_m(field, 45.9, 8.5));
    const auto hit = first_ground_hit(field, ecef_from_geodetic({46.5, 8.5, 10000.0}),
                                      towards({46.5, 8.5, 0.0}, 0.0, -90.0), 1e5, 3.0);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance_m, 10000.0 - 3053.0, 1e-3);
}

TEST(Ground, StraightDownOntoAPost) {
    std::mt19937_64 random(33);
    const HeightField field =
        alpine_field([&](double, double) { return static_cast<double>(random() % 4000); });
    for (int i = 0; i < 300; ++i) {
        const int row = 1 + static_cast<int>(random() % 1199);
        const int column = 1 + static_cast<int>(random() % 1199);
        const Geodetic eye{field.grid.lat.at_deg(row), field.grid.lon.at_deg(column), 5000.0};
        EXPECT_NEAR(*ground_h_m(field, eye.lat_deg, eye.lon_deg), field.h_at_post_m(row, column), 1e-5);
        const auto hit = first_ground_hit(field, ecef_from_geodetic(eye), towards(eye, 0.0, -90.0), 1e5);
        ASSERT_TRUE(hit);
        // Beside the post the ground falls by up to 4000 m in 60: 4 nm of the ray's place are nothing.
        EXPECT_NEAR(hit->distance_m, 5000.0 - field.h_at_post_m(row, column), 1e-3);
        EXPECT_NEAR(hit->point.lat_deg, eye.lat_deg, 1e-12);
    }
}

// Roughest possible ground against brute force in small steps.
TEST(Ground, TheFirstOfManyCrossingsIsFound) {
    std::mt19937_64 random(34);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const Surface hills = [](double lat_deg, double lon_deg) {
        return 2000.0 + 800.0 * std::sin(lat_deg * 300.0) * std::cos(lon_deg * 250.0);
    };
    const HeightField field = alpine_field(hills);
    int hits = 0;
    for (int i = 0; i < 200; ++i) {
        const Geodetic eye{46.3 + 0.4 * unit(random), 8.3 + 0.4 * unit(random), 2850.0};
        const glm::dvec3 direction = towards(eye, 360.0 * unit(random), -4.0 * unit(random));
        const auto hit = first_ground_hit(field, ecef_from_geodetic(eye), direction, 4e4);
        double expected_m = -1.0;
        for (double t_m = 0.0; t_m < 1.5e4 && expected_m < 0.0; t_m += 20.0) {
            const Geodetic at = geodetic_from_ecef(Ecef{ecef_from_geodetic(eye).m + t_m * direction});
            const auto ground = ground_h_m(field, at.lat_deg, at.lon_deg);
            if (ground && at.h_m < *ground) expected_m = t_m;
        }
        if (expected_m < 0.0) continue;
        ++hits;
        ASSERT_TRUE(hit);
        // Earlier than the steps saw it only where they stepped over it.
        const auto ground = ground_h_m(field, hit->point.lat_deg, hit->point.lon_deg);
        ASSERT_TRUE(ground);
        EXPECT_NEAR(hit->point.h_m, *ground, 1e-6);
        EXPECT_LE(hit->distance_m, expected_m + 1e-3);
    }
    EXPECT_GT(hits, 50);
}

TEST(Ground, HolesAreSeenThrough) {
    // A sloping strip with a hole; behind the hole, level ground that rises.
    HeightField field =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 201, 201, [](double, double) { return 100.0; });
    for (int row = 80; row <= 120; ++row) {
        for (int column = 0; column < 201; ++column)
            field.H_m[static_cast<std::size_t>(row * 201 + column)] = void_height_m;
    }
    const double lat_deg = field.grid.lat.at_deg(100);
    const double lon_deg = field.grid.lon.at_deg(100) + 0.0001;
    EXPECT_FALSE(ground_h_m(field, lat_deg, lon_deg));
    const Geodetic above{lat_deg, lon_deg, 1000.0};
    EXPECT_FALSE(first_ground_hit(field, ecef_from_geodetic(above), towards(above, 0.0, -90.0), 1e7));
    // Down through the hole at a slant, then nothing from above; and from under the ground beside it, out
    // through its rim.
    const auto slanted = first_ground_hit(field, ecef_from_geodetic(above), towards(above, 0.0, -20.0), 1e6);
    ASSERT_TRUE(slanted) << "beyond the hole the ground goes on";
    EXPECT_NEAR(slanted->point.h_m, 100.0, 1e-3);
    EXPECT_GT(slanted->point.lat_deg, field.grid.lat.at_deg(79) - 1e-9);
    const Geodetic low{lat_deg, lon_deg, 101.0};
    const auto passed = first_ground_hit(field, ecef_from_geodetic(low), towards(low, 0.0, -10.0), 300.0);
    EXPECT_FALSE(passed);
    const Geodetic beneath{lat_deg, lon_deg, 60.0};
    const auto from_below =
        first_ground_hit(field, ecef_from_geodetic(beneath), towards(beneath, 0.0, 0.5), 1e5);
    ASSERT_TRUE(from_below);
    EXPECT_NEAR(from_below->point.h_m, 100.0, 1e-3);
}

TEST(Ground, TheRimOfTheDataIsExact) {
    // A steep plane whose rim the ray meets within its last stride: found on the data, missed beside it.
    const HeightField field = alpine_field([](double, double) { return 500.0; });
    const TrueSurface ground(field, 1.0, 1);
    for (const double offset_deg : {-1.0e-7, 1.0e-7}) {  // 1 cm
        for (const double eye_lat_deg : {45.9, 46.1}) {  // from outside, and over the data
            const Geodetic target{46.0 - offset_deg, 8.5, 500.0};
            const Geodetic eye{eye_lat_deg, 8.5, 20000.0};
            const Attitude attitude = attitude_towards(eye, target);
            const auto hit = first_hit(ground, {ecef_from_geodetic(eye), {}},
                                       towards(eye, attitude.heading_deg, attitude.pitch_deg), 1e5);
            EXPECT_EQ(hit.has_value(), offset_deg < 0.0) << eye_lat_deg;
        }
    }
}

TEST(Ground, FromTheMoonOntoTheWholeEarth) {
    const HeightField field =
        test::world_field(1.0, 90, -180, 181, 361, [](double, double) { return 250.0; });
    std::mt19937_64 random(35);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        const Geodetic target{180.0 * unit(random) - 90.0, 360.0 * unit(random) - 180.0, 250.0};
        const Geodetic eye{target.lat_deg, target.lon_deg, i % 2 == 0 ? 4.0e8 : 1.0e4};
        const auto hit = first_ground_hit(field, ecef_from_geodetic(eye), towards(eye, 0.0, -90.0), 1e9);
        ASSERT_TRUE(hit) << target.lat_deg << " " << target.lon_deg;
        EXPECT_NEAR(hit->distance_m, eye.h_m - 250.0, 1e-3);
    }
    // Past the limb there is nothing.
    const Geodetic far{0.0, 0.0, 4.0e8};
    EXPECT_FALSE(first_ground_hit(field, ecef_from_geodetic(far), towards(far, 0.0, -88.0), 1e9));
    EXPECT_FALSE(first_ground_hit(field, ecef_from_geodetic(far), towards(far, 0.0, 10.0), 1e9));
    // A level ray 2 m above the ground flies off, one a degree below the level meets it after 115 m.
    const Geodetic low{10.0, 179.9995, 252.0};
    EXPECT_FALSE(first_ground_hit(field, ecef_from_geodetic(low), towards(low, 90.0, 0.1), 1e6));
    const auto over_antimeridian =
        first_ground_hit(field, ecef_from_geodetic(low), towards(low, 90.0, -1.0), 1e6);
    ASSERT_TRUE(over_antimeridian);
    EXPECT_NEAR(over_antimeridian->distance_m, 2.0 / std::sin(0.0174532925), 0.2);
    EXPECT_LT(over_antimeridian->point.lon_deg, -179.9);
    // Over the pole.
    const Geodetic polar{89.9999, 30.0, 252.0};
    const auto over_pole = first_ground_hit(field, ecef_from_geodetic(polar), towards(polar, 0.0, -1.0), 1e6);
    ASSERT_TRUE(over_pole);
    EXPECT_NEAR(over_pole->point.lon_deg, -150.0, 1e-6);
}

TEST(Ground, RegionsPastTheAntimeridian) {
    const HeightField field =
        test::world_field(1200.0, -16 * 1200, 179 * 1200, 1201, 2401,
                          [](double, double lon_deg) { return 1000.0 * (lon_deg - 179.0); });
    EXPECT_NEAR(*ground_h_m(field, -16.5, -179.5), 1500.0, 1e-3);
    const Geodetic eye{-16.5, 179.9, 3000.0};
    const auto hit = first_ground_hit(field, ecef_from_geodetic(eye), towards(eye, 90.0, -3.0), 1e6);
    ASSERT_TRUE(hit);
    EXPECT_LT(hit->point.lon_deg, -179.0);
    EXPECT_NEAR(hit->point.h_m, 1000.0 * (hit->point.lon_deg + 360.0 - 179.0), 1e-3);
}

TEST(Ground, FromUnderTheGround) {
    const HeightField field = alpine_field([](double, double) { return 500.0; });
    const Geodetic eye{46.5, 8.5, -2000.0};
    const auto up = first_ground_hit(field, ecef_from_geodetic(eye), towards(eye, 0.0, 90.0), 1e5);
    ASSERT_TRUE(up);
    EXPECT_NEAR(up->distance_m, 2500.0, 1e-3);
    EXPECT_FALSE(first_ground_hit(field, ecef_from_geodetic(eye), towards(eye, 0.0, 90.0), 2499.0));
}

}  // namespace
}  // namespace oro
