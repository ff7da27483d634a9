#include "geo/sources/raster_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "geo/sources/source_words.h"
#include "tests/geo/datum/proj_folder.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

// A small raster of posts at whole hundredths of a degree: north-west post at 46.5 N 8 E.
Raster hundredths(int rows, int columns) {
    Raster raster;
    raster.rows = rows;
    raster.columns = columns;
    raster.cell_corners = posts_from(8.0, 46.5, 100.0);
    return raster;
}

double slope(int row, int column) {
    return 500.0 + 10.0 * row + column;
}

TEST(Raster, UnitsByTheirNames) {
    for (const auto& [name, metres] : {std::pair{"m", 1.0},
                                       {"Metre", 1.0},
                                       {"ft", 0.3048},
                                       {"FOOT", 0.3048},
                                       {"us-ft", 0.3048006096012192},
                                       {"US survey foot", 0.3048006096012192},
                                       {"cm", 0.01},
                                       {"centimetre", 0.01}}) {
        const auto found = metres_in(name);
        ASSERT_TRUE(found.has_value()) << name;
        EXPECT_DOUBLE_EQ(*found, metres) << name;
    }
    for (const char* name : {"", "K", "degree", "furlong", "m/s"})
        EXPECT_FALSE(metres_in(name).has_value()) << name;
}

TEST(Raster, PostsAreCopiedExactly) {
    const fs::path file = scratch_folder() / "dem.tif";
    Raster raster = hundredths(21, 31);
    raster.copyright = "A survey, 2020";
    const auto region = opened(request_for({write_raster(file, raster, slope)}));
    ASSERT_TRUE(region);
    const PostGrid& grid = region->field.grid;
    EXPECT_EQ(grid.lat.posts_per_deg, 100.0);
    EXPECT_EQ(grid.lat.phase_deg, 0.0);
    EXPECT_EQ(grid.rows(), 21);
    EXPECT_EQ(grid.columns(), 31);
    EXPECT_EQ(grid.north_deg(), 46.5);
    EXPECT_EQ(grid.west_deg(), 8.0);
    for (int r = 0; r < 21; ++r) {
        for (int c = 0; c < 31; ++c)
            ASSERT_EQ(region->field.H_at_post_m(r, c), static_cast<float>(slope(r, c)));
    }
    EXPECT_EQ(region->sources[0].attribution, "A survey, 2020");
    EXPECT_EQ(region->sources[0].crs, "EPSG:4326 WGS 84");
    EXPECT_EQ(placement_words(region->sources[0]), "posts copied");
    EXPECT_EQ(unit_words(region->sources[0].height_unit), "m (assumed)");
}

// A tilted plane is the same surface whether its file says "area" or "point": GDAL's map is for cell corners
// in both, and posts are cell centres. Half a post of error would be 5.5 m here in latitude.
TEST(Raster, AreaAndPointAgreeToTheHalfPost) {
    const fs::path folder = scratch_folder();
    const auto plane = [](double lat_deg, double lon_deg) {
        return 1000.0 * (lat_deg - 46.0) + 300.0 * (lon_deg - 8.0);
    };
    for (const bool points : {false, true}) {
        // On degrees: posts at their centres; and projected, where the surface must come out at the right
        // place.
        for (const char* crs : {"EPSG:4326", "EPSG:32632"}) {
            const bool degrees = std::string(crs) == "EPSG:4326";
            Raster raster;
            raster.rows = raster.columns = 81;
            raster.points = points;
            raster.crs = crs;
            raster.cell_corners = degrees
                                      ? posts_from(8.0, 46.5, 160.0)
                                      : std::array<double, 6>{420000.0, 1000.0, 0.0, 5180000.0, 0.0, -1000.0};
            const auto wgs84 = OSRNewSpatialReference(nullptr);
            const auto utm = OSRNewSpatialReference(nullptr);
            OSRImportFromEPSG(wgs84, 4326);
            OSRSetAxisMappingStrategy(wgs84, OAMS_TRADITIONAL_GIS_ORDER);
            OSRImportFromEPSG(utm, 32632);
            OSRSetAxisMappingStrategy(utm, OAMS_TRADITIONAL_GIS_ORDER);
            const auto to_degrees = OCTNewCoordinateTransformation(utm, wgs84);
            const std::string file = write_raster(
                folder / (std::string(points ? "point" : "area") + (degrees ? "_deg.tif" : "_utm.tif")),
                raster, [&](int r, int c) {
                    const auto& g = raster.cell_corners;
                    double x = g[0] + (c + 0.5) * g[1];
                    double y = g[3] + (r + 0.5) * g[5];
                    if (!degrees) OCTTransform(to_degrees, 1, &x, &y, nullptr);
                    return plane(y, x);
                });
            OCTDestroyCoordinateTransformation(to_degrees);
            OSRDestroySpatialReference(wgs84);
            OSRDestroySpatialReference(utm);
            std::string reason;
            const auto region = opened(resampled_from({file}), &reason);
            ASSERT_TRUE(region) << file << ": " << reason;
            EXPECT_EQ(region->sources[0].posts_are, points ? PostsAre::points : PostsAre::cell_centres);
            const PostGrid& grid = region->field.grid;
            int compared = 0;
            for (int r = 0; r < grid.rows(); ++r) {
                for (int c = 0; c < grid.columns(); ++c) {
                    const float H = region->field.H_at_post_m(r, c);
                    if (is_void(H)) continue;
                    ++compared;
                    // 1 cm: the plane is not quite one in UTM, and the mapping may err by 0.002 posts (2 m: 2
                    // cm at most).
                    ASSERT_NEAR(static_cast<double>(H), plane(grid.lat.at_deg(r), grid.lon.at_deg(c)),
                                degrees ? 1e-4 : 0.03)
                        << file << " row " << r << " column " << c;
                }
            }
            EXPECT_GT(compared, 5000);
        }
    }
}

TEST(Raster, UnitsScaleAndOffset) {
    const fs::path folder = scratch_folder();
    const auto highest = [&](const std::string& name, const Raster& raster, const std::string& height_unit) {
        RegionRequest request =
            request_for({write_raster(folder / name, raster, [](int, int) { return 1000.0; })});
        request.height_unit = height_unit;
        std::string reason;
        const auto region = opened(request, &reason);
        EXPECT_TRUE(region) << reason;
        return region ? static_cast<double>(height_range(region->field).highest_m) : 0.0;
    };
    Raster raster = hundredths(5, 5);
    raster.unit = "m";
    EXPECT_NEAR(highest("m.tif", raster, ""), 1000.0, 1e-4);
    EXPECT_NEAR(highest("told.tif", raster, "cm"), 10.0, 1e-5);  // what the user says overrides
    raster.unit = "ft";
    EXPECT_NEAR(highest("ft.tif", raster, ""), 304.8, 1e-4);
    raster.unit = "US survey foot";
    EXPECT_NEAR(highest("usft.tif", raster, ""), 304.8006096, 1e-4);
    raster.unit = "cm";
    EXPECT_NEAR(highest("cm.tif", raster, ""), 10.0, 1e-5);
    raster.unit = "";
    raster.scale = 0.1;
    raster.offset = -50.0;
    EXPECT_NEAR(highest("scaled.tif", raster, ""), 50.0, 1e-4);
    EXPECT_NEAR(highest("scaled_ft.tif", raster, "ft"), 15.24, 1e-5);
}

TEST(Raster, UnknownUnitsAreErrors) {
    const fs::path folder = scratch_folder();
    Raster raster = hundredths(5, 5);
    RegionRequest request = request_for({write_raster(folder / "a.tif", raster, slope)});
    request.height_unit = "furlong";
    auto region = test::open_grid(request);
    ASSERT_FALSE(region.ok());
    EXPECT_EQ(region.error().kind, ErrorKind::usage);
    raster.unit = "K";
    region = test::open_grid(request_for({write_raster(folder / "b.tif", raster, slope)}));
    ASSERT_FALSE(region.ok());
    EXPECT_NE(region.error().line().find("'K'"), std::string::npos) << region.error().line();
    EXPECT_NE(region.error().line().find("b.tif"), std::string::npos) << region.error().line();
}

TEST(Raster, NoDataOfEveryKindIsAHole) {
    const fs::path folder = scratch_folder();
    const auto voids = [&](const char* name, GDALDataType type, std::optional<double> declared,
                           double stored) {
        Raster raster = hundredths(9, 9);
        raster.type = type;
        raster.no_data = declared;
        std::string reason;
        const auto region = opened(
            request_for({write_raster(folder / name, raster,
                                      [&](int r, int c) { return r == 4 && c == 4 ? stored : 700.0; })}),
            &reason);
        EXPECT_TRUE(region) << name << ": " << reason;
        if (!region) return std::uint64_t{99};
        EXPECT_EQ(height_range(region->field).lowest_m, 700.0F) << name;  // no pit, no 0 m
        return region->voids;
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(voids("i16.tif", GDT_Int16, -32768.0, -32768.0), 1U);
    EXPECT_EQ(voids("f32.tif", GDT_Float32, -9999.0, -9999.0), 1U);
    EXPECT_EQ(voids("float_rounded.tif", GDT_Float32, -9999.006, -9999.006), 1U);
    EXPECT_EQ(voids("nan.tif", GDT_Float32, nan, nan), 1U);
    EXPECT_EQ(voids("nan_undeclared.tif", GDT_Float32, std::nullopt, nan), 1U);
    EXPECT_EQ(voids("mistyped.tif", GDT_Int16, -32678.0, -32768.0), 1U);
    EXPECT_EQ(voids("undeclared.tif", GDT_Int16, std::nullopt, -32768.0), 1U);
    EXPECT_EQ(voids("lowest_float.tif", GDT_Float32, -3.4028234663852886e38, -3.4028234663852886e38), 1U);
    EXPECT_EQ(voids("double.tif", GDT_Float64, -1.7976931348623157e308, -1.7976931348623157e308), 1U);
}

TEST(Raster, WhatIsNoElevationIsRefusedWithTheReason) {
    const fs::path folder = scratch_folder();
    const auto expect = [&](const char* name, const Raster& raster, const char* says) {
        const auto region = test::open_grid(request_for({write_raster(folder / name, raster, slope)}));
        ASSERT_FALSE(region.ok()) << name;
        const std::string line = region.error().line();
        EXPECT_NE(line.find(name), std::string::npos) << line;
        EXPECT_NE(line.find(says), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    };
    Raster raster = hundredths(5, 5);
    raster.bands = 3;
    raster.type = GDT_Byte;
    expect("rgb.tif", raster, "3 bands");
    raster = hundredths(5, 5);
    raster.crs = "";
    expect("no_crs.tif", raster, "no coordinate reference system");
    raster.crs = R"(LOCAL_CS["site grid",UNIT["metre",1]])";
    expect("local.tif", raster, "no place on the Earth");
    raster = hundredths(5, 5);
    raster.type = GDT_CFloat32;
    expect("complex.tif", raster, "complex");
    raster = hundredths(5, 5);
    raster.cell_corners = {420000.0, 100.0, 0.0, 5180000.0, 0.0, -100.0};  // metres, called degrees
    expect("metres.tif", raster, "");
    raster.cell_corners = {420000.0, 100.0, 0.0, 47.0, 0.0, -0.01};
    expect("metres_east.tif", raster, "longitudes");
    raster.cell_corners = {8.0, 0.01, 0.0, 47.0, 0.0, 0.0};
    expect("line.tif", raster, "cover no area");
}

TEST(Raster, TagsThatAreNoUtf8AreKeptWithTheirBadBytesReplaced) {
    const fs::path folder = scratch_folder();
    Raster raster = hundredths(11, 11);
    const std::string sign = "\xEF\xBF\xBD";  // U+FFFD
    const std::vector<std::array<std::string, 2>> texts{
        {"\xA9 2024 Swisstopo", sign + " 2024 Swisstopo"},  // Latin-1
        {"\xC2\xA9 2024", "\xC2\xA9 2024"},                 // UTF-8
        {"bell \x07 and cut \xE2\x82", "bell " + sign + " and cut " + sign},
        {"a line\nand\tmore", "a line\nand\tmore"}};
    for (const auto& [stored, shown] : texts) {
        raster.copyright = stored;
        const auto region = opened(request_for({write_raster(folder / "dem.tif", raster, slope)}));
        ASSERT_TRUE(region) << stored;
        EXPECT_EQ(region->sources[0].attribution, shown);
        fs::remove(folder / "dem.tif");
    }
}

TEST(Raster, UnknownCrsIsAnErrorThatNamesTheFile) {
    const fs::path folder = scratch_folder();
    std::ofstream(folder / "dem.vrt")
        << "<VRTDataset rasterXSize=\"5\" rasterYSize=\"5\"><SRS>EPSG:999999</SRS>"
           "<GeoTransform>8,0.01,0,46,0,-0.01</GeoTransform>"
           "<VRTRasterBand dataType=\"Int16\" band=\"1\"/></VRTDataset>";
    const auto region = test::open_grid(request_for({(folder / "dem.vrt").string()}));
    ASSERT_FALSE(region.ok());
    EXPECT_EQ(region.error().kind, ErrorKind::failed);
    EXPECT_TRUE(
        region.error().line().ends_with("dem.vrt: its coordinate reference system is unknown to PROJ"))
        << region.error().line();
}

TEST(Raster, AFolderWithoutProjsDatabaseIsNamed) {
    const fs::path folder = scratch_folder(), empty = scratch_folder();
    Raster nowhere = hundredths(5, 5);
    nowhere.crs = R"(LOCAL_CS["site",UNIT["metre",1]])";
    const std::string file = write_raster(folder / "dem.tif", nowhere, slope);
    const ProjFolder only(empty.string());
    const auto region = test::open_grid(request_for({file}));
    ASSERT_FALSE(region.ok());
    EXPECT_TRUE(region.error().line().ends_with("dem.tif: PROJ finds no proj.db, its database, in " +
                                                empty.string() + ", which PROJ_DATA names"))
        << region.error().line();
}

// As many posts as GDAL can count: told by their number, with no overflow on the way (asan watches).
TEST(Raster, TheLargestRasterIsTooLarge) {
    const fs::path file = scratch_folder() / "huge.vrt";
    std::ofstream(file) << R"(<VRTDataset rasterXSize="2147483647" rasterYSize="2147483647">
<SRS>EPSG:4326</SRS><GeoTransform>0, 1e-9, 0, 40, 0, -1e-9</GeoTransform>
<VRTRasterBand dataType="Float32" band="1"/></VRTDataset>)";
    const auto region = test::open_grid(request_for({file.string()}));
    ASSERT_FALSE(region.ok());
    EXPECT_NE(region.error().line().find("2147483647 x 2147483647"), std::string::npos)
        << region.error().line();
}

TEST(Raster, ImagesInAFolderArePassedOverAndNoted) {
    const fs::path folder = scratch_folder();
    Raster raster = hundredths(5, 5);
    write_raster(folder / "dem.tif", raster, slope);
    raster.bands = 3;
    raster.type = GDT_Byte;
    write_raster(folder / "photo.tif", raster, slope);
    const auto region = opened(request_for({folder.string()}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->sources.size(), 1U);
    ASSERT_EQ(region->notes.size(), 1U);
    EXPECT_NE(region->notes[0].find("photo.tif"), std::string::npos);
}

TEST(Raster, SouthUpRasterAndDatumEqualToWgs84AreCopied) {
    const fs::path folder = scratch_folder();
    Raster raster = hundredths(11, 11);
    const auto upright = opened(request_for({write_raster(folder / "north_up.tif", raster, slope)}));
    raster.cell_corners = {7.995, 0.01, 0.0, 46.395, 0.0, 0.01};
    const auto flipped = opened(request_for(
        {write_raster(folder / "south_up.tif", raster, [](int r, int c) { return slope(10 - r, c); })}));
    raster = hundredths(11, 11);
    raster.crs = "EPSG:4258";  // ETRS89, WGS84 to PROJ
    const auto etrs = opened(request_for({write_raster(folder / "etrs.tif", raster, slope)}));
    ASSERT_TRUE(upright && flipped && etrs);
    EXPECT_EQ(upright->field.H_m, flipped->field.H_m);
    EXPECT_EQ(upright->field.H_m, etrs->field.H_m);
    EXPECT_EQ(placement_words(etrs->sources[0]), "posts copied");
}

TEST(Raster, RotatedGeoreferenceAndVrtWork) {
    const fs::path folder = scratch_folder();
    // 1 km posts turned by 30 degrees about (440 km, 5150 km), on a plane that falls eastwards by 10 m/km in
    // UTM.
    const double c30 = std::sqrt(0.75);
    Raster raster;
    raster.rows = raster.columns = 41;
    raster.crs = "EPSG:32632";
    raster.cell_corners = {440000.0, 1000.0 * c30, 500.0, 5150000.0, 500.0, -1000.0 * c30};
    const auto height = [&](int r, int c) {
        return 2000.0 - ((c + 0.5) * 1000.0 * c30 + (r + 0.5) * 500.0) / 100.0;
    };
    const std::string file = write_raster(folder / "rotated.tif", raster, height);
    const auto region = opened(request_for({file}));
    ASSERT_TRUE(region);
    // The centre post: row 20, column 20 of the file, through GDAL's own transformation.
    const auto wgs84 = OSRNewSpatialReference(nullptr);
    const auto utm = OSRNewSpatialReference(nullptr);
    OSRImportFromEPSG(wgs84, 4326);
    OSRSetAxisMappingStrategy(wgs84, OAMS_TRADITIONAL_GIS_ORDER);
    OSRImportFromEPSG(utm, 32632);
    const auto to_degrees = OCTNewCoordinateTransformation(utm, wgs84);
    const auto& g = raster.cell_corners;
    double x = g[0] + 20.5 * g[1] + 20.5 * g[2];
    double y = g[3] + 20.5 * g[4] + 20.5 * g[5];
    OCTTransform(to_degrees, 1, &x, &y, nullptr);
    EXPECT_NEAR(static_cast<double>(region->field.H_at_m(y, x)), height(20, 20), 0.1);
    OCTDestroyCoordinateTransformation(to_degrees);
    OSRDestroySpatialReference(wgs84);
    OSRDestroySpatialReference(utm);

    const GDALDatasetH dataset = GDALOpen(file.c_str(), GA_ReadOnly);
    const GDALDatasetH vrt = GDALCreateCopy(GDALGetDriverByName("VRT"), (folder / "rotated.vrt").c_str(),
                                            dataset, 0, nullptr, nullptr, nullptr);
    GDALClose(vrt);
    GDALClose(dataset);
    const auto through_vrt = opened(request_for({(folder / "rotated.vrt").string()}));
    ASSERT_TRUE(through_vrt);
    EXPECT_EQ(through_vrt->field.H_m, region->field.H_m);
}

TEST(Raster, PackedGeoTiffs) {
    const fs::path folder = scratch_folder();
    const std::string plain = write_raster(folder / "dem.tif", hundredths(11, 11), slope);
    std::ifstream stream(plain, std::ios::binary);
    const std::vector<unsigned char> bytes((std::istreambuf_iterator<char>(stream)), {});
    write_bytes("/vsigzip/" + (folder / "dem.tif.gz").string(), bytes);
    write_bytes("/vsizip/" + (folder / "dems.zip").string() + "/deep/dem.tif", bytes);
    const auto expected = opened(request_for({plain}));
    ASSERT_TRUE(expected);
    for (const char* name : {"dem.tif.gz", "dems.zip"}) {
        std::string reason;
        const auto region = opened(request_for({(folder / name).string()}), &reason);
        ASSERT_TRUE(region) << name << ": " << reason;
        EXPECT_EQ(region->field.H_m, expected->field.H_m) << name;
    }
}

// Found: a folder of tiles with the VRT that gdalbuildvrt had made of them could not be read.
TEST(Raster, AVrtOfHgtTilesGivesWayToThem) {
    const fs::path folder = scratch_folder();
    write_hgt(folder / "N46E008.hgt", 1201, [](int r, int c) { return 500 + (r + c) / 8; });
    const std::string vrt = (folder / "all.vrt").string();
    std::ofstream(vrt) << R"(<VRTDataset rasterXSize="1201" rasterYSize="1201"><SRS>EPSG:4326</SRS>
<GeoTransform>7.99958333, 8.33333e-4, 0, 47.00041667, 0, -8.33333e-4</GeoTransform>
<VRTRasterBand dataType="Int16" band="1"><SimpleSource><SourceFilename relativeToVRT="1">N46E008.hgt</SourceFilename><SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>)";
    constexpr const char* why =
        "all.vrt: is a VRT of .hgt files, which are read without it: name the tiles themselves (N46E008.hgt)";
    std::string reason;
    const auto region = opened(request_for({folder.string()}), &reason);
    ASSERT_TRUE(region) << reason;
    EXPECT_EQ(region->sources.size(), 1U);
    EXPECT_EQ(
        std::ranges::count_if(region->notes,
                              [&](const std::string& note) { return note.find(why) != std::string::npos; }),
        1);
    const auto alone = test::open_grid(request_for({vrt}));
    ASSERT_FALSE(alone.ok());
    EXPECT_TRUE(alone.error().line().ends_with(why)) << alone.error().line();
}

std::string grid_text(int rows) {
    std::string text = "ncols 10\nnrows 10\nxllcorner 8\nyllcorner 46\ncellsize 0.01\nNODATA_value -9999\n";
    for (int i = 0; i < 10 * rows; ++i) text += std::to_string(500 + i) + (i % 10 == 9 ? "\n" : " ");
    return text;
}

TEST(Raster, AGridOfMoreNumbersThanItsHeaderSaysIsTold) {
    RegionRequest request = request_for({});
    request.source_crs = "EPSG:4326";
    for (const int rows : {10, 15}) {
        request.paths = {(scratch_folder() / "grid.asc").string()};
        std::ofstream(request.paths[0]) << grid_text(rows);
        std::string reason;
        const auto region = opened(request, &reason);
        ASSERT_TRUE(region) << reason;
        EXPECT_EQ(std::ranges::count_if(region->notes,
                                        [](const std::string& note) {
                                            return note.find(
                                                       "grid.asc holds 150 numbers, and its header speaks of "
                                                       "10 rows of 10: the last 50 are not read") !=
                                                   std::string::npos;
                                        }),
                  rows == 15 ? 1 : 0);
    }
}

TEST(Raster, AGridWithAByteOrderMarkIsRefusedForIt) {
    for (const auto& [mark, encoding] : {std::pair{"\xef\xbb\xbf", "UTF-8"}, {"\xff\xfe", "UTF-16"}}) {
        const fs::path file = scratch_folder() / "grid.asc";
        std::ofstream(file) << mark << grid_text(10);
        const auto region = test::open_grid(request_for({file.string()}));
        ASSERT_FALSE(region.ok());
        EXPECT_NE(region.error().line().find("grid.asc: starts with a byte order mark (its text is " +
                                             std::string(encoding) + ")"),
                  std::string::npos)
            << region.error().line();
    }
}

TEST(Raster, DamagedContentIsAnError) {
    const fs::path folder = scratch_folder();
    const std::string file = write_raster(folder / "dem.tif", hundredths(200, 200), slope);
    fs::resize_file(file, fs::file_size(file) / 2);
    const auto region = test::open_grid(request_for({file}));
    ASSERT_FALSE(region.ok());
    EXPECT_NE(region.error().line().find("dem.tif"), std::string::npos) << region.error().line();
}

}  // namespace
}  // namespace oro
