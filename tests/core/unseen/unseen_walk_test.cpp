// The horizon of the data against brute force: sight lines of every pixel, walked in small steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/core/unseen/unseen_land.h"

namespace oro {
namespace {

using test::ceiling_m, test::hills, test::Land, test::turned_square;

constexpr double highest_sea_m = 86.0;

// What a sight line comes upon first: places without data below the ceiling, known ground, or neither.
enum class First { unknown, ground, neither };
First walked(const Land& land, const Camera& camera, const Sight& sight, glm::dvec2 place_px) {
    const glm::dvec3 direction = camera.ecef_direction_at(place_px);
    const double ceiling_h_m = ceiling_m * land.surface->exaggeration() + highest_sea_m;
    const double reach_m = sight_reach_m(camera.eye.h_m);
    // From above everything, first to where anything may be: the ball of the highest ceiling.
    double t_m = 0.0;
    const double radius_m = wgs84_a_m + ceiling_h_m + 1000.0;
    const double along = glm::dot(sight.eye.m, direction);
    const double below_eye = glm::dot(sight.eye.m, sight.eye.m) - radius_m * radius_m;
    if (below_eye > 0.0 && sight.refraction.straight()) {
        const double root = along * along - below_eye;
        if (root < 0.0 || along > 0.0) return First::neither;
        t_m = -along - std::sqrt(root);
    }
    const double start_m = t_m;
    while (t_m < reach_m) {
        const Geodetic at = geodetic_from_ecef({sight.eye.m + sight.refraction.true_m(t_m * direction)});
        double step_m = 4.0 + 0.003 * std::min(t_m - start_m, 100000.0);
        if (at.h_m > ceiling_h_m) {
            if (t_m - start_m > 5.0e5 && at.h_m > camera.eye.h_m + ceiling_h_m) break;
            // Bent as it may be, it is not below the ceiling before it has gone half of the way down to it.
            step_m = std::max(step_m, 0.5 * (at.h_m - ceiling_h_m));
        } else {
            if (!land.known->holds(at.lat_deg, at.lon_deg)) return First::unknown;
            const auto ground_h_m = land.surface->h_m(at.lat_deg, at.lon_deg);
            if (ground_h_m && at.h_m <= *ground_h_m) return First::ground;
        }
        t_m += step_m;
    }
    return First::neither;
}

// The longest run of each column, by the walk: ended by so many pixels of ground. `thick`: pixels that have
// none of their kind above or below them do not count.
std::vector<int> longest_runs(const std::vector<First>& truth, int width, int height, int ground_px,
                              bool thick) {
    std::vector<int> runs;
    for (int x = 0; x < width; ++x) {
        int longest = 0, begin = -1, ground = 0;
        for (int y = 0; y < height; ++y) {
            const First here = truth[static_cast<std::size_t>(y * width + x)];
            ground = here == First::ground ? ground + 1 : 0;
            if (ground >= ground_px) begin = -1;
            const auto unknown_at = [&](int row) {
                return row >= 0 && row < height &&
                       truth[static_cast<std::size_t>(row * width + x)] == First::unknown;
            };
            if (here != First::unknown || (thick && !unknown_at(y - 1) && !unknown_at(y + 1))) continue;
            if (begin < 0) begin = y;
            longest = std::max(longest, y - begin + 1);
        }
        runs.push_back(longest);
    }
    return runs;
}

// How far a picture and the walk are apart. What lies within a pixel of an edge may be of either kind.
struct Comparison {
    int unknown{};
    int amiss{};
    int columns_amiss{};
};
Comparison compare(const Land& land, const Camera& camera, const Air& air) {
    const UnseenPicture picture = land.look(camera, air);
    const Sight sight = sight_from(camera.eye, air);
    const int width = camera.width_px, height = camera.height_px;
    std::vector<First> truth(static_cast<std::size_t>(width * height));
    in_parallel(height, thread_count(), [&](int y) {
        for (int x = 0; x < width; ++x)
            truth[static_cast<std::size_t>(y * width + x)] = walked(land, camera, sight, {x + 0.5, y + 0.5});
    });
    const auto unknown_at = [&](int x, int y) {
        return truth[static_cast<std::size_t>(std::clamp(y, 0, height - 1) * width +
                                              std::clamp(x, 0, width - 1))] == First::unknown;
    };
    Comparison comparison;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const bool unknown = unknown_at(x, y);
            comparison.unknown += unknown;
            if (unknown == (picture.at(x, y) >= 0)) continue;
            bool edge = false;
            for (int i = 0; i < 9; ++i) edge = edge || unknown_at(x + i % 3 - 1, y + i / 3 - 1) != unknown;
            // What is thinner than a pixel lies between their middles.
            for (int i = 0; i < 192 && !edge; ++i) {
                const double to = (i / 2 - 48) / 48.0;
                const glm::dvec2 place_px = glm::dvec2(x, y) + 0.5 + to * glm::dvec2(i % 2, 1 - i % 2);
                edge = (walked(land, camera, sight, place_px) == First::unknown) != unknown;
            }
            comparison.amiss += !edge;
        }
    }
    const UnseenGround unseen = unseen_ground(picture, camera, ceiling_m);
    const std::vector<int> least = longest_runs(truth, width, height, 1, true),
                           most = longest_runs(truth, width, height, 4, false);
    for (int x = 1; x + 1 < width; ++x) {
        const auto at = static_cast<std::size_t>(x);
        const double bound_px = static_cast<double>(unseen.column_px[at]);
        const bool holds = bound_px >= std::min({least[at - 1], least[at], least[at + 1]}) - 1 &&
                           bound_px <= std::max({most[at - 1], most[at], most[at + 1]}) + 3;
        comparison.columns_amiss += !holds;
    }
    return comparison;
}

Camera random_camera(const Land& land, std::mt19937_64& random, double lowest_m, double highest_m) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const PostGrid& grid = land.field.grid;
    const double tall = grid.north_deg() - grid.south_deg(), wide = grid.east_deg() - grid.west_deg();
    Camera camera;
    // A sixth of all eyes is beside the box.
    camera.eye.lat_deg = std::clamp(grid.south_deg() + (1.2 * unit(random) - 0.1) * tall, -89.9, 89.9);
    camera.eye.lon_deg = grid.west_deg() + (1.2 * unit(random) - 0.1) * wide;
    const double ground_h_m = land.surface->h_m(camera.eye.lat_deg, camera.eye.lon_deg).value_or(0.0);
    camera.eye.h_m = ground_h_m + lowest_m * std::pow(highest_m / lowest_m, unit(random));
    camera.vertical_fov_deg = 10.0 + 60.0 * unit(random);
    camera.width_px = 40;
    camera.height_px = 30;
    // High up one looks down.
    const double horizon_deg =
        deg_from_radians(Radians{std::acos(wgs84_a_m / (wgs84_a_m + std::max(camera.eye.h_m, 0.0)))});
    camera.attitude = {360.0 * unit(random), 30.0 * unit(random) - 20.0 - horizon_deg, 0.0};
    if (unit(random) < 0.2) camera.attitude.pitch_deg = -90.0;
    if (unit(random) < 0.3) camera.attitude.roll_deg = 360.0 * unit(random) - 180.0;
    camera.attitude.pitch_deg = std::clamp(camera.attitude.pitch_deg, -90.0, 90.0);
    return camera;
}

void expect_as_walked(const Land& land, unsigned seed, int views, double lowest_m, double highest_m) {
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    int with_some = 0, amiss = 0, unknown = 0;
    for (int view = 0; view < views; ++view) {
        const Camera camera = random_camera(land, random, lowest_m, highest_m);
        const Air air = view % 3 == 0 ? Air{} : view % 3 == 1 ? standard_air : Air{-0.3, AirLaw::standard};
        const Comparison comparison = compare(land, camera, air);
        with_some += comparison.unknown > 0;
        amiss += comparison.amiss;
        unknown += comparison.unknown;
        if (comparison.amiss > 0 || comparison.columns_amiss > 0)
            ADD_FAILURE() << "view " << view << ": " << comparison.amiss << " pixels amiss, of "
                          << comparison.unknown << " that look beyond the data; " << comparison.columns_amiss
                          << " columns amiss; eye " << camera.eye.lat_deg << " " << camera.eye.lon_deg
                          << " h " << camera.eye.h_m << ", heading " << camera.attitude.heading_deg
                          << " pitch " << camera.attitude.pitch_deg << " roll " << camera.attitude.roll_deg
                          << " fov " << camera.vertical_fov_deg;
    }
    std::printf("%d views, %d of them look beyond the data, with %d pixels; %d amiss\n", views, with_some,
                unknown, amiss);
    EXPECT_GE(with_some, views / 4);
}

TEST(UnseenGround, OneTileIsAsWalked) {
    const Land land(hills(47.0, 9.0, 240.0, 241, 241), {});
    expect_as_walked(land, 1, 10, 2.0, 3000.0);
    expect_as_walked(land, 2, 8, 8000.0, 400000.0);
}

TEST(UnseenGround, CellsMissingInsideAreAsWalked) {
    const Land land(hills(48.0, 8.0, 120.0, 361, 481), {{46, 9}, {45, 11}});
    expect_as_walked(land, 3, 10, 2.0, 5000.0);
    expect_as_walked(land, 4, 8, 5000.0, 400000.0);
}

TEST(UnseenGround, TheAntimeridianIsAsWalked) {
    expect_as_walked(Land(hills(-16.0, 178.0, 60.0, 181, 241), {{-18, -180}}), 5, 10, 10.0, 100000.0);
}

TEST(UnseenGround, ThePolesAreAsWalked) {
    expect_as_walked(Land(hills(90.0, -180.0, 4.0, 41, 1441), {}), 6, 8, 10.0, 400000.0);
    // A sixth of the Earth, so that none is narrower than a pixel.
    std::vector<DegreeCell> missing;
    for (int lon = -50; lon < 10; ++lon) missing.insert(missing.end(), {{-90, lon}, {-86, lon}});
    expect_as_walked(Land(hills(-80.0, -180.0, 4.0, 41, 1441), missing), 7, 9, 10.0, 400000.0);
}

TEST(UnseenGround, ExaggerationLiftsTheCeiling) {
    expect_as_walked(Land(hills(47.0, 9.0, 240.0, 241, 241), {}, false, 3.0), 8, 8, 10.0, 60000.0);
}

TEST(UnseenGround, RotatedRastersAreAsWalked) {
    expect_as_walked(Land(turned_square(), {}, true), 9, 10, 10.0, 60000.0);
}

}  // namespace
}  // namespace oro
