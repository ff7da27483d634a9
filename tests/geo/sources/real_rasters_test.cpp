// Rasters of the real collection beside the repository.
#include "geo/sources/raster_source.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

#include "geo/sources/source_words.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

// Every file of the real collection opens, or is refused for the right reason.
TEST(Raster, RealCollection) {
    const auto folder = real_data("geotiff");
    if (!folder) GTEST_SKIP() << "needs geotiff";
    struct Case {
        const char* file;
        const char* height_unit;
        double lowest, highest, tolerance;  // of the data's README, after units; resampling moves extremes
    };
    for (const Case& c :
         {Case{"alpinemaps_at_mgi.tif", "", 100, 3794.5, 60},
          Case{"antarctica_etopo1_EPSG3031_20km.tif", "", -5529.4, 4066.7, 60},
          Case{"demcompare_Copernicus_DSM_10_N45_00_E005_00_DEM.tif", "", 136, 2854, 0},
          Case{"demcompare_dem_cm.tif", "cm", -104.2, -4.2, 50},
          Case{"fiji_antimeridian_etopo1_170_190.tif", "", -5781.4, -615.3, 0.1},
          Case{"jonnyhuck_data.tif", "", 10.3, 972.7, 10}, Case{"linz_DEM_BY23.tif", "", 28.39, 34.42, 0.5},
          Case{"nfong_N46E008.tif", "", 187, 4173, 0}, Case{"nfong_S33W071.tif", "", 250, 6929, 0},
          Case{"oggm_dem.tif", "", 816.4, 3996.2, 10}, Case{"qgis_srtm_41_19.tif", "", 0, 1699, 41},
          Case{"shareloc_N44E005_big_hole.tif", "", 32, 1000, 0},
          Case{"topopyscale_davos_SRTM1.tif", "", 556, 3373, 0},
          Case{"vavilov_EPSG3413_f32.tif", "", 1, 711.3, 1},
          Case{"wwj_craterlake-elev-16bit-30m.tif", "", 1289, 1880, 0},
          Case{"N46E008_UTM32_feet_f32.tif", "", 190.7, 4108.8, 10},
          Case{"N46E008_EPSG2056_f32_cog.tif", "", 431, 4107.9, 25},
          Case{"N46E008_EPSG21781_i16_rotated_nodata_edges.tif", "", 190, 4114, 25}}) {
        RegionRequest request = request_for({(*folder / c.file).string()});
        request.height_unit = c.height_unit;
        std::string reason;
        const auto region = opened(request, &reason);
        ASSERT_TRUE(region) << c.file << ": " << reason;
        const HeightRange range = height_range(region->field);
        EXPECT_NEAR(static_cast<double>(range.lowest_m), c.lowest, c.tolerance + 0.05) << c.file;
        EXPECT_NEAR(static_cast<double>(range.highest_m), c.highest, c.tolerance + 0.05) << c.file;
        std::printf("%-50s %5d x %-5d %s\n", c.file, region->field.grid.rows(), region->field.grid.columns(),
                    placement_words(region->sources[0]).c_str());
    }
    const auto swiss = test::open_grid(request_for({(*folder / "dhm25_25_matrix.bt").string()}));
    ASSERT_FALSE(swiss.ok());
    EXPECT_NE(swiss.error().line().find("coordinate reference system"), std::string::npos)
        << swiss.error().line();
}

TEST(Raster, RealImagesAreRefused) {
    const auto image = real_data("drape/osgearth_world.tif");
    if (!image) GTEST_SKIP() << "needs drape/osgearth_world.tif";
    const auto region = test::open_grid(request_for({image->string()}));
    ASSERT_FALSE(region.ok());
    EXPECT_NE(region.error().line().find("3 bands"), std::string::npos);
}

}  // namespace
}  // namespace oro
