#include "geo/posts/source_sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/geo/written_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

PostBlock block_of(int rows, int columns, const HeightOfPost& height) {
    PostBlock block;
    block.window = {0, 0, rows, columns};
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) block.height_m.push_back(static_cast<float>(height(r, c)));
    }
    return block;
}

constexpr double no_limit_m = 1e9;

TEST(Cubic, GivesPostsAndPlanesExactlyAndGoesOnStraightBeyondTheEdge) {
    const auto plane = [](double r, double c) { return 100.0 + 3.0 * r - 2.0 * c; };
    const PostBlock block = block_of(6, 7, plane);
    std::mt19937 random(20261121);
    std::uniform_real_distribution<double> row(-0.5, 5.5), column(-0.5, 6.5);
    for (int i = 0; i < 2000; ++i) {
        const double r = row(random), c = column(random);
        ASSERT_NEAR(static_cast<double>(cubic_height_m(block, 6, 7, false, c, r, no_limit_m)), plane(r, c),
                    1e-4)
            << r << " " << c;
    }
    const PostBlock rough = block_of(6, 7, [](int r, int c) { return (r * 37 + c * 53) % 101; });
    for (int r = 0; r < 6; ++r) {
        for (int c = 0; c < 7; ++c)
            EXPECT_EQ(cubic_height_m(rough, 6, 7, false, c, r, no_limit_m), rough.at(r, c));
    }
}

TEST(Cubic, ReproducesAParabola) {
    // Keys' kernel with a = -1/2 is exact for polynomials up to the second degree (Keys 1981, section IV).
    const PostBlock block = block_of(8, 8, [](int, int c) { return 2.0 * c * c; });
    EXPECT_NEAR(static_cast<double>(cubic_height_m(block, 8, 8, false, 3.25, 4.0, no_limit_m)),
                2.0 * 3.25 * 3.25, 1e-4);
}

TEST(Cubic, VoidsNeverMixIntoHeights) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> at(0.0, 19.0);
    std::bernoulli_distribution hole(0.15);
    const PostBlock block = block_of(20, 20, [&](int r, int c) {
        return hole(random) ? static_cast<double>(void_height_m) : 1000.0 + (r + c) % 3;
    });
    int voids = 0;
    for (int i = 0; i < 20000; ++i) {
        const float height = cubic_height_m(block, 20, 20, false, at(random), at(random), no_limit_m);
        if (is_void(height)) {
            ++voids;
            continue;
        }
        ASSERT_GT(height, 998.0F);
        ASSERT_LT(height, 1004.0F);
    }
    EXPECT_GT(voids, 1000);
    EXPECT_LT(voids, 15000);
}

TEST(Cubic, AStepThrowsNoPits) {
    const PostBlock block = block_of(8, 8, [](int, int c) { return c < 4 ? 0.0 : 3000.0; });
    for (double c = 0.0; c <= 7.0; c += 0.05) {
        const float height = cubic_height_m(block, 8, 8, false, c, 3.5, 45.0);
        EXPECT_GE(height, -45.0F);
        EXPECT_LE(height, 3045.0F);
    }
}

TEST(Cubic, WrapsAroundTheEarth) {
    const PostBlock block = block_of(4, 12, [](int, int c) { return std::cos(c * std::numbers::pi / 6.0); });
    for (double c = -3.0; c < 15.0; c += 0.37)
        EXPECT_NEAR(static_cast<double>(cubic_height_m(block, 4, 12, true, c, 1.5, no_limit_m)),
                    std::cos(c * std::numbers::pi / 6.0), 0.01);
}

// Two projected rasters that touch join without a gap, whatever lies between their outer posts.
TEST(Resampling, TouchingProjectedRastersJoin) {
    const auto folder = scratch_folder();
    Raster raster;
    raster.rows = raster.columns = 40;
    raster.crs = "EPSG:32632";
    const auto surface = [](double x, double y) { return (x - 400000.0) / 50.0 + (y - 5100000.0) / 80.0; };
    const auto write = [&](const char* name, double west) {
        raster.cell_corners = {west, 100.0, 0.0, 5104000.0, 0.0, -100.0};
        return write_raster(folder / name, raster, [&](int r, int c) {
            return surface(west + 50.0 + 100.0 * c, 5103950.0 - 100.0 * r);
        });
    };
    const auto region = opened(resampled_from({write("a.tif", 400000.0), write("b.tif", 404000.0)}));
    ASSERT_TRUE(region);
    // Voids only around the (slightly turned) outline: between the first and last height of each row there is
    // none.
    const PostGrid& grid = region->field.grid;
    int whole_rows = 0;
    for (int r = 3; r < grid.rows() - 3; ++r) {
        int first = -1, last = -1, heights = 0;
        for (int c = 0; c < grid.columns(); ++c) {
            if (is_void(region->field.H_at_post_m(r, c))) continue;
            if (first < 0) first = c;
            last = c;
            ++heights;
            if (c > first + 1 && !is_void(region->field.H_at_post_m(r, c - 1))) {
                EXPECT_LT(std::abs(region->field.H_at_post_m(r, c) - region->field.H_at_post_m(r, c - 1)),
                          4.0F);
            }
        }
        if (first < 0) continue;
        EXPECT_EQ(heights, last - first + 1) << "row " << r;
        whole_rows += heights > 60;
    }
    EXPECT_GT(whole_rows, 25);
}

// N46E008 from .hgt.zip and from the same tile in other CRSs and units. The common grid is the one that the
// resampled file opens on (90 m, as its own posts); the tile is its full-resolution surface there. The files
// hold less than the tile: the UTM one is its bilinear 90 m resampling (GDAL's bilinear warp of the tile
// gives the same values to 0.2 mm), from which GDAL's cubic warp of the tile to the same posts differs by 2.9
// m RMS, and GDAL's cubic warp of the file back to the tile's posts by 5.3 m. A tenth of a post of
// misplacement would add several metres.
TEST(Resampling, RealTileInThreeOtherSystems) {
    const auto hgt = real_data("alps/N46E008.SRTMGL3.hgt.zip");
    if (!hgt || !real_data("geotiff")) GTEST_SKIP() << "needs alps, geotiff";
    const auto truth = opened(request_for({hgt->string()}));
    ASSERT_TRUE(truth);
    std::printf("%-50s %9s %8s %9s %8s\n", "against N46E008.SRTMGL3.hgt.zip", "samples", "RMS m", "mean m",
                "most m");
    for (const char* name : {"N46E008_EPSG2056_f32_cog.tif", "N46E008_EPSG21781_i16_rotated_nodata_edges.tif",
                             "N46E008_UTM32_feet_f32.tif"}) {
        const auto other = opened(resampled_from({real_data(std::string("geotiff/") + name)->string()}));
        ASSERT_TRUE(other) << name;
        double sum = 0.0, squares = 0.0, most = 0.0;
        int count = 0;
        const PostGrid& grid = other->field.grid;
        constexpr double margin_deg = 0.02;
        for (int r = 0; r < grid.rows(); ++r) {
            const double lat = grid.lat.at_deg(r);
            if (lat < 46.0 + margin_deg || lat > 47.0 - margin_deg) continue;
            for (int c = 0; c < grid.columns(); ++c) {
                const double lon = grid.lon.at_deg(c);
                if (lon < 8.0 + margin_deg || lon > 9.0 - margin_deg) continue;
                const float a = truth->field.H_at_m(lat, lon);
                const float b = other->field.H_at_post_m(r, c);
                if (is_void(a) || is_void(b)) continue;
                const double difference = static_cast<double>(b) - static_cast<double>(a);
                sum += difference;
                squares += difference * difference;
                most = std::max(most, std::abs(difference));
                ++count;
            }
        }
        const double rms = std::sqrt(squares / count), mean = sum / count;
        std::printf("%-50s %9d %8.2f %9.3f %8.1f\n", name, count, rms, mean, most);
        EXPECT_GT(count, 300000) << name;
        EXPECT_LE(rms, 5.0) << name;
        EXPECT_LT(std::abs(mean), 0.3) << name;
    }
}

}  // namespace
}  // namespace oro
