// Viewsheds over posts on a net: of every post what a line of sight to it says.
#include "core/sight/viewshed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/base/parallel.h"
#include "tests/core/sight/against_observers.h"
#include "tests/support/net_terrain.h"

namespace oro {
namespace {

using test::expect_observers;
using test::eye_over;

TEST(NetViewshed, IsTheLookoutsTurnedOverTheAntimeridianAndAPole) {
    struct Case {
        const char* name;
        test::PlaneOfPosts plane;
    };
    for (const auto& [name, plane] :
         {Case{"turned", {320, 400, {46.5, 8.0}, 60.0, 33.0}},
          Case{"over the antimeridian", {300, 260, {-17.0, 179.99}, 90.0, -100.0}},
          Case{"over a pole", {280, 300, {89.97, 20.0}, 80.0, 10.0}}}) {
        HeightField field = test::net_field(plane, test::patchy_H_m, 47.5F);
        for (int row = 40; row < 60; ++row) {
            for (int column = 90; column < 99; ++column)
                field.H_m[static_cast<std::size_t>(row * plane.columns + column)] = void_height_m;
        }
        const TrueSurface surface(field, 1.0, thread_count());
        for (const double above_m : {2.0, 400.0}) {
            const PostPlace under = plane.place_of(0.4 * plane.rows + 0.3, 0.55 * plane.columns + 0.6);
            const ViewshedRequest request{eye_over(surface, under.lat_deg, under.lon_deg, above_m),
                                          standard_air, 2.0, 9.0e3, thread_count()};
            expect_observers(name, surface, request, 20000);
        }
        // On a post, and beside the data.
        const PostPlace post = field.grid.place_at(200, 130);
        expect_observers(name, surface,
                         {eye_over(surface, post.lat_deg, post.lon_deg, 3.0), {0.13}, 0.0, 6e3, 2}, 10000);
        const PostPlace outside = field.grid.place_at(-20.0, 100.0);
        expect_observers(name, surface, {{outside.lat_deg, outside.lon_deg, 600.0}, {}, 0.0, 8e3, 2}, 5000);
    }
}

// Every post within the radius is in the window, wherever the eye stands.
TEST(NetViewshed, WindowsHoldTheCircle) {
    constexpr unsigned seed = 93;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const test::PlaneOfPosts plane{200, 300, {89.6, 120.0}, 400.0, 25.0};
    const HeightField field = test::net_field(plane, [](double, double) { return 0.0F; });
    int empty = 0;
    for (int i = 0; i < 200; ++i) {
        const PostPlace at = plane.place_of((2.0 * unit(random) - 0.5) * plane.rows,
                                            (2.0 * unit(random) - 0.5) * plane.columns);
        const double radius_m = 60000.0 * unit(random);
        const GridPart window = window_around(field.grid, {at.lat_deg, at.lon_deg, 0.0}, radius_m);
        empty += window.rows < 1 ? 1 : 0;
        const glm::dvec3 eye = ecef_from_enu(at.lat_deg, at.lon_deg)[2];
        for (int row = 0; row < plane.rows; ++row) {
            for (int column = 0; column < plane.columns; ++column) {
                const double angle =
                    std::acos(std::min(1.0, glm::dot(eye, field.grid.net->normal_at(row, column))));
                if (angle * 6.357e6 > radius_m) continue;
                ASSERT_TRUE(row >= window.first_row && row < window.first_row + window.rows &&
                            column >= window.first_column && column < window.first_column + window.columns)
                    << row << "," << column << " of " << radius_m << " m";
            }
        }
    }
    EXPECT_GT(empty, 0);
    EXPECT_EQ(window_around(field.grid, {46.5, 8.0, 0.0}, 20e3).rows, 0);
}

}  // namespace
}  // namespace oro
