// Must hold: of every post a viewshed says what a line of sight to it says.
#include "core/sight/viewshed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/base/parallel.h"
#include "tests/core/sight/against_observers.h"
#include "tests/support/made_terrain.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

using test::expect_observers;
using test::eye_over;

float hills_H_m(double lat_deg, double lon_deg) {
    return static_cast<float>(test::Waves{1200.0, 500.0, 90.0, 7}.H_m(lat_deg, lon_deg));
}

TEST(Viewshed, IsTheLookoutsOverHills) {
    const HeightField field = test::made_field(46.6, 8.3, 1200.0, 400, 500, hills_H_m);
    const TrueSurface surface(field, 1.0, thread_count());
    for (const double above_m : {0.001, 2.0, 300.0}) {
        for (const double target_m : {0.0, 2.0, 50.0}) {
            const ViewshedRequest request{eye_over(surface, 46.43, 8.51, above_m), standard_air, target_m,
                                          12.0e3, thread_count()};
            expect_observers("hills", surface, request, 60000);
        }
    }
    // On a post, on an edge, in a corner, and beyond the data.
    expect_observers("post", surface,
                     {eye_over(surface, 46.6 - 200 / 1200.0, 8.3 + 250 / 1200.0, 2.0), {}, 1.0, 8e3, 2},
                     30000);
    expect_observers("edge", surface,
                     {eye_over(surface, 46.6 - 200 / 1200.0, 8.3 + 250.4 / 1200.0, 2.0), {0.13}, 1.0, 8e3, 2},
                     30000);
    expect_observers("corner", surface, {eye_over(surface, 46.6, 8.3, 20.0), {0.2}, 0.0, 9e3, 2}, 7000);
    expect_observers("outside", surface, {{46.61, 8.25, 2500.0}, {-0.3}, 2.0, 25e3, 2}, 50000);
}

TEST(Viewshed, IsTheLookoutsOverTheAntimeridianAndNearThePole) {
    const HeightField fiji = test::made_field(-16.9, 179.9, 600.0, 120, 140, hills_H_m);
    const TrueSurface over(fiji, 1.0, thread_count());
    expect_observers("antimeridian", over, {eye_over(over, -17.0, -179.99, 10.0), standard_air, 2.0, 9e3, 2},
                     5000);
    const auto polar_H_m = [](double lat, double lon) {
        // No seam.
        const double x = (90.0 - lat) * std::cos(lon * 0.017453292519943295);
        const double y = (90.0 - lat) * std::sin(lon * 0.017453292519943295);
        return hills_H_m(x, y);
    };
    HeightField whole;
    whole.grid.lat = {100.0, 0.0, 8999, -1, 150};
    whole.grid.lon = {2.0, 0.0, -360, +1, 721};
    for (int row = 0; row < 150; ++row) {
        for (int column = 0; column < 721; ++column)
            whole.H_m.push_back(polar_H_m(whole.grid.lat.at_deg(row), whole.grid.lon.at_deg(column)));
    }
    const TrueSurface polar(whole, 1.0, thread_count());
    expect_observers("89 N", polar, {eye_over(polar, 89.0, 179.98, 20.0), standard_air, 2.0, 20e3, 2}, 500,
                     5.0);
    expect_observers("over the pole", polar, {eye_over(polar, 89.9, 20.3, 200.0), standard_air, 2.0, 15e3, 2},
                     3000, 5.0);
}

TEST(Viewshed, HasNoAnswerForVoidsAndLooksOverThem) {
    HeightField field = test::made_field(46.6, 8.3, 1200.0, 300, 300, hills_H_m);
    std::mt19937_64 random(815);
    std::printf("seed 815\n");
    std::uniform_int_distribution<int> place(0, 280), size(0, 12);
    for (int i = 0; i < 60; ++i) {
        const int row = place(random), column = place(random), tall = size(random), wide = size(random);
        for (int r = row; r <= row + tall; ++r) {
            for (int c = column; c <= column + wide; ++c)
                field.H_m[static_cast<std::size_t>(r * 300 + c)] = void_height_m;
        }
    }
    field.H_m[150 * 300 + 150] = field.H_m[151 * 300 + 151] = hills_H_m(46.5, 8.4);
    field.H_m[151 * 300 + 150] = field.H_m[150 * 300 + 151] = hills_H_m(46.5, 8.4);
    const TrueSurface surface(field, 1.0, thread_count());
    const ViewshedRequest request{
        eye_over(surface, 46.6 - 150.5 / 1200.0, 8.3 + 150.4 / 1200.0, 1200.0), {0.13}, 2.0, 9e3, 2};
    expect_observers("voids", surface, request, 20000);
    const Viewshed shed = viewshed(surface, 0, request);
    for (int row = 100; row < 200; ++row) {
        for (int column = 100; column < 200; ++column) {
            if (!is_void(field.H_at_post_m(row, column))) continue;
            EXPECT_EQ(shed.clearance_deficit_m[shed.window.number(row, column)], Viewshed::unknown);
        }
    }
}

TEST(Viewshed, GivesUpWhenItIsAskedTo) {
    const HeightField field = test::made_field(46.6, 8.3, 1200.0, 120, 130, hills_H_m);
    const TrueSurface surface(field, 1.0, thread_count());
    ViewshedRequest request{eye_over(surface, 46.55, 8.35, 2.0), standard_air, 0.0, 4.0e3, 2};
    std::stop_source stop;
    stop.request_stop();
    request.stop = stop.get_token();
    for (const float missed_m : viewshed(surface, 0, request).clearance_deficit_m)
        ASSERT_EQ(missed_m, Viewshed::unknown);
}

TEST(Viewshed, IsTheSameForAnyNumberOfThreads) {
    const HeightField field = test::made_field(46.6, 8.3, 1200.0, 200, 200, hills_H_m);
    const TrueSurface surface(field, 1.0, 1);
    ViewshedRequest request{eye_over(surface, 46.52, 8.38, 5.0), standard_air, 1.0, 6e3, 1};
    const Viewshed one = viewshed(surface, 0, request);
    request.threads = 5;
    EXPECT_EQ(one.clearance_deficit_m, viewshed(surface, 0, request).clearance_deficit_m);
}

TEST(Viewshed, WindowsHoldTheCircle) {
    const HeightField field = test::made_field(46.6, 8.3, 1200.0, 400, 500, hills_H_m);
    EXPECT_EQ(window_around(field.grid, {10.0, 8.4, 0.0}, 20e3).rows, 0);
    EXPECT_EQ(window_around(field.grid, {46.5, 100.0, 0.0}, 20e3).columns, 0);
    // 1,000 m are 10.8 rows of 92.6 m and 15.6 columns of 63.9 m at 46.5 N, and 3 to spare.
    const GridPart window = window_around(field.grid, {46.5, 8.5, 0.0}, 1000.0);
    EXPECT_NEAR(window.rows, 2 * 10.8 + 7.0, 2.0);
    EXPECT_NEAR(window.columns, 2 * 15.6 + 7.0, 2.0);
}

}  // namespace
}  // namespace oro
