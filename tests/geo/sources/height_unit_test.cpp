#include "geo/sources/height_unit.h"

#include <gtest/gtest.h>

#include <cpl_string.h>

#include <cstring>

#include "geo/sources/source_words.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

Raster utm_grid(const std::string& crs) {
    Raster raster;
    raster.rows = raster.columns = 20;
    raster.crs = crs;
    raster.cell_corners = {500000.0, 100.0, 0.0, 4400000.0, 0.0, -100.0};
    return raster;
}

double slope_m(int row, int column) {
    return 1000.0 + row + column;
}

// Bytes of a TIFF of 16-bit numbers with GeoKeys for UTM zone 13N and this unit of heights; little or big
// endian, classic or BigTIFF. 2 x 2 cells of `value`, with a pixel of 100 m.
std::vector<unsigned char> tiff_with_vertical_unit(bool big, bool little, int unit, int value) {
    std::vector<unsigned char> bytes;
    const auto put = [&](std::uint64_t number, int length) {
        for (int i = 0; i < length; ++i)
            bytes.push_back(static_cast<unsigned char>(number >> (8 * (little ? i : length - 1 - i)) & 255U));
    };
    const auto put_double = [&](double number) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &number, sizeof bits);
        put(bits, 8);
    };
    constexpr std::array<std::uint64_t, 20> keys{1, 1, 0,    4, 1024, 0,     1,    1, 1025, 0,
                                                 1, 1, 3072, 0, 1,    32613, 4099, 0, 1,    0};
    const std::uint64_t data = 16, scale = data + 8, tie = scale + 24, geo = tie + 48,
                        directory = geo + 2 * keys.size();
    for (int i = 0; i < 2; ++i) bytes.push_back(little ? 'I' : 'M');
    put(big ? 43 : 42, 2);
    if (big) put(8, 2), put(0, 2), put(directory, 8);
    if (!big) put(directory, 4), put(0, 8);
    for (int i = 0; i < 4; ++i) put(static_cast<std::uint64_t>(value), 2);
    for (const double number : {100.0, 100.0, 0.0}) put_double(number);
    for (const double number : {0.0, 0.0, 0.0, 500000.0, 4400000.0, 0.0}) put_double(number);
    for (std::size_t i = 0; i < keys.size(); ++i)
        put(i + 1 == keys.size() ? static_cast<std::uint64_t>(unit) : keys[i], 2);
    struct Entry {
        std::uint64_t tag, type, count, at;
    };
    constexpr std::uint64_t u16 = 3, u32 = 4, f64 = 12;
    const std::vector<Entry> entries{{256, u16, 1, 2},
                                     {257, u16, 1, 2},
                                     {258, u16, 1, 16},
                                     {259, u16, 1, 1},
                                     {262, u16, 1, 1},
                                     {273, u32, 1, data},
                                     {277, u16, 1, 1},
                                     {278, u16, 1, 2},
                                     {279, u32, 1, 8},
                                     {339, u16, 1, 2},
                                     {33550, f64, 3, scale},
                                     {33922, f64, 6, tie},
                                     {34735, u16, keys.size(), geo}};
    put(entries.size(), big ? 8 : 2);
    for (const Entry& entry : entries) {
        put(entry.tag, 2), put(entry.type, 2), put(entry.count, big ? 8 : 4);
        // A value of its own stands at the front of its place.
        const int wide = big ? 8 : 4;
        const int length = entry.count > 1 ? wide : entry.type == u16 ? 2 : 4;
        put(entry.at, length), put(0, wide - length);
    }
    put(0, big ? 8 : 4);
    return bytes;
}

TEST(HeightUnit, GeoKey4099InEveryKindOfTiff) {
    const fs::path folder = scratch_folder();
    struct Case {
        int unit;
        double H_m;
        const char* words;
    };
    // 1000 of each: EPSG's 9003 US survey foot, 9002 foot, 9001 metre, 1025 millimetre, 9014 fathom (6 ft).
    for (const Case& c : {Case{9003, 304.8006096, "us-ft"},
                          {9002, 304.8, "ft"},
                          {9001, 1000.0, "m"},
                          {1025, 1.0, "mm"},
                          {9014, 1828.8, "fathom"}}) {
        for (const bool big : {false, true}) {
            for (const bool little : {false, true}) {
                const auto file = write_bytes((folder / "keys.tif").string(),
                                              tiff_with_vertical_unit(big, little, c.unit, 1000));
                std::string reason;
                const auto region = opened(request_for({file}), &reason);
                ASSERT_TRUE(region) << c.unit << big << little << reason;
                EXPECT_NEAR(static_cast<double>(region->field.H_at_post_m(0, 0)), c.H_m, 1e-4)
                    << c.unit << big << little;
                EXPECT_EQ(unit_words(region->sources[0].height_unit), c.words);
                for (const std::string& note : region->notes)
                    EXPECT_EQ(note.find("--height-unit"), std::string::npos) << note;
            }
        }
    }
    // Of a mosaic of such files, and packed.
    write_bytes((folder / "keys.tif").string(), tiff_with_vertical_unit(false, true, 9003, 1000));
    std::ofstream(folder / "keys.vrt")
        << "<VRTDataset rasterXSize=\"2\" "
           "rasterYSize=\"2\"><SRS>EPSG:32613</SRS><GeoTransform>500000,100,0,4400000,"
           "0,-100</GeoTransform><VRTRasterBand dataType=\"Int16\" band=\"1\"><SimpleSource><SourceFilename "
           "relativeToVRT=\"1\">keys.tif</SourceFilename><SourceBand>1</SourceBand></SimpleSource></"
           "VRTRasterBand>"
           "</VRTDataset>";
    write_bytes("/vsizip/" + (folder / "keys.zip").string() + "/keys.tif",
                tiff_with_vertical_unit(true, false, 9003, 1000));
    for (const char* name : {"keys.vrt", "keys.zip"}) {
        std::string reason;
        const auto region = opened(request_for({(folder / name).string()}), &reason);
        ASSERT_TRUE(region) << name << ": " << reason;
        EXPECT_NEAR(static_cast<double>(region->field.H_at_post_m(0, 0)), 304.8006096, 1e-4) << name;
    }
}

TEST(HeightUnit, AnUnknownOneNamesTheOption) {
    const fs::path folder = scratch_folder();
    Raster raster = utm_grid("EPSG:32613");
    raster.unit = "cubit";
    const auto file = write_raster(folder / "cubits.tif", raster, slope_m);
    const auto refused = test::open_grid(request_for({file}));
    ASSERT_FALSE(refused.ok());
    for (const char* words : {"'cubit'", "--height-unit m, ft, us-ft, cm, dm or mm"})
        EXPECT_NE(refused.error().line().find(words), std::string::npos) << refused.error().line();
    const auto keys = test::open_grid(request_for(
        {write_bytes((folder / "keys.tif").string(), tiff_with_vertical_unit(false, true, 9102, 1000))}));
    ASSERT_FALSE(keys.ok());  // 9102 is the degree
    EXPECT_NE(keys.error().line().find("--height-unit"), std::string::npos) << keys.error().line();
    RegionRequest with_unit = request_for({file});
    with_unit.height_unit = "ft";
    EXPECT_TRUE(opened(with_unit));
}

// International foot 0.3048 m, US survey foot 1200/3937 m: NIST Special Publication 811, B.6.
TEST(HeightUnit, PlainWordsAreUnderstood) {
    for (const char* unit : {"meters", "m a.s.l.", "m a. s. l.", "metres above sea level",
                             "Meters above mean sea level", "m (MSL)", "metre [m]", "[m]"})
        EXPECT_EQ(metres_in(unit), 1.0) << unit;
    for (const char* unit : {"feet (US)", "US-foot", "US survey feet", "U.S. Survey Foot", "ft (US)",
                             "US survey foot (ftUS)", "Foot_US", "us-ft", "sFt"})
        EXPECT_EQ(metres_in(unit), 1200.0 / 3937.0) << unit;
    for (const char* unit : {"feet", "ft", "foot (international)", "ft above sea level"})
        EXPECT_EQ(metres_in(unit), 0.3048) << unit;
    EXPECT_EQ(metres_in("km"), 1000.0);
    for (const char* unit : {"", "us", "sea level", "m/s", "m2", "metres below sea level", "1e-1 m", "us m",
                             "m ft", "degree", "cubit"})
        EXPECT_EQ(metres_in(unit), std::nullopt) << unit;
}

// Found: heights in furlongs were metres, without a word.
TEST(HeightUnit, ZunitsThatAreNoUnitAreRefused) {
    const fs::path folder = scratch_folder();
    Raster raster = utm_grid("EPSG:32613");
    const std::string file = write_raster(folder / "grid.tif", raster, slope_m);
    std::ofstream(folder / "grid.prj") << "Projection UTM\nZunits  furlongs\nUnits METERS\n";
    const auto refused = test::open_grid(request_for({file}));
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(
        refused.error().line().find("gives its heights in 'furlongs' (Zunits of its .prj file), which is "
                                    "no known unit of height; --height-unit m, ft, us-ft"),
        std::string::npos)
        << refused.error().line();
    RegionRequest with_unit = request_for({file});
    with_unit.height_unit = "m";
    EXPECT_TRUE(opened(with_unit));
}

TEST(HeightUnit, ZunitsOfOldPrjFiles) {
    const fs::path folder = scratch_folder();
    struct Case {
        const char* zunits;
        double H_m;
        const char* words;
    };
    for (const Case& c : {Case{"Zunits        FEET", 304.8, "ft"},
                          {"ZUNITS METERS", 1000.0, "m"},
                          {"Zunits 100", 10.0, "cm"},
                          {"Zunits\tNO", 1000.0, "m (assumed)"},
                          {"", 1000.0, "m (assumed)"}}) {
        std::ofstream text(folder / "grid.asc");
        text << "ncols 10\nnrows 10\nxllcorner 500000\nyllcorner 4400000\ncellsize 100\nNODATA_value -9999\n";
        for (int i = 0; i < 100; ++i) text << (i % 10 == 9 ? "1000\n" : "1000 ");
        text.close();
        std::ofstream(folder / "grid.prj")
            << "Projection    UTM\nZone          13\nDatum         NAD83\n"
            << c.zunits
            << "\nUnits         METERS\nSpheroid      GRS1980\nXshift        0.0\nYshift        0.0\n"
            << "Parameters\n";
        std::string reason;
        const auto region = opened(request_for({(folder / "grid.asc").string()}), &reason);
        ASSERT_TRUE(region) << reason;
        EXPECT_NEAR(static_cast<double>(region->field.H_at_post_m(5, 5)), c.H_m, 1e-4) << c.zunits;
        EXPECT_EQ(unit_words(region->sources[0].height_unit), c.words) << c.zunits;
    }
}

// A CRS that counts in feet: nothing is said of heights, then the option says it, then the file.
TEST(HeightUnit, AssumedMetresBesideACrsInFeetAreTold) {
    const fs::path folder = scratch_folder();
    Raster raster = utm_grid("EPSG:6529");  // NAD83(2011) / New Mexico Central (ftUS)
    raster.cell_corners = {1640000.0, 10.0, 0.0, 1700000.0, 0.0, -10.0};
    RegionRequest request;
    for (const char* name : {"a.tif", "b.tif"}) {
        request.paths.push_back(write_raster(folder / name, raster, slope_m));
        raster.cell_corners[0] += 200.0;
    }
    const auto about_unit = [](const RegionGrid& region) {
        std::vector<std::string> found;
        for (const std::string& note : region.notes)
            if (note.find("--height-unit") != std::string::npos) found.push_back(note);
        return found;
    };
    const auto assumed = opened(request);
    ASSERT_TRUE(assumed);
    const auto notes = about_unit(*assumed);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(
        notes[0].substr(notes[0].find("a.tif")),
        "a.tif and 1 more file: its coordinate reference system counts in US survey foot, and nothing says "
        "what its heights count in; metres are assumed (--height-unit us-ft tells it otherwise)");
    request.height_unit = "us-ft";
    const auto region = opened(request);
    ASSERT_TRUE(region);
    EXPECT_TRUE(about_unit(*region).empty());
    EXPECT_NEAR(static_cast<double>(region->field.H_at_post_m(0, 0)), 304.8006096, 1e-4);
    request.height_unit = "";
    raster.unit = "US survey foot";
    request.paths = {write_raster(folder / "c.tif", raster, slope_m)};
    const auto stated = opened(request);
    ASSERT_TRUE(stated);
    EXPECT_TRUE(about_unit(*stated).empty());
}

TEST(HeightUnit, ABandAndACrsThatContradictEachOtherAreTold) {
    const fs::path folder = scratch_folder();
    Raster raster = utm_grid("EPSG:32613+5703");  // NAVD88 in metres
    raster.unit = "ft";
    const auto region = opened(request_for({write_raster(folder / "a.tif", raster, slope_m)}));
    ASSERT_TRUE(region);
    EXPECT_NEAR(static_cast<double>(region->field.H_at_post_m(0, 0)), 304.8, 2.0);  // NAVD88 to EGM96
    std::size_t reported = 0;
    for (const std::string& note : region->notes)
        reported += note.find("its band gives heights in ft") != std::string::npos &&
                    note.find("ft is taken (--height-unit tells it otherwise)") != std::string::npos;
    EXPECT_EQ(reported, 1U);
}

}  // namespace
}  // namespace oro
