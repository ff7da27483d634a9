// What lies beside elevation data and is none does not become the ground: in folders as they are downloaded,
// beside what gdaldem makes, by names that say nothing, and named by itself.
#include "geo/opening/companions.h"

#include <gdal_utils.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geo/sources/source_words.h"
#include "tests/geo/datum/proj_folder.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

// Hills of 1750 to 2240 m, on latitudes and longitudes or on metres.
double hills_m(int r, int c) {
    return 1995.0 + 200.0 * std::sin(0.21 * r) * std::cos(0.17 * c) + 45.0 * std::sin(0.05 * r + 0.31 * c);
}

Raster on_degrees_near(double west_deg, double north_deg, GDALDataType type = GDT_Float32) {
    Raster raster;
    raster.rows = raster.columns = 60;
    raster.cell_corners = posts_from(west_deg, north_deg, 100.0);
    raster.type = type;
    return raster;
}

Raster on_metres(GDALDataType type = GDT_Float32) {
    Raster raster = on_degrees_near(0.0, 0.0, type);
    raster.cell_corners = {500000.0, 100.0, 0.0, 5000000.0, 0.0, -100.0};
    raster.crs = "EPSG:32632";
    return raster;
}

HeightRange range_of_folder(const fs::path& folder, std::vector<std::string>& notes) {
    std::string reason;
    const auto region = opened(request_for({folder.string()}), &reason);
    EXPECT_TRUE(region) << reason;
    if (!region) return {};
    notes = region->notes;
    EXPECT_EQ(region->sources.size(), 1U);
    return height_range(region->field);
}

std::string refusal_of(const std::vector<std::string>& paths) {
    const auto region = test::open_grid(request_for(paths));
    return region.ok() ? "" : region.error().line();
}

// Found: the radar amplitude of a TanDEM-X download was the ground, H 50 to 899 m.
TEST(Companions, OfATanDemXDownloadAreLeftOut) {
    const fs::path folder = scratch_folder();
    for (const char* part : {"AUXFILES", "DEM"}) fs::create_directory(folder / part);
    const std::string stem = "TDM1_DEM__30_N47E011_";
    write_raster(folder / "DEM" / (stem + "DEM.tif"), on_degrees_near(11.0, 48.0), hills_m);
    const auto aux = [&](const char* name, GDALDataType type, double low, double high) {
        write_raster(folder / "AUXFILES" / (stem + name + ".tif"), on_degrees_near(11.0, 48.0, type),
                     [=](int r, int c) { return low + std::fmod(7.0 * r + 13.0 * c, high - low); });
    };
    aux("AMP", GDT_UInt16, 50.0, 900.0);
    aux("AM2", GDT_UInt16, 50.0, 900.0);
    aux("COM", GDT_Byte, 1.0, 10.0);
    aux("COV", GDT_Byte, 1.0, 4.0);
    aux("HEM", GDT_Float32, 0.0, 3.0);
    std::vector<std::string> notes;
    const HeightRange range = range_of_folder(folder, notes);
    // Above the ellipsoid by definition: N of EGM96 is 46.5 to 47.8 m there.
    EXPECT_GT(range.lowest_m, 1700.0F);
    EXPECT_LT(range.highest_m, 2200.0F);
    ASSERT_EQ(notes_with(notes, "left out"), 1U);
    const auto note = std::ranges::find_if(
        notes, [](const std::string& one) { return one.find("left out") != std::string::npos; });
    for (const char* name : {"AMP.tif (holds radar amplitude", "AM2.tif", "COM.tif", "COV.tif", "HEM.tif"})
        EXPECT_NE(note->find(name), std::string::npos) << *note;
    EXPECT_EQ(notes_with(notes, "DEM.tif ("), 0U);
}

// Found: mask values filled the voids of AW3D30, and "void posts: none" was told.
TEST(Companions, DoNotFillVoids) {
    const fs::path folder = scratch_folder();
    Raster heights = on_degrees_near(11.0, 48.0, GDT_Int16);
    heights.no_data = -9999.0;
    write_raster(folder / "ALPSMLC30_N047E011_DSM.tif", heights,
                 [](int r, int c) { return r < 10 && c < 20 ? -9999.0 : std::round(hills_m(r, c)); });
    for (const char* name : {"ALPSMLC30_N047E011_MSK.tif", "ALPSMLC30_N047E011_STK.tif"})
        write_raster(folder / name, on_degrees_near(11.0, 48.0, GDT_Byte), [](int r, int) { return r; });
    const auto region = opened(request_for({folder.string()}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->void_posts(), 200U);
    EXPECT_EQ(datum_words(region->sources[0].vertical_datum), "EGM96 height, of AW3D30 (by its name)");
}

// Found: errors and masks that a browser or file manager had copied were the ground.
TEST(Companions, AreKnownByTheNamesOfTheirCopies) {
    const fs::path folder = scratch_folder();
    const std::string stem = "Copernicus_DSM_COG_10_N47_00_E011_00_";
    write_raster(folder / (stem + "DEM.tif"), on_degrees_near(11.0, 48.0), hills_m);
    const auto low = [](int r, int c) { return 0.5 + 0.05 * (r + c); };
    write_raster(folder / (stem + "HEM (1).tif"), on_degrees_near(11.0, 48.0), low);
    write_raster(folder / "survey.tif", on_degrees_near(12.0, 48.0), hills_m);
    write_raster(folder / "survey_error - Copy (2).tif", on_degrees_near(12.0, 48.0), low);
    const auto region = opened(request_for({folder.string()}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->sources.size(), 2U);
    EXPECT_EQ(notes_with(region->notes, "HEM (1).tif (holds height error of Copernicus DEM)"), 1U);
    EXPECT_EQ(notes_with(region->notes, "survey_error - Copy (2).tif (lies beside survey.tif"), 1U);
    // A name of heights says nothing of bytes.
    const auto bytes = opened(
        request_for({write_raster(scratch_folder() / (stem + "x.tif"), on_degrees_near(11.0, 48.0, GDT_Byte),
                                  [](int r, int) { return r; })}));
    ASSERT_TRUE(bytes);
    EXPECT_EQ(notes_with(bytes->notes, "whole numbers of 0 to 255"), 1U);
}

// Found: days since 2000 of REMA 1 were heights beside its own.
TEST(Companions, ThatContradictAFileCalledDemAreLeftOut) {
    for (const auto& [heights, other] : {std::pair{"45_18_8m_dem.tif", "45_18_8m_day.tif"},
                                         {"tile_dsm.tif", "tile_what.tif"},
                                         {"dtm.tif", "a.tif"}}) {
        const fs::path folder = scratch_folder();
        write_raster(folder / heights, on_degrees_near(11.0, 48.0), hills_m);
        write_raster(folder / other, on_degrees_near(11.0, 48.0, GDT_Int16),
                     [](int r, int c) { return hills_m(r, c) > 1995.0 ? 6361.0 : 6321.0; });
        std::vector<std::string> notes;
        EXPECT_LT(range_of_folder(folder, notes).highest_m, 2250.0F) << heights;
        EXPECT_EQ(notes_with(notes, std::string(other) + " ("), 1U) << other;
    }
}

// Found by their names alone: slopes in per cent, ruggedness of coarse posts, shaded relief.
TEST(Companions, OfWiderValuesAreRefusedByName) {
    const fs::path folder = scratch_folder();
    const auto wide = [](int r, int c) { return 0.1 * r * c; };
    for (const char* name : {"slope.tif", "x_slope_pct.tif", "tri.tif", "roughness.tif", "slope (1).tif"})
        EXPECT_NE(refusal_of({write_raster(folder / name, on_degrees_near(8.0, 47.0), wide)})
                      .find("by its name and its values from 0 to 3"),
                  std::string::npos)
            << name;
    const auto around_0 = [](int r, int c) { return 3.0 * (r - 30) + 0.1 * c; };
    EXPECT_NE(refusal_of({write_raster(folder / "tpi.tif", on_degrees_near(8.0, 47.0), around_0)})
                  .find("holds position beside its neighbours"),
              std::string::npos);
    const auto grey = [](int r, int c) { return 120 + r + c; };
    for (const char* name : {"hs.tif", "N46E008_shade_z2.tif"}) {
        EXPECT_NE(refusal_of({write_raster(folder / name, on_degrees_near(8.0, 47.0, GDT_Byte), grey)})
                      .find("holds a hillshade"),
                  std::string::npos)
            << name;
        EXPECT_EQ(refusal_of({write_raster(folder / name, on_degrees_near(8.0, 47.0), grey)}), "") << name;
    }
    // Heights of a mountain, of a valley floor, and of land at the sea that is called so.
    EXPECT_EQ(refusal_of({write_raster(folder / "north_slope.tif", on_degrees_near(8.0, 47.0), wide)}), "");
    EXPECT_EQ(refusal_of({write_raster(folder / "tri.tif", on_degrees_near(8.0, 47.0), hills_m)}), "");
    EXPECT_EQ(refusal_of({write_raster(folder / "east_slope.tif", on_degrees_near(8.0, 47.0),
                                       [](int r, int) { return 100.0 + r; })}),
              "");
}

// The same, made by GDAL's own program, under names that say nothing and names that do.
TEST(Companions, WhatGdaldemMakesIsLeftOut) {
    for (const bool metres : {true, false}) {
        for (const bool named_so : {true, false}) {
            SCOPED_TRACE(std::string(metres ? "metres" : "degrees") + (named_so ? ", words" : ", no words"));
            const fs::path folder = scratch_folder();
            const Raster raster = metres ? on_metres() : on_degrees_near(8.0, 47.0);
            const std::string dem = write_raster(folder / "m.tif", raster, hills_m);
            const Dataset source(GDALOpen(dem.c_str(), GA_ReadOnly));
            int made = 0;
            for (const char* kind : {"slope", "aspect", "hillshade", "TRI", "TPI", "roughness"}) {
                const fs::path file =
                    folder / (named_so ? std::string(kind) + ".tif"
                                       : std::string(1, static_cast<char>('a' + made)) + ".tif");
                const Dataset done(
                    GDALDEMProcessing(file.c_str(), source.get(), kind, nullptr, nullptr, nullptr));
                ASSERT_TRUE(done) << kind;
                ++made;
            }
            std::vector<std::string> notes;
            const HeightRange range = range_of_folder(folder, notes);
            EXPECT_GT(range.lowest_m, 1740.0F);
            EXPECT_LT(range.highest_m, 2250.0F);
            EXPECT_EQ(notes_with(notes, "left out"), 1U);
            EXPECT_EQ(notes_with(notes, named_so ? "hillshade.tif" : "c.tif"), 1U);
        }
    }
}

TEST(Companions, AreRefusedByThemselvesWithAReason) {
    const fs::path folder = scratch_folder();
    const std::string amplitude =
        write_raster(folder / "TDM1_DEM__30_N47E011_AMP.tif", on_degrees_near(11.0, 48.0),
                     [](int r, int c) { return 50 + r + c; });
    EXPECT_NE(refusal_of({amplitude}).find("AMP.tif: holds radar amplitude of TanDEM-X DEM, no elevation"),
              std::string::npos)
        << refusal_of({amplitude});
    const std::string slope = write_raster(folder / "dem_slope.tif", on_degrees_near(11.0, 48.0),
                                           [](int r, int c) { return (r + c) / 4.0; });
    EXPECT_NE(refusal_of({slope}).find("dem_slope.tif: holds slope"), std::string::npos)
        << refusal_of({slope});
    // Beside heights they are left out, also where the shell has named them all.
    const std::string dem =
        write_raster(folder / "TDM1_DEM__30_N47E011_DEM.tif", on_degrees_near(11.0, 48.0), hills_m);
    const auto all = opened(request_for({amplitude, dem, slope}));
    ASSERT_TRUE(all);
    EXPECT_EQ(all->sources.size(), 1U);
    EXPECT_EQ(notes_with(all->notes, "left out"), 1U);
    // A folder of companions alone says what they are.
    fs::remove(dem);
    EXPECT_NE(refusal_of({folder.string()}).find("no elevation"), std::string::npos);
}

TEST(Companions, HeightsAreNotTakenForOthers) {
    // Words of a name alone do not decide.
    const fs::path folder = scratch_folder();
    std::string reason;
    EXPECT_TRUE(
        opened(request_for({write_raster(folder / "north_slope.tif", on_degrees_near(8.0, 47.0), hills_m)}),
               &reason))
        << reason;
    // Low land in bytes, by itself: taken, with a note.
    const fs::path low = scratch_folder();
    const auto flat =
        opened(request_for({write_raster(low / "polder.tif", on_degrees_near(5.0, 53.0, GDT_Byte),
                                         [](int r, int c) { return (r + c) % 30; })}));
    ASSERT_TRUE(flat);
    EXPECT_EQ(notes_with(flat->notes, "whole numbers of 0 to 255"), 1U);
    EXPECT_EQ(height_range(flat->field).highest_m, 29.0F);
    // Tiles side by side, one of them low enough for bytes.
    write_raster(low / "hill.tif", on_degrees_near(5.6, 53.0), [](int r, int) { return 300 + r; });
    const auto tiles = opened(request_for({low.string()}));
    ASSERT_TRUE(tiles);
    EXPECT_EQ(tiles->sources.size(), 2U);
    // Two surveys of one ground are both heights.
    const fs::path twice = scratch_folder();
    write_raster(twice / "a.tif", on_degrees_near(8.0, 47.0), hills_m);
    write_raster(twice / "b.tif", on_degrees_near(8.0, 47.0),
                 [](int r, int c) { return hills_m(r, c) + 2.0; });
    const auto both = opened(request_for({twice.string()}));
    ASSERT_TRUE(both);
    EXPECT_EQ(both->sources.size(), 2U);
    EXPECT_EQ(notes_with(both->notes, "contradict"), 0U) << "2 m";
}

TEST(Companions, BytesOverHeightsAndWordsBesideThemAreLeftOut) {
    const fs::path folder = scratch_folder();
    write_hgt(folder / "N46E008.hgt", 1201, [](int r, int c) { return 1500 + (r + c) / 10; });
    write_raster(folder / "landuse.tif", on_degrees_near(8.2, 46.8, GDT_Byte), [](int r, int) { return r; });
    std::vector<std::string> notes;
    EXPECT_GE(range_of_folder(folder, notes).lowest_m, 1500.0F);
    EXPECT_EQ(notes_with(notes, "landuse.tif"), 1U);
    const fs::path other = scratch_folder();
    write_raster(other / "survey.tif", on_degrees_near(8.0, 47.0), hills_m);
    write_raster(other / "survey_uncertainty.tif", on_degrees_near(8.0, 47.0),
                 [](int r, int c) { return 0.01 * (r + c); });
    EXPECT_GE(range_of_folder(other, notes).lowest_m, 1740.0F);
    EXPECT_EQ(notes_with(notes, "survey_uncertainty.tif"), 1U);
}

// Found: that files contradict each other was told by `info` alone.
TEST(Companions, ContradictionsAreNotesOfTheRegion) {
    const auto some = [](int r, int c) { return 50.0 + std::fmod(7.0 * r + 13.0 * c, 850.0); };
    const fs::path folder = scratch_folder();
    write_raster(folder / "p.tif", on_degrees_near(8.0, 47.0), hills_m);
    write_raster(folder / "q.tif", on_degrees_near(8.0, 47.0, GDT_UInt16), some);
    auto region = opened(request_for({folder.string()}));
    ASSERT_TRUE(region);
    ASSERT_EQ(notes_with(region->notes, "contradict each other by more than 16 m"), 1U);
    EXPECT_EQ(notes_with(region->notes, "q.tif (3600 of 3600 shared posts)"), 1U) << region->notes[0];
    // On other posts of one grid, and on posts in metres, which are a grid of their own.
    for (const bool metres : {false, true}) {
        const fs::path other = scratch_folder();
        Raster coarser = metres ? on_metres() : on_degrees_near(8.0, 47.0);
        Raster finer = coarser;
        finer.type = GDT_UInt16;
        finer.cell_corners = metres ? std::array<double, 6>{500000.0, 77.0, 0.0, 5000000.0, 0.0, -77.0}
                                    : posts_from(8.0, 47.0, 130.0);
        write_raster(other / "p.tif", coarser, hills_m);
        write_raster(other / "q.tif", finer, some);
        RegionRequest request = request_for({other.string()});
        request.allow_multiple_grids = true;
        const auto grids = open_region(request);
        ASSERT_TRUE(grids.ok()) << grids.error().line();
        EXPECT_EQ(grids->grids.size(), metres ? 2U : 1U);
        EXPECT_EQ(notes_with(grids->grids[0].notes, "contradict each other by more than 16 m"), 1U) << metres;
    }
}

// Found: heights above the ellipsoid were read as EGM96: 46.5 m too high at 47.7 N 11.2 E.
TEST(ProductHeights, AreAboveWhatTheProductSaysUnlessTheFileOrTheUserSaysElse) {
    const auto flat = [](int, int) { return 1000.0; };
    const fs::path folder = scratch_folder();
    const std::string file =
        write_raster(folder / "TDM1_DEM__30_N47E011_DEM.tif", on_degrees_near(11.0, 48.0), flat);
    const auto H_m = [](const RegionRequest& request) {
        const auto region = opened(request);
        return region ? static_cast<double>(region->field.H_at_m(47.7, 11.2)) : 0.0;
    };
    RegionRequest request = request_for({file});
    const auto region = opened(request);
    ASSERT_TRUE(region);
    // N of EGM96 by PROJ 9.1 with egm96_15.gtx.
    EXPECT_NEAR(H_m(request), 1000.0 - 46.5, 0.1);
    EXPECT_EQ(datum_words(region->sources[0].vertical_datum),
              "ellipsoidal height (EPSG:4979 WGS 84), of TanDEM-X DEM (by its name)");
    request.source_vertical = "EPSG:5773";
    EXPECT_EQ(H_m(request), 1000.0);
    fs::remove(file);
    Raster stated = on_degrees_near(11.0, 48.0);
    stated.crs = "EPSG:4326+5773";
    write_raster(file, stated, flat);
    EXPECT_EQ(H_m(request_for({file})), 1000.0);
    // In a CRS of its own, too: ArcticDEM's.
    Raster polar = on_metres();
    polar.crs = "EPSG:3413";
    polar.cell_corners = {500000.0, 100.0, 0.0, -1500000.0, 0.0, -100.0};
    const auto arctic =
        opened(request_for({write_raster(scratch_folder() / "23_44_10m_v4.1_dem.tif", polar, flat)}));
    ASSERT_TRUE(arctic);
    const double N_m = arctic->field.N_at_post_m(30, 30);
    EXPECT_GT(std::abs(N_m), 5.0);
    EXPECT_NEAR(static_cast<double>(arctic->field.H_at_post_m(30, 30)), 1000.0 - N_m, 0.01);
}

TEST(ProductHeights, ThatLackTheirGridSaySo) {
    const fs::path folder = scratch_folder();
    const std::string file = write_raster(folder / "Copernicus_DSM_COG_10_N47_00_E011_00_DEM.tif",
                                          on_degrees_near(11.0, 48.0), [](int, int) { return 1000.0; });
    const fs::path grids = scratch_folder();
    fs::create_symlink(*proj_file("proj.db"), grids / "proj.db");
    fs::create_symlink(*proj_file("egm96_15.gtx"), grids / "egm96_15.gtx");
    const ProjFolder only(grids.string());
    RegionRequest request = request_for({file});
    const auto region = opened(request);
    ASSERT_TRUE(region);
    EXPECT_EQ(notes_with(region->notes, "us_nga_egm08_25.tif for EPSG:3855 EGM2008 height: EGM96 stands in"),
              1U);
    EXPECT_EQ(datum_words(region->sources[0].vertical_datum),
              "EPSG:3855 EGM2008 height, of Copernicus DEM (by its name); EGM96 stands in");
    request.strict_datum = true;
    EXPECT_NE(test::open_grid(request).ok(), true);
}

}  // namespace
}  // namespace oro
