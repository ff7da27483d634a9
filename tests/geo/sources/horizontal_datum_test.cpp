// What horizontal datums are said to be good to. Accuracies are those of the EPSG dataset (v10.076), which
// PROJ's database holds; names of grids are PROJ's.
#include "geo/sources/horizontal_datum.h"

#include <gtest/gtest.h>

#include "geo/region/region_description.h"
#include "geo/sources/source_words.h"
#include "tests/geo/datum/proj_folder.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro::test {
namespace {

namespace fs = std::filesystem;

// 21 x 21 posts, 1/200 degree apart, around a place; the first of them half a cell inside.
std::string write_around(const fs::path& folder, const std::string& crs, double lat_deg, double lon_deg,
                         double epoch = 0.0) {
    Raster raster;
    raster.rows = raster.columns = 21;
    raster.cell_corners = posts_from(lon_deg - 0.05, lat_deg + 0.05, 200.0);
    raster.crs = crs;
    raster.epoch = epoch;
    return write_raster(folder / "around.tif", raster, [](int, int) { return 500.0; });
}

class HorizontalDatums : public testing::Test {
  protected:
    fs::path folder = scratch_folder();
    // PROJ with its database and EGM96, and without all grids for horizontal datums.
    void SetUp() override {
        for (const char* file : {"proj.db", "egm96_15.gtx"})
            if (const auto path = proj_file(file)) fs::create_symlink(*path, folder / file);
        OSRCleanup();  // GDAL keeps the folders that PROJ looked into before
    }
    void TearDown() override { OSRCleanup(); }
    RegionGrid region_of(const std::string& file) {
        std::string reason;
        const auto region = opened(request_for({file}), &reason);
        EXPECT_TRUE(region) << reason;
        return region ? *region : RegionGrid{};
    }
    std::string refusal_of(const std::string& file) {
        RegionRequest request = request_for({file});
        request.strict_datum = true;
        const auto region = test::open_grid(request);
        return region.ok() ? "" : region.error().line();
    }
};

TEST_F(HorizontalDatums, Wgs84SaysNothing) {
    for (const char* crs : {"EPSG:4326", "EPSG:4979"}) {
        const std::string file = write_around(folder, crs, 46.5, 8.0);
        const RegionGrid region = region_of(file);
        ASSERT_EQ(region.sources.size(), 1U);
        EXPECT_TRUE(region.sources[0].horizontal_datum.is_wgs84) << crs;
        EXPECT_EQ(horizontal_words(region.sources[0].horizontal_datum), "");
        EXPECT_TRUE(region.notes.empty()) << region.notes[0];
        EXPECT_EQ(refusal_of(file), "");
        fs::remove(file);
    }
}

// Found: at Meades Ranch, where NAD27 is tied to the ground, posts are 4.5 m off without the grid, and
// --strict-datum said nothing.
TEST_F(HorizontalDatums, Nad27LacksItsGrids) {
    const ProjFolder only(folder.string());
    const std::string file = write_around(folder, "EPSG:4267", 39.2240867, -98.5421517);
    const RegionGrid region = region_of(file);
    ASSERT_EQ(region.sources.size(), 1U);
    const HorizontalDatum& datum = region.sources[0].horizontal_datum;
    EXPECT_FALSE(datum.is_wgs84);
    EXPECT_EQ(datum.name, "EPSG:4267 NAD27");
    EXPECT_EQ(datum.operation, "NAD27 to WGS 84 (6)");
    EXPECT_EQ(datum.accuracy_m, 7.0);
    EXPECT_FALSE(datum.ballpark);
    EXPECT_FALSE(datum.unchanged);
    EXPECT_EQ(datum.missing_grids, (std::vector<std::string>{"us_noaa_conus.tif", "us_noaa_kshpgn.tif"}));
    EXPECT_EQ(datum.accuracy_with_grids_m, 1.5);
    const std::string words =
        "EPSG:4267 NAD27: within 7 m of WGS84, by NAD27 to WGS 84 (6); within 1.5 m with us_noaa_conus.tif "
        "and us_noaa_kshpgn.tif, which PROJ lacks";
    EXPECT_EQ(region.notes, std::vector<std::string>{words});
    EXPECT_NE(refusal_of(file).find("around.tif: horizontal datum " + words), std::string::npos)
        << refusal_of(file);
}

// Found: none of it was said.
TEST_F(HorizontalDatums, WhatCountsAsWgs84ByConvention) {
    const std::string file = write_around(folder, "EPSG:4258", 50.0, 10.0);
    const RegionGrid region = region_of(file);
    ASSERT_EQ(region.sources.size(), 1U);
    const HorizontalDatum& datum = region.sources[0].horizontal_datum;
    EXPECT_EQ(datum.operation, "ETRS89 to WGS 84 (1)");
    EXPECT_EQ(datum.accuracy_m, 1.0);
    EXPECT_TRUE(datum.unchanged);
    EXPECT_TRUE(datum.missing_grids.empty());
    EXPECT_EQ(region.notes, std::vector<std::string>{"EPSG:4258 ETRS89: taken as WGS84, within 1 to 2 m"});
    EXPECT_EQ(refusal_of(file), "") << "no grid makes it better";
}

// The same on a map: UTM zone 32 on ETRS89.
TEST_F(HorizontalDatums, MapsHaveTheDatumOfTheirDegrees) {
    Raster raster;
    raster.rows = raster.columns = 21;
    raster.cell_corners = {570000.0, 500.0, 0.0, 5545000.0, 0.0, -500.0};
    raster.crs = "EPSG:25832";
    const auto flat = [](int, int) { return 500.0; };
    const RegionGrid region = region_of(write_raster(folder / "map.tif", raster, flat));
    EXPECT_TRUE(region.sources.at(0).horizontal_datum.unchanged);
    EXPECT_EQ(region.notes, std::vector<std::string>{"EPSG:4258 ETRS89: taken as WGS84, within 1 to 2 m"});
    raster.crs = "EPSG:32632";
    EXPECT_TRUE(region_of(write_raster(folder / "wgs84.tif", raster, flat)).notes.empty());
}

// EPSG's null operation states 4 m; with a grid of the state it would be 2 m, which is what is known anyway.
TEST_F(HorizontalDatums, Nad83IsKnownBetterThanItsOperationStates) {
    const std::string file = write_around(folder, "EPSG:4269", 36.5, -84.2);
    const RegionGrid region = region_of(file);
    const HorizontalDatum& datum = region.sources.at(0).horizontal_datum;
    EXPECT_EQ(datum.operation, "NAD83 to WGS 84 (1)");
    EXPECT_EQ(datum.accuracy_m, 4.0);
    EXPECT_TRUE(datum.unchanged);
    EXPECT_EQ(region.notes, std::vector<std::string>{"EPSG:4269 NAD83: taken as WGS84, within 1 to 2 m"});
    EXPECT_EQ(refusal_of(file), "");
}

TEST_F(HorizontalDatums, DhdnWithAndWithoutItsGrid) {
    const std::string file = write_around(folder, "EPSG:4314", 50.0, 10.0);
    {
        const ProjFolder only(folder.string());
        const RegionGrid region = region_of(file);
        const HorizontalDatum& datum = region.sources.at(0).horizontal_datum;
        EXPECT_EQ(datum.operation, "DHDN to WGS 84 (2)");
        EXPECT_EQ(datum.accuracy_m, 3.0);
        EXPECT_EQ(datum.missing_grids, std::vector<std::string>{"de_adv_BETA2007.tif"});
        EXPECT_EQ(datum.accuracy_with_grids_m, 1.0);
        EXPECT_NE(refusal_of(file).find("de_adv_BETA2007.tif"), std::string::npos) << refusal_of(file);
    }
    if (!proj_file("BETA2007.gsb")) GTEST_SKIP() << "needs BETA2007.gsb of proj-data";
    OSRCleanup();
    const RegionGrid region = region_of(file);
    const HorizontalDatum& datum = region.sources.at(0).horizontal_datum;
    EXPECT_EQ(datum.operation, "DHDN to WGS 84 (4)");
    EXPECT_EQ(datum.accuracy_m, 1.0);
    EXPECT_TRUE(datum.missing_grids.empty());
    // Found: such a file was resampled, because of the kinks between nodes of a grid of shifts.
    EXPECT_TRUE(region.field.grid.net);
    EXPECT_EQ(region.notes,
              std::vector<std::string>{"EPSG:4314 DHDN: within 1 m of WGS84, by DHDN to WGS 84 (4)"});
    EXPECT_EQ(refusal_of(file), "");
}

// A datum of the file's own making: nobody knows a way from it.
TEST_F(HorizontalDatums, BallparkIsRefused) {
    const std::string file =
        write_around(folder, "+proj=longlat +a=6378000 +b=6356000 +no_defs +type=crs", 46.5, 8.0);
    const RegionGrid region = region_of(file);
    const HorizontalDatum& datum = region.sources.at(0).horizontal_datum;
    EXPECT_TRUE(datum.ballpark);
    EXPECT_FALSE(datum.accuracy_m);
    ASSERT_EQ(region.notes.size(), 1U);
    EXPECT_NE(region.notes[0].find("ballpark"), std::string::npos) << region.notes[0];
    EXPECT_NE(refusal_of(file).find("ballpark"), std::string::npos) << refusal_of(file);
}

TEST_F(HorizontalDatums, DynamicDatumsAndEpochs) {
    for (const double epoch : {0.0, 2020.5}) {
        const std::string file = write_around(folder, "EPSG:9000", 46.5, 8.0, epoch);  // ITRF2014
        const RegionGrid region = region_of(file);
        const HorizontalDatum& datum = region.sources.at(0).horizontal_datum;
        EXPECT_EQ(datum.frame_epoch, 2010.0);
        EXPECT_EQ(datum.coordinate_epoch, epoch > 0.0 ? std::optional(epoch) : std::nullopt);
        const std::string words = horizontal_words(datum);
        EXPECT_NE(words.find("dynamic, reference epoch 2010"), std::string::npos) << words;
        EXPECT_NE(words.find(epoch > 0.0 ? "coordinates of epoch 2020.5" : "epoch is not stated"),
                  std::string::npos)
            << words;
        fs::remove(file);
    }
}

TEST_F(HorizontalDatums, ABakedRegionTellsTheSame) {
    const RegionGrid region = region_of(write_around(folder, "EPSG:4267", 39.2240867, -98.5421517));
    const std::string text = region_description(region);
    const auto read = region_from_description(text, "test");
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(region_description(*read), text);
    EXPECT_EQ(horizontal_words(read->sources.at(0).horizontal_datum),
              horizontal_words(region.sources.at(0).horizontal_datum));
}

}  // namespace
}  // namespace oro::test
