// Must hold: horizons over real tiles are those of the oracle's sight lines, to 0.01 degree, and the sky-view
// factor that of these, to 0.001.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

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

TEST_F(RealHorizons, AreThoseOfSightLines) {
    constexpr int places = 1000, directions = 36;
    constexpr unsigned seed = 2054;
    std::printf("seed %u\n", seed);
    const TrueSurface surface(field_, 1.0, thread_count());
    std::mt19937_64 random(seed);
    // Blocks of posts, so that ground around them is made ready once for all of a block.
    std::uniform_int_distribution<int> row(400, field_.grid.rows() - 440),
        column(400, field_.grid.columns() - 440), within(0, 39), azimuth(0, directions - 1);
    double worst_deg = 0.0;
    int compared = 0;
    for (int block = 0; block < 10; ++block) {
        const GridPart part{row(random), 40, column(random), 40};
        const PostHorizons found =
            post_horizons(surface, 0, {part, standard_air, 0.0, directions, radius_m, thread_count()});
        for (int i = 0; i < places / 10; ++i) {
            const int r = part.first_row + within(random), c = part.first_column + within(random);
            const int k = azimuth(random);
            if (!surface.post_h_m(r, c)) continue;
            const auto lines_deg = horizon_by_lines_deg(surface, eye_on(surface, r, c), standard_air,
                                                        360.0 * k / directions, radius_m);
            ASSERT_TRUE(lines_deg);
            const double off_deg = std::abs(
                static_cast<double>(found.elevation_deg[static_cast<std::size_t>(k)][part.number(r, c)]) -
                *lines_deg);
            EXPECT_LE(off_deg, 0.01) << r << "," << c << " azimuth " << 360 * k / directions;
            worst_deg = std::max(worst_deg, off_deg);
            ++compared;
        }
    }
    std::printf("%d posts and azimuths: worst %.2e degree\n", compared, worst_deg);
    EXPECT_GE(compared, 990);
}

TEST_F(RealHorizons, SkyViewIsThatOfSightLines) {
    constexpr int directions = 36;
    constexpr unsigned seed = 2055;
    std::printf("seed %u\n", seed);
    const TrueSurface surface(field_, 1.0, thread_count());
    std::mt19937_64 random(seed);
    std::uniform_int_distribution<int> within(0, 39);
    const GridPart part{650, 40, 1300, 40};
    const PostHorizons found =
        post_horizons(surface, 0, {part, standard_air, 0.0, directions, radius_m, thread_count()});
    double worst = 0.0;
    for (int i = 0; i < 40; ++i) {
        const int r = part.first_row + within(random), c = part.first_column + within(random);
        std::vector<double> elevations_deg;
        for (int k = 0; k < directions; ++k)
            elevations_deg.push_back(horizon_by_lines_deg(surface, eye_on(surface, r, c), standard_air,
                                                          360.0 * k / directions, radius_m)
                                         .value_or(-90.0));
        worst = std::max(worst, std::abs(static_cast<double>(found.sky_view[part.number(r, c)]) -
                                         sky_view_factor(elevations_deg)));
    }
    std::printf("40 posts: sky view off by at most %.1e\n", worst);
    EXPECT_LE(worst, 0.001);
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
