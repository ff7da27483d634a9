// Must hold: horizons over real tiles are those of the oracle's sight lines, to 0.01 degree, and the sky-view
// factor that of these, to 0.001.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "core/base/elapsed.h"
#include "core/base/parallel.h"
#include "core/sight/observer.h"
#include "core/sight/post_horizons.h"
#include "geo/region/region.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

constexpr double radius_m = 30.0e3;

Geodetic eye_on(const TrueSurface& surface, int row, int column) {
    const PostPlace place = surface.field().grid.place_at(row, column);
    return {place.lat_deg, place.lon_deg, surface.post_h_m(row, column).value_or(0.0) + least_above_m};
}

// All around a post, from north.
std::vector<double> horizons_by_lines_deg(const TrueSurface& surface, int row, int column, int directions) {
    const Geodetic eye = eye_on(surface, row, column);
    std::vector<double> elevations_deg(static_cast<std::size_t>(directions), 1000.0);
    in_parallel(directions, thread_count(), [&](int k) {
        elevations_deg[static_cast<std::size_t>(k)] =
            horizon_by_lines_deg(surface, eye, standard_air, 360.0 * k / directions, radius_m)
                .value_or(1000.0);
    });
    return elevations_deg;
}

class RealHorizons : public testing::Test {
  protected:
    // Two tiles of the Alps; skips where there are none.
    void SetUp() override {
        const auto alps = test::real_data("alps");
        if (!alps) GTEST_SKIP() << "needs alps";
        RegionRequest request;
        request.paths = {alps->string()};
        request.box = *parse_tile_range("N46E007:N46E008");
        auto opened = test::open_grid(request);
        ASSERT_TRUE(opened.ok()) << opened.error().line();
        field_ = std::move(opened->field);
    }
    HeightField field_;
};

// At 1,000 random posts, all around each: 36,000 horizons, and the sky-view factors of these.
TEST_F(RealHorizons, AreThoseOfSightLines) {
    constexpr int blocks = 40, posts_of_block = 25, side = 16, directions = 36;
    constexpr unsigned seed = 2054;
    std::printf("seed %u\n", seed);
    const TrueSurface surface(field_, 1.0, thread_count());
    std::mt19937_64 random(seed);
    // Blocks of posts, so that ground around them is made ready once for all of a block.
    std::uniform_int_distribution<int> row(400, field_.grid.rows() - 400 - side),
        column(400, field_.grid.columns() - 400 - side), within(0, side - 1);
    std::vector<double> off_deg;
    double worst_sky = 0.0;
    for (int block = 0; block < blocks; ++block) {
        const GridPart part{row(random), side, column(random), side};
        const PostHorizons found =
            post_horizons(surface, 0, {part, standard_air, 0.0, directions, radius_m, thread_count()});
        for (int i = 0; i < posts_of_block; ++i) {
            const int r = part.first_row + within(random), c = part.first_column + within(random);
            ASSERT_TRUE(surface.post_h_m(r, c));
            const std::vector<double> lines_deg = horizons_by_lines_deg(surface, r, c, directions);
            for (int k = 0; k < directions; ++k) {
                const double found_deg =
                    static_cast<double>(found.elevation_deg[static_cast<std::size_t>(k)][part.number(r, c)]);
                off_deg.push_back(std::abs(found_deg - lines_deg[static_cast<std::size_t>(k)]));
                EXPECT_LE(off_deg.back(), 0.01) << r << "," << c << " azimuth " << 360 * k / directions;
            }
            const double off =
                std::abs(static_cast<double>(found.sky_view[part.number(r, c)]) - sky_view_factor(lines_deg));
            EXPECT_LE(off, 0.001) << r << "," << c;
            worst_sky = std::max(worst_sky, off);
        }
    }
    std::ranges::sort(off_deg);
    std::printf(
        "%d posts, %zu horizons: half within %.1e, 99.9 of 100 within %.1e, all within %.1e degree; sky view "
        "within %.1e\n",
        blocks * posts_of_block, off_deg.size(), off_deg[off_deg.size() / 2],
        off_deg[off_deg.size() * 999 / 1000], off_deg.back(), worst_sky);
    EXPECT_EQ(off_deg.size(), 36000U);
}

// The figures of the page.
TEST_F(RealHorizons, TakesSecondsForThousandsOfPosts) {
    const TrueSurface surface(field_, 1.0, thread_count());
    const auto begin = Clock::now();
    const PostHorizons found =
        post_horizons(surface, 0, {{500, 200, 1100, 200}, standard_air, 0.0, 36, 50.0e3, thread_count()});
    std::printf("200 x 200 posts, 36 azimuths, 50 km: %.2f s on %d threads\n", seconds_since(begin),
                thread_count());
    EXPECT_LT(seconds_since(begin), 60.0);
    EXPECT_EQ(std::ranges::count(found.sky_view, PostHorizons::unknown), 0);
}

}  // namespace
}  // namespace oro
