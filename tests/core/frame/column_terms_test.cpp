// Terms of many columns at a time are those of one at a time, to the bit; so are angles of rows that are
// kept.
#include "core/frame/column_terms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/frame/row_angles.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

TEST(ColumnTerms, OfManyAreThoseOfOneToTheBit) {
    constexpr unsigned seed = 5101;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0), both(-1.0, 1.0);
    std::vector<double> east_deg{0.0, -0.0, 45.0, -45.0, 90.0, 180.0, -180.0, 1e-9, -1e-9, 5e-324, 1e-300};
    for (const double limit : {45.0, 90.0, 1.0, 1e-9})
        for (const double towards : {0.0, 1e3}) east_deg.push_back(std::nextafter(limit, towards));
    for (int i = 0; i < 2'000'000; ++i) {
        switch (i % 3) {
            case 0:
                east_deg.push_back(180.0 * both(random));
                break;
            case 1:
                east_deg.push_back(50.0 * both(random));
                break;
            default:
                east_deg.push_back(std::copysign(std::pow(10.0, 20.0 * unit(random) - 18.0), both(random)));
        }
    }
    std::vector<gpu::ColumnTerms> terms(east_deg.size());
    column_terms(east_deg, terms);
    for (std::size_t i = 0; i < east_deg.size(); ++i) {
        const gpu::ColumnTerms one = column_terms(east_deg[i]);
        ASSERT_EQ(std::memcmp(&one, &terms[i], sizeof(one)), 0) << "seed " << seed << ": " << east_deg[i];
    }
}

// All of a page's columns, as a rule: by the shorter series.
TEST(ColumnTerms, OfManyNearTheEyeAreThoseOfOneToTheBit) {
    constexpr unsigned seed = 5115;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0), both(-1.0, 1.0);
    std::vector<double> east_deg{0.0, -0.0, 4.0, -4.0, 1e-9, -1e-9, 5e-324, 1e-300};
    for (int i = 0; i < 1'000'000; ++i)
        east_deg.push_back(i % 2 == 0
                               ? 4.0 * both(random)
                               : std::copysign(4.0 * std::pow(10.0, -18.0 * unit(random)), both(random)));
    std::vector<gpu::ColumnTerms> terms(east_deg.size());
    column_terms(east_deg, terms);
    for (std::size_t i = 0; i < east_deg.size(); ++i) {
        const gpu::ColumnTerms one = column_terms(east_deg[i]);
        ASSERT_EQ(std::memcmp(&one, &terms[i], sizeof(one)), 0) << "seed " << seed << ": " << east_deg[i];
    }
}

TEST(ColumnTerms, Literals) {
    EXPECT_EQ(column_terms(90.0).W, 1.0F);
    EXPECT_EQ(column_terms(180.0).V, 2.0F);
    EXPECT_NEAR(column_terms(30.0).W, 0.5, 1e-7);
    EXPECT_NEAR(column_terms(60.0).V, 0.5, 1e-7) << "1 - cos 60 degrees";
}

TEST(RowAngles, AreThoseOfTheLatitude) {
    PostGrid grid;
    grid.lat = {1200.0, 0.0, 90 * 1200, -1, 400};
    grid.lon = {1200.0, 0.0, 0, 1, 400};
    RowAngles angles(grid);
    for (int turn = 0; turn < 2; ++turn)
        for (int row = 0; row < 700; row += 3) {
            const RowAngles::Row found = angles.at(row);
            const double lat_deg = row_lat_deg(grid, row);
            const SineCosine lat = sine_cosine_deg(lat_deg);
            EXPECT_EQ(found.sine, lat.sine);
            EXPECT_EQ(found.cosine, lat.cosine);
            EXPECT_EQ(found.normal_m, prime_vertical_radius_m(lat_deg));
        }
}

}  // namespace
}  // namespace oro
