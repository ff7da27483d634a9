// Culling under models of the world: nothing that light from a visible place brings to the eye is lost.
#include "core/frame/model_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace oro {
namespace {

// Does the sight line to a point pass above the occluder all the way?
bool is_seen(const HorizonOccluder& occluder, const Ecef& eye, const Refraction& refraction,
             const glm::dvec3& point_ecef_m) {
    const glm::dvec3 apparent = refraction.apparent_m(point_ecef_m - eye.m);
    constexpr int steps = 400;
    for (int i = 1; i < steps; ++i) {
        const glm::dvec3 at = eye.m + refraction.true_m(apparent * (static_cast<double>(i) / steps));
        if (glm::length(occluder.scaled(Ecef{at})) < 1.0) return false;
    }
    return true;
}

struct Tally {
    int seen{};
    int hidden{};
    int culled{};
    int lost{};  // seen, and yet culled
};

void judge(std::mt19937_64& random, double k, double highest_m, Tally& tally) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const HorizonOccluder occluder = occluder_below(0.0, 100.0);
    Camera camera;
    camera.eye = {-90.0 + 180.0 * unit(random), 360.0 * unit(random), std::pow(3.0e4, unit(random))};
    const SeenHorizon horizon =
        ModelView(camera, {Earth::ellipsoid, {k}, Precision::relative}, {}).horizon(occluder);
    const double h_m = highest_m * unit(random) * unit(random);
    // About as far as either sees over the horizon.
    const double bent_radius_m = 6.37e6 / (1.0 - std::max(0.0, k));
    const double distance_m =
        1.3 * unit(random) *
        (std::sqrt(2.0 * bent_radius_m * camera.eye.h_m) + std::sqrt(2.0 * bent_radius_m * h_m) + 2000.0);
    const double azimuth = 2.0 * std::numbers::pi * unit(random), angle = distance_m / 6.37e6;
    const glm::dmat3 ecef_from_enu_eye = ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg);
    const glm::dvec3 towards = ecef_from_enu_eye * glm::dvec3(std::sin(azimuth), std::cos(azimuth), 0.0);
    const glm::dvec3 direction = std::cos(angle) * ecef_from_enu_eye[2] + std::sin(angle) * towards;
    Geodetic place = geodetic_from_ecef({6.37e6 * direction});
    place.h_m = h_m;
    const glm::dvec3 point = ecef_from_geodetic(place).m;
    const HorizonCone cone = horizon_cone(occluder, std::span(&point, 1));
    const bool culled = beyond_horizon(horizon.eye, {cone.direction, cone.angle_rad * horizon.stretch});
    const bool seen = is_seen(occluder, camera.eye_ecef(), Refraction(camera.eye, {k}), point);
    ++(seen ? tally.seen : tally.hidden);
    tally.culled += culled ? 1 : 0;
    tally.lost += culled && seen ? 1 : 0;
}

TEST(ModelView, TheHorizonHidesNothingThatBentLightShows) {
    constexpr unsigned seed = 72;
    for (const double highest_m : {9000.0, 100000.0}) {
        for (const double k : {-1.0, -0.3, 0.0, 0.07, 0.13, 0.3, 0.6, 0.9}) {
            std::mt19937_64 random(seed);
            Tally tally;
            for (int i = 0; i < 20000; ++i) judge(random, k, highest_m, tally);
            std::printf("seed %u, up to %6.0f m, k %5.2f: %d seen, %d hidden, %d culled, %d lost\n", seed,
                        highest_m, k, tally.seen, tally.hidden, tally.culled, tally.lost);
            EXPECT_EQ(tally.lost, 0);
            EXPECT_GT(tally.seen, 2000);
            EXPECT_GT(tally.culled, tally.hidden / 4);
        }
    }
}

// The test above can fail: without widening, bent light is lost.
TEST(ModelView, WithoutWideningBentLightWouldBeLost) {
    const HorizonOccluder occluder = occluder_below(0.0, 100.0);
    Camera camera;
    camera.eye = {46.0, 8.0, 100.0};
    const SeenHorizon straight = ModelView(camera, {}, {}).horizon(occluder);
    const SeenHorizon bent =
        ModelView(camera, {Earth::ellipsoid, {0.13}, Precision::relative}, {}).horizon(occluder);
    EXPECT_EQ(straight.stretch, 1.0);
    EXPECT_EQ(straight.eye.angle_rad, horizon_eye(occluder, camera.eye_ecef()).angle_rad);
    EXPECT_NEAR(bent.eye.angle_rad / straight.eye.angle_rad, 1.02 / std::sqrt(1.0 - 0.13), 0.002);
    // 0.2 m above the sea 39 km away: hidden behind 35.7 km of horizon, but not with bent light (38.3 km).
    const glm::dvec3 point = ecef_from_geodetic({46.0 + 39.0 / 111.15, 8.0, 0.2}).m;
    const HorizonCone cone = horizon_cone(occluder, std::span(&point, 1));
    EXPECT_TRUE(is_seen(occluder, camera.eye_ecef(), Refraction(camera.eye, {0.13}), point));
    EXPECT_FALSE(is_seen(occluder, camera.eye_ecef(), Refraction(), point));
    EXPECT_TRUE(beyond_horizon(straight.eye, cone));
    EXPECT_FALSE(beyond_horizon(bent.eye, {cone.direction, cone.angle_rad * bent.stretch}));
}

}  // namespace
}  // namespace oro
