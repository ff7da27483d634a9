// Boxes cut out of rasters that go round the Earth, wherever these begin: every post is the raster's own.
#include <gtest/gtest.h>

#include <cmath>

#include "geo/sources/source_words.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

constexpr double north_deg = 30.0;

// No two posts within 360 columns and 41 rows are alike.
double height_at(int row, int column) {
    return 5.0 * (column % 360) + 0.1 * row;
}

// A degree a post, from 30 N to 10 S, the first column at `west_deg`.
std::string write_world(const fs::path& file, double west_deg, int columns = 360) {
    Raster raster;
    raster.rows = 41;
    raster.columns = columns;
    raster.cell_corners = posts_from(west_deg, north_deg, 1.0);
    return write_raster(file, raster, height_at);
}

// Every post of the region against the pixel that GDAL reads there.
void expect_pixels(const std::string& file, double west_deg, const RegionGrid& region) {
    const GDALDatasetH dataset = GDALOpen(file.c_str(), GA_ReadOnly);
    ASSERT_TRUE(dataset);
    const PostGrid& grid = region.field.grid;
    int wrong = 0;
    for (int r = 0; r < grid.rows(); ++r) {
        for (int c = 0; c < grid.columns(); ++c) {
            const double column = std::fmod(grid.lon.at_deg(c) - west_deg + 720.0, 360.0);
            const double row = north_deg - grid.lat.at_deg(r);
            if (std::abs(column - std::round(column)) > 1e-9 || std::abs(row - std::round(row)) > 1e-9)
                continue;
            float expected = 0.0F;
            ASSERT_EQ(GDALRasterIO(
                          GDALGetRasterBand(dataset, 1), GF_Read, static_cast<int>(std::lround(column)) % 360,
                          static_cast<int>(std::lround(row)), 1, 1, &expected, 1, 1, GDT_Float32, 0, 0),
                      CE_None);
            if (region.field.H_at_post_m(r, c) == expected) continue;
            if (++wrong <= 3)
                ADD_FAILURE() << grid.lat.at_deg(r) << "," << grid.lon.at_deg(c) << ": "
                              << region.field.H_at_post_m(r, c) << " for " << expected;
        }
    }
    EXPECT_EQ(wrong, 0);
    GDALClose(dataset);
}

constexpr std::array<double, 9> begins_deg{0.0, 0.5, -180.0, -179.5, 20.0, 20.5, 180.0, -340.0, 179.5};
const std::array<BoundingBox, 9> boxes{BoundingBox{-30, 10, -10, 20},
                                       {-10, 10, 10, 20},
                                       {170, 10, -170, 20},
                                       {10, 10, 30, 20},
                                       {190 - 360, 0, -100, 20},
                                       {-180, -5, 180, 20},
                                       {179.9, 10, -179.9, 20},
                                       {-0.1, 10, 0.1, 20},
                                       {5, 10, -5, 20}};

TEST(WorldBox, EveryPartOfEveryWorldIsTheRastersOwn) {
    const fs::path folder = scratch_folder();
    for (const double west_deg : begins_deg) {
        for (const int columns : {360, 361}) {
            const std::string file = write_world(folder / "world.tif", west_deg, columns);
            for (const BoundingBox& box : boxes) {
                SCOPED_TRACE(std::to_string(west_deg) + " x " + std::to_string(columns) + " box " +
                             std::to_string(box.west_deg) + " .. " + std::to_string(box.east_deg));
                RegionRequest request = request_for({file});
                request.box = box;
                std::string reason;
                const auto region = opened(request, &reason);
                EXPECT_TRUE(region) << reason;
                if (!region) continue;
                EXPECT_EQ(region->voids, 0U);
                EXPECT_TRUE(region->missing_cells.empty());
                const PostGrid& grid = region->field.grid;
                const double east_deg = box.east_deg + (box.west_deg > box.east_deg ? 360.0 : 0.0);
                EXPECT_TRUE(grid.wraps_longitude() ||
                            (grid.west_deg() <= box.west_deg && grid.east_deg() >= east_deg))
                    << grid.west_deg() << " .. " << grid.east_deg();
                EXPECT_EQ(placement_words(region->sources[0]), "posts copied");
                expect_pixels(file, west_deg, *region);
            }
            fs::remove(file);
        }
    }
}

TEST(WorldBox, BesideAnotherSourceNothingIsLost) {
    const fs::path folder = scratch_folder();
    for (const double west_deg : begins_deg) {
        const std::string world = write_world(folder / "world.tif", west_deg);
        // A patch with the world's spacing and one four times as fine, which hold what the world holds there.
        for (const double per_deg : {1.0, 4.0}) {
            Raster raster;
            raster.rows = raster.columns = 9;
            const double patch_west_deg = std::floor(-25.0) + west_deg - std::floor(west_deg);
            raster.cell_corners = posts_from(patch_west_deg, 18.0, per_deg);
            const std::string patch =
                write_raster(folder / "a.tif", raster, [&](int, int) { return 7000.0; });
            for (const BoundingBox& box : boxes) {
                SCOPED_TRACE(std::to_string(west_deg) + " beside " + std::to_string(per_deg) + " box " +
                             std::to_string(box.west_deg) + " .. " + std::to_string(box.east_deg));
                RegionRequest request = request_for({world, patch});
                request.box = box;
                std::string reason;
                const auto region = opened(request, &reason);
                EXPECT_TRUE(region) << reason;
                if (!region) continue;
                EXPECT_EQ(region->voids, 0U);
                int posts = 0, wrong = 0;
                const PostGrid& grid = region->field.grid;
                for (int r = 0; r < grid.rows(); ++r) {
                    for (int c = 0; c < grid.columns(); ++c) {
                        const double column = std::fmod(grid.lon.at_deg(c) - west_deg + 720.0, 360.0);
                        const double row = north_deg - grid.lat.at_deg(r);
                        if (column != std::round(column) || row != std::round(row)) continue;
                        const double H_m = static_cast<double>(region->field.H_at_post_m(r, c));
                        const double due_m = height_at(static_cast<int>(row), static_cast<int>(column));
                        ++posts;
                        wrong += H_m != 7000.0 && std::abs(H_m - due_m) > 1e-3;
                    }
                }
                EXPECT_GT(posts, 0);
                EXPECT_EQ(wrong, 0) << "of " << posts;
            }
            fs::remove(patch);
        }
        fs::remove(world);
    }
}

// Rasters of cells whose posts are a spacing apart: the surface goes over the seam, and so do boxes.
TEST(NarrowBox, BetweenTheLastPostsOfTwoRastersIsInsideTheSurface) {
    const fs::path folder = scratch_folder();
    struct Seam {
        double west_deg;  // first post of the western raster
        double east_deg;  // of the eastern
        BoundingBox box;
    };
    for (const Seam& seam :
         {Seam{170.5, -179.5, {179.9, 10, -179.9, 10.1}}, Seam{170.5, -179.5, {179.6, 10.2, 179.8, 10.3}},
          Seam{0.5, 10.5, {9.9, 10, 10.1, 10.1}}, Seam{0.5, 10.5, {9.6, 10.2, 9.8, 10.3}},
          Seam{0.5, 10.5, {5, 12, 9.8, 13}}, Seam{170.5, -179.5, {-179.9, 12, -175, 13}}}) {
        Raster raster;
        raster.rows = 21;
        raster.columns = 10;
        std::vector<std::string> files;
        for (const double west_deg : {seam.west_deg, seam.east_deg}) {
            raster.cell_corners = posts_from(west_deg, 20.5, 1.0);
            files.push_back(write_raster(folder / (std::to_string(west_deg) + ".tif"), raster,
                                         [&](int r, int c) { return west_deg + 100.0 + c + 20.0 * r; }));
        }
        RegionRequest request = request_for(files);
        request.box = seam.box;
        std::string reason;
        const auto region = opened(request, &reason);
        ASSERT_TRUE(region) << seam.box.west_deg << ": " << reason;
        EXPECT_EQ(region->voids, 0U);
        const double width_deg = std::remainder(seam.box.east_deg - seam.box.west_deg, 360.0);
        const auto H_m = region->field.surface_H_m(0.5 * (seam.box.south_deg + seam.box.north_deg),
                                                   seam.box.west_deg + 0.5 * width_deg);
        EXPECT_TRUE(H_m.has_value()) << seam.box.west_deg;
        EXPECT_GE(region->field.grid.column_at(seam.box.west_deg), -1e-9);
        EXPECT_LE(region->field.grid.column_at(seam.box.east_deg), region->field.grid.columns() - 1 + 1e-9);
        // One of the two alone ends at its last post, and a box beyond that has no data.
        if (std::abs(width_deg) > 1.0) continue;
        request.paths.pop_back();
        const auto alone = test::open_grid(request);
        ASSERT_FALSE(alone.ok());
        EXPECT_EQ(alone.error().kind, ErrorKind::no_data);
    }
}

}  // namespace
}  // namespace oro
