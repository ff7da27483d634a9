// The oracle against surfaces whose crossings are known in closed form, and against brute force.
#include "core/truth/oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "core/earth/camera.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/ground.h"
#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

using Crossing = std::function<std::optional<double>(const glm::dvec3& eye, const glm::dvec3& direction)>;

// First positive root of a t^2 + 2 b t + c.
std::optional<double> first_root(double a, double b, double c) {
    const double discriminant = b * b - a * c;
    if (discriminant < 0.0) return std::nullopt;
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    const double low = std::min(q / a, c / q), high = std::max(q / a, c / q);
    return low > 0.0 ? std::optional(low) : high > 0.0 ? std::optional(high) : std::nullopt;
}

// Rays from eyes over (and a tenth of them under) a surface towards places of it: how far the hits are from
// the known crossings, along the ray times the sine of the angle at which it meets the ground.
struct Comparison {
    int rays{};
    int hits{};
    double worst_m{};
    double worst_residual_m{};
};
Comparison compare(const HeightField& field, const Crossing& truth, unsigned seed, int rays,
                   double highest_eye_m, const std::optional<glm::dvec3>& normal = std::nullopt) {
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const TrueSurface surface(field, 1.0, 2);
    const PostGrid& grid = field.grid;
    Comparison comparison;
    const auto place = [&] {
        return Geodetic{
            grid.south_deg() + (0.05 + 0.9 * unit(random)) * (grid.north_deg() - grid.south_deg()),
            grid.west_deg() + (0.05 + 0.9 * unit(random)) * (grid.east_deg() - grid.west_deg()), 0.0};
    };
    for (; comparison.rays < rays; ++comparison.rays) {
        Geodetic eye = place(), target = place();
        target.h_m = *surface.h_m(target.lat_deg, target.lon_deg);
        const double above_m = std::pow(highest_eye_m, unit(random)) - 0.9;
        eye.h_m = *surface.h_m(eye.lat_deg, eye.lon_deg) + (comparison.rays % 10 == 0 ? -above_m : above_m);
        const Ecef from = ecef_from_geodetic(eye);
        const glm::dvec3 direction = glm::normalize(ecef_from_geodetic(target).m - from.m);
        const auto hit = first_hit(surface, {from, {}}, direction, 1.0e7);
        const auto expected_m = truth(from.m, direction);
        EXPECT_TRUE(hit && expected_m) << comparison.rays;
        if (!hit || !expected_m) continue;
        ++comparison.hits;
        const glm::dvec3 across = normal.value_or(ecef_from_enu(hit->point.lat_deg, hit->point.lon_deg)[2]);
        const double across_m = std::abs((hit->distance_m - *expected_m) * glm::dot(direction, across));
        if (across_m > comparison.worst_m) comparison.worst_m = across_m;
        comparison.worst_residual_m = std::max(comparison.worst_residual_m, std::abs(hit->residual_m));
    }
    std::printf("%d rays, %d hits: farthest from the known crossing %.3g m, largest residual %.3g m\n",
                comparison.rays, comparison.hits, comparison.worst_m, comparison.worst_residual_m);
    return comparison;
}

// The ellipsoid itself: (x, y, z / (1 - f)) on a sphere. Constant height 0, at posts of a degree.
TEST(Oracle, TenThousandRaysOntoTheEllipsoid) {
    const HeightField field = test::world_field(1.0, 60, 0, 31, 41, [](double, double) { return 0.0; });
    const double squash = 1.0 / (1.0 - wgs84_f);
    const Crossing truth = [&](const glm::dvec3& eye, const glm::dvec3& direction) {
        const glm::dvec3 e(eye.x, eye.y, eye.z * squash), d(direction.x, direction.y, direction.z * squash);
        return first_root(glm::dot(d, d), glm::dot(e, d), glm::dot(e, e) - wgs84_a_m * wgs84_a_m);
    };
    // Eyes a degree apart and more see each other through the Earth: those hits are crossings, too.
    EXPECT_LT(compare(field, truth, 401, 10000, 1.0e6).worst_m, 1.0e-6);
}

// At a constant height the surface is no quadric; but straight down, from over it, the crossing is known, and
// everywhere the height of the hit is.
TEST(Oracle, TenThousandRaysOntoAConstantHeight) {
    const HeightField field =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 601, 601, [](double, double) { return 1234.5; });
    const TrueSurface surface(field, 1.0, 2);
    std::mt19937_64 random(402);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double worst_m = 0.0;
    int hits = 0;
    for (int i = 0; i < 10000; ++i) {
        const Geodetic eye{46.6 + 0.3 * unit(random), 8.1 + 0.3 * unit(random),
                           1234.5 + std::pow(10.0, 5.0 * unit(random) - 1.0)};
        const bool down = i % 2 == 0;
        const Geodetic target = down ? Geodetic{eye.lat_deg, eye.lon_deg, 0.0}
                                     : Geodetic{46.6 + 0.3 * unit(random), 8.1 + 0.3 * unit(random), 1234.5};
        const Ecef from = ecef_from_geodetic(eye);
        const auto hit =
            first_hit(surface, {from, {}}, glm::normalize(ecef_from_geodetic(target).m - from.m), 1.0e6);
        ASSERT_TRUE(hit) << i;
        ++hits;
        worst_m = std::max(worst_m, std::abs(hit->point.h_m - 1234.5));
        if (down) worst_m = std::max(worst_m, std::abs(hit->distance_m - (eye.h_m - 1234.5)));
    }
    std::printf("%d hits, farthest from the height %.3g m\n", hits, worst_m);
    EXPECT_LT(worst_m, 1.0e-6);
}

// A sphere that touches the ellipsoid in the middle of a field with posts 1" apart: heights below 1 m, so
// that floats hold them to 3e-8 m, and the chord of a cell lies 1.3e-7 m off at most.
TEST(Oracle, TenThousandRaysOntoASphere) {
    const double radius_m = std::sqrt(prime_vertical_radius_m(46.5) * meridian_radius_m(46.5));
    const glm::dvec3 centre = ecef_from_geodetic({46.5, 8.5, -radius_m}).m;
    const auto to_sphere_m = [&](const glm::dvec3& from, const glm::dvec3& direction) {
        const glm::dvec3 e = from - centre;
        return first_root(1.0, glm::dot(e, direction), glm::dot(e, e) - radius_m * radius_m);
    };
    const HeightField field = test::world_field(
        3600.0, 3600 * 46 + 1800 + 360, 3600 * 8 + 1800 - 360, 721, 721, [&](double lat_deg, double lon_deg) {
            return 100.0 - *to_sphere_m(ecef_from_geodetic({lat_deg, lon_deg, 100.0}).m,
                                        -ecef_from_enu(lat_deg, lon_deg)[2]);
        });
    EXPECT_LT(compare(field, to_sphere_m, 403, 10000, 1.0e5).worst_m, 1.0e-6);
}

// A plane that falls by 3 in 10, at posts 0.1 m apart (heights to 5 m: floats hold them to 2.4e-7 m).
TEST(Oracle, TenThousandRaysOntoATiltedPlane) {
    const double posts_per_deg = 1.1e6;
    const Geodetic middle{46.5, 8.5, 0.0};
    const glm::dmat3 enu = ecef_from_enu(middle.lat_deg, middle.lon_deg);
    const glm::dvec3 foot = ecef_from_geodetic(middle).m,
                     normal = glm::normalize(enu * glm::dvec3(0.3, -0.1, 1.0));
    const Crossing truth = [&](const glm::dvec3& eye, const glm::dvec3& direction) -> std::optional<double> {
        const double t_m = glm::dot(foot - eye, normal) / glm::dot(direction, normal);
        return t_m > 0.0 ? std::optional(t_m) : std::nullopt;
    };
    const auto north = static_cast<std::int64_t>(46.5 * posts_per_deg),
               west = static_cast<std::int64_t>(8.5 * posts_per_deg);
    const HeightField field = test::world_field(
        posts_per_deg, north + 120, west - 120, 241, 241, [&](double lat_deg, double lon_deg) {
            return 100.0 - *truth(ecef_from_geodetic({lat_deg, lon_deg, 100.0}).m,
                                  -ecef_from_enu(lat_deg, lon_deg)[2]);
        });
    EXPECT_LT(compare(field, truth, 404, 10000, 100.0, normal).worst_m, 1.0e-6);
}

// Rough ground, every ray also walked in short steps: what the steps see first is what the oracle gives, and
// no crossing is earlier. Refracted rays, too.
TEST(Oracle, BruteForceFindsNothingEarlier) {
    std::mt19937_64 random(405);
    std::printf("seed 405\n");
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const HeightField field = test::world_field(1200.0, 47 * 1200, 8 * 1200, 161, 161, [&](double, double) {
        return unit(random) < 0.003 ? static_cast<double>(void_height_m) : 1500.0 + 500.0 * unit(random);
    });
    const TrueSurface surface(field, 1.0, 1);
    int hits = 0, later = 0;
    for (int i = 0; i < 600; ++i) {
        const Geodetic eye{46.88 + 0.11 * unit(random), 8.01 + 0.11 * unit(random),
                           1700.0 + 600.0 * unit(random)};
        const Sight sight = sight_from(eye, {i % 2 == 0 ? 0.0 : 0.5});
        Camera camera;
        camera.eye = eye;
        camera.attitude = {360.0 * unit(random), 3.0 - 20.0 * unit(random), 0.0};
        const glm::dvec3 direction = camera.ecef_direction_at({0.5, 0.5});
        const auto hit = first_hit(surface, sight, direction, 1.5e4);
        const auto above_m = [&](double t_m) -> std::optional<double> {
            const Geodetic at = geodetic_from_ecef({sight.eye.m + sight.refraction.true_m(t_m * direction)});
            const auto ground = surface.h_m(at.lat_deg, at.lon_deg);
            return ground ? std::optional(at.h_m - *ground) : std::nullopt;
        };
        if (hit) {
            ++hits;
            EXPECT_NEAR(above_m(hit->distance_m).value_or(0.0), 0.0, 1.0e-5);
        }
        const double end_m = hit ? hit->distance_m - 0.5 : 1.5e4;
        std::optional<double> before = above_m(0.0);
        for (double t_m = 2.0; t_m < end_m; t_m += 2.0) {
            const std::optional<double> now = above_m(t_m);
            if (before && now && (*before > 0.0) != (*now > 0.0)) ++later;
            before = now;
        }
    }
    std::printf("%d hits\n", hits);
    EXPECT_GT(hits, 300);
    EXPECT_EQ(later, 0);
}

// Through posts and along rows, columns and diagonals, where a line belongs to several triangles: it meets
// one of them.
TEST(Oracle, NoLineSlipsThroughBetweenTriangles) {
    std::mt19937_64 random(406);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const HeightField field = test::world_field(1200.0, 47 * 1200, 8 * 1200, 201, 201,
                                                [&](double, double) { return 100.0 * unit(random); });
    const TrueSurface surface(field, 1.0, 1);
    for (int i = 0; i < 20000; ++i) {
        const int row = 20 + static_cast<int>(random() % 160), column = 20 + static_cast<int>(random() % 160);
        const double share = i % 4 == 0 ? 0.0 : unit(random);
        const double down = i % 4 == 1 ? 0.0 : share, right = i % 4 == 2 ? 0.0 : share;
        const Geodetic target{field.grid.lat.at_deg(row) - down / 1200.0,
                              field.grid.lon.at_deg(column) + right / 1200.0, 0.0};
        Geodetic on = target;
        on.h_m = *surface.h_m(target.lat_deg, target.lon_deg);
        // From over the same meridian, the same parallel, and straight above.
        const Geodetic eye{on.lat_deg + (i % 3 == 0 ? 0.01 : 0.0), on.lon_deg + (i % 3 == 1 ? 0.01 : 0.0),
                           3000.0};
        const Ecef from = ecef_from_geodetic(eye);
        const glm::dvec3 to = ecef_from_geodetic(on).m - from.m;
        const auto hit = first_hit(surface, {from, {}}, glm::normalize(to), 1.0e5);
        ASSERT_TRUE(hit) << i;
        ASSERT_LT(hit->distance_m, glm::length(to) + 1.0e-5) << i;
    }
}

TEST(Oracle, TellsTheCellAndTheTriangle) {
    const HeightField field =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 21, 21, [](double, double) { return 100.0; });
    const TrueSurface surface(field, 1.0, 1);
    for (const bool south_west : {true, false}) {
        const double down = south_west ? 0.7 : 0.3, right = south_west ? 0.3 : 0.7;
        const Geodetic eye{47.0 - (5 + down) / 1200.0, 8.0 + (9 + right) / 1200.0, 500.0};
        const auto hit =
            first_hit(surface, sight_from(eye), -ecef_from_enu(eye.lat_deg, eye.lon_deg)[2], 1e4);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->row, 5);
        EXPECT_EQ(hit->column, 9);
        EXPECT_EQ(hit->west, south_west);
        EXPECT_NEAR(hit->distance_m, 400.0, 1e-8);
    }
}

// What nothing can be seen of: no cell, no height.
TEST(Oracle, SeesNothingWhereNothingIs) {
    const HeightField row =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 1, 50, [](double, double) { return 1.0; });
    const HeightField column =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 50, 1, [](double, double) { return 1.0; });
    const HeightField voids = test::world_field(1200.0, 47 * 1200, 8 * 1200, 300, 300, [](double, double) {
        return static_cast<double>(void_height_m);
    });
    for (const HeightField* field : {&row, &column, &voids}) {
        const TrueSurface surface(*field, 1.0, 2);
        const Geodetic eye{46.99, 8.02, 500.0};
        EXPECT_FALSE(first_hit(surface, sight_from(eye), -ecef_from_enu(eye.lat_deg, eye.lon_deg)[2], 1e6));
        EXPECT_FALSE(surface.h_m(46.99, 8.02));
    }
}

// Sea level seen from 100 m by a ray 0.4 degrees down, eastward along the equator. At a distance s the ray is
// 100 m - s tan(0.4 deg) + c s^2 / 2 above the ground, c = 1 / R for straight light (17,936 m) and less by
// the light's own curvature when it bends (17,218.6 m with k = 0.13). Second order in s / R: good to 1 m.
TEST(Oracle, RefractionBringsTheGroundNearer) {
    const HeightField field =
        test::world_field(1200.0, 600, 0, 1201, 1201, [](double, double) { return 0.0; });
    const TrueSurface surface(field, 1.0, 1);
    Camera camera;
    camera.eye = {0.0, 0.1, 100.0};
    camera.attitude = {90.0, -0.4, 0.0};
    const glm::dvec3 direction = camera.ecef_direction_at({0.5, 0.5});
    const auto straight = first_hit(surface, sight_from(camera.eye), direction, 1e6);
    const auto bent = first_hit(surface, sight_from(camera.eye, {0.13}), direction, 1e6);
    ASSERT_TRUE(straight && bent);
    const auto expected_m = [](double curvature_per_m) {
        const double slope = std::tan(0.4 * std::numbers::pi / 180.0);
        return (slope - std::sqrt(slope * slope - 2.0 * curvature_per_m * 100.0)) / curvature_per_m;
    };
    const double k = 0.13;
    const double R_m = std::sqrt(prime_vertical_radius_m(0.0) * meridian_radius_m(0.0));
    EXPECT_NEAR(straight->distance_m, expected_m(1.0 / wgs84_a_m), 1.0);
    EXPECT_NEAR(bent->distance_m, expected_m(1.0 / wgs84_a_m - k / R_m), 1.0);
    EXPECT_NEAR(straight->distance_m, 17936.0, 5.0);
    EXPECT_NEAR(bent->distance_m, 17218.6, 1.5);
}

}  // namespace
}  // namespace oro
