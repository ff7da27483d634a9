// The ground of several grids: sight lines, profiles and places see the grid that is the ground there, and
// the steps between.
#include "geo/together/region_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>

#include "core/sight/ground_profile.h"
#include "core/sight/observer.h"
#include "core/truth/oracle.h"
#include "geo/together/cut_regions.h"
#include "tests/support/three_grids.h"

namespace oro {
namespace {

double between(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

// A sight line, followed by its own formula.
struct Line {
    const TrueGround& ground;
    Sight sight;
    glm::dvec3 direction;
    [[nodiscard]] Geodetic at(double t_m) const {
        return geodetic_from_ecef({sight.eye.m + sight.refraction.true_m(t_m * direction)});
    }
    // Height over the ground; nothing over none.
    [[nodiscard]] std::optional<double> above_m(double t_m) const {
        const Geodetic point = at(t_m);
        const auto ground_h_m = ground.h_m(point.lat_deg, point.lon_deg);
        return ground_h_m ? std::optional(point.h_m - *ground_h_m) : std::nullopt;
    }
};

Line random_line(const TrueGround& ground, std::mt19937& random) {
    const double lat_deg = 47.0 - between(random, 0.01, 0.065), lon_deg = 8.0 + between(random, 0.01, 0.065);
    const double h_m = ground.h_m(lat_deg, lon_deg).value_or(500.0) +
                       std::exp(between(random, std::log(0.5), std::log(2000.0)));
    const Geodetic eye{lat_deg, lon_deg, h_m};
    const Air air = random() % 2 == 0 ? Air{} : Air{0.13};
    const Camera camera{eye, {between(random, 0.0, 360.0), between(random, -60.0, 8.0), 0.0}, 45.0, 1, 1};
    return {ground, sight_from(eye, air), camera.ecef_direction_at({0.5, 0.5})};
}

// Marching by small steps: where the line first goes under the ground, between two of them; or where it comes
// to no ground.
struct Marched {
    bool hit{};
    bool lost{};
    double from_m{}, to_m{};
};
Marched march(const Line& line, double reach_m) {
    constexpr double step_m = 1.0;
    double before_m = 0.0;
    for (double t_m = step_m; t_m < reach_m; t_m += step_m) {
        const auto above_m = line.above_m(t_m);
        if (!above_m) return {false, true, before_m, t_m};
        if (*above_m < 0.0) return {true, false, before_m, t_m};
        before_m = t_m;
    }
    return {};
}

TEST(RegionGround, SightLinesMeetWhatMarchingFinds) {
    constexpr unsigned seed = 91;
    constexpr int lines = 4000;
    constexpr double reach_m = 6000.0;
    std::mt19937 random(seed);
    const Region region = test::three_grids(90);
    const auto grounds = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grounds.ok()) << grounds.error().line();
    const TrueGround& ground = (*grounds)->ground();
    ASSERT_EQ(ground.grids(), 3U);
    ASSERT_GT(ground.pieces().size(), 100U);
    int hits = 0, steps = 0, grazes = 0, missed = 0, wrong = 0, off_ground = 0;
    for (int i = 0; i < lines; ++i) {
        const Line line = random_line(ground, random);
        const Oracle oracle(ground, line.sight);
        const auto hit = oracle.first_hit(line.direction, reach_m);
        const Marched marched = march(line, reach_m);
        if (hit && !hit->between_grids) {
            const auto above_m = line.above_m(hit->distance_m);
            if (!above_m || std::abs(*above_m) > 1.0e-5) ++off_ground;
        }
        // Beyond the data, and in a hole of all, nothing is told.
        if (marched.lost && (!hit || hit->distance_m > marched.from_m)) continue;
        if (!hit) {
            if (marched.hit) ++missed;
            continue;
        }
        ++hits;
        steps += hit->between_grids ? 1 : 0;
        if (marched.hit && hit->distance_m >= marched.from_m - 0.01 && hit->distance_m <= marched.to_m + 0.01)
            continue;
        // Steps of the march may jump over a crest, a corner, or go along one.
        if (hit->distance_m < (marched.hit ? marched.from_m : reach_m)) {
            ++grazes;
            const double away_m = 0.01;
            const auto before_m = line.above_m(hit->distance_m - away_m),
                       after_m = line.above_m(hit->distance_m + away_m);
            const bool passes = before_m && after_m && std::min(*before_m, *after_m) < 0.02;
            if (!passes && !hit->between_grids) ++wrong;
        } else {
            ++missed;
        }
    }
    std::printf(
        "seed %u: %d lines, %d meet ground, %d of them on a step, %d between steps of the march; %d missed, "
        "%d "
        "where there is none, %d off the ground\n",
        seed, lines, hits, steps, grazes, missed, wrong, off_ground);
    EXPECT_GT(hits, lines / 2);
    EXPECT_GT(steps, 10);
    EXPECT_LT(grazes, hits / 50);
    EXPECT_EQ(missed, 0);
    EXPECT_EQ(wrong, 0);
    EXPECT_EQ(off_ground, 0);
}

// A step is met as high as the two surfaces are there, and nowhere else.
TEST(RegionGround, StepsAreAsHighAsTheSurfacesDiffer) {
    const Region region = test::three_grids(90);
    const auto grounds = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grounds.ok()) << grounds.error().line();
    const TrueGround& ground = (*grounds)->ground();
    double worst_m = 0.0;
    for (const SurfaceTriangle& piece : ground.pieces()) {
        for (const Geodetic& corner : piece.corners) {
            double nearest_m = 1.0e9;
            for (std::size_t grid = 0; grid < ground.grids(); ++grid) {
                // A rounded place on a rim may lie beyond it.
                for (const double aside_deg : {0.0, 1.0e-9, -1.0e-9}) {
                    for (const double up_deg : {0.0, 1.0e-9, -1.0e-9}) {
                        const auto h_m =
                            ground.surface(grid).h_m(corner.lat_deg + up_deg, corner.lon_deg + aside_deg);
                        if (h_m) nearest_m = std::min(nearest_m, std::abs(*h_m - corner.h_m));
                    }
                }
            }
            worst_m = std::max(worst_m, nearest_m);
        }
    }
    std::printf("%zu pieces, corners at most %.6f m off a surface\n", ground.pieces().size(), worst_m);
    EXPECT_LT(worst_m, 0.001);
}

TEST(RegionGround, ProfilesFollowTheGridThatIsTheGround) {
    constexpr unsigned seed = 92;
    std::mt19937 random(seed);
    const Region region = test::three_grids(90);
    const auto grounds = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grounds.ok()) << grounds.error().line();
    const TrueGround& ground = (*grounds)->ground();
    int compared = 0, near_rims = 0;
    double worst_m = 0.0;
    for (int i = 0; i < 60; ++i) {
        const double north_deg = 47.0 - between(random, 0.005, 0.07),
                     west_deg = 8.0 + between(random, 0.005, 0.07),
                     south_deg = 47.0 - between(random, 0.005, 0.07),
                     east_deg = 8.0 + between(random, 0.005, 0.07);
        const double length_m = 111'000.0 * std::hypot(north_deg - south_deg, west_deg - east_deg);
        const auto way = [&](double along_m) {
            const double share = along_m / length_m;
            return Geodetic{std::lerp(north_deg, south_deg, share), std::lerp(west_deg, east_deg, share),
                            0.0};
        };
        std::vector<ProfilePoint> points;
        add_profile(ground, way, 0.0, length_m, points);
        for (double along_m = 0.5; along_m < length_m; along_m += 7.3) {
            const auto after = std::ranges::lower_bound(points, along_m, {}, &ProfilePoint::along_m);
            if (after == points.begin() || after == points.end()) continue;
            const auto before = after - 1;
            const Geodetic place = way(along_m);
            const auto h_m = ground.h_m(place.lat_deg, place.lon_deg);
            if (!h_m || !before->has_ground || !after->has_ground) continue;
            const double profile_h_m = std::lerp(
                before->h_m, after->h_m, (along_m - before->along_m) / (after->along_m - before->along_m));
            if (after->along_m - before->along_m < 3.0 * off_rim_m) {
                ++near_rims;
                continue;
            }
            ++compared;
            worst_m = std::max(worst_m, std::abs(profile_h_m - *h_m));
        }
    }
    std::printf("seed %u: %d places of 60 profiles, at most %.4f m off; %d on a rim left out\n", seed,
                compared, worst_m, near_rims);
    EXPECT_GT(compared, 10'000);
    EXPECT_LT(near_rims, compared / 50);
    EXPECT_LT(worst_m, 0.02);
}

// Over a rim a line of sight is seen or not as marching says.
TEST(RegionGround, LookoutsSeeOverSteps) {
    constexpr unsigned seed = 93;
    std::mt19937 random(seed);
    const Region region = test::three_grids(90);
    const auto grounds = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grounds.ok()) << grounds.error().line();
    const TrueGround& ground = (*grounds)->ground();
    int seen = 0, asked = 0, wrong = 0;
    for (int i = 0; i < 600; ++i) {
        const auto point = [&](double above_m) {
            const double lat_deg = 47.0 - between(random, 0.02, 0.055),
                         lon_deg = 8.0 + between(random, 0.02, 0.055);
            return Geodetic{lat_deg, lon_deg, ground.h_m(lat_deg, lon_deg).value_or(-1.0e6) + above_m};
        };
        const Geodetic eye = point(between(random, 2.0, 60.0)), target = point(between(random, 2.0, 60.0));
        if (eye.h_m < -1.0e5 || target.h_m < -1.0e5) continue;
        const Observer observer(ground, eye, Air{});
        const glm::dvec3 offset_m = ecef_from_geodetic(target).m - observer.sight().eye.m;
        const double length_m = glm::length(offset_m);
        const Line line{ground, observer.sight(), offset_m / length_m};
        double least_m = 1.0e9;
        bool lost = false;
        for (double t_m = 0.0; t_m < length_m; t_m += 0.5) {
            const auto above_m = line.above_m(t_m);
            lost = lost || !above_m;
            if (above_m) least_m = std::min(least_m, *above_m);
        }
        if (lost || std::abs(least_m) < 0.3) continue;  // between two steps of the march
        ++asked;
        seen += observer.sees(target) ? 1 : 0;
        if (observer.sees(target) != (least_m > 0.0)) ++wrong;
        const double clearance_m = observer.line_to(target).clearance_m;
        if ((clearance_m > 0.0) != (least_m > 0.0) && least_m < 0.0) ++wrong;
    }
    std::printf("seed %u: %d lines asked, %d seen, %d wrong\n", seed, asked, seen, wrong);
    EXPECT_GT(asked, 300);
    EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace oro
