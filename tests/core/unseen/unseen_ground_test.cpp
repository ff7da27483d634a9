// The horizon of the data: what is told of it, against what is known of made terrain.
#include "core/unseen/unseen_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <random>
#include <vector>

#include "tests/core/unseen/unseen_land.h"

namespace oro {
namespace {

using test::ceiling_m, test::hills, test::Land, test::turned_square;

TEST(KnownGround, EndsAtTheRimsOfARotatedRaster) {
    HeightField field = turned_square();
    // Void posts of the source, in its middle, are no rim.
    for (int row = 110; row < 130; ++row) {
        for (int column = 110; column < 130; ++column)
            field.H_m[static_cast<std::size_t>(row * field.grid.columns() + column)] = void_height_m;
    }
    const KnownGround known(field, {}, true), without(field, {}, false);
    EXPECT_TRUE(known.holds(46.5, 9.5));
    EXPECT_TRUE(known.holds(46.5, 9.5 + 360.0));
    EXPECT_FALSE(known.holds(46.02, 9.02));
    EXPECT_TRUE(without.holds(46.02, 9.02));
    // Along the diagonal of the square's corner, 0.36 * sqrt(2) degrees from the middle at 75 degrees: known
    // up to two blocks (of 2 posts, 1/120 degree) before it, never beyond it.
    const auto at = [&](double deg) { return known.holds(46.5 + 0.966 * deg, 9.5 + 0.259 * deg); };
    EXPECT_TRUE(at(0.509 - 0.06));
    EXPECT_FALSE(at(0.509));
    EXPECT_FALSE(at(0.52));
}

Camera looking(const Geodetic& eye, double heading_deg, double pitch_deg, int width_px = 320,
               int height_px = 180) {
    Camera camera;
    camera.eye = eye;
    camera.attitude = {heading_deg, pitch_deg, 0.0};
    camera.width_px = width_px;
    camera.height_px = height_px;
    return camera;
}

UnseenGround unseen_from(const Land& land, const Camera& camera, double ceiling = ceiling_m) {
    return unseen_ground(land.look(camera, standard_air, ceiling), camera, ceiling);
}

// Where the ground of each column begins, in pixels from the top, to half a pixel.
std::vector<double> skyline_px(const TrueSurface& surface, const Camera& camera) {
    const Oracle oracle(surface, sight_from(camera.eye, standard_air));
    std::vector<double> skyline(static_cast<std::size_t>(camera.width_px));
    in_parallel(camera.width_px, thread_count(), [&](int x) {
        double y = 0.0;
        while (y < camera.height_px &&
               !oracle.first_hit(camera.ecef_direction_at({x + 0.5, y}), sight_reach_m(camera.eye.h_m)))
            y += 0.5;
        skyline[static_cast<std::size_t>(x)] = y;
    });
    return skyline;
}

// The ground that is left out moves the skyline, and hides ground behind a gap, by no more than the bound.
TEST(UnseenGround, NoGroundThatIsLeftOutIsHigherThanTheBound) {
    constexpr unsigned seed = 11;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    // Hills in the west, a plain up to the edge, and ranges of up to 8,800 m beyond it.
    const auto H_m = [](double lat, double lon) {
        const double of_hills = std::clamp((9.9 - lon) * 20.0, 0.0, 1.0);
        const double range = std::max(0.0, lon - 10.02) * 8900.0 * std::abs(std::sin(40.0 * lat + 9.0 * lon));
        return static_cast<float>(of_hills * test::hills_m(lat, lon) + range);
    };
    HeightField all = test::made_field(47.0, 9.0, 240.0, 241, 481, H_m);
    const TrueSurface whole(all, 1.0, thread_count());
    const Land part(test::made_field(47.0, 9.0, 240.0, 241, 241, H_m), {});
    double largest_px = 0.0, mean_px = 0.0;
    int columns = 0, moved = 0;
    for (int view = 0; view < 10; ++view) {
        Geodetic eye{46.05 + 0.9 * unit(random), 9.1 + 0.88 * unit(random), 0.0};
        if (view == 0) eye = {46.5, 9.95, 0.0};
        eye.h_m = *whole.h_m(eye.lat_deg, eye.lon_deg) + 2.0;
        const Camera camera = looking(eye, view == 0 ? 90.0 : 45.0 + 90.0 * unit(random), 0.0, 160, 90);
        const std::vector<double> with = skyline_px(whole, camera),
                                  without = skyline_px(*part.surface, camera);
        const UnseenGround unseen = unseen_from(part, camera);
        for (std::size_t x = 0; x < with.size(); ++x) {
            const double by_px = without[x] - with[x];
            EXPECT_LE(by_px, static_cast<double>(unseen.column_px[x]) + 1e-3) << "view " << view << ", " << x;
            EXPECT_LE(static_cast<double>(unseen.column_px[x]), unseen.bound_px);
            largest_px = std::max(largest_px, by_px);
            moved += by_px > 1.0;
            mean_px += view == 0 ? by_px / camera.width_px : 0.0;
            ++columns;
        }
        if (view > 0) continue;
        EXPECT_EQ(unseen.columns_beyond, unseen.columns);
        ASSERT_EQ(unseen.missing.size(), 1U);
        EXPECT_EQ(unseen.missing[0].cell, (DegreeCell{46, 10}));
        EXPECT_EQ(unseen.missing[0].bound_px, unseen.bound_px);
    }
    std::printf(
        "%d columns, %d moved by more than 1 px, by at most %.1f px; the first view by %.1f px in the mean\n",
        columns, moved, largest_px, mean_px);
    EXPECT_GT(moved, 300);
    EXPECT_GT(largest_px, 15.0);
}

// What lies beyond a part that was chosen is no missing cell, wherever the grid's last posts are.
TEST(KnownGround, TellsBeyondAPartFromBeyondTheData) {
    const HeightField field = hills(46.5, 8.25, 120.0, 31, 31);  // to 46.25 N, 8.5 E
    const KnownGround all(field, {}, false);
    EXPECT_FALSE(all.is_beyond_part(46.6, 8.3));
    // 1.5 posts wider in the west and north, much wider in the east and south.
    const KnownGround part(field, {}, false, DegreeBox{8.2375, 46.0, 9.0, 46.5125});
    EXPECT_TRUE(part.is_beyond_part(46.4, 8.2499));
    EXPECT_TRUE(part.is_beyond_part(46.5001, 8.3));
    EXPECT_FALSE(part.is_beyond_part(46.4, 8.51));
    EXPECT_FALSE(part.is_beyond_part(46.2, 8.3));
    EXPECT_TRUE(part.is_beyond_part(46.4, 9.01));
    EXPECT_TRUE(part.is_beyond_part(45.99, 8.3));
    // Over the antimeridian.
    const HeightField fiji = hills(-16.5, 179.75, 120.0, 31, 61);  // to 179.75 W
    const KnownGround over(fiji, {}, false, DegreeBox{179.0, -17.0, -179.0, -16.0});
    EXPECT_FALSE(over.is_beyond_part(-16.6, -179.5));
    EXPECT_FALSE(over.is_beyond_part(-16.6, 179.5));
    EXPECT_TRUE(over.is_beyond_part(-16.6, 178.5));
    EXPECT_TRUE(over.is_beyond_part(-16.6, -178.5));
    EXPECT_EQ(over.unseen_at(-16.6, -178.5), (UnseenPlace{{-17, -179}, true}));
}

TEST(UnseenGround, SaysNothingOfViewsThatEndOnData) {
    const Land land(hills(47.0, 9.0, 240.0, 241, 241), {});
    const auto columns = [&](const Geodetic& eye, double pitch_deg) {
        const UnseenGround unseen = unseen_from(land, looking(eye, 90.0, pitch_deg));
        EXPECT_EQ(unseen.missing.empty(), unseen.columns_beyond == 0);
        EXPECT_EQ(unseen.bound_px > 0.0, unseen.columns_beyond > 0);
        return unseen.columns_beyond;
    };
    EXPECT_EQ(columns({46.5, 9.5, 5000.0}, -90.0), 0);
    EXPECT_EQ(columns({46.5, 9.5, 20000.0}, -90.0), 0);
    EXPECT_EQ(columns({46.5, 9.5, 3000.0}, 90.0), 0);   // the zenith
    EXPECT_EQ(columns({46.5, 9.5, 3000.0}, 0.0), 320);  // the horizon
    EXPECT_EQ(columns({46.5, 9.5, 1e6}, 0.0), 0);       // space
    EXPECT_EQ(columns({46.5, 9.5, 200000.0}, -90.0), 320);
}

TEST(UnseenGround, TheWholeEarthHasNoEdge) {
    const HeightField field = hills(90.0, -180.0, 1.0, 181, 361);
    const Land earth(field, {});
    for (const double height_m : {4000.0, 30000.0, 4.0e6}) {
        for (const double lat_deg : {-90.0, -33.3, 0.0, 89.99}) {
            for (const double pitch_deg : {0.0, -20.0, -90.0})
                EXPECT_EQ(
                    unseen_from(earth, looking({lat_deg, 179.9, height_m}, 77.0, pitch_deg)).columns_beyond,
                    0);
        }
    }
    // One cell less: seen from beside it, not from the other side of the Earth.
    const Land but_one(field, {{0, -180}});
    const UnseenGround unseen = unseen_from(but_one, looking({0.5, 179.9, 3000.0}, 90.0, 0.0));
    EXPECT_EQ(unseen.columns_beyond, 320);
    ASSERT_EQ(unseen.missing.size(), 1U);
    EXPECT_EQ(unseen.missing[0].cell, (DegreeCell{0, -180}));
    EXPECT_EQ(unseen_from(but_one, looking({0.5, 0.0, 4.0e6}, 90.0, -90.0)).columns_beyond, 0);
}

// From 3,000 m, level, over level ground: the ceiling C at the edge, a distance s away, is seen (C - h - s^2
// (1
// - k) / 2R) / s above the level; f = 180 px / 2 tan(22.5 deg) = 217.28 px a unit. The ground's horizon is
// where the tangents meet it, some 1.6 degrees lower, unless the data end before it.
TEST(UnseenGround, TheBoundIsTheCeilingAtTheEdge) {
    const Land land(test::made_field(47.0, 9.0, 240.0, 241, 241, [](double, double) { return 0.0F; }), {});
    const Geodetic eye{46.5, 9.5, 3000.0};
    // North, 0.5 degrees of latitude: 55,577 m. The meridian's radius there is 6,369 km.
    const double s_m = 55577.0, R_m = 6.369e6;
    const auto tangent = [&](double H_m, double k) {
        return (H_m - 3000.0 - s_m * s_m * (1.0 - k) / (2.0 * R_m)) / s_m;
    };
    for (const double ceiling : {4000.0, 6000.0, 9000.0}) {
        const Camera camera = looking(eye, 0.0, 0.0, 321);
        const UnseenGround unseen = unseen_from(land, camera, ceiling);
        // Refraction by height: k exp(-3000 / 8434).
        const double k = 0.13 * std::exp(-3000.0 / 8434.0);
        const double expected_px = 217.28 * (tangent(ceiling + 86.0, k) - tangent(0.0, k));
        const double bound_px = static_cast<double>(unseen.column_px[160]);
        EXPECT_GE(bound_px, expected_px);
        EXPECT_LE(bound_px, expected_px + 2.5) << ceiling;  // two pixels, and half a pixel for the edge
    }
}

TEST(UnseenGround, LargePicturesAreLookedAtInParts) {
    const Land land(hills(47.0, 9.0, 240.0, 241, 241), {});
    const Geodetic eye{46.5, 9.9, 2500.0};
    const UnseenGround small = unseen_from(land, looking(eye, 90.0, 0.0, 800, 450));
    const UnseenGround large = unseen_from(land, looking(eye, 90.0, 0.0, 8000, 4500));
    EXPECT_EQ(large.columns, 8000);
    EXPECT_EQ(large.columns_beyond, 8000);
    EXPECT_EQ(small.columns_beyond, 800);
    EXPECT_NEAR(large.bound_px, 10.0 * small.bound_px, 20.0);
    EXPECT_EQ(unseen_from(land, looking(eye, 90.0, 0.0, 1, 1)).columns, 1);
}

TEST(UnseenGround, EyesWithoutDataBelowThemSeeNothingKnown) {
    const Land land(hills(47.0, 9.0, 240.0, 241, 241), {});
    const UnseenGround unseen = unseen_from(land, looking({46.5, 8.5, 2000.0}, 90.0, 0.0));
    EXPECT_EQ(unseen.columns_beyond, 320);
    EXPECT_EQ(unseen.bound_px, 180.0);
    ASSERT_EQ(unseen.missing.size(), 1U);
    EXPECT_EQ(unseen.missing[0].cell, (DegreeCell{46, 8}));
    // Far below the ground, and near the Earth's middle: no answer means much, but there is one.
    for (const double h_m : {-5000.0, -3.0e6, -6.3e6}) {
        const UnseenGround odd = unseen_from(land, looking({46.5, 9.5, h_m}, 90.0, 10.0));
        EXPECT_LE(odd.bound_px, 180.0);
    }
}

// The cost for a picture of 1280 x 720 of nine tiles, on one thread.
TEST(UnseenGround, CostsLittle) {
    const Land land(
        test::made_field(48.0, 8.0, 1200.0, 3601, 3601,
                         [](double lat, double lon) { return static_cast<float>(test::hills_m(lat, lon)); }),
        {});
    double most_s = 0.0;
    for (const double above_m : {2.0, 3000.0, 30000.0}) {
        const Geodetic eye{46.5, 9.6, *land.surface->h_m(46.5, 9.6) + above_m};
        const Camera camera = looking(eye, 90.0, 0.0, 1280, 720);
        const Sight sight = sight_from(camera.eye, standard_air);
        const std::clock_t start = std::clock();
        const UnseenPicture picture = unseen_picture(*land.surface, *land.known, sight, camera, ceiling_m, 1);
        const UnseenGround unseen = unseen_ground(picture, camera, ceiling_m);
        const double spent_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        std::printf("%g m above the ground: %.3f s, %d columns\n", above_m, spent_s, unseen.columns_beyond);
        most_s = std::max(most_s, spent_s);
    }
    EXPECT_LT(most_s, 1.0);  // some 0.1 s; a machine under sanitizers takes longer
}

}  // namespace
}  // namespace oro
