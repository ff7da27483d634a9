// Must hold: a profile leaves nothing out: between two of its points the ground is straight.
#include "core/sight/ground_profile.h"

#include <gtest/gtest.h>

#include <GeographicLib/GeodesicExact.hpp>
#include <GeographicLib/GeodesicLineExact.hpp>
#include <cmath>
#include <cstdio>
#include <random>

#include "core/base/parallel.h"
#include "tests/support/made_terrain.h"
#include "tests/support/marched_line.h"

namespace oro {
namespace {

float ridges_H_m(double lat_deg, double lon_deg) {
    return static_cast<float>(900.0 + 600.0 * std::sin(700.0 * lat_deg) * std::cos(500.0 * lon_deg));
}

struct Tally {
    int lines{};
    std::size_t points{}, places{};
    double worst_point_m{}, worst_between_m{};
};

void follow(const HeightField& field, const TrueSurface& surface, std::mt19937_64& random, int lines,
            Tally& tally) {
    const PostGrid& grid = field.grid;
    const test::MarchedLine ground(field, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, 0.0);
    std::uniform_real_distribution<double> share(0.02, 0.98);
    const auto place = [&] {
        return std::pair(grid.north_deg() + share(random) * (grid.south_deg() - grid.north_deg()),
                         grid.west_deg() + share(random) * (grid.east_deg() - grid.west_deg()));
    };
    for (int i = 0; i < lines; ++i) {
        const auto [from_lat, from_lon] = place();
        const auto [to_lat, to_lon] = place();
        const auto line =
            GeographicLib::GeodesicExact::WGS84().InverseLine(from_lat, from_lon, to_lat, to_lon);
        const Way way = [&line = line](double along_m) {
            Geodetic at;
            line.Position(along_m, at.lat_deg, at.lon_deg);
            return at;
        };
        std::vector<ProfilePoint> points;
        add_profile(surface, way, 0.0, line.Distance(), points);
        ++tally.lines;
        tally.points += points.size();
        for (std::size_t p = 0; p < points.size(); ++p) {
            const ProfilePoint& here = points[p];
            const auto truth_m = ground.ground_h_m({here.lat_deg, here.lon_deg, 0.0});
            ASSERT_TRUE(truth_m && here.has_ground) << here.lat_deg << "," << here.lon_deg;
            tally.worst_point_m = std::max(tally.worst_point_m, std::abs(here.h_m - *truth_m));
            if (p == 0) continue;
            const ProfilePoint& before = points[p - 1];
            for (const double part : {0.1, 0.5, 0.9}) {
                const double along_m = before.along_m + part * (here.along_m - before.along_m);
                const Geodetic at = way(along_m);
                const auto between_m = ground.ground_h_m({at.lat_deg, at.lon_deg, 0.0});
                ASSERT_TRUE(between_m);
                const double straight_m = before.h_m + part * (here.h_m - before.h_m);
                tally.worst_between_m = std::max(tally.worst_between_m, std::abs(straight_m - *between_m));
                ++tally.places;
            }
        }
    }
}

TEST(GroundProfile, TenThousandLinesLeaveNothingOut) {
    constexpr unsigned seed = 20261123;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    Tally tally;
    const HeightField alps = test::made_field(46.6, 8.3, 1200.0, 90, 90, ridges_H_m);
    const HeightField round = test::made_field(-17.0, 179.95, 600.0, 80, 80, ridges_H_m);
    const HeightField north = test::made_field(88.9, -30.0, 300.0, 40, 900, [](double lat, double lon) {
        return ridges_H_m(0.2 * lat, 0.02 * lon);
    });
    for (const auto& [field, lines] : {std::pair{&alps, 7000}, {&round, 2000}, {&north, 1000}}) {
        const TrueSurface surface(*field, 1.0, thread_count());
        follow(*field, surface, random, lines, tally);
    }
    std::printf("%d lines, %zu points: off by %.2e m at most; %zu places between them: %.2e m\n", tally.lines,
                tally.points, tally.worst_point_m, tally.places, tally.worst_between_m);
    EXPECT_EQ(tally.lines, 10000);
    EXPECT_GT(tally.points, 500000U);
    EXPECT_LE(tally.worst_point_m, 1.0e-3);
    // A step of 1e-4 cell at an edge where 600 m waves turn, and what a line bends within a cell.
    EXPECT_LE(tally.worst_between_m, 0.05);
}

TEST(GroundProfile, SumsAreOfTheGroundAlone) {
    // Up 10 m from post to post as far as the void, and down behind it: along a row, H at its posts.
    HeightField field = test::made_field(10.0, 20.0, 100.0, 3, 21, [](double, double lon_deg) {
        const double post = std::round((lon_deg - 20.0) * 100.0);
        return static_cast<float>(post <= 8.0 ? 10.0 * post : 300.0 - 10.0 * post);
    });
    for (int row = 0; row < 3; ++row) field.H_m[static_cast<std::size_t>(row * 21 + 10)] = void_height_m;
    const TrueSurface surface(field, 1.0, 1);
    std::vector<ProfilePoint> points;
    const Way way = [](double along_m) { return Geodetic{9.995, 20.0 + along_m / 1000.0, 0.0}; };
    add_profile(surface, way, 0.0, 200.0, points);
    const ProfileSums sums = sums_of(points, 10.0);
    // Posts 0 to 9 are there, of 0 to 80 and 210; and 11 to 20, of 190 to 100.
    // The rim of the void is asked for 0.02 of 10 beside it.
    EXPECT_NEAR(sums.ascent_m, 80.0 + 130.0, 0.3);
    EXPECT_NEAR(sums.descent_m, 90.0, 0.03);
    EXPECT_NEAR(points[*sums.highest].along_m, 90.0, 1e-3);
    EXPECT_NEAR(points[*sums.lowest].along_m, 0.0, 1e-3);
    EXPECT_NEAR(sums.without_data_m, 20.0, 1e-3);
    // Each part goes one way.
    EXPECT_NEAR(sums.climbed_m, 80.0 + 130.0, 0.3);
    EXPECT_NEAR(sums.went_down_m, 90.0, 0.03);
}

// By hand. Found: a walk whose top is 430 m above its start had an ascent of 1,443 m, every ripple counted.
TEST(GroundProfile, ClimbsAreOfRisesAsHighAsTheThreshold) {
    const auto line = [](const std::vector<double>& heights_m) {
        std::vector<ProfilePoint> points;
        for (const double H_m : heights_m)
            points.push_back({static_cast<double>(points.size()), 46.0, 8.0, H_m > -1000.0, H_m, H_m});
        return points;
    };
    const auto expect_climb = [&](const std::vector<double>& heights_m, double threshold_m, double up_m,
                                  double down_m) {
        const Climb climb = climb_over(line(heights_m), threshold_m);
        EXPECT_DOUBLE_EQ(climb.up_m, up_m) << threshold_m;
        EXPECT_DOUBLE_EQ(climb.down_m, down_m) << threshold_m;
    };
    // Ripples of 9 m on the way up and down count nothing, a dip of 10 m counts on both ways.
    expect_climb({100, 150, 141, 200, 191, 250, 200, 209, 100}, 10.0, 150.0, 150.0);
    expect_climb({100, 150, 140, 200}, 10.0, 110.0, 10.0);
    expect_climb({100, 150, 140, 200}, 10.1, 100.0, 0.0);
    // Slow ways add up, whatever a step is.
    expect_climb({0, 3, 6, 9, 12, 9, 6, 3, 0}, 10.0, 12.0, 12.0);
    // What never comes to the threshold is level.
    expect_climb({0, 9, 0, 9, 0, 9}, 10.0, 0.0, 0.0);
    expect_climb({5, 0, 9, 0, 20, 11, 22}, 10.0, 22.0, 0.0);
    // 0 counts every one.
    expect_climb({0, 9, 0, 9, 9, 1}, 0.0, 18.0, 17.0);
    // A part without ground ends a way.
    expect_climb({0, 8, -9999, 16, 40}, 10.0, 24.0, 0.0);
    expect_climb({}, 10.0, 0.0, 0.0);
    // Ascent less descent is the ends' difference, but for less than the threshold at either end.
    expect_climb({4, 0, 100, 60, 66}, 10.0, 100.0, 40.0);
}

}  // namespace
}  // namespace oro
