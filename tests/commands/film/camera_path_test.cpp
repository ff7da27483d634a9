// What is between the keys of a camera's path.
#include "apps/film/camera_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "geo/places/geodesic.h"

namespace oro {
namespace {

CameraKey key_at(double time_s, const Geodetic& eye, const Attitude& attitude = {}) {
    return {time_s, eye, attitude, 45.0, std::nullopt};
}

// How far apart two directions of sight are, and two tops of pictures: the larger angle, degrees.
double apart_deg(const CameraKey& one, const CameraKey& other) {
    Camera a, b;
    a.eye = one.eye, a.attitude = one.attitude;
    b.eye = other.eye, b.attitude = other.attitude;
    const glm::dmat3 from = glm::transpose(a.view_from_ecef()), to = glm::transpose(b.view_from_ecef());
    double most = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        most = std::max(most, 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(from[axis] - to[axis]))));
    return deg_from_radians(Radians{most});
}

void expect_same(const CameraKey& one, const CameraKey& other) {
    EXPECT_EQ(one.eye.lat_deg, other.eye.lat_deg);
    EXPECT_EQ(one.eye.lon_deg, other.eye.lon_deg);
    EXPECT_EQ(one.eye.h_m, other.eye.h_m);
    EXPECT_EQ(one.attitude.heading_deg, other.attitude.heading_deg);
    EXPECT_EQ(one.attitude.pitch_deg, other.attitude.pitch_deg);
    EXPECT_EQ(one.attitude.roll_deg, other.attitude.roll_deg);
    EXPECT_EQ(one.vertical_fov_deg, other.vertical_fov_deg);
}

TEST(CameraPaths, AreTheirKeysAtTheirTimesToTheBit) {
    const std::vector<CameraKey> keys{key_at(0.0, {36.5, -84.25, 900.1}, {350.3, -12.7, 3.1}),
                                      key_at(0.7, {36.6, -84.2, 700.3}, {10.9, 5.5, -20.2}),
                                      key_at(2.0, {36.6, -84.2, 1200.9}, {100.1, -89.0, 0.0})};
    const CameraPath path(keys);
    EXPECT_EQ(path.duration_s(), 2.0);
    for (const CameraKey& key : keys) {
        expect_same(path.at(key.time_s), key);
        expect_same(path.at(key.time_s + 1e-10), key);
    }
    expect_same(path.at(-5.0), keys.front());
    expect_same(path.at(99.0), keys.back());
}

// One key is a picture that stands still.
TEST(CameraPaths, OfOneKeyStandStill) {
    const CameraPath path({key_at(3.0, {36.5, -84.25, 900.0}, {90.0, 0.0, 0.0})});
    EXPECT_EQ(path.duration_s(), 0.0);
    EXPECT_EQ(path.at(7.0).eye.h_m, 900.0);
}

// Halfway between two keys of an even speed is the middle of the shortest way: of the equator from 10 to 20
// degrees east that is 15 east, at 150 m.
TEST(CameraPaths, FollowTheShortestWay) {
    const CameraPath path({key_at(0.0, {0.0, 10.0, 100.0}), key_at(4.0, {0.0, 20.0, 200.0})});
    const CameraKey middle = path.at(2.0);
    EXPECT_NEAR(middle.eye.lat_deg, 0.0, 1e-12);
    EXPECT_NEAR(middle.eye.lon_deg, 15.0, 1e-9);
    EXPECT_NEAR(middle.eye.h_m, 150.0, 1e-9);
}

TEST(CameraPaths, CrossTheAntimeridianTheShortWay) {
    const CameraPath path({key_at(0.0, {10.0, 179.0, 0.0}), key_at(2.0, {10.0, -179.0, 0.0})});
    EXPECT_NEAR(std::abs(path.at(1.0).eye.lon_deg), 180.0, 1e-9);
    EXPECT_NEAR(path.at(0.5).eye.lon_deg, 179.5, 1e-4);
}

// From 89 N on one side of the pole to 89 N on the other: north before it is south behind it, and the picture
// does not turn. 1 degree at the pole is 111.7 km; in 1/1000 of the way the direction of sight turns by the
// bend of the Earth, 0.002 degree.
TEST(CameraPaths, LookStraightAheadOverAPole) {
    const CameraPath path({key_at(0.0, {89.0, 0.0, 5000.0}, {0.0, -10.0, 0.0}),
                           key_at(1.0, {89.0, 180.0, 5000.0}, {180.0, -10.0, 0.0})});
    EXPECT_NEAR(path.at(0.5).eye.lat_deg, 90.0, 1e-9);
    EXPECT_NEAR(std::remainder(path.at(0.25).attitude.heading_deg, 360.0), 0.0, 1e-6);
    EXPECT_NEAR(path.at(0.75).attitude.heading_deg, 180.0, 1e-6);
    CameraKey before = path.at(0.0);
    for (int i = 1; i <= 1000; ++i) {
        const CameraKey now = path.at(i / 1000.0);
        EXPECT_LT(apart_deg(before, now), 0.0021) << i;
        EXPECT_NEAR(now.attitude.pitch_deg, -10.0, 1e-6);
        before = now;
    }
}

// A heading from 350 to 10 degrees goes over north.
TEST(CameraPaths, TurnTheShorterWay) {
    const Attitude west{350.0, 0.0, 0.0}, east{10.0, 0.0, 0.0};
    EXPECT_NEAR(std::remainder(turned_between(west, east, 0.5).heading_deg, 360.0), 0.0, 1e-9);
    EXPECT_NEAR(turned_between(west, east, 0.25).heading_deg, 355.0, 1e-9);
    EXPECT_NEAR(turned_between(east, west, 0.75).heading_deg, 355.0, 1e-9);
    // Half a turn: whichever way, evenly and level.
    const Attitude half = turned_between({0.0, 0.0, 0.0}, {180.0, 0.0, 0.0}, 0.5);
    EXPECT_NEAR(std::abs(std::remainder(half.heading_deg, 360.0)), 90.0, 1e-9);
    EXPECT_NEAR(half.pitch_deg, 0.0, 1e-9);
    EXPECT_NEAR(half.roll_deg, 0.0, 1e-9);
    // From level to straight down there is no heading to turn to: the picture's top decides.
    const Attitude down = turned_between({30.0, 0.0, 0.0}, {30.0, -90.0, 0.0}, 0.5);
    EXPECT_NEAR(down.heading_deg, 30.0, 1e-9);
    EXPECT_NEAR(down.pitch_deg, -45.0, 1e-9);
}

TEST(CameraPaths, GiveBackAnyAttitude) {
    std::mt19937 random(20261127);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const Attitude one{360.0 * share(random), 178.0 * share(random) - 89.0,
                           358.0 * share(random) - 179.0};
        const Attitude same = turned_between(one, {1.0, 2.0, 3.0}, 0.0);
        EXPECT_NEAR(std::remainder(same.heading_deg - one.heading_deg, 360.0), 0.0, 1e-9) << "seed 20261127";
        EXPECT_NEAR(same.pitch_deg, one.pitch_deg, 1e-9);
        EXPECT_NEAR(std::remainder(same.roll_deg - one.roll_deg, 360.0), 0.0, 1e-9);
    }
}

// Of random keys, poles and the antimeridian among them: neither the place nor the direction jumps, the
// height stays between those of the two keys, and so does the angle of view.
TEST(CameraPaths, NeverJumpNorLeaveTheirKeysHeights) {
    constexpr unsigned seed = 27;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int round = 0; round < 40; ++round) {
        std::vector<CameraKey> keys;
        for (int i = 0; i < 6; ++i) {
            const double lat_deg = i % 3 == 0 ? 89.9 : i % 3 == 1 ? -89.0 + 178.0 * share(random) : 90.0;
            CameraKey key = key_at(i + 0.5 * share(random), {lat_deg, 360.0 * share(random) - 180.0, 0.0},
                                   {360.0 * share(random), 170.0 * share(random) - 85.0, 0.0});
            key.eye.h_m = i % 2 == 0 ? 1000.0 : 1000.0 + 9000.0 * share(random);
            key.vertical_fov_deg = 20.0 + 60.0 * share(random);
            keys.push_back(key);
        }
        const CameraPath path(keys);
        for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
            const double length_m = geodesic_between(keys[i].eye.lat_deg, keys[i].eye.lon_deg,
                                                     keys[i + 1].eye.lat_deg, keys[i + 1].eye.lon_deg)
                                        .distance_m;
            constexpr int steps = 400;
            CameraKey before = keys[i];
            for (int step = 1; step <= steps; ++step) {
                const double part = static_cast<double>(step) / steps;
                const CameraKey now = path.at(keys[i].time_s + part * (keys[i + 1].time_s - keys[i].time_s));
                // No cubic of this kind is steeper than three times its secant.
                const double way_m =
                    glm::length(ecef_from_geodetic({now.eye.lat_deg, now.eye.lon_deg, 0.0}).m -
                                ecef_from_geodetic({before.eye.lat_deg, before.eye.lon_deg, 0.0}).m);
                EXPECT_LE(way_m, 3.01 * length_m / steps + 1e-3) << "seed " << seed << " round " << round;
                // Half a turn at most, and what the Earth bends over the way.
                EXPECT_LE(apart_deg(before, now), 181.0 / steps + way_m / 6.3e6 * 58.0 + 1e-3)
                    << "seed " << seed << " round " << round << " leg " << i << " step " << step;
                EXPECT_GE(now.eye.h_m, std::min(keys[i].eye.h_m, keys[i + 1].eye.h_m));
                EXPECT_LE(now.eye.h_m, std::max(keys[i].eye.h_m, keys[i + 1].eye.h_m));
                EXPECT_GE(now.vertical_fov_deg,
                          std::min(keys[i].vertical_fov_deg, keys[i + 1].vertical_fov_deg));
                EXPECT_LE(now.vertical_fov_deg,
                          std::max(keys[i].vertical_fov_deg, keys[i + 1].vertical_fov_deg));
                before = now;
            }
        }
    }
}

// The clock between keys that have one, beyond them, and rounded down.
TEST(CameraPaths, HaveAClock) {
    std::vector<CameraKey> keys{key_at(0.0, {46.0, 8.0, 0.0}), key_at(1.0, {46.0, 8.0, 0.0}),
                                key_at(5.0, {46.0, 8.0, 0.0}), key_at(7.0, {46.0, 8.0, 0.0})};
    EXPECT_FALSE(CameraPath(keys).at(1.0).time_utc_s.has_value());
    keys[1].time_utc_s = 1'000'000;
    keys[2].time_utc_s = 1'000'400;
    const CameraPath path(keys);
    EXPECT_EQ(path.at(1.0).time_utc_s, 1'000'000);
    EXPECT_EQ(path.at(2.0).time_utc_s, 1'000'100);
    EXPECT_EQ(path.at(2.0149).time_utc_s, 1'000'101);
    EXPECT_EQ(path.at(5.0).time_utc_s, 1'000'400);
    EXPECT_EQ(path.at(6.5).time_utc_s, 1'000'401);
    EXPECT_EQ(path.at(0.5).time_utc_s, 999'999);
}

// Three values that rise and fall again: the curve rests at the highest, and at (0.5) between 0 and 1 has the
// value of the cubic with the tangents 2 (three points, held to twice the secant here) and 0: 0.5 + 2 / 8.
TEST(MonotoneCubics, RestWhereValuesTurn) {
    const MonotoneCubic curve({0.0, 1.0, 2.0}, {0.0, 1.0, 0.0});
    EXPECT_EQ(curve.at(1.0), 1.0);
    EXPECT_NEAR(curve.at(0.5), 0.75, 1e-15);
    EXPECT_NEAR(curve.at(1.5), 0.75, 1e-15);
    const double step = 1e-6;
    EXPECT_NEAR((curve.at(1.0 + step) - curve.at(1.0 - step)) / (2.0 * step), 0.0, 1e-5);
}

// Even values are a straight line.
TEST(MonotoneCubics, OfALineAreTheLine) {
    const MonotoneCubic curve({0.0, 1.0, 4.0, 9.0}, {1.0, 3.0, 9.0, 19.0});
    for (double x = 0.0; x < 9.0; x += 0.1) EXPECT_NEAR(curve.at(x), 1.0 + 2.0 * x, 1e-12);
}

}  // namespace
}  // namespace oro
