// The range of a file's own values, against GDAL's for the same file (what gdalinfo -mm prints).
#include "geo/measures/stored_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "geo/files/raster_library.h"
#include "geo/files/source_paths.h"
#include "geo/sources/raster_source.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

// Lowest and highest in metres. What this program registers of GDAL's drivers lacks that of .hgt: gdalinfo is
// asked for these, which hold whole metres.
std::optional<std::pair<double, double>> by_gdal(const SourcePath& path, double metres) {
    std::array<double, 2> range{};
    if (path.hgt) {
        // Else it writes FILE.gz.properties beside the file.
        const std::string command =
            "CPL_VSIL_GZIP_WRITE_PROPERTIES=NO gdalinfo -mm '" + path.file + "' 2>/dev/null";
        FILE* const out = popen(command.c_str(), "r");
        std::array<char, 4096> line{};
        bool found = false;
        while (out && std::fgets(line.data(), line.size(), out))
            found = found || std::sscanf(line.data(), " Computed Min/Max=%lf,%lf", &range[0], &range[1]) == 2;
        if (out) pclose(out);
        return found ? std::optional(std::pair{range[0], range[1]}) : std::nullopt;
    }
    const Dataset dataset(GDALOpen(path.file.c_str(), GA_ReadOnly));
    EXPECT_TRUE(dataset);
    const GDALRasterBandH band = GDALGetRasterBand(dataset.get(), 1);
    GDALComputeRasterMinMax(band, 0, range.data());
    int scaled = 0, shifted = 0;
    const double scale = GDALGetRasterScale(band, &scaled), offset = GDALGetRasterOffset(band, &shifted);
    const auto metre = [&](double value) {
        return (value * (scaled ? scale : 1.0) + (shifted ? offset : 0.0)) * metres;
    };
    return std::pair{metre(range[0]), metre(range[1])};
}

TEST(StoredValues, OfAllRealFilesAreThoseOfGdal) {
    if (!real_data("geotiff") || !real_data("extremes")) GTEST_SKIP() << "needs geotiff, extremes";
    int files = 0;
    for (const char* folder : {"geotiff", "extremes", "himalaya", "alps"}) {
        const auto found = find_sources({real_data(folder)->string()});
        ASSERT_TRUE(found.ok()) << found.error().line();
        for (const SourcePath& path : *found) {
            SCOPED_TRACE(path.shown);
            RegionRequest request = request_for(
                {real_data(folder)->string() + "/" +
                 (path.archive.empty() ? path.shown.substr(path.shown.rfind('/') + 1) : path.archive)});
            // What these do not say themselves.
            if (path.name == "demcompare_dem_cm.tif") request.height_unit = "cm";
            if (path.name.ends_with(".bt")) request.source_crs = "EPSG:21781";
            std::string reason;
            const auto region = opened(request, &reason);
            ASSERT_TRUE(region) << reason;
            ASSERT_EQ(region->sources.size(), 1U);
            const auto& stored = region->sources[0].stored;
            ASSERT_TRUE(stored);
            EXPECT_TRUE(stored->whole);
            const double metres = metres_in(region->sources[0].height_unit.name).value_or(1.0);
            const auto gdal = by_gdal(path, metres);
            ASSERT_TRUE(gdal) << "gdalinfo says nothing of it";
            EXPECT_NEAR(stored->lowest_m, gdal->first, 1e-9 * std::abs(gdal->first));
            EXPECT_NEAR(stored->highest_m, gdal->second, 1e-9 * std::abs(gdal->second));
            std::printf("%-52s %9.1f .. %-9.1f H in the region %9.1f .. %.1f\n", path.name.c_str(),
                        stored->lowest_m, stored->highest_m, region->sources[0].lowest_m,
                        region->sources[0].highest_m);
            ++files;
        }
    }
    EXPECT_GE(files, 19 + 13 + 12 + 12);
}

TEST(StoredValues, ScaleOffsetAndUnitCountAndNoDataDoesNot) {
    Raster raster;
    raster.rows = raster.columns = 12;
    raster.type = GDT_Int16;
    raster.cell_corners = posts_from(8.0, 47.0, 1200.0);
    raster.scale = 0.1;
    raster.offset = 100.0;
    raster.unit = "ft";
    raster.no_data = -9999.0;
    const auto file = write_raster(scratch_folder() / "scaled.tif", raster,
                                   [](int r, int c) { return r == 0 ? -9999.0 : 10.0 * c + r; });
    const auto region = opened(request_for({file}));
    ASSERT_TRUE(region);
    EXPECT_NEAR(region->sources[0].stored->lowest_m, (0.1 * 1.0 + 100.0) * 0.3048, 1e-9);
    EXPECT_NEAR(region->sources[0].stored->highest_m, (0.1 * 121.0 + 100.0) * 0.3048, 1e-9);
    EXPECT_TRUE(region->sources[0].stored->whole);
}

// A value that no terrain has is stored all the same.
TEST(StoredValues, ImplausibleOnesAreTold) {
    Raster raster;
    raster.rows = raster.columns = 12;
    raster.cell_corners = posts_from(8.0, 47.0, 1200.0);
    const auto file = write_raster(scratch_folder() / "odd.tif", raster,
                                   [](int r, int c) { return r == 3 && c == 3 ? -32678.0 : 500.0 + r; });
    const auto region = opened(request_for({file}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->sources[0].stored->lowest_m, -32678.0);
    EXPECT_EQ(region->sources[0].lowest_m, 500.0);
    EXPECT_EQ(region->sources[0].implausible, 1U);
}

// Posts in windows by chance, counted one by one.
TEST(StoredValues, WindowsAreCountedOnce) {
    const unsigned seed = std::random_device{}();
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    constexpr int side = 30;
    const auto up_to = [&](int most) { return static_cast<int>(random() % static_cast<unsigned>(most + 1)); };
    for (int i = 0; i < 500; ++i) {
        std::vector<PostWindow> windows;
        std::vector<bool> seen(side * side);
        for (int w = up_to(5); w > 0; --w) {
            PostWindow window{up_to(side - 1), up_to(side - 1), 0, 0};
            window.rows = up_to(side - window.row);
            window.columns = up_to(side - window.column);
            windows.push_back(window);
            for (int r = window.row; r < window.row + window.rows; ++r)
                for (int c = window.column; c < window.column + window.columns; ++c)
                    seen[static_cast<std::size_t>(r * side + c)] = true;
        }
        EXPECT_EQ(posts_in(windows), static_cast<std::uint64_t>(std::ranges::count(seen, true)))
            << "seed " << seed;
    }
}

}  // namespace
}  // namespace oro
