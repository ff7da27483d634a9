// Archives that are cut, empty or none: errors wherever they lie, for a missing tile is no way to hear of it.
#include "geo/files/archive_entries.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>

#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void put(const fs::path& file, const std::string& content) {
    std::ofstream(file, std::ios::binary) << content;
}

// One file in a .tar, with the two empty blocks that end it.
std::string tar_of(const std::string& name, const std::vector<unsigned char>& content) {
    std::string header(512, '\0');
    header.replace(0, name.size(), name);
    for (const std::size_t place : {100U, 108U, 116U}) header.replace(place, 7, "0000644");
    header.replace(136, 11, "00000000000");
    std::array<char, 12> size{};
    std::snprintf(size.data(), size.size(), "%011zo", content.size());
    header.replace(124, 11, size.data());
    header.replace(148, 8, "        ");
    header[156] = '0';
    header.replace(257, 8,
                   std::string("ustar\0"
                               "00",
                               8));
    unsigned sum = 0;
    for (const char c : header) sum += static_cast<unsigned char>(c);
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "%06o", sum);
    header.replace(148, 7, std::string(text.data(), 7));
    std::string tar = header + std::string(content.begin(), content.end());
    tar.resize((tar.size() + 511) / 512 * 512 + 1024);
    return tar;
}

// A folder with a sound tile, and beside it the archive of another.
class DamagedArchive : public testing::Test {
  protected:
    DamagedArchive() {
        write_hgt(folder / "N46E007.hgt", 1201, [](int, int) { return 7; });
    }

    // The archive must open, then fail for each damaged content, named directly and in the folder.
    void expect_errors(const std::string& name, const std::vector<std::string>& damaged) const {
        const fs::path archive = folder / name;
        std::string reason;
        const auto whole = opened(request_for({folder.string()}), &reason);
        ASSERT_TRUE(whole) << reason;
        EXPECT_EQ(whole->sources.size(), 2U) << name;
        for (const std::string& content : damaged) {
            put(archive, content);
            for (const std::string& path : {archive.string(), folder.string()}) {
                const auto region = test::open_grid(request_for({path}));
                ASSERT_FALSE(region.ok()) << name << " of " << content.size() << " bytes in " << path;
                EXPECT_EQ(region.error().kind, ErrorKind::failed);
                EXPECT_NE(region.error().line().find(name), std::string::npos) << region.error().line();
            }
        }
        fs::remove(archive);
    }

    // Its first bytes: none, few, about half, nearly all.
    static std::vector<std::string> cuts_of(const std::string& content) {
        std::vector<std::string> cuts;
        for (std::size_t part = 0; part < 16; ++part)
            cuts.push_back(content.substr(0, content.size() * part / 16));
        for (const std::size_t lost : {1U, 2U, 21U, 22U, 23U, 60U})
            cuts.push_back(content.substr(0, content.size() - lost));
        return cuts;
    }

    const fs::path folder = scratch_folder();
    const std::vector<unsigned char> tile =
        hgt_bytes(1201, [](int r, int c) { return (r * 31 + c * 17) % 3000; });
};

TEST_F(DamagedArchive, CutZip) {
    write_bytes("/vsizip/" + (folder / "b.zip").string() + "/N46E008.hgt", tile);
    expect_errors("b.zip", cuts_of(content_of(folder / "b.zip")));
}

TEST_F(DamagedArchive, ZipWithoutEntriesAndErrorPages) {
    write_bytes("/vsizip/" + (folder / "b.zip").string() + "/N46E008.hgt", tile);
    expect_errors("b.zip", {"PK\5\6" + std::string(18, '\0'), "<html><body>404 Not Found</body></html>\n",
                            std::string(100000, ' ')});
}

TEST_F(DamagedArchive, ZipWhoseListIsDamaged) {
    write_bytes("/vsizip/" + (folder / "b.zip").string() + "/N46E008.hgt", tile);
    const std::string whole = content_of(folder / "b.zip");
    const std::size_t list = whole.rfind("PK\1\2"), end = whole.rfind("PK\5\6");
    std::vector<std::string> damaged(3, whole);
    damaged[0][list] = 'p';          // no entry there
    damaged[1][list + 29] = '\x7f';  // a name longer than the list
    damaged[2][end + 10] = '\2';     // one entry more than there are
    // Nothing before the list: the front is missing.
    damaged.push_back(whole.substr(list));
    expect_errors("b.zip", damaged);
}

// What is unpacked at once is what GDAL unpacks, or nothing: each byte of the packed entry and of its headers
// is changed in turn, many of them, and the archive cut.
TEST_F(DamagedArchive, UnpacksAtOnceWhatIsSound) {
    const std::string archive = (folder / "b.zip").string(), name = "N46E008.hgt";
    write_bytes("/vsizip/" + archive + "/" + name, tile);
    const std::string whole = content_of(archive);
    EXPECT_EQ(unpacked_at_once(archive, name, tile.size()), tile);
    EXPECT_FALSE(unpacked_at_once(archive, "N46E009.hgt", tile.size()));
    EXPECT_FALSE(unpacked_at_once(archive, name, tile.size() - 2));
    EXPECT_FALSE(unpacked_at_once((folder / "none.zip").string(), name, tile.size()));
    // What stands before an archive moves its places.
    put(archive, std::string(1000, '#') + whole);
    EXPECT_EQ(unpacked_at_once(archive, name, tile.size()), tile);
    for (const std::string& cut : cuts_of(whole)) {
        put(archive, cut);
        EXPECT_FALSE(unpacked_at_once(archive, name, tile.size())) << cut.size();
    }
    std::size_t refused = 0;
    for (std::size_t at = 0; at < whole.size(); at += at < 60 || at + 160 > whole.size() ? 1 : 97) {
        std::string changed = whole;
        changed[at] ^= '\x21';
        put(archive, changed);
        const auto found = unpacked_at_once(archive, name, tile.size());
        EXPECT_TRUE(!found || *found == tile) << "byte " << at;
        refused += !found;
    }
    EXPECT_GT(refused, 30U);
    // One name twice: GDAL knows which.
    fs::remove(archive);
    write_bytes("/vsizip/" + archive + "/" + name, tile);
    const std::string one = content_of(archive);
    const std::size_t list = one.rfind("PK\1\2"), end = one.rfind("PK\5\6");
    std::string twice = one.substr(0, end) + one.substr(list, end - list) + one.substr(end);
    const std::size_t tail = twice.rfind("PK\5\6");
    twice[tail + 8] = twice[tail + 10] = '\2';
    const auto bytes = static_cast<std::uint32_t>(2 * (end - list));
    for (unsigned i = 0; i < 4; ++i) twice[tail + 12 + i] = static_cast<char>(bytes >> (8 * i) & 255U);
    put(archive, twice);
    EXPECT_FALSE(unpacked_at_once(archive, name, tile.size()));
}

TEST_F(DamagedArchive, CutTar) {
    const std::string tar = tar_of("N46E008.hgt", tile);
    put(folder / "b.tar", tar);
    // The last of its bytes are filling: what counts ends with the tile and one empty block.
    std::vector<std::string> cuts;
    for (std::size_t part = 0; part < 16; ++part)
        cuts.push_back(tar.substr(0, (tar.size() - 1024) * part / 16));
    cuts.push_back(tar.substr(0, tar.size() - 1024));
    cuts.push_back("<html><body>404 Not Found</body></html>\n");
    cuts.push_back(std::string(10240, '\0'));
    expect_errors("b.tar", cuts);
}

TEST_F(DamagedArchive, CutOrChangedTarGz) {
    for (const char* name : {"b.tar.gz", "b.tgz"}) {
        const std::string tar = tar_of("N46E008.hgt", tile);
        write_bytes("/vsigzip/" + (folder / name).string(), {tar.begin(), tar.end()});
        const std::string whole = content_of(folder / name);
        auto damaged = cuts_of(whole);
        damaged.push_back(whole);
        damaged.back()[whole.size() / 2] ^= '\x11';
        expect_errors(name, damaged);
    }
}

TEST_F(DamagedArchive, NamesOfEntriesAreThoseThatGdalOpens) {
    const std::string deep = "a folder/" + std::string(120, 'x') + "/N46E008.hgt";
    write_bytes("/vsizip/" + (folder / "b.zip").string() + "/" + deep, tile);
    expect_errors("b.zip", {});
    // GDAL writes such a name twice: in an old encoding, and in UTF-8.
    const std::string high = (folder / "c.zip").string();
    write_bytes("/vsizip/" + high + "/Höhe/N46E008.hgt", tile);
    const auto entries = archive_entries(high, high, ArchiveKind::zip);
    ASSERT_TRUE(entries.ok()) << entries.error().line();
    EXPECT_EQ(entries->back().name, "Höhe/N46E008.hgt");
    expect_errors("c.zip", {});
    put(folder / "b.tar", tar_of("./sub/N46E008.hgt", tile));
    expect_errors("b.tar", {});
    const auto found = archive_entries((folder / "no.zip").string(), "no.zip", ArchiveKind::zip);
    ASSERT_FALSE(found.ok());
    EXPECT_NE(found.error().line().find("No such file"), std::string::npos) << found.error().line();
}

// However few files may be open: two tiles, or an error that says so.
TEST_F(DamagedArchive, TooManyOpenFiles) {
    write_bytes("/vsizip/" + (folder / "b.zip").string() + "/N46E008.hgt", tile);
    ASSERT_TRUE(test::open_grid(request_for({folder.string()})).ok());
    rlimit before{};
    getrlimit(RLIMIT_NOFILE, &before);
    const int first_free = open("/dev/null", O_RDONLY);
    close(first_free);
    int refused = 0;
    for (int more = 0; more < 8; ++more) {
        rlimit few = before;
        few.rlim_cur = static_cast<rlim_t>(first_free + more);
        setrlimit(RLIMIT_NOFILE, &few);
        const auto region = test::open_grid(request_for({folder.string()}));
        setrlimit(RLIMIT_NOFILE, &before);
        if (region.ok()) {
            EXPECT_EQ(region->sources.size(), 2U) << more;
            EXPECT_NE(region->geoid.find("EGM96"), std::string::npos) << region->geoid;
            continue;
        }
        ++refused;
        EXPECT_NE(region.error().line().find("Too many open files"), std::string::npos)
            << region.error().line();
    }
    EXPECT_GT(refused, 0);
    EXPECT_LT(refused, 8);
}

// What has no elevation in it is passed over in a folder, as before.
TEST_F(DamagedArchive, SoundArchiveOfOtherThings) {
    write_bytes("/vsizip/" + (folder / "papers.zip").string() + "/readme.txt", {'x'});
    std::string reason;
    ASSERT_TRUE(opened(request_for({folder.string()}), &reason)) << reason;
}

}  // namespace
}  // namespace oro
