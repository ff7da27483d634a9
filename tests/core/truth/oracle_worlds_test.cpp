// The oracle over other Earths than the ellipsoid: what a picture of them shows.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>

#include "core/terrain/ground.h"
#include "core/truth/oracle.h"
#include "tests/core/truth/world_field.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

class OracleOfModels : public ::testing::TestWithParam<Earth> {};

// Each hit lies on its ray, by the model's own formula; and marching along the ray meets no ground before it.
TEST_P(OracleOfModels, HitsLieOnTheRayAndNothingIsNearer) {
    constexpr unsigned seed = 7;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const HeightField field = test::rough_field(47.0, 8.0, 600, 600);
    const TrueSurface surface(field, 1.0, 2);
    int hits = 0, earlier = 0;
    double farthest_m = 0.0;
    for (int i = 0; i < 300; ++i) {
        Geodetic eye{46.5 + 0.5 * unit(random), 8.0 + 0.5 * unit(random), 0.0};
        eye.h_m = ground_h_m(field, eye.lat_deg, eye.lon_deg).value() + std::pow(10.0, 4.0 * unit(random));
        const WorldModel model{GetParam(), Air{i % 2 == 0 ? 0.0 : 0.13}, Precision::relative};
        const Sight sight = sight_of(model, eye);
        const double turn = 6.2831853 * unit(random), fall = 0.6 * unit(random) * unit(random);
        const glm::dvec3 direction =
            ecef_from_enu(eye.lat_deg, eye.lon_deg) *
            glm::dvec3(std::cos(fall) * std::sin(turn), std::cos(fall) * std::cos(turn), -std::sin(fall));
        const auto hit = first_hit(surface, sight, direction, 1.0e6);
        const double until_m = hit ? hit->distance_m - 1.0 : 60000.0;
        for (double t_m = 0.0; t_m < until_m; t_m += 10.0) {
            const auto at = model_point(GetParam(), eye, sight.refraction.true_m(t_m * direction));
            ASSERT_TRUE(at);
            const auto ground_m = surface.h_m(at->lat_deg, at->lon_deg);
            if (ground_m && at->h_m < *ground_m - 1.0e-6) ++earlier;
        }
        if (!hit) continue;
        ++hits;
        const glm::dvec3 seen_m = model_offset_m(model, eye, hit->point);
        farthest_m = std::max(farthest_m, glm::length(seen_m - hit->distance_m * direction));
        EXPECT_NEAR(surface.h_m(hit->point.lat_deg, hit->point.lon_deg).value(), hit->point.h_m, 1.0e-6)
            << "m";
    }
    EXPECT_GT(hits, 150);
    EXPECT_EQ(earlier, 0);
    EXPECT_LT(farthest_m, 1.0e-6) << "m";
}

// The same of posts on a net: turned, over the antimeridian, over a pole.
TEST_P(OracleOfModels, MeetsPostsOnANetAsMarchingAlongTheRayDoes) {
    constexpr unsigned seed = 8;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const test::PlaneOfPosts& plane : {test::PlaneOfPosts{400, 500, {46.5, 8.0}, 90.0, 33.0},
                                            test::PlaneOfPosts{300, 400, {-17.0, 179.98}, 120.0, -70.0},
                                            test::PlaneOfPosts{300, 300, {89.95, 20.0}, 100.0, 10.0}}) {
        const HeightField field = test::net_field(plane, test::patchy_H_m);
        const TrueSurface surface(field, 1.0, 2);
        // Degrees at a pole are no longer than they are at the eye: a plane there is no ground to look at.
        if (GetParam() == Earth::flat && plane.middle.lat_deg > 80.0) continue;
        int hits = 0, earlier = 0;
        double farthest_m = 0.0;
        for (int i = 0; i < 200; ++i) {
            const PostPlace under =
                plane.place_of(unit(random) * (plane.rows - 1), unit(random) * (plane.columns - 1));
            Geodetic eye{under.lat_deg, under.lon_deg, 0.0};
            eye.h_m = surface.h_m(eye.lat_deg, eye.lon_deg).value() + std::pow(10.0, 4.0 * unit(random));
            const WorldModel model{GetParam(), Air{i % 2 == 0 ? 0.0 : 0.13}, Precision::relative};
            const Sight sight = sight_of(model, eye);
            const double turn = 6.2831853 * unit(random), fall = 0.6 * unit(random) * unit(random);
            const glm::dvec3 direction =
                ecef_from_enu(eye.lat_deg, eye.lon_deg) *
                glm::dvec3(std::cos(fall) * std::sin(turn), std::cos(fall) * std::cos(turn), -std::sin(fall));
            const auto hit = first_hit(surface, sight, direction, 1.0e6);
            const double until_m = hit ? hit->distance_m - 1.0 : 60000.0;
            for (double t_m = 0.0; t_m < until_m; t_m += 20.0) {
                const auto at = model_point(GetParam(), eye, sight.refraction.true_m(t_m * direction));
                ASSERT_TRUE(at);
                const auto ground_m = surface.h_m(at->lat_deg, at->lon_deg);
                if (ground_m && at->h_m < *ground_m - 1.0e-6) ++earlier;
            }
            if (!hit) continue;
            ++hits;
            const glm::dvec3 seen_m = model_offset_m(model, eye, hit->point);
            farthest_m = std::max(farthest_m, glm::length(seen_m - hit->distance_m * direction));
            EXPECT_NEAR(surface.h_m(hit->point.lat_deg, hit->point.lon_deg).value(), hit->point.h_m, 1.0e-5)
                << "m";
        }
        EXPECT_GT(hits, 80);
        EXPECT_EQ(earlier, 0);
        EXPECT_LT(farthest_m, 1.0e-5) << "m";
    }
}

INSTANTIATE_TEST_SUITE_P(Earths, OracleOfModels,
                         ::testing::Values(Earth::ellipsoid, Earth::sphere, Earth::flat),
                         [](const auto& earth) {
                             return earth.param == Earth::flat     ? "flat"
                                    : earth.param == Earth::sphere ? "sphere"
                                                                   : "ellipsoid";
                         });

// A plane with the whole Earth on it, cut opposite to the eye: lines find the first ground from one end to
// the other, and none beyond.
TEST(OracleOverThePlane, FindsTheFirstGroundOfAWholeEarth) {
    constexpr unsigned seed = 435;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const HeightField field = test::world_field(2.0, 180, -360, 361, 721, [](double lat_deg, double lon_deg) {
        return 40000.0 * std::sin(lat_deg * 0.3) * std::cos(radians_from_deg(lon_deg).rad * 9.0);
    });
    ASSERT_TRUE(field.grid.wraps_longitude());
    const TrueSurface surface(field, 1.0, 2);
    int hits = 0, far_hits = 0, earlier = 0, of_the_other_end = 0;
    double farthest_m = 0.0;
    for (int i = 0; i < 300; ++i) {
        Geodetic eye{120.0 * unit(random) - 60.0, 360.0 * unit(random) - 180.0, 0.0};
        eye.h_m = surface.h_m(eye.lat_deg, eye.lon_deg).value() + std::pow(10.0, 6.0 * unit(random));
        const WorldModel model{Earth::flat, Air{i % 2 == 0 ? 0.0 : 0.13}, Precision::relative};
        const Sight sight = sight_of(model, eye);
        const double turn = 6.2831853 * unit(random), fall = 0.3 * std::pow(unit(random), 4.0);
        const glm::dvec3 direction =
            ecef_from_enu(eye.lat_deg, eye.lon_deg) *
            glm::dvec3(std::cos(fall) * std::sin(turn), std::cos(fall) * std::cos(turn), -std::sin(fall));
        const auto hit = first_hit(surface, sight, direction, 1.0e8);
        const double until_m = hit ? hit->distance_m - 1.0 : 2.0e7;
        for (double t_m = 0.0; t_m < until_m; t_m += 5000.0) {
            const auto at = model_point(Earth::flat, eye, sight.refraction.true_m(t_m * direction));
            if (!at) break;  // off the plane, and lines are straight
            const auto ground_m = surface.h_m(at->lat_deg, at->lon_deg);
            if (ground_m && at->h_m < *ground_m - 1.0e-6) ++earlier;
        }
        if (!hit) continue;
        ++hits;
        if (hit->distance_m > 1.0e6) ++far_hits;
        const glm::dvec3 seen_m = model_offset_m(model, eye, hit->point);
        farthest_m = std::max(farthest_m, glm::length(seen_m - hit->distance_m * direction));
        const double east_deg = std::remainder(hit->point.lon_deg - eye.lon_deg, 360.0);
        if (east_deg * std::sin(turn) < 0.0) ++of_the_other_end;
    }
    EXPECT_GT(hits, 150);
    EXPECT_GT(far_hits, 20);
    EXPECT_EQ(earlier, 0);
    EXPECT_EQ(of_the_other_end, 0);
    EXPECT_LT(farthest_m, 1.0e-5) << "m, of up to 2e7 m";
}

}  // namespace
}  // namespace oro
