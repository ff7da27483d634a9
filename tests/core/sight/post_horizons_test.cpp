// Must hold: horizons are those of closed forms over made ground, and those that sight lines of the oracle
// find, whatever the grid.
#include "core/sight/post_horizons.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "core/base/parallel.h"
#include "core/sight/observer.h"
#include "tests/support/made_terrain.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

float waves_H_m(double lat_deg, double lon_deg) {
    return static_cast<float>(test::Waves{1200.0, 500.0, 90.0, 7}.H_m(lat_deg, lon_deg));
}

// Of one post, by azimuth.
std::vector<double> around(const HeightField& field, int row, int column, double above_m, int directions,
                           double radius_m, const Air& air = {}) {
    const TrueSurface surface(field, 1.0, 2);
    const PostHorizons found =
        post_horizons(surface, 0, {{row, 1, column, 1}, air, above_m, directions, radius_m, 1});
    std::vector<double> elevations_deg;
    for (const auto& band : found.elevation_deg) elevations_deg.push_back(static_cast<double>(band.front()));
    return elevations_deg;
}

TEST(PostHorizons, OfALevelEarthIsLevelAndItsSkyIsWhole) {
    const HeightField field =
        test::made_field(46.5, 8.0, 1200.0, 300, 300, [](double, double) { return 0.0F; });
    const TrueSurface surface(field, 1.0, 2);
    const PostHorizons found = post_horizons(surface, 0, {{140, 5, 150, 6}, {}, 0.0, 36, 20.0e3, 2});
    ASSERT_EQ(found.elevation_deg.size(), 36U);
    for (const auto& band : found.elevation_deg)
        for (const float elevation_deg : band) EXPECT_NEAR(elevation_deg, 0.0, 0.0015);  // 1 mm over ground
    for (const float share : found.sky_view) EXPECT_EQ(share, 1.0F);
}

// The dip of an eye h over a sphere is the angle whose cosine is R / (R + h). R: of the ellipsoid in that
// direction.
TEST(PostHorizons, DipsAsTheEarthDoes) {
    const HeightField field =
        test::made_field(46.5, 8.0, 100.0, 100, 200, [](double, double) { return 0.0F; });
    const double eye_m = 80.0, lat_deg = 46.5 - 50 / 100.0;
    const auto found_deg = around(field, 50, 100, eye_m, 4, 200.0e3);
    const auto dip_deg = [&](double radius_m) {
        return -deg_from_radians(Radians(std::acos(radius_m / (radius_m + eye_m))));
    };
    for (const std::size_t i : {0U, 2U})
        EXPECT_NEAR(found_deg[i], dip_deg(meridian_radius_m(lat_deg)), 1.0e-3);
    for (const std::size_t i : {1U, 3U})
        EXPECT_NEAR(found_deg[i], dip_deg(prime_vertical_radius_m(lat_deg)), 1.0e-3);
    // Refraction of k makes the Earth's radius R / (1 - k). Source: Torge & Müller, Geodesy, 4th ed. 2012,
    // section 5.1.1.2.
    const auto bent_deg = around(field, 50, 100, eye_m, 4, 200.0e3, {0.2, AirLaw::constant});
    EXPECT_NEAR(bent_deg[0], dip_deg(meridian_radius_m(lat_deg) / 0.8), 2.0e-3);
}

// A plateau 500 m high north of a parallel, seen from d south of it.
TEST(PostHorizons, SeesThePlateausWall) {
    constexpr int wall_row = 100, eye_row = 160;
    const HeightField field = test::made_field(46.5, 8.0, 1200.0, 300, 301, [](double lat_deg, double) {
        return lat_deg > 46.5 - (wall_row + 0.5) / 1200.0 ? 500.0F : 0.0F;
    });
    const auto found_deg = around(field, eye_row, 150, 0.0, 36, 30.0e3);
    const double radius_m = meridian_radius_m(46.5 - 130 / 1200.0);
    const double angle = radians_from_deg((eye_row - wall_row) / 1200.0).rad;
    const double wall_deg = deg_from_radians(Radians(
        std::atan2((radius_m + 500.0) * std::cos(angle) - radius_m, (radius_m + 500.0) * std::sin(angle))));
    EXPECT_NEAR(found_deg[0], wall_deg, 5.0e-4);
    // In other azimuths the wall is farther away, by the azimuth's cosine.
    const double away_m = radius_m * angle;
    for (const int i : {1, 2, 3, 4}) {
        const double along_m = away_m / sine_cosine_deg(10.0 * i).cosine;
        const double level_deg =
            deg_from_radians(Radians(std::atan((500.0 - along_m * along_m / (2.0 * radius_m)) / along_m)));
        EXPECT_NEAR(found_deg[static_cast<std::size_t>(i)], level_deg, 0.005) << 10 * i;
        EXPECT_NEAR(found_deg[static_cast<std::size_t>(36 - i)], level_deg, 0.005) << 10 * (36 - i);
    }
    for (int i = 10; i <= 26; ++i) EXPECT_NEAR(found_deg[static_cast<std::size_t>(i)], 0.0, 0.002) << 10 * i;
}

// A cone 1,000 m high and 4 km wide, with a post on its apex.
TEST(PostHorizons, SeesAConesApex) {
    constexpr int apex_row = 100, apex_column = 150;
    const double apex_deg = 46.5 - apex_row / 1200.0;
    const HeightField field =
        test::made_field(46.5, 8.0, 1200.0, 300, 301, [&](double lat_deg, double lon_deg) {
            const double north_m = radians_from_deg(lat_deg - apex_deg).rad * meridian_radius_m(apex_deg);
            const double east_m = radians_from_deg(lon_deg - 8.0 - apex_column / 1200.0).rad *
                                  prime_vertical_radius_m(apex_deg) * sine_cosine_deg(apex_deg).cosine;
            return static_cast<float>(std::max(0.0, 1000.0 * (1.0 - std::hypot(north_m, east_m) / 2000.0)));
        });
    for (const auto& [rows, azimuth] : {std::pair{80, 0U}, {-70, 18U}}) {
        const auto found_deg = around(field, apex_row + rows, apex_column, 0.0, 36, 30.0e3);
        const double radius_m = meridian_radius_m(apex_deg - 0.5 * rows / 1200.0);
        const double angle = radians_from_deg(std::abs(rows) / 1200.0).rad;
        const double top_deg = deg_from_radians(Radians(std::atan2(
            (radius_m + 1000.0) * std::cos(angle) - radius_m, (radius_m + 1000.0) * std::sin(angle))));
        EXPECT_NEAR(found_deg[azimuth], top_deg, 1.0e-3);
        EXPECT_NEAR(found_deg[(azimuth + 18) % 36], 0.0, 0.002);
    }
    // From the apex all around is below; over the flank the horizon is the flank or the level ground beyond.
    for (const double elevation_deg : around(field, apex_row, apex_column, 0.0, 36, 10.0e3))
        EXPECT_LT(elevation_deg, -4.0);
}

struct Differences {
    int compared{};
    double worst_deg{}, worst_sky{};
};

// Random posts and azimuths against sight lines.
Differences against_lines(const TrueSurface& surface, int count, unsigned seed, double above_m,
                          double radius_m, int rim) {
    constexpr int directions = 24;
    const PostGrid& grid = surface.field().grid;
    std::mt19937_64 random(seed);
    std::uniform_int_distribution<int> row(rim, grid.rows() - 1 - rim), column(rim, grid.columns() - 1 - rim),
        azimuth(0, directions - 1);
    Differences differences;
    for (int i = 0; i < count; ++i) {
        const int r = row(random), c = column(random);
        const auto k = static_cast<std::size_t>(azimuth(random));
        const auto h_m = surface.post_h_m(r, c);
        if (!h_m) continue;
        const PostHorizons found =
            post_horizons(surface, 0, {{r, 1, c, 1}, standard_air, above_m, directions, radius_m, 1});
        const PostPlace place = grid.place_at(r, c);
        const auto lines_deg = horizon_by_lines_deg(
            surface, {place.lat_deg, place.lon_deg, *h_m + std::max(above_m, least_above_m)}, standard_air,
            360.0 * static_cast<double>(k) / directions, radius_m);
        const auto found_deg = static_cast<double>(found.elevation_deg[k].front());
        EXPECT_TRUE(lines_deg) << r << " " << c << " " << k;
        if (!lines_deg) continue;
        ++differences.compared;
        const double off_deg = std::abs(found_deg - *lines_deg);
        if (off_deg > 0.01) std::printf("%d %d %zu: %.5f, by lines %.5f\n", r, c, k, found_deg, *lines_deg);
        differences.worst_deg = std::max(differences.worst_deg, off_deg);
    }
    return differences;
}

TEST(PostHorizons, AreThoseOfSightLinesOverHillsThePoleAndNets) {
    constexpr unsigned seed = 54;
    std::printf("seed %u\n", seed);
    const auto expect = [&](const char* name, const HeightField& field, int count, double radius_m, int rim) {
        const TrueSurface surface(field, 1.0, 2);
        for (const double above_m : {0.0, 2.0, 50.0}) {
            const Differences found = against_lines(surface, count, seed, above_m, radius_m, rim);
            std::printf("%s, %.0f m over ground: %d compared, worst %.2e degree\n", name, above_m,
                        found.compared, found.worst_deg);
            EXPECT_GT(found.compared, count / 2) << name;
            EXPECT_LE(found.worst_deg, 1.0e-3) << name;
        }
    };
    expect("hills", test::made_field(46.6, 8.3, 1200.0, 300, 300, waves_H_m), 150, 9.0e3, 2);
    expect("antimeridian", test::made_field(-16.9, 179.9, 600.0, 120, 140, waves_H_m), 60, 9.0e3, 2);
    expect("net over a pole", test::net_field({280, 300, {89.97, 20.0}, 80.0, 10.0}, test::patchy_H_m, 47.5F),
           60, 9.0e3, 2);
    expect("net", test::net_field({320, 400, {46.5, 8.0}, 60.0, 33.0}, test::patchy_H_m, 47.5F), 60, 9.0e3,
           2);
}

// All around the Earth: columns of a part may run past the last.
TEST(PostHorizons, GoRoundTheEarth) {
    HeightField whole;
    whole.grid.lat = {100.0, 0.0, 8999, -1, 60};
    whole.grid.lon = {2.0, 0.0, -360, +1, 721};
    for (int row = 0; row < 60; ++row) {
        for (int column = 0; column < 721; ++column)
            whole.H_m.push_back(waves_H_m(46.0 + 0.002 * row, 8.0 + 0.001 * std::min(column, 720 - column)));
    }
    const TrueSurface surface(whole, 1.0, 2);
    const PostHorizonsRequest across{{30, 1, 718, 6}, standard_air, 2.0, 12, 15.0e3, 2};
    PostHorizonsRequest again = across;
    again.part.first_column = -2;
    const PostHorizons one = post_horizons(surface, 0, across), other = post_horizons(surface, 0, again);
    EXPECT_EQ(one.elevation_deg, other.elevation_deg);
    EXPECT_NE(one.sky_view.front(), PostHorizons::unknown);
}

TEST(PostHorizons, OfVoidPostsAreUnknownAndTheSameForAnyNumberOfThreads) {
    HeightField field = test::made_field(46.6, 8.3, 1200.0, 200, 200, waves_H_m);
    field.H_m[100 * 200 + 100] = field.H_m[100 * 200 + 101] = void_height_m;
    const TrueSurface surface(field, 1.0, 2);
    PostHorizonsRequest request{{90, 30, 85, 25}, standard_air, 2.0, 16, 6.0e3, 1};
    const PostHorizons one = post_horizons(surface, 0, request);
    EXPECT_EQ(one.sky_view[request.part.number(100, 100)], PostHorizons::unknown);
    EXPECT_EQ(one.elevation_deg[3][request.part.number(100, 101)], PostHorizons::unknown);
    EXPECT_EQ(std::ranges::count(one.sky_view, PostHorizons::unknown), 2);
    for (const int threads : {2, 5}) {
        request.threads = threads;
        const PostHorizons other = post_horizons(surface, 0, request);
        EXPECT_EQ(one.elevation_deg, other.elevation_deg) << threads;
        EXPECT_EQ(one.sky_view, other.sky_view) << threads;
    }
    // A part has the values that a larger one has.
    PostHorizonsRequest part = request;
    part.part = {95, 3, 90, 4};
    const PostHorizons few = post_horizons(surface, 0, part);
    for (int row = 95; row < 98; ++row)
        for (int column = 90; column < 94; ++column)
            EXPECT_EQ(few.sky_view[part.part.number(row, column)],
                      one.sky_view[request.part.number(row, column)]);
}

// Of several grids by sight lines: one that is out of reach changes nothing.
TEST(PostHorizons, OfSeveralGridsAreThoseOfOne) {
    const HeightField field = test::made_field(46.6, 8.3, 1200.0, 150, 150, waves_H_m);
    const HeightField far = test::made_field(45.0, 8.3, 600.0, 20, 20, waves_H_m);
    const TrueSurface surface(field, 1.0, 2), other(far, 1.0, 2);
    const TrueGround both({{&surface, 0}, {&other, 1}}, nullptr);
    const PostHorizonsRequest request{{70, 3, 60, 3}, standard_air, 2.0, 8, 4.0e3, 2};
    const PostHorizons one = post_horizons(surface, 0, request), two = post_horizons(both, 0, request);
    for (std::size_t k = 0; k < 8; ++k)
        for (std::size_t i = 0; i < 9; ++i)
            EXPECT_NEAR(one.elevation_deg[k][i], two.elevation_deg[k][i], 1.0e-3);
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(one.sky_view[i], two.sky_view[i], 1.0e-5);
}

TEST(PostHorizons, HaveNoValueWhereThereIsNoGround) {
    const HeightField field = test::made_field(46.6, 8.3, 1200.0, 50, 50, waves_H_m);
    const auto corner_deg = around(field, 0, 0, 2.0, 4, 3.0e3);  // the north-western one
    EXPECT_EQ(corner_deg[3], static_cast<double>(PostHorizons::unknown));
    EXPECT_GT(corner_deg[2], -90.0);
}

TEST(SkyViewFactor, IsTheMeanSquareOfTheCosine) {
    EXPECT_DOUBLE_EQ(sky_view_factor({0.0, -5.0, 0.0}), 1.0);
    EXPECT_NEAR(sky_view_factor({30.0, 30.0}), 0.75, 1.0e-12);
    EXPECT_NEAR(sky_view_factor({90.0, 0.0}), 0.5, 1.0e-12);  // half of it behind a wall
}

}  // namespace
}  // namespace oro
