// Must hold: whether one place is seen from another, and by how much, is what marching along the line in
// small steps says.
#include "core/sight/observer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/base/parallel.h"
#include "tests/support/made_terrain.h"
#include "tests/support/marched_line.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

using test::MarchedLine;

// Mountains of 1,500 m with ridges a few cells wide.
float mountains_H_m(double lat_deg, double lon_deg) {
    return static_cast<float>(test::Waves{1200.0, 700.0, 60.0, 6}.H_m(lat_deg, lon_deg));
}

struct Pairs {
    const HeightField& field;
    const TrueSurface surface{field, 1.0, thread_count()};
    std::mt19937_64 random;

    [[nodiscard]] Geodetic standing(double above_m) {
        const PostGrid& grid = field.grid;
        std::uniform_real_distribution<double> share(0.0, 1.0);
        for (;;) {
            Geodetic point{grid.lat.at_deg(0) - share(random) * (grid.rows() - 1) / grid.lat.posts_per_deg,
                           grid.lon.at_deg(0) + share(random) * (grid.columns() - 1) / grid.lon.posts_per_deg,
                           0.0};
            const auto h_m = surface.h_m(point.lat_deg, point.lon_deg);
            if (!h_m) continue;
            point.h_m = *h_m + above_m;
            return point;
        }
    }
};

struct Tally {
    int pairs{}, visible{}, ties{}, wrong{}, clearances_off{}, raised_wrong{};
    double worst_m{};
};

MarchedLine::Place place(const Geodetic& point, double by_m = 0.0) {
    return {point.lat_deg, point.lon_deg, point.h_m + by_m};
}

// Closer to the ground than this, places in double decide.
constexpr double tie_m = 1.0e-3;

void compare(Pairs& pairs, int count, Tally& tally) {
    std::uniform_real_distribution<double> above(0.5, 60.0), bend(-0.2, 0.3);
    for (int i = 0; i < count; ++i) {
        const Geodetic eye = pairs.standing(above(pairs.random)),
                       target = pairs.standing(above(pairs.random));
        const double k = bend(pairs.random);
        const Observer observer(pairs.surface, eye, {k});
        const MarchedLine line(pairs.field, place(eye), place(target), k);
        const double truth_m = line.least_clearance_m(2.0);
        const bool sees = observer.sees(target);
        ++tally.pairs;
        tally.visible += sees;
        if (std::abs(truth_m) < tie_m) {
            ++tally.ties;
        } else if (sees != (truth_m > 0.0)) {
            ++tally.wrong;
            std::printf("pair %d: %s, marched clearance %.6f m\n", i, sees ? "seen" : "hidden", truth_m);
        }
        // Where it is under the ground, its deepest place is a dip; elsewhere the ends may be lower.
        if (truth_m < 0.0 && sees == false) {
            const double off_m = observer.line_to(target).clearance_m - truth_m;
            tally.worst_m = std::max(tally.worst_m, std::abs(off_m));
            tally.clearances_off += std::abs(off_m) > 2.0e-3;
        }
        if (sees || i % 8 != 0) continue;
        const auto by_m = observer.clearance_deficit_m(target);
        ASSERT_TRUE(by_m);
        for (const double offset_m : {-0.02, 0.02}) {
            const MarchedLine raised(pairs.field, place(eye), place(target, *by_m + offset_m), k);
            tally.raised_wrong += (raised.least_clearance_m(2.0) > 0.0) != (offset_m > 0.0);
        }
    }
}

TEST(Observer, TenThousandPairsAreTheMarchedLines) {
    constexpr unsigned seed = 4711;
    std::printf("seed %u\n", seed);
    const HeightField alps = test::made_field(46.6, 8.3, 1200.0, 160, 200, mountains_H_m);
    const HeightField round = test::made_field(-17.0, 179.9, 600.0, 120, 140, mountains_H_m);
    const HeightField north = test::made_field(89.0, -30.0, 300.0, 100, 3000, [](double lat, double lon) {
        return mountains_H_m(3.0 * lat, 0.1 * lon);
    });
    Tally tally;
    unsigned next = seed;
    for (const auto& [field, count] : {std::pair{&alps, 7500}, {&round, 2000}, {&north, 500}}) {
        Pairs pairs{*field, TrueSurface(*field, 1.0, thread_count()), std::mt19937_64(next++)};
        compare(pairs, count, tally);
    }
    std::printf(
        "%d pairs, %d visible, %d ties within 1 mm, %d wrong; clearance off by %.2e m at most; of "
        "raised targets %d wrong\n",
        tally.pairs, tally.visible, tally.ties, tally.wrong, tally.worst_m, tally.raised_wrong);
    EXPECT_EQ(tally.pairs, 10000);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_EQ(tally.clearances_off, 0);
    EXPECT_EQ(tally.raised_wrong, 0);
    EXPECT_LE(tally.ties, 10);
    EXPECT_GT(tally.visible, 500);
}

// Asked for: whether ground at the eye's feet, which hides what is thousands of times as far away, is told to
// a centimetre there. By marched lines, as above: 5 mm less hide the target, 5 mm more do not.
TEST(Observer, WhatIsCloseByHidesByItsFullHeight) {
    constexpr unsigned seed = 4712;
    std::printf("seed %u\n", seed);
    const HeightField field = test::made_field(46.6, 8.3, 1200.0, 160, 200, mountains_H_m);
    Pairs pairs{field, TrueSurface(field, 1.0, thread_count()), std::mt19937_64(seed)};
    std::uniform_real_distribution<double> above(0.02, 0.5);
    int hidden = 0, wrong = 0;
    for (int i = 0; i < 300; ++i) {
        const Geodetic eye = pairs.standing(above(pairs.random)),
                       target = pairs.standing(above(pairs.random));
        const auto by_m = Observer(pairs.surface, eye, {0.13}).clearance_deficit_m(target);
        ASSERT_TRUE(by_m);
        if (*by_m == 0.0) continue;
        ++hidden;
        for (const double offset_m : {-0.005, 0.005}) {
            const MarchedLine raised(field, place(eye), place(target, *by_m + offset_m), 0.13);
            wrong += (raised.least_clearance_m(8.0) > 0.0) != (offset_m > 0.0);
        }
    }
    std::printf("%d hidden, %d wrong\n", hidden, wrong);
    EXPECT_GT(hidden, 200);
    EXPECT_EQ(wrong, 0);
}

// Over a sphere's like, without mountains: the distance to the horizon, and what it hides.
TEST(Observer, TheEarthsCurvatureHides) {
    const HeightField sea = test::made_field(0.2, 10.0, 600.0, 240, 600, [](double, double) { return 0.0F; });
    const TrueSurface surface(sea, 1.0, 1);
    // Along the equator, a circle of a: an eye and a target of 10 m each see each other over
    // 2 acos(a / (a + 10)) a = 22,588.72 m; 0.2029179 degree.
    const Observer observer(surface, {0.0, 10.1, 10.0}, {});
    EXPECT_TRUE(observer.sees({0.0, 10.1 + 0.202905, 10.0}));
    EXPECT_FALSE(observer.sees({0.0, 10.1 + 0.202925, 10.0}));
    // 40 km off (0.3593261 degree): h = a (1 / cos((d - d1) / a) - 1), d1 = 11,294.36 m, is 64.597 m.
    const auto by_m = observer.clearance_deficit_m({0.0, 10.1 + 0.3593261, 1.0});
    ASSERT_TRUE(by_m);
    EXPECT_NEAR(*by_m, 64.5973 - 1.0, 0.01);
}

TEST(Observer, VoidsHideNothingAndAreTold) {
    HeightField field = test::made_field(46.6, 8.3, 1200.0, 60, 60, [](double, double) { return 500.0F; });
    for (int row = 0; row < 60; ++row) {
        for (int column = 20; column < 30; ++column)
            field.H_m[static_cast<std::size_t>(row * 60 + column)] = void_height_m;
    }
    const TrueSurface surface(field, 1.0, 1);
    const Observer observer(surface, {46.58, 8.305, 510.0}, {});
    const Geodetic target{46.58, 8.345, 510.0};
    EXPECT_TRUE(observer.sees(target));
    // Eleven cells of 1/1200 degree on the parallel of 46.58 N: 76,656 m a degree (N + h) cos(lat).
    EXPECT_NEAR(observer.line_to(target).without_data_m, 11.0 / 1200.0 * 76656.0, 2.0);
}

}  // namespace
}  // namespace oro
