#include "geo/sources/raster_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string_view>

#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

double relief_m(int row, int column) {
    return 500.0 + row + column;
}

Raster forty(const std::string& crs, double x, double y, double step) {
    Raster raster;
    raster.rows = raster.columns = 40;
    raster.crs = crs;
    raster.cell_corners = {x, step, 0.0, y, 0.0, -step};
    return raster;
}

TEST(PlaceDoubts, DegreesUnderACrsOfMetresAreRefused) {
    const fs::path folder = scratch_folder();
    struct Case {
        const char* crs;
        double x, y, step;
    };
    for (const Case& c : {Case{"EPSG:32632", 10.0, 46.0, 0.01},
                          {"EPSG:3857", 10.0, 46.0, 0.01},
                          {"EPSG:2056", 8.0, 46.9, 1.0 / 1200.0},
                          {"EPSG:32632", 8.0, 47.0, 1.0},
                          {"EPSG:32718", -71.0, -33.0, 1.0 / 3600.0},
                          {"EPSG:2056+5728", 8.0, 46.9, 1.0 / 1200.0},
                          {"EPSG:2056+5728", 46.0, 8.1, 1.0 / 1200.0},
                          {"EPSG:32632+5773", 8.0, 47.0, 1.0},
                          {"EPSG:2226", -120.5, 38.0, 1.0 / 1200.0},
                          {"EPSG:3857", 46.0, 10.0, 0.01}}) {
        const auto region = test::open_grid(
            request_for({write_raster(folder / "deg.tif", forty(c.crs, c.x, c.y, c.step), relief_m)}));
        ASSERT_FALSE(region.ok()) << c.crs;
        const std::string line = region.error().line();
        const std::string_view crs(c.crs);
        for (const std::string_view words :
             {std::string_view("deg.tif: its coordinates (x "), std::string_view("look like degrees"),
              crs.substr(0, crs.find('+')), std::string_view("gdal_edit.py -a_srs EPSG:4326")})
            EXPECT_NE(line.find(words), std::string::npos) << line;
    }
}

// Norway is in zone 33 as a whole, Svalbard's west in 33, too; a site grid around its own origin has no area.
TEST(PlaceDoubts, NeighbouringZonesAndSiteGridsAreFine) {
    const fs::path folder = scratch_folder();
    for (const Raster& raster :
         {forty("EPSG:25833", -40000.0, 6740000.0, 10.0), forty("EPSG:32632", 500000.0, 5000000.0, 100.0),
          forty("EPSG:3857", 900000.0, 5900000.0, 30.0),
          forty("+proj=tmerc +lat_0=46.5 +lon_0=8 +datum=WGS84 +type=crs", -10.0, 10.0, 0.5)}) {
        std::string reason;
        const auto region =
            opened(request_for({write_raster(folder / "a.tif", raster,
                                             [](int r, int c) { return 500.0 + 0.01 * (r + c); })}),
                   &reason);
        ASSERT_TRUE(region) << raster.crs << ": " << reason;
        for (const std::string& note : region->notes)
            EXPECT_EQ(note.find("outside the area"), std::string::npos) << note;
    }
}

// Found: a compound CRS has no area of use without its vertical part, and Esri's .prj files none at all.
TEST(PlaceDoubts, SystemsThatStateNoAreaAreLookedUp) {
    const fs::path folder = scratch_folder();
    const auto file =
        write_raster(folder / "lv03.tif", forty("EPSG:2056+5728", 600000.0, 200000.0, 30.0), relief_m);
    const auto region = opened(request_for({file}));
    ASSERT_TRUE(region);
    EXPECT_TRUE(std::ranges::any_of(region->notes, [](const std::string& note) {
        return note.find("lv03.tif: its posts lie ") != std::string::npos &&
               note.find("degrees outside the area") != std::string::npos;
    }));
    std::ofstream grid(folder / "deg.asc");
    grid << "ncols 40\nnrows 40\nxllcorner 8\nyllcorner 46\ncellsize 0.5\n";
    for (int i = 0; i < 1600; ++i) grid << 500 + i % 7 << (i % 40 == 39 ? "\n" : " ");
    grid.close();
    std::ofstream(folder / "deg.prj")
        << R"(PROJCS["WGS_1984_UTM_Zone_32N",GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",)"
        << R"(SPHEROID["WGS_1984",6378137.0,298.257223563]],PRIMEM["Greenwich",0.0],)"
        << R"(UNIT["Degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],)"
        << R"(PARAMETER["False_Easting",500000.0],PARAMETER["False_Northing",0.0],)"
        << R"(PARAMETER["Central_Meridian",9.0],PARAMETER["Scale_Factor",0.9996],)"
        << R"(PARAMETER["Latitude_Of_Origin",0.0],UNIT["Meter",1.0]])";
    const auto refused = test::open_grid(request_for({(folder / "deg.asc").string()}));
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().line().find("look like degrees"), std::string::npos) << refused.error().line();
}

// East and north the wrong way round: somewhere else on the Earth.
TEST(PlaceDoubts, FarOutsideTheAreaOfUseIsTold) {
    const auto file = write_raster(scratch_folder() / "swapped.tif",
                                   forty("EPSG:32632", 5000000.0, 500000.0, 100.0), relief_m);
    const auto region = opened(request_for({file}));
    ASSERT_TRUE(region);
    std::size_t reported = 0;
    for (const std::string& note : region->notes)
        reported +=
            note.find("swapped.tif: its posts lie ") != std::string::npos &&
            note.find(
                "degrees outside the area that its coordinate reference system is made for (0 N to 84 N, "
                "6 E to 12 E)") != std::string::npos;
    EXPECT_EQ(reported, 1U) << (region->notes.empty() ? "" : region->notes[0]);
}

}  // namespace
}  // namespace oro
