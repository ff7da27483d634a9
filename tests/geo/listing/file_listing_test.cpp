// Every file of a folder, whatever can be opened together; and headers that are kept between calls.
#include "geo/listing/file_listing.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <random>
#include <thread>

#include "core/base/elapsed.h"
#include "geo/sources/hgt_source.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

namespace fs = std::filesystem;
using namespace test;

Raster tiny(double west_deg, double north_deg, double per_deg = 100.0, int side = 4) {
    Raster raster;
    raster.rows = raster.columns = side;
    raster.type = GDT_Int16;
    raster.cell_corners = posts_from(west_deg, north_deg, per_deg);
    return raster;
}

FileListing listed(const RegionRequest& request, const ListingCache& cache = {}) {
    auto listing = list_files(request, cache, {});
    EXPECT_TRUE(listing.ok()) << listing.error().line();
    return listing.ok() ? std::move(listing).value() : FileListing{};
}

const ListedFile& file_named(const FileListing& listing, const std::string& name) {
    static const ListedFile none;
    for (const ListedFile& file : listing.files)
        if (file.path.ends_with(name)) return file;
    ADD_FAILURE() << name << " is not listed";
    return none;
}

// What a file says is as it is now: the same as without any cache.
std::string words_of(const FileListing& listing) {
    std::string words;
    for (const ListedFile& file : listing.files) {
        words += file.path + "|" + file.reason + "|" + file.leave_out + (file.damaged ? "|damaged" : "|");
        if (!file.report) {
            words += "\n";
            continue;
        }
        const SourceReport& r = *file.report;
        words += r.crs + "|" + r.driver + "|" + r.height_unit.name + "|" + r.attribution + "|" +
                 r.horizontal_datum.operation + "|" + std::to_string(r.rows) + "|" +
                 std::to_string(r.columns) + "|" + std::to_string(r.box.west_deg) + "|" +
                 std::to_string(r.box.north_deg) + "|" + std::to_string(r.lat_spacing_deg) + "|" +
                 std::to_string(r.spacing_m) + "\n";
    }
    return words + (listing.error ? listing.error->line() : "");
}

// Times that a later change cannot repeat.
void settle() {
    std::this_thread::sleep_for(std::chrono::milliseconds(80));
}

class Listing : public ::testing::Test {
  protected:
    // Twenty small files, one after the other.
    void write_files(int count = 20) const {
        for (int i = 0; i < count; ++i)
            write_raster(data / ("t" + std::to_string(i) + ".tif"), tiny(8.0 + 0.04 * i, 47.0),
                         [](int r, int c) { return 100 + r + c; });
    }
    [[nodiscard]] RegionRequest request() const { return request_for({data.string()}); }

    fs::path folder = scratch_folder();
    fs::path data = folder / "data";
    ListingCache cache{(folder / "cache").string(), "program 1"};
    void SetUp() override { fs::create_directories(data); }
};

TEST_F(Listing, TellsOfEveryFileWhateverCanBeOpenedTogether) {
    write_raster(data / "a.tif", tiny(8.0, 47.0), [](int, int) { return 1; });
    Raster swiss = tiny(0, 0, 1, 12);
    swiss.crs = "EPSG:2056";
    swiss.cell_corners = {2600000.0, 500.0, 0.0, 1200000.0, 0.0, -500.0};
    write_raster(data / "b_swiss.tif", swiss, [](int, int) { return 2; });
    swiss.crs = "";
    write_raster(data / "c_nowhere.tif", swiss, [](int, int) { return 3; });
    Raster image = tiny(8.0, 47.0);
    image.bands = 3;
    write_raster(data / "d_image.tif", image, [](int, int) { return 4; });
    Raster lidar = tiny(8.0, 47.0, 1e8, 40);
    write_raster(data / "e_fine.tif", lidar, [](int, int) { return 5; });
    std::ofstream(data / "f_broken.tif") << "no raster at all";
    std::ofstream(data / "N46E008.hgt") << "short";
    fs::create_symlink("nowhere", data / "g_link.tif");
    const FileListing listing = listed(request());
    EXPECT_EQ(listing.files.size(), 8U);
    EXPECT_TRUE(file_named(listing, "a.tif").report);
    EXPECT_EQ(file_named(listing, "b_swiss.tif").report->crs, "EPSG:2056 CH1903+ / LV95");
    for (const auto& [name, reason, damaged] : {std::tuple{"c_nowhere.tif", "--source-crs EPSG:CODE", false},
                                                {"d_image.tif", "3 bands", false},
                                                {"f_broken.tif", "cannot be opened as a raster", true},
                                                {"N46E008.hgt", "has 5 bytes", true},
                                                {"g_link.tif", "symbolic link to nothing", true}}) {
        const ListedFile& file = file_named(listing, name);
        EXPECT_FALSE(file.report) << name;
        EXPECT_NE(file.reason.find(reason), std::string::npos) << name << ": " << file.reason;
        EXPECT_EQ(file.damaged, damaged) << name;
        EXPECT_FALSE(file.reason.starts_with(file.path)) << "its name stands before: " << file.reason;
    }
    ASSERT_TRUE(listing.error);
    // Without the damaged ones, the finest file makes the region too large.
    for (const char* name : {"f_broken.tif", "N46E008.hgt", "g_link.tif"}) fs::remove(data / name);
    const FileListing too_large = listed(request());
    ASSERT_TRUE(too_large.error);
    EXPECT_NE(too_large.error->line().find("region too large"), std::string::npos) << too_large.error->line();
    for (const ListedFile& file : too_large.files)
        EXPECT_EQ(!file.leave_out.empty(), file.path.ends_with("e_fine.tif")) << file.path;
    // And without that one there is a region.
    fs::remove(data / "e_fine.tif");
    EXPECT_FALSE(listed(request()).error);
    EXPECT_TRUE(opened(request()));
}

// What would be opened is what the region opens, and the reason is the region's own.
TEST_F(Listing, SaysWhatOpeningSays) {
    write_files(3);
    EXPECT_FALSE(listed(request()).error);
    std::ofstream(data / "broken.tif") << "no raster at all";
    const auto region = test::open_grid(request());
    ASSERT_FALSE(region.ok());
    EXPECT_EQ(listed(request()).error->line(), region.error().line());
}

TEST_F(Listing, HeadersOfTenThousandFilesAreReadOnce) {
    constexpr int files = 10000;
    // One header, placed elsewhere by name: a tile of 3" each.
    const fs::path tile = write_hgt(folder / "tile.hgt", 1201, [](int, int) { return 7; });
    int written = 0;
    for (int lat = -60; lat < 60 && written < files / 2; ++lat)
        for (int lon = -180; lon < 180 && written < files / 2; ++lon, ++written)
            fs::create_hard_link(tile, data / (tile_name(lat, lon) + ".hgt"));
    for (; written < files; ++written)
        write_raster(data / ("t" + std::to_string(written) + ".tif"),
                     tiny(0.03 * (written % 3000), 0.03 * (written / 3000)),
                     [](int r, int c) { return r + c; });
    settle();
    auto start = Clock::now();
    const FileListing first = listed(request(), cache);
    const double first_s = seconds_since(start);
    start = Clock::now();
    const FileListing second = listed(request(), cache);
    const double second_s = seconds_since(start);
    std::printf("10,000 files listed in %.2f s, then in %.2f s\n", first_s, second_s);
    EXPECT_EQ(first.looked_at, files);
    EXPECT_EQ(second.looked_at, 0U);
    EXPECT_EQ(words_of(first), words_of(second));
    EXPECT_EQ(first.files.size(), files);
}

TEST_F(Listing, AFileThatChangedIsReadAgain) {
    write_files();
    settle();
    EXPECT_EQ(listed(request(), cache).looked_at, 20U);
    EXPECT_EQ(listed(request(), cache).looked_at, 0U);
    // In place, with as many bytes, and its time set back: another height unit in the same tag.
    const fs::path changed = data / "t3.tif";
    struct stat before {};
    ASSERT_EQ(stat(changed.c_str(), &before), 0);
    std::string bytes(fs::file_size(changed), '\0');
    std::ifstream(changed, std::ios::binary).read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    // The tie point's longitude, 8.12 less half a cell, as a double.
    const double from = posts_from(8.0 + 0.04 * 3, 47.0, 100.0)[0], to = from + 1.0;
    const std::string was(reinterpret_cast<const char*>(&from), 8), is(reinterpret_cast<const char*>(&to), 8);
    ASSERT_NE(bytes.find(was), std::string::npos);
    bytes.replace(bytes.find(was), 8, is);
    std::fstream(changed, std::ios::binary | std::ios::in | std::ios::out)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    const timespec times[2] = {before.st_atim, before.st_mtim};
    ASSERT_EQ(utimensat(AT_FDCWD, changed.c_str(), times, 0), 0);
    settle();
    const FileListing again = listed(request(), cache);
    EXPECT_EQ(again.looked_at, 1U);
    EXPECT_NEAR(file_named(again, "t3.tif").report->box.west_deg, 9.12, 1e-9);
    EXPECT_EQ(words_of(again), words_of(listed(request())));
}

TEST_F(Listing, ASideCarThatAppearsCounts) {
    write_files();
    settle();
    listed(request(), cache);
    EXPECT_EQ(listed(request(), cache).looked_at, 0U);
    std::ofstream(data / "t5.tif.aux.xml")
        << "<PAMDataset><SRS>EPSG:4267</SRS><PAMRasterBand band=\"1\"><UnitType>ft</UnitType></PAMRasterBand>"
           "</PAMDataset>";
    settle();
    const FileListing with = listed(request(), cache);
    EXPECT_EQ(file_named(with, "t5.tif").report->height_unit.name, "ft");
    EXPECT_EQ(words_of(with), words_of(listed(request())));
    settle();
    EXPECT_EQ(words_of(with), words_of(listed(request(), cache)));
    // ... that changes, and that goes.
    std::ofstream(data / "t5.tif.aux.xml")
        << "<PAMDataset><PAMRasterBand band=\"1\"><UnitType>cm</UnitType></PAMRasterBand></PAMDataset>";
    settle();
    EXPECT_EQ(file_named(listed(request(), cache), "t5.tif").report->height_unit.name, "cm");
    fs::remove(data / "t5.tif.aux.xml");
    settle();
    EXPECT_EQ(words_of(listed(request(), cache)), words_of(listed(request())));
}

TEST_F(Listing, WhatWasToldAndTheProgramHaveAnswersOfTheirOwn) {
    write_files();
    settle();
    listed(request(), cache);
    RegionRequest in_feet = request();
    in_feet.height_unit = "ft";
    EXPECT_EQ(file_named(listed(in_feet, cache), "t1.tif").report->height_unit.name, "ft");
    EXPECT_EQ(file_named(listed(request(), cache), "t1.tif").report->height_unit.name, "m");
    EXPECT_EQ(listed(request(), {cache.folder, "program 2"}).looked_at, 20U);
    EXPECT_EQ(listed(request(), cache).looked_at, 0U);
}

// Any damage: bytes changed, cut, added. The answer stays, and the cache is made anew.
TEST_F(Listing, ADamagedCacheIsIgnored) {
    write_files();
    settle();
    const std::string expected = words_of(listed(request(), cache));
    const fs::path kept = fs::directory_iterator(cache.folder)->path();
    std::string whole(fs::file_size(kept), '\0');
    std::ifstream(kept, std::ios::binary).read(whole.data(), static_cast<std::streamsize>(whole.size()));
    const unsigned seed = std::random_device{}();
    std::printf("seed %u, %zu bytes\n", seed, whole.size());
    std::mt19937 random(seed);
    for (int i = 0; i < 60; ++i) {
        std::string bytes = whole;
        if (i % 3 == 0) bytes.resize(random() % bytes.size());
        if (i % 3 == 1) bytes[random() % bytes.size()] ^= static_cast<char>(1 + random() % 255);
        if (i % 3 == 2) bytes += "x";
        std::ofstream(kept, std::ios::binary | std::ios::trunc) << bytes;
        const FileListing listing = listed(request(), cache);
        ASSERT_EQ(listing.looked_at, 20U) << "seed " << seed << " " << i;
        ASSERT_EQ(words_of(listing), expected) << "seed " << seed << " " << i;
    }
    EXPECT_EQ(listed(request(), cache).looked_at, 0U);
    // Where nothing can be kept, files are listed all the same.
    EXPECT_EQ(words_of(listed(request(), {"/dev/null/none", "program 1"})), expected);
}

}  // namespace
}  // namespace oro
