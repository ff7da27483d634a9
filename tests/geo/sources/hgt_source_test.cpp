#include "geo/sources/hgt_source.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "geo/sources/source_words.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

double ramp(int row, int column) {
    return 1000 + row - 2 * (column % 500);
}

TEST(HgtName, FormsOfNames) {
    const auto expect = [](const char* text, int lat, int lon, int arc_seconds) {
        const auto name = parse_hgt_name(text);
        ASSERT_TRUE(name.has_value()) << text;
        EXPECT_EQ(name->tile.lat_deg, lat) << text;
        EXPECT_EQ(name->tile.lon_deg, lon) << text;
        EXPECT_EQ(name->arc_seconds, arc_seconds) << text;
    };
    expect("N46E008.hgt", 46, 8, 0);
    expect("n46e008.HGT", 46, 8, 0);
    expect("S46W066.SRTMGL1.hgt", -46, -66, 1);
    expect("N46E008.SRTMGL3.hgt", 46, 8, 3);
    expect("N46E008_srtm3.hgt", 46, 8, 3);
    for (const char* text : {"dem.hgt", "N46E008", "N46E008.tif", "N46E0080.hgt", "N46E008x.hgt", ".hgt",
                             "N91E008.hgt", "E008N46.hgt"})
        EXPECT_FALSE(parse_hgt_name(text).has_value()) << text;
}

TEST(Hgt, PostsLieOnWholeDegreesAndKeepTheirValues) {
    const fs::path folder = scratch_folder();
    const auto region = opened(request_for({write_hgt(folder / "n46e008.HGT", 1201, ramp)}));
    ASSERT_TRUE(region);
    const PostGrid& grid = region->field.grid;
    EXPECT_EQ(grid.rows(), 1201);
    EXPECT_EQ(grid.columns(), 1201);
    // The name is the centre of the south-west post, and the corners are whole degrees to the last bit.
    EXPECT_EQ(grid.west_deg(), 8.0);
    EXPECT_EQ(grid.south_deg(), 46.0);
    EXPECT_EQ(grid.east_deg(), 9.0);
    EXPECT_EQ(grid.north_deg(), 47.0);
    for (int r = 0; r < 1201; r += 37) {
        for (int c = 0; c < 1201; c += 41)
            EXPECT_EQ(region->field.H_at_post_m(r, c), static_cast<float>(ramp(r, c)));
    }
    ASSERT_EQ(region->sources.size(), 1U);
    const SourceReport& source = region->sources[0];
    EXPECT_EQ(format_words(source), "SRTM3 .hgt");
    EXPECT_EQ(placement_words(source), "posts copied");
    EXPECT_NE(datum_words(source.vertical_datum).find("EGM96"), std::string::npos);
    EXPECT_NE(datum_words(source.vertical_datum).find("by definition of .hgt"), std::string::npos)
        << "SRTM's format: nothing is assumed";
    EXPECT_EQ(source.box.west_deg, 8.0);
    EXPECT_NEAR(source.spacing_m, 92.63, 0.01);  // 1/1200 degree of the meridian at 46.5 N (WGS84)
    EXPECT_EQ(region->voids, 0U);
    EXPECT_EQ(region->void_method, VoidMethod::holes);
    EXPECT_TRUE(region->missing_cells.empty());
}

TEST(Hgt, PartOfATileIsThatPart) {
    const fs::path folder = scratch_folder();
    RegionRequest request = request_for({write_hgt(folder / "S46W066.hgt", 1201, ramp)});
    request.box = BoundingBox{-65.75, -45.5, -65.5, -45.25};
    const auto region = opened(request);
    ASSERT_TRUE(region);
    EXPECT_EQ(region->field.grid.rows(), 301);
    EXPECT_EQ(region->field.grid.columns(), 301);
    EXPECT_EQ(region->field.H_at_post_m(0, 0), static_cast<float>(ramp(300, 300)));
    EXPECT_EQ(region->field.H_at_post_m(300, 300), static_cast<float>(ramp(600, 600)));
}

TEST(Hgt, ZipGzipAndFoldersGiveTheSameHeights) {
    const fs::path folder = scratch_folder();
    const auto bytes = hgt_bytes(1201, ramp);
    fs::create_directories(folder / "plain" / "deeper");
    write_bytes((folder / "plain" / "deeper" / "N46E008.hgt").string(), bytes);
    std::ofstream(folder / "plain" / "readme.txt") << "not elevation\n";
    write_bytes("/vsizip/" + (folder / "N46E008.SRTMGL3.hgt.zip").string() + "/N46E008.hgt", bytes);
    write_bytes("/vsigzip/" + (folder / "N46E008.hgt.gz").string(), bytes);
    const auto plain = opened(request_for({(folder / "plain").string()}));
    ASSERT_TRUE(plain);
    for (const char* name : {"N46E008.SRTMGL3.hgt.zip", "N46E008.hgt.gz"}) {
        std::string reason;
        const auto packed = opened(request_for({(folder / name).string()}), &reason);
        ASSERT_TRUE(packed) << name << ": " << reason;
        EXPECT_EQ(packed->field.H_m, plain->field.H_m) << name;
    }
    const auto zip = opened(request_for({(folder / "N46E008.SRTMGL3.hgt.zip").string()}));
    EXPECT_EQ(zip->sources[0].attribution, "NASA SRTM v3 (SRTMGL3), public domain");
    EXPECT_TRUE(zip->sources[0].path.ends_with("N46E008.SRTMGL3.hgt.zip/N46E008.hgt"))
        << zip->sources[0].path;
    EXPECT_FALSE(fs::exists(folder / "N46E008.hgt.gz.properties"));
}

TEST(Hgt, SeveralTilesInOneZipAndMixedPaths) {
    const fs::path folder = scratch_folder();
    const std::string zip = "/vsizip/" + (folder / "tiles.zip").string();
    VSILFILE* const keep_open = VSIFOpenL(zip.c_str(), "wb");
    ASSERT_TRUE(keep_open);
    write_bytes(zip + "/a/N10E020.hgt", hgt_bytes(1201, [](int, int c) { return c; }));
    write_bytes(zip + "/a/n10e021.hgt", hgt_bytes(1201, [](int, int c) { return 1200 + c; }));
    write_bytes(zip + "/notes.txt", {'x'});
    VSIFCloseL(keep_open);
    const std::string neighbour =
        write_hgt(folder / "N10E022.hgt", 1201, [](int, int c) { return 2400 + c; });
    std::string reason;
    const auto region = opened(request_for({(folder / "tiles.zip").string(), neighbour}), &reason);
    ASSERT_TRUE(region) << reason;
    EXPECT_EQ(region->sources.size(), 3U);
    EXPECT_EQ(region->field.grid.columns(), 3601);
    for (const int c : {0, 1199, 1200, 1201, 2400, 3600})
        EXPECT_EQ(region->field.H_at_post_m(600, c), static_cast<float>(c));
    EXPECT_EQ(region->seams.shared_posts, 2U * 1201U);
    EXPECT_EQ(region->seams.disagreeing_posts, 0U);
}

// ---- bad input: one clear line with the file, what was expected and what was found

struct BadHgt {
    const char* name;
    std::size_t bytes;
    const char* says;
};

TEST(Hgt, WrongSizesAndNamesAreErrorsThatSayWhatWasExpected) {
    const fs::path folder = scratch_folder();
    for (const BadHgt& bad :
         {BadHgt{"N46E008.hgt", 0, "is empty"}, BadHgt{"N46E009.hgt", 2884801, "2884801 bytes"},
          BadHgt{"N46E010.hgt", 100000, "2884802"}, BadHgt{"N46E011.hgt", 2 * 1200 * 1200, "25934402"},
          BadHgt{"dem.hgt", 2884802, "N46E008.hgt"}, BadHgt{"N99E011.hgt", 2884802, "name"},
          BadHgt{"N46E012.SRTMGL1.hgt", 2884802, "1 arc-second"}}) {
        const std::string file =
            write_bytes((folder / bad.name).string(), std::vector<unsigned char>(bad.bytes));
        const auto region = test::open_grid(request_for({file}));
        ASSERT_FALSE(region.ok()) << bad.name;
        EXPECT_EQ(region.error().kind, ErrorKind::failed) << bad.name;
        const std::string line = region.error().line();
        EXPECT_NE(line.find(bad.name), std::string::npos) << line;
        EXPECT_NE(line.find(bad.says), std::string::npos) << line;
        EXPECT_EQ(line.find('\n'), std::string::npos) << line;
        // Found in a folder it is the same error: terrain does not silently miss a tile.
        EXPECT_FALSE(test::open_grid(request_for({folder.string()})).ok());
        fs::remove(file);
    }
}

TEST(Hgt, DamagedPackingIsAnErrorAndNotZeros) {
    const fs::path folder = scratch_folder();
    const auto bytes = hgt_bytes(1201, [](int r, int c) { return (r * 31 + c * 17) % 3000; });
    for (const char* name : {"N46E008.hgt.zip", "N46E008.hgt.gz"}) {
        const fs::path file = folder / name;
        const bool zip = file.extension() == ".zip";
        write_bytes((zip ? "/vsizip/" : "/vsigzip/") + file.string() + (zip ? "/N46E008.hgt" : ""), bytes);
        // A hole in the packed bytes: sizes and directory stay right, the content does not.
        std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekp(static_cast<std::streamoff>(fs::file_size(file) / 3));
        const std::string noise(5000, '\xff');
        stream.write(noise.data(), static_cast<std::streamsize>(noise.size()));
        stream.close();
        const auto region = test::open_grid(request_for({file.string()}));
        ASSERT_FALSE(region.ok()) << name;
        EXPECT_NE(region.error().line().find(name), std::string::npos) << region.error().line();
    }
}

// Unlike noise, a single changed byte often unpacks into other heights without complaint: only the checksum
// tells. Every place is tried, of which most unpack.
TEST(Hgt, AChangedByteInAnArchiveIsAnError) {
    const fs::path folder = scratch_folder();
    const auto bytes = hgt_bytes(1201, [](int r, int c) { return (r * r + c * 17) % 3000; });
    for (const char* name : {"N46E008.hgt.zip", "N46E008.hgt.gz"}) {
        const fs::path file = folder / name;
        const bool zip = file.extension() == ".zip";
        write_bytes((zip ? "/vsizip/" : "/vsigzip/") + file.string() + (zip ? "/N46E008.hgt" : ""), bytes);
        EXPECT_TRUE(test::open_grid(request_for({file.string()})).ok()) << name;
        const auto size = static_cast<std::streamoff>(fs::file_size(file));
        for (int part = 2; part < 12; ++part) {
            const fs::path changed = folder / "changed" / name;
            fs::create_directories(changed.parent_path());
            fs::copy_file(file, changed, fs::copy_options::overwrite_existing);
            std::fstream stream(changed, std::ios::in | std::ios::out | std::ios::binary);
            stream.seekg(size * part / 13);
            const auto byte = static_cast<char>(stream.get() ^ 0x11);
            stream.seekp(size * part / 13);
            stream.put(byte);
            stream.close();
            const auto region = test::open_grid(request_for({changed.string()}));
            ASSERT_FALSE(region.ok()) << name << ", byte " << size * part / 13 << " of " << size;
            EXPECT_NE(region.error().line().find(name), std::string::npos) << region.error().line();
        }
    }
}

TEST(Hgt, PlainTileCalledGzip) {
    const fs::path file = scratch_folder() / "N46E008.hgt.gz";
    write_hgt(file, 1201, ramp);
    const auto region = test::open_grid(request_for({file.string()}));
    ASSERT_FALSE(region.ok());
    EXPECT_NE(region.error().line().find("is no gzip file"), std::string::npos) << region.error().line();
}

TEST(Hgt, TruncatedArchivesAreErrors) {
    const fs::path folder = scratch_folder();
    const auto bytes = hgt_bytes(1201, ramp);
    write_bytes("/vsigzip/" + (folder / "N46E008.hgt.gz").string(), bytes);
    fs::resize_file(folder / "N46E008.hgt.gz", fs::file_size(folder / "N46E008.hgt.gz") / 2);
    EXPECT_FALSE(test::open_grid(request_for({(folder / "N46E008.hgt.gz").string()})).ok());
    fs::resize_file(folder / "N46E008.hgt.gz", 5);
    EXPECT_FALSE(test::open_grid(request_for({(folder / "N46E008.hgt.gz").string()})).ok());
    write_bytes("/vsizip/" + (folder / "N46E009.hgt.zip").string() + "/N46E009.hgt", bytes);
    fs::resize_file(folder / "N46E009.hgt.zip", fs::file_size(folder / "N46E009.hgt.zip") / 2);
    const auto region = test::open_grid(request_for({(folder / "N46E009.hgt.zip").string()}));
    ASSERT_FALSE(region.ok());
    EXPECT_NE(region.error().line().find("archive"), std::string::npos) << region.error().line();
}

// The size that a .gz states is that of its last part, modulo 4 GiB; what it unpacks to may be anything.
TEST(Hgt, GzipThatUnpacksToMoreThanItStates) {
    const fs::path folder = scratch_folder();
    const auto bytes = hgt_bytes(1201, ramp);
    write_bytes("/vsigzip/" + (folder / "tile.gz").string(), bytes);
    for (const std::size_t more : {std::size_t{1}, std::size_t{64} << 20U}) {
        std::vector<unsigned char> longer(bytes.size() + more);
        std::copy(bytes.begin(), bytes.end(), longer.begin());
        const fs::path file = folder / "N46E008.hgt.gz";
        write_bytes("/vsigzip/" + file.string(), longer);
        std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekp(-4, std::ios::end);
        for (unsigned shift = 0; shift < 32; shift += 8)
            stream.put(static_cast<char>(bytes.size() >> shift & 0xffU));
        stream.close();
        const auto region = test::open_grid(request_for({file.string()}));
        ASSERT_FALSE(region.ok()) << more;
        EXPECT_NE(region.error().line().find("N46E008.hgt.gz"), std::string::npos) << region.error().line();
    }
}

TEST(Hgt, VoidsAndImplausibleHeightsAreHolesAndCounted) {
    const fs::path folder = scratch_folder();
    const auto region = opened(request_for({write_hgt(folder / "N46E008.hgt", 1201, [](int r, int c) {
        if (r == 10 && c < 7) return -32768;
        if (r == 20 && c < 5) return -32678;  // the usual slip of the pen
        if (r == 30 && c < 3) return 9500;
        return 500;
    })}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->voids, 15U);
    EXPECT_EQ(region->sources[0].voids, 15U);
    EXPECT_EQ(region->sources[0].implausible, 8U);
    EXPECT_EQ(region->sources[0].lowest_m, 500.0);
    EXPECT_EQ(region->sources[0].highest_m, 500.0);
    EXPECT_TRUE(is_void(region->field.H_at_post_m(20, 0)));
    ASSERT_EQ(region->notes.size(), 1U);
    EXPECT_NE(region->notes[0].find("8 heights"), std::string::npos) << region->notes[0];
}

// Posts half a second of arc apart: 7201 a side. A file of zeros but for a few posts, most of it never
// written.
// Heights of 500 to 700 m with the low byte first.
TEST(Hgt, BytesInTheOtherOrderAreAnError) {
    const fs::path folder = scratch_folder();
    const std::string file = write_hgt(folder / "N46E008.hgt", 1201, [](int r, int c) {
        const int height_m = 500 + (r + c) / 12;
        const int swapped = (height_m & 255) << 8 | height_m >> 8;
        return swapped > 32767 ? swapped - 65536 : swapped;
    });
    const auto refused = test::open_grid(request_for({file}));
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().line().find("its bytes seem to be in the other order"), std::string::npos);
}

TEST(Hgt, TilesOfHalfASecond) {
    const fs::path file = scratch_folder() / "N46E008.hgt";
    constexpr int side = 7201;
    std::ofstream(file).close();
    fs::resize_file(file, std::uintmax_t{2} * side * side);
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    // Row 100 from the north, column 200: 47 - 100/7200 N, 8 + 200/7200 E.
    stream.seekp((std::streamoff{100} * side + 200) * 2);
    stream.write("\x07\xd0", 2);  // 2000
    stream.close();
    RegionRequest request = request_for({file.string()});
    request.box = BoundingBox{8.02, 46.98, 8.03, 46.99};
    std::string reason;
    const auto region = opened(request, &reason);
    ASSERT_TRUE(region) << reason;
    EXPECT_EQ(region->field.grid.lat.posts_per_deg, 7200.0);
    EXPECT_EQ(region->field.H_at_m(47.0 - 100.0 / 7200.0, 8.0 + 200.0 / 7200.0), 2000.0F);
    EXPECT_EQ(format_words(region->sources[0]), "half-second .hgt");
    EXPECT_EQ(region->sources[0].rows, side);
    EXPECT_NEAR(region->sources[0].spacing_m, 15.44, 0.01);  // a 7200th of a degree of the meridian at 46.5
}

TEST(Hgt, RealGzipTileOfPatagonia) {
    const auto file = real_data("extremes/S46W066.hgt.gz");
    if (!file) GTEST_SKIP() << "needs extremes/S46W066.hgt.gz";
    const auto region = opened(request_for({file->string()}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->field.grid.rows(), 3601);
    EXPECT_EQ(region->field.grid.south_deg(), -46.0);
    EXPECT_EQ(region->field.grid.west_deg(), -66.0);
    const HeightRange range = height_range(region->field);  // of the data's README
    EXPECT_EQ(range.lowest_m, -3.0F);
    EXPECT_EQ(range.highest_m, 146.0F);
    EXPECT_EQ(range.voids, 0U);
}

TEST(Hgt, RealVoidTilesCountAsTheirReadmeSays) {
    struct Case {
        const char* file;
        std::uint64_t voids;
        float lowest, highest;
    };
    for (const Case& tile :
         {Case{"extremes/N44E005.hgt.zip", 4822, 32, 2757}, Case{"extremes/N42E001.hgt.zip", 7652, 349, 3100},
          Case{"extremes/N48W125.hgt.zip", 6483876, -13, 1095}, Case{"extremes/N41E011.hgt.zip", 0, -2, 5}}) {
        const auto file = real_data(tile.file);
        if (!file) GTEST_SKIP() << "needs " << tile.file;
        const auto region = opened(request_for({file->string()}));
        ASSERT_TRUE(region) << tile.file;
        EXPECT_EQ(region->voids, tile.voids) << tile.file;
        EXPECT_EQ(height_range(region->field).lowest_m, tile.lowest) << tile.file;
        EXPECT_EQ(height_range(region->field).highest_m, tile.highest) << tile.file;
    }
}

}  // namespace
}  // namespace oro
