#include "geo/files/source_paths.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "tests/geo/vectors/written_zip.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

void expect_error(const std::string& path, ErrorKind kind, const std::string& says) {
    const auto region = test::open_grid(request_for({path}));
    ASSERT_FALSE(region.ok()) << path;
    EXPECT_EQ(region.error().kind, kind) << region.error().line();
    EXPECT_NE(region.error().line().find(path), std::string::npos) << region.error().line();
    EXPECT_NE(region.error().line().find(says), std::string::npos) << region.error().line();
    EXPECT_EQ(region.error().line().find('\n'), std::string::npos) << region.error().line();
}

TEST(SourcePaths, NothingThere) {
    const fs::path folder = scratch_folder();
    expect_error((folder / "missing.hgt").string(), ErrorKind::failed, "no such file");
    expect_error("/vsicurl/http://localhost/N46E008.hgt", ErrorKind::usage, "lies on a network");
    fs::create_symlink(folder / "gone.hgt", folder / "N46E008.hgt");
    expect_error((folder / "N46E008.hgt").string(), ErrorKind::failed, "symbolic link to nothing");
    EXPECT_FALSE(test::open_grid(request_for({folder.string()})).ok());
    EXPECT_FALSE(test::open_grid(request_for({})).ok());
}

TEST(SourcePaths, FoldersWithoutData) {
    const fs::path folder = scratch_folder();
    expect_error(folder.string(), ErrorKind::no_data, "no elevation data");
    std::ofstream(folder / "readme.txt") << "nothing here\n";
    fs::create_directory(folder / "N46E008.hgt");
    expect_error(folder.string(), ErrorKind::no_data, "no elevation data");
    expect_error((folder / "N46E008.hgt").string(), ErrorKind::no_data, "no elevation data");
    write_bytes("/vsizip/" + (folder / "empty.zip").string() + "/readme.txt", {'x'});
    expect_error((folder / "empty.zip").string(), ErrorKind::no_data, "no elevation data");
}

TEST(SourcePaths, UnreadableFile) {
    if (geteuid() == 0) GTEST_SKIP() << "needs an ordinary user: root reads everything";
    const fs::path file = scratch_folder() / "N46E008.hgt";
    write_hgt(file, 1201, [](int, int) { return 1; });
    fs::permissions(file, fs::perms::none);
    expect_error(file.string(), ErrorKind::failed, "cannot be read");
}

TEST(SourcePaths, EntriesThatCannotBeUnpackedHaveALine) {
    const auto zip = [](const char* name, std::uint16_t flags, std::uint16_t method) {
        ZipEntry tile{"N46E008.hgt", std::string(2 * 1201 * 1201, '\1')};
        tile.flags = flags, tile.method = method;
        return written_zip(name, {{"readme.txt", "x"}, tile});
    };
    expect_error(zip("locked.zip", 1, 8), ErrorKind::failed,
                 "locked.zip/N46E008.hgt: is locked with a password: unpack it, and name the file");
    expect_error(zip("rare.zip", 0, 9), ErrorKind::failed,
                 "is packed by Deflate64, and only Deflate is read: unpack it, and name the file");
    expect_error(zip("rare.zip", 0, 77), ErrorKind::failed,
                 "is packed by method 77, and only Deflate is read");
    EXPECT_TRUE(test::open_grid(request_for({zip("whole.zip", 0, 0)})).ok());
    // Bytes that are no Deflate.
    expect_error(zip("broken.zip", 0, 8), ErrorKind::failed, "broken.zip/N46E008.hgt: ");
    const auto broken = test::open_grid(request_for({zip("broken.zip", 0, 8)}));
    EXPECT_EQ(broken.error().line().find(".cpp"), std::string::npos) << broken.error().line();
}

TEST(SourcePaths, TextFileCalledTif) {
    const fs::path folder = scratch_folder();
    std::ofstream(folder / "dem.tif") << "This is no raster.\n";
    expect_error((folder / "dem.tif").string(), ErrorKind::failed, "cannot be opened as a raster");
    // In a folder, too: it may be what a server sent instead of a tile.
    const auto region = test::open_grid(request_for({folder.string()}));
    ASSERT_FALSE(region.ok());
    EXPECT_EQ(region.error().kind, ErrorKind::failed);
    EXPECT_NE(region.error().line().find("dem.tif"), std::string::npos) << region.error().line();
}

// Endings that other things have, too: what is no raster at all is passed over and named.
TEST(SourcePaths, OtherThingsWithEndingsOfRasters) {
    const fs::path folder = scratch_folder();
    write_hgt(folder / "N46E007.hgt", 1201, [](int, int) { return 7; });
    for (const char* name : {"signature.asc", "disk.img", "cdl.nc"})
        std::ofstream(folder / name) << "something else\n";
    const auto region = opened(request_for({folder.string()}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->notes.size(), 3U);
    for (const char* name : {"signature.asc", "disk.img", "cdl.nc"}) {
        EXPECT_TRUE(std::ranges::any_of(region->notes, [&](const std::string& note) {
            return note.find(name) != std::string::npos;
        })) << name;
        expect_error((folder / name).string(), ErrorKind::failed, "accepted format");
    }
}

TEST(SourcePaths, ArchiveThatIsNone) {
    const fs::path folder = scratch_folder();
    std::ofstream(folder / "tiles.zip") << "This is no archive, whatever its name says.\n";
    expect_error((folder / "tiles.zip").string(), ErrorKind::failed, "archive");
    std::ofstream(folder / "N46E008.hgt.gz") << "This is not packed, whatever its name says.\n";
    EXPECT_FALSE(test::open_grid(request_for({(folder / "N46E008.hgt.gz").string()})).ok());
}

TEST(SourcePaths, LibrariesStayOffStandardError) {
    const fs::path folder = scratch_folder();
    std::ofstream(folder / "dem.tif") << "II*\0 and then nonsense that only starts like a TIFF";
    std::ofstream(folder / "tiles.zip") << "no archive";
    std::ofstream(folder / "N46E008.hgt.gz") << "not packed, and long enough for a trailer";
    std::ofstream(folder / "dem.vrt")
        << "<VRTDataset rasterXSize=\"5\" rasterYSize=\"5\"><SRS>EPSG:999999</SRS></VRTDataset>";
    std::ofstream(folder / "dem.asc") << "ncols 4\nnrows 4\nxllcorner 1\nyllcorner 2\ncellsize 1\n1 2 3\n";
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    for (const char* name : {"dem.tif", "tiles.zip", "N46E008.hgt.gz", "dem.vrt", "dem.asc", ""})
        EXPECT_FALSE(test::open_grid(request_for({(folder / name).string()})).ok()) << name;
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(SourcePaths, OrderIsByNameAndFilesCountOnce) {
    const fs::path folder = scratch_folder();
    fs::create_directories(folder / "b");
    for (const char* name : {"b/N46E008.hgt", "N47E008.hgt", "a.TIF", "x.vrt", "ignored.png"})
        std::ofstream(folder / name) << "x";
    const auto found =
        find_sources({folder.string(), (folder / "N47E008.hgt").string(), (folder / "b").string()});
    ASSERT_TRUE(found.ok()) << found.error().line();
    std::vector<std::string> names;
    for (const SourcePath& path : *found) names.push_back(path.name);
    EXPECT_EQ(names, (std::vector<std::string>{"N46E008.hgt", "N47E008.hgt", "a.TIF", "x.vrt"}));
    EXPECT_TRUE((*found)[1].named);
    EXPECT_FALSE((*found)[0].named);
}

TEST(SourcePaths, OneTileOfThousandsOpensWithoutReadingTheOthers) {
    // Tiles outside the box are never opened: these have no content at all.
    const fs::path folder = scratch_folder();
    for (int lat = 0; lat < 60; ++lat) {
        for (int lon = 10; lon < 60; ++lon)
            std::ofstream(folder / ("N" + std::string(lat < 10 ? "0" : "") + std::to_string(lat) + "E0" +
                                    std::to_string(lon) + ".hgt"));
    }
    write_hgt(folder / "N46E008.hgt", 1201, [](int, int) { return 7; });
    RegionRequest request = request_for({folder.string()});
    request.box = BoundingBox{8, 46, 9, 47};
    std::string reason;
    const auto region = opened(request, &reason);
    ASSERT_TRUE(region) << reason;
    EXPECT_EQ(region->sources.size(), 1U);
}

}  // namespace
}  // namespace oro
