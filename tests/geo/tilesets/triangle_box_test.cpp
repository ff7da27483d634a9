// Boxes of flat triangles hold all of their points, and reach no deeper than they must.
#include "geo/tilesets/triangle_box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>

#include "geo/tilesets/tile_boxes.h"
#include "tests/geo/tilesets/held_triangles.h"

namespace oro {
namespace {

constexpr unsigned box_seed = 20261129;
using Corners = std::array<glm::dvec3, 3>;

TileBox box_around(const Corners& corners_m) {
    TriangleBox box(geodetic_from_ecef({corners_m[0]}).lon_deg);
    for (const glm::dvec3& corner_m : corners_m) box.add_corner(corner_m);
    box.add_triangle(corners_m);
    return box.box();
}

test::BoxRegion region_of(const TileBox& box) {
    test::BoxRegion region{};
    const auto json = region_json_of(box);
    for (std::size_t i = 0; i < region.size(); ++i) region[i] = json[i];
    return region;
}

// Corners so far around a place, at heights from the deepest sea to the highest summit.
Corners random_triangle(const Geodetic& middle, double reach_m, std::mt19937& random) {
    std::uniform_real_distribution<double> aside(-reach_m, reach_m), heights_m(-11000.0, 9000.0);
    const glm::dmat3 enu = ecef_from_enu(middle.lat_deg, middle.lon_deg);
    const glm::dvec3 middle_m = ecef_from_geodetic(middle).m;
    Corners corners_m;
    for (glm::dvec3& corner_m : corners_m) {
        Geodetic at = geodetic_from_ecef({middle_m + enu * glm::dvec3(aside(random), aside(random), 0.0)});
        at.h_m = heights_m(random);
        corner_m = ecef_from_geodetic(at).m;
    }
    return corners_m;
}

// Around the equator, the antimeridian and the poles; of 100 m to 2,000 km.
TEST(TriangleBoxes, HoldEveryPointAndAreNoDeeperThanTheSagitta) {
    std::printf("seed %u\n", box_seed);
    std::mt19937 random(box_seed);
    constexpr std::array<Geodetic, 9> middles{{{0.0, 10.0, 0.0},
                                               {0.001, 179.999, 0.0},
                                               {45.0, -180.0, 0.0},
                                               {-60.0, 179.9, 0.0},
                                               {80.0, 100.0, 0.0},
                                               {89.99, -120.0, 0.0},
                                               {90.0, 0.0, 0.0},
                                               {-89.9, 60.0, 0.0},
                                               {-90.0, 0.0, 0.0}}};
    int outside = 0, turns = 0, triangles = 0;
    double deepest_m = 0.0;
    for (const Geodetic& middle : middles)
        for (const double reach_m : {1.0e2, 1.0e4, 1.0e5, 5.0e5, 1.0e6})
            for (int i = 0; i < 20; ++i) {
                const Corners corners_m = random_triangle(middle, reach_m, random);
                const TileBox box = box_around(corners_m);
                outside += test::points_outside(region_of(box), corners_m, 60);
                ++triangles;
                turns += box.east_deg - box.west_deg >= 360.0 ? 1 : 0;
                double lowest_h_m = 1.0e9;
                for (const glm::dvec3& corner_m : corners_m)
                    lowest_h_m = std::min(lowest_h_m, geodetic_from_ecef({corner_m}).h_m);
                const double sag_m = lowest_h_m - box.lowest_h_m;
                EXPECT_LE(sag_m, test::sagitta_m(corners_m, lowest_h_m) + 1.0);
                deepest_m = std::max(deepest_m, sag_m);
            }
    std::printf("%d triangles, %d around a pole, the deepest box %.0f m below its corners\n", triangles,
                turns, deepest_m);
    EXPECT_EQ(outside, 0);
    EXPECT_GT(turns, 10);
    EXPECT_LT(turns, triangles / 2);
    EXPECT_GT(deepest_m, 10000.0);
}

// The middle of a triangle of three equal sides of 1,000 km lies 1,000 km / sqrt(3) from its corners: on a
// sphere of the radius R that is L^2 / (6 R) below it to the first order, and more than the sagitta
// L^2 / (8 R) of a side.
TEST(TriangleBoxes, HoldTheMiddleOfEqualSides) {
    const glm::dmat3 enu = ecef_from_enu(0.0, 0.0);
    constexpr double side_m = 1.0e6, to_corner_m = 577350.27, meridian_at_equator_m = 6335439.0;
    Corners corners_m;
    for (std::size_t i = 0; i < 3; ++i) {
        const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / 3.0;
        const Geodetic at = geodetic_from_ecef(
            {ecef_from_geodetic({}).m +
             enu * glm::dvec3(to_corner_m * std::sin(turn), to_corner_m * std::cos(turn), 0.0)});
        corners_m[i] = ecef_from_geodetic({at.lat_deg, at.lon_deg, 0.0}).m;
    }
    const TileBox box = box_around(corners_m);
    const double middle_h_m = geodetic_from_ecef({(corners_m[0] + corners_m[1] + corners_m[2]) / 3.0}).h_m;
    EXPECT_LT(middle_h_m, -side_m * side_m / (8.0 * meridian_at_equator_m) - 5000.0);
    EXPECT_LT(box.lowest_h_m, middle_h_m);
    EXPECT_GT(box.lowest_h_m, middle_h_m - 500.0);
    EXPECT_EQ(test::points_outside(region_of(box), corners_m, 200), 0);
}

// Between two meridians, and on the side of a parallel that is the equator's, nothing bulges: a centimetre is
// 9.0e-8 degrees of latitude.
TEST(TriangleBoxes, AreAsWideAsTheirCornersWhereNothingBulges) {
    const auto at = [](double lat_deg, double lon_deg) {
        return ecef_from_geodetic({lat_deg, lon_deg, 100.0}).m;
    };
    const TileBox north = box_around({at(60.0, 170.0), at(60.0, 190.0), at(70.0, 180.0)});
    EXPECT_NEAR(north.south_deg, 60.0, 1e-6);
    EXPECT_NEAR(north.west_deg, 170.0, 1e-6);
    EXPECT_NEAR(north.east_deg, 190.0, 1e-6);
    EXPECT_NEAR(north.highest_h_m, 100.0, 0.02);
    const TileBox south = box_around({at(-60.0, 170.0), at(-60.0, 190.0), at(-70.0, 180.0)});
    EXPECT_NEAR(south.north_deg, -60.0, 1e-6);
    // The middle of the parallel's chord: tan(60) / cos(10) is tan(60.379) where the Earth is a sphere.
    const TileBox chord = box_around({at(60.0, 170.0), at(60.0, 190.0), at(59.0, 180.0)});
    EXPECT_GT(chord.north_deg, 60.37);
    EXPECT_LT(chord.north_deg, 60.42);
}

// What is larger than half the Earth has its box.
TEST(TriangleBoxes, OfHalfTheEarthAreTheEarth) {
    const auto at = [](double lat_deg, double lon_deg) {
        return ecef_from_geodetic({lat_deg, lon_deg, 0.0}).m;
    };
    const Corners corners_m{at(0.0, 0.0), at(0.0, 120.0), at(0.0, -120.0)};
    const TileBox box = box_around(corners_m);
    EXPECT_EQ(box.north_deg, 90.0);
    EXPECT_EQ(box.south_deg, -90.0);
    EXPECT_EQ(box.east_deg - box.west_deg, 360.0);
    EXPECT_LE(box.lowest_h_m, -6356752.0);
    EXPECT_NEAR(box.highest_h_m, 0.0, 0.02);
}

}  // namespace
}  // namespace oro
