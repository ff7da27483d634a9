#include "geo/datum/vertical_datum.h"

#include <gtest/gtest.h>
#include <proj.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "geo/sources/source.h"
#include "geo/sources/source_words.h"
#include "tests/geo/datum/proj_folder.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

// PROJ as a library of its own: what the program must agree with.
class PlainProj {
  public:
    PlainProj(const char* from, const char* to) : context_(proj_context_create()) {
        PJ* const crs = proj_create_crs_to_crs(context_, from, to, nullptr);
        operation_ = proj_normalize_for_visualization(context_, crs);
        proj_destroy(crs);
    }
    ~PlainProj() {
        proj_destroy(operation_);
        proj_context_destroy(context_);
    }
    PlainProj(const PlainProj&) = delete;
    PlainProj& operator=(const PlainProj&) = delete;
    [[nodiscard]] double height_m(double lat_deg, double lon_deg, double z) const {
        return proj_trans(operation_, PJ_FWD, proj_coord(lon_deg, lat_deg, z, 0)).xyzt.z;
    }

  private:
    PJ_CONTEXT* context_;
    PJ* operation_;
};

std::string write_flat(const fs::path& folder, const std::string& crs, double height, double west_deg = 7.95,
                       double north_deg = 46.55) {
    Raster raster;
    raster.rows = raster.columns = 11;
    raster.cell_corners = posts_from(west_deg, north_deg, 100.0);
    raster.crs = crs;
    return write_raster(folder / "flat.tif", raster, [=](int, int) { return height; });
}

double H_at_centre(const RegionGrid& region) {
    return static_cast<double>(region.field.H_at_m(46.5, 8.0));
}

TEST(Geoid, Egm96LiftsSrtmHeights) {
    const fs::path folder = scratch_folder();
    const auto region =
        opened(request_for({write_hgt(folder / "N46E008.hgt", 1201, [](int, int) { return 1000; })}));
    ASSERT_TRUE(region);
    // EPSG:4326+5773 to 4979 at 46.5 N 8 E with egm96_15.gtx (PROJ 9.1).
    EXPECT_NEAR(region->field.undulation.at_m(46.5, 8.0), 50.68, 0.02);
    EXPECT_NEAR(region->field.h_at_post_m(600, 0), 1050.68, 0.02);
    EXPECT_NE(region->geoid.find("EGM96"), std::string::npos);
    EXPECT_NE(region->geoid.find("egm96_15"), std::string::npos) << region->geoid;
    EXPECT_TRUE(region->notes.empty());
}

TEST(Geoid, UndulationIsExactlyWhatProjGives) {
    const auto geoid = GeoidOfRegion::open(true);
    ASSERT_TRUE(geoid.ok()) << geoid.error().line();
    const PlainProj proj("EPSG:4326+5773", "EPSG:4979");
    const unsigned seed = 96;
    std::mt19937 random(seed);
    double most = 0.0;
    for (const BoundingBox& box :
         {BoundingBox{8, 46, 9, 47}, BoundingBox{-180, -90, 180, 90}, BoundingBox{175, -20, 185, -15},
          BoundingBox{-84.41, 36.44, -84.07, 36.74}, BoundingBox{100, 88.3, 140, 90}}) {
        const auto asked = geoid->undulation(box);
        ASSERT_TRUE(asked.ok()) << asked.error().line();
        const UndulationField& field = *asked;
        std::uniform_real_distribution<double> lat(box.south_deg, box.north_deg),
            lon(box.west_deg, box.east_deg);
        for (int i = 0; i < 4000; ++i) {
            const double lat_deg = lat(random), lon_deg = lon(random);
            const double expected = proj.height_m(lat_deg, lon_deg > 180.0 ? lon_deg - 360.0 : lon_deg, 0.0);
            const double error = std::abs(field.at_m(lat_deg, lon_deg) - expected);
            most = std::max(most, error);
            ASSERT_LT(error, 1e-4) << lat_deg << " " << lon_deg << " seed " << seed;
        }
    }
    std::printf("N between nodes against PROJ: at most %.2g m\n", most);
}

TEST(VerticalDatum, NamesAndUnits) {
    EXPECT_FALSE(stated_datum("EPSG:4326").has_value());
    EXPECT_FALSE(stated_datum("EPSG:32632").has_value());
    EXPECT_FALSE(stated_datum("not a CRS").has_value());
    EXPECT_EQ(stated_datum("EPSG:4326+5773")->name, "EPSG:5773 EGM96 height");
    EXPECT_EQ(stated_datum("EPSG:32632+3855")->name, "EPSG:3855 EGM2008 height");
    EXPECT_NE(stated_datum("EPSG:4979")->name.find("ellipsoidal"), std::string::npos);
    EXPECT_NEAR(stated_datum("EPSG:4269+6360")->metres_per_unit, 1200.0 / 3937.0,
                1e-12);                                                // NAVD88 height (ftUS)
    EXPECT_EQ(stated_datum("EPSG:4326+5715")->metres_per_unit, -1.0);  // MSL depth
}

TEST(VerticalDatum, StatedEgm96IsTakenAsItIs) {
    RegionRequest request = request_for({write_flat(scratch_folder(), "EPSG:4326+5773", 1000.0)});
    request.strict_datum = true;
    std::string reason;
    const auto region = opened(request, &reason);
    ASSERT_TRUE(region) << reason;
    EXPECT_EQ(H_at_centre(*region), 1000.0);
    EXPECT_EQ(datum_words(region->sources[0].vertical_datum), "EPSG:5773 EGM96 height");
    EXPECT_EQ(placement_words(region->sources[0]), "posts copied");
    EXPECT_TRUE(region->notes.empty());
}

TEST(VerticalDatum, EllipsoidalHeightsLoseTheUndulation) {
    const fs::path folder = scratch_folder();
    for (const char* crs : {"EPSG:4979", "EPSG:4937"}) {  // WGS84 and ETRS89, three axes
        RegionRequest request = request_for({write_flat(folder, crs, 1050.68)});
        request.strict_datum = true;
        std::string reason;
        const auto region = opened(request, &reason);
        ASSERT_TRUE(region) << crs << ": " << reason;
        EXPECT_NEAR(H_at_centre(*region), 1000.0, 0.02) << crs;
        EXPECT_NE(datum_words(region->sources[0].vertical_datum).find("ellipsoidal"), std::string::npos);
        fs::remove(folder / "flat.tif");
    }
}

// WGS84 with heights in feet: three axes, latitude and longitude or UTM.
std::string three_axes_in_feet(bool projected) {
    const std::string axis_ft = "AXIS[\"ellipsoidal height (h)\",up,ORDER[3],LENGTHUNIT[\"foot\",0.3048]]";
    const std::string datum =
        "[\"WGS 84 in feet\",DATUM[\"World Geodetic System 1984\",ELLIPSOID[\"WGS "
        "84\",6378137,298.257223563]],"
        "PRIMEM[\"Greenwich\",0]";
    const std::string degrees =
        "CS[ellipsoidal,3],AXIS[\"latitude\",north,ORDER[1],ANGLEUNIT[\"degree\",0.0174532925199433]],"
        "AXIS[\"longitude\",east,ORDER[2],ANGLEUNIT[\"degree\",0.0174532925199433]],";
    if (!projected) return "GEOGCRS" + datum + "," + degrees + axis_ft + "]";
    return "PROJCRS[\"UTM 32 in feet\",BASEGEOGCRS" + datum +
           "],CONVERSION[\"UTM zone 32N\",METHOD[\"Transverse Mercator\",ID[\"EPSG\",9807]],"
           "PARAMETER[\"Latitude of natural "
           "origin\",0,ANGLEUNIT[\"degree\",0.0174532925199433],ID[\"EPSG\",8801]],"
           "PARAMETER[\"Longitude of natural "
           "origin\",9,ANGLEUNIT[\"degree\",0.0174532925199433],ID[\"EPSG\",8802]],"
           "PARAMETER[\"Scale factor at natural origin\",0.9996,SCALEUNIT[\"unity\",1],ID[\"EPSG\",8805]],"
           "PARAMETER[\"False easting\",500000,LENGTHUNIT[\"metre\",1],ID[\"EPSG\",8806]],"
           "PARAMETER[\"False northing\",0,LENGTHUNIT[\"metre\",1],ID[\"EPSG\",8807]]],"
           "CS[Cartesian,3],AXIS[\"(E)\",east,ORDER[1],LENGTHUNIT[\"metre\",1]],"
           "AXIS[\"(N)\",north,ORDER[2],LENGTHUNIT[\"metre\",1]]," +
           axis_ft + "]";
}

// A VRT over data.tif beside it, with a CRS that GeoTIFF cannot hold.
std::string write_vrt(const fs::path& file, const Raster& raster, std::string crs) {
    for (std::size_t at = 0; (at = crs.find('"', at)) != std::string::npos;) crs.replace(at, 1, "&quot;");
    std::ofstream vrt(file);
    vrt.precision(17);
    vrt << "<VRTDataset rasterXSize=\"" << raster.columns << "\" rasterYSize=\"" << raster.rows
        << "\"><SRS dataAxisToSRSAxisMapping=\"2,1,3\">" << crs << "</SRS><GeoTransform>";
    for (std::size_t i = 0; i < 6; ++i) vrt << (i > 0 ? "," : "") << raster.cell_corners[i];
    vrt << "</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"><UnitType>" << raster.unit
        << "</UnitType><SimpleSource><SourceFilename relativeToVRT=\"1\">data.tif</SourceFilename>"
           "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>";
    return file.string();
}

TEST(VerticalDatum, HeightsInFeetOfThreeAxesAreConvertedOnce) {
    const fs::path folder = scratch_folder();
    Raster raster;
    raster.rows = raster.columns = 21;
    raster.crs = "";
    for (const bool projected : {false, true}) {
        raster.cell_corners = projected ? std::array{419000.0, 500.0, 0.0, 5155000.0, 0.0, -500.0}
                                        : posts_from(7.9, 46.6, 100.0);
        for (const char* unit : {"", "ft", "m"}) {
            raster.unit = unit;
            for (const double stored : {3000.0, 12000.0, 29000.0}) {
                const double h_m = stored * (std::string(unit) == "m" ? 1.0 : 0.3048);
                if (h_m > highest_plausible_m) continue;
                write_raster(folder / "data.tif", raster, [=](int, int) { return stored; });
                const std::string file =
                    write_vrt(folder / "feet.vrt", raster, three_axes_in_feet(projected));
                RegionRequest request = request_for({file});
                request.strict_datum = true;
                std::string reason;
                const auto region = opened(request, &reason);
                ASSERT_TRUE(region) << projected << unit << stored << ": " << reason;
                EXPECT_EQ(region->sources[0].implausible, 0U) << projected << unit << stored;
                EXPECT_NEAR(H_at_centre(*region), h_m - region->field.undulation.at_m(46.5, 8.0), 0.01)
                    << projected << " '" << unit << "' " << stored << ", "
                    << unit_words(region->sources[0].height_unit);
                EXPECT_NE(datum_words(region->sources[0].vertical_datum).find("ellipsoidal"),
                          std::string::npos);
                fs::remove(file);
            }
        }
    }
}

TEST(VerticalDatum, AGridThatProjLacksIsNamedAndStrictRefuses) {
    const fs::path folder = scratch_folder();
    fs::create_symlink(*proj_file("proj.db"), folder / "proj.db");
    fs::create_symlink(*proj_file("egm96_15.gtx"), folder / "egm96_15.gtx");
    const ProjFolder only(folder.string());
    struct Case {
        const char* crs;
        const char* datum;
        const char* grid;
        double lat_deg, lon_deg;
        const char* off_by;
        std::size_t notes;  // NAD83 has one of its own
    };
    for (const Case& c : {Case{"EPSG:4326+3855", "EGM2008", "us_nga_egm08_25.tif", 46.5, 8.0,
                               "0.5 m (RMS) and at most about 10 m from EGM2008 over the whole Earth", 1},
                          Case{"EPSG:4269+5703", "NAVD88", "us_noaa_g", 40.5, -105.0, "not known here", 2}}) {
        RegionRequest request =
            request_for({write_flat(folder, c.crs, 1000.0, c.lon_deg - 0.05, c.lat_deg + 0.05)});
        const auto region = opened(request);
        ASSERT_TRUE(region) << c.crs;
        EXPECT_EQ(region->field.H_at_m(c.lat_deg, c.lon_deg), 1000.0F)
            << "EGM96 stands in: heights stay, lifted by its N";
        ASSERT_EQ(region->notes.size(), c.notes);
        const std::string& note = region->notes.back();
        for (const char* said : {c.grid, c.datum, "EGM96 stands in", c.off_by})
            EXPECT_NE(note.find(said), std::string::npos) << note;
        EXPECT_NE(datum_words(region->sources[0].vertical_datum).find(c.datum), std::string::npos);
        request.strict_datum = true;
        const auto strict = test::open_grid(request);
        ASSERT_FALSE(strict.ok()) << c.crs;
        EXPECT_NE(strict.error().line().find("flat.tif"), std::string::npos) << strict.error().line();
        EXPECT_NE(strict.error().line().find(c.grid), std::string::npos) << strict.error().line();
        fs::remove(folder / "flat.tif");
    }
}

TEST(VerticalDatum, WithoutEgm96NothingIsHidden) {
    const fs::path folder = scratch_folder();
    fs::create_symlink(*proj_file("proj.db"), folder / "proj.db");
    RegionRequest request =
        request_for({write_hgt(folder / "N46E008.hgt", 1201, [](int, int) { return 1000; })});
    const ProjFolder only(folder.string());
    const auto region = opened(request);
    ASSERT_TRUE(region);
    EXPECT_EQ(region->field.undulation.at_m(46.5, 8.5), 0.0);
    EXPECT_NE(region->geoid.find("N = 0"), std::string::npos) << region->geoid;
    ASSERT_EQ(region->notes.size(), 1U);
    EXPECT_NE(region->notes[0].find("egm96_15"), std::string::npos) << region->notes[0];
    request.strict_datum = true;
    const auto strict = test::open_grid(request);
    ASSERT_FALSE(strict.ok());
    EXPECT_NE(strict.error().line().find("egm96_15"), std::string::npos) << strict.error().line();
}

TEST(VerticalDatum, WithoutProjsDatabaseThereIsANoteAndNoChatter) {
    const fs::path folder = scratch_folder();
    const RegionRequest request =
        request_for({write_hgt(folder / "N46E008.hgt", 1201, [](int, int) { return 1000; })});
    const ProjFolder only(folder.string());
    testing::internal::CaptureStderr();
    const auto region = opened(request);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    ASSERT_TRUE(region);
    ASSERT_EQ(region->notes.size(), 1U);
    EXPECT_NE(region->notes[0].find("proj-data"), std::string::npos) << region->notes[0];
}

TEST(VerticalDatum, DepthsAndForeignUnits) {
    const fs::path folder = scratch_folder();
    // NAVD88 in US survey feet: PROJ's grids for it are missing, the unit must hold all the same.
    auto region = opened(request_for({write_flat(folder, "EPSG:4269+6360", 3937.0)}));
    ASSERT_TRUE(region);
    EXPECT_NEAR(H_at_centre(*region), 1200.0, 1e-3);
    fs::remove(folder / "flat.tif");
    // Depth below mean sea level grows downwards.
    region = opened(request_for({write_flat(folder, "EPSG:4326+5715", 4000.0)}));
    ASSERT_TRUE(region);
    EXPECT_NEAR(H_at_centre(*region), -4000.0, 1e-3);
}

// With the EGM2008 grid (a clip over the Alps under the name that PROJ looks for) heights move by the two
// geoids' difference.
TEST(VerticalDatum, RealEgm2008GridIsUsedWhereItIsThere) {
    const auto clip = real_data("geoid/us_nga_egm2008_1_clipAlps.tif");
    if (!clip) GTEST_SKIP() << "needs geoid/us_nga_egm2008_1_clipAlps.tif";
    const fs::path folder = scratch_folder();
    fs::create_symlink(*proj_file("proj.db"), folder / "proj.db");
    fs::create_symlink(*proj_file("egm96_15.gtx"), folder / "egm96_15.gtx");
    fs::create_symlink(*clip, folder / "us_nga_egm08_25.tif");
    const ProjFolder only(folder.string());
    RegionRequest request = request_for({write_flat(folder, "EPSG:4326+3855", 1000.0)});
    request.strict_datum = true;
    std::string reason;
    const auto region = opened(request, &reason);
    ASSERT_TRUE(region) << reason;
    EXPECT_TRUE(region->notes.empty());
    const double N2008 = PlainProj("EPSG:4326+3855", "EPSG:4979").height_m(46.5, 8.0, 0.0);
    EXPECT_GT(N2008, 45.0);
    EXPECT_NEAR(H_at_centre(*region), 1000.0 + N2008 - region->field.undulation.at_m(46.5, 8.0), 1e-3);
    std::printf("EGM2008 %.3f m, EGM96 %.3f m at 46.5 N 8 E\n", N2008,
                region->field.undulation.at_m(46.5, 8.0));
}

TEST(VerticalDatum, RealDtedMetadataIsHonoured) {
    const auto copernicus = real_data("geotiff/demcompare_Copernicus_DSM_10_N45_00_E005_00_DEM.tif");
    if (!copernicus) GTEST_SKIP() << "needs geotiff";
    const auto region = opened(request_for({copernicus->string()}));
    ASSERT_TRUE(region);
    EXPECT_NE(datum_words(region->sources[0].vertical_datum).find("EGM2008"), std::string::npos);
    const auto nfong = opened(request_for({real_data("geotiff/nfong_N46E008.tif")->string()}));
    ASSERT_TRUE(nfong);
    EXPECT_NE(datum_words(nfong->sources[0].vertical_datum).find("EGM96"), std::string::npos);
    EXPECT_EQ(datum_words(nfong->sources[0].vertical_datum).find("assumed"), std::string::npos);
    EXPECT_TRUE(nfong->notes.empty());
}

}  // namespace
}  // namespace oro
