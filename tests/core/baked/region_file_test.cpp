#include "core/baked/region_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cstring>
#include <limits>

#include "core/baked/file_pages.h"
#include "core/base/checksum.h"
#include "tests/core/baked/made_region_file.h"
#include "tests/support/mended_container.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

TEST(Checksum, IsTheSamePieceByPiece) {
    std::mt19937_64 random(5);
    std::vector<std::byte> bytes(100'000);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    RunningChecksum sum;
    EXPECT_EQ(sum.sum(), xxh64({}));
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t some = std::min<std::size_t>(random() % 5000, bytes.size() - at);
        sum.add(std::span(bytes).subspan(at, some));
        at += some;
    }
    EXPECT_EQ(sum.sum(), xxh64(bytes));
}

TEST(PageOrder, CountsPagesBeyondAnInt) {
    EXPECT_EQ((PageLayout{1 << 24, 1 << 24}.count()), std::uint64_t{1} << 48U);
}

TEST(PageOrder, NumbersLevelByLevelRowByRow) {
    const PageOrder order(made_outline().grid);
    EXPECT_EQ(order.levels(), 3);
    EXPECT_EQ(order.count(), made_pages);  // 3 x 3 + 2 x 2 + 1
    EXPECT_EQ(order.number({1, 2, 0}), 5U);
    EXPECT_EQ(order.number({1, 0, 1}), 11U);
    for (std::uint64_t i = 0; i < order.count(); ++i) EXPECT_EQ(order.number(order.index(i)), i);
    EXPECT_TRUE(order.holds({2, 2, 0}));
    EXPECT_FALSE(order.holds({2, 2, 1}));
    EXPECT_FALSE(order.holds({0, 0, 3}));
    EXPECT_FALSE(order.holds({-1, 0, 0}));
}

TEST(RegionFile, BringsBackWhatWasWritten) {
    const fs::path path = scratch_folder() / "a.oro";
    write_whole(path);
    EXPECT_EQ(names_in(path.parent_path()), Names{"a.oro"});
    const auto file = RegionFile::open(path);
    ASSERT_TRUE(file.ok()) << file.error().line();
    const RegionOutline expected = made_outline();
    const RegionOutline& found = file->outline();
    EXPECT_EQ(region_format::beginning_of(found, file->fingerprint()).chunks,
              region_format::beginning_of(expected, made_fingerprint).chunks);
    EXPECT_EQ(found.description, expected.description);
    EXPECT_EQ(found.grid.lat.first, 47 * 1200);
    EXPECT_EQ(found.undulation.N_m, expected.undulation.N_m);
    EXPECT_EQ(found.undulation.lon.count, 3);
    EXPECT_EQ(found.shape.occluder.radii_m.z, 6356000.0);
    EXPECT_EQ(found.shape.exaggeration, 1.0);
    EXPECT_EQ(found.triangles, expected.triangles);
    EXPECT_EQ(found.voids, 77U);
    EXPECT_EQ(found.lowest_H_m, -12.5F);
    EXPECT_EQ(file->bytes(), fs::file_size(path));
    const auto payload = std::make_unique<PagePayload>();
    for (std::uint64_t number = made_pages; number-- > 0;) {  // not in the order of writing
        const auto page = made_page(file->order(), number);
        const auto record = file->record(file->order().index(number));
        ASSERT_TRUE(record.ok()) << record.error().line();
        EXPECT_TRUE(same(*record, page->record)) << number;
        EXPECT_EQ(record->summary.ecef_from_page, page->record.summary.ecef_from_page);
        EXPECT_EQ(record->quarters[3].largest_error_m, page->record.quarters[3].largest_error_m);
        ASSERT_TRUE(file->payload(file->order().index(number), *payload).ok());
        EXPECT_EQ(std::memcmp(payload.get(), &page->payload, sizeof(PagePayload)), 0) << number;
    }
    EXPECT_EQ(refusal(path), "");
}

TEST(RegionFile, IsRecognised) {
    const fs::path folder = scratch_folder();
    write_whole(folder / "a.oro");
    put(folder / "b.oro", "\x89ORO\r\n\n\n0123456789");
    put(folder / "c.oro", "");
    EXPECT_TRUE(looks_baked(folder / "a.oro"));
    EXPECT_FALSE(looks_baked(folder / "b.oro"));
    EXPECT_FALSE(looks_baked(folder / "c.oro"));
    EXPECT_FALSE(looks_baked(folder));
    EXPECT_FALSE(looks_baked(folder / "none.oro"));
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_FALSE(looks_baked(folder / "pipe"));
    EXPECT_TRUE(says(refusal(folder / "pipe"), "is no plain file"));
    EXPECT_TRUE(says(refusal(folder), "is a folder"));
    EXPECT_TRUE(says(refusal(folder / "none.oro"), "No such file"));
    EXPECT_TRUE(says(refusal(folder / "b.oro"), "is no region file"));
    EXPECT_TRUE(says(refusal(folder / "c.oro"), "is empty"));
}

// Of every kind there was: region files of six versions, clusters, and what joined them.
TEST(RegionFile, OfAnOlderProgramIsRefusedWithOneLine) {
    const fs::path path = scratch_folder() / "a.oro";
    const std::string rest(1000, '\x01');
    for (const std::string& begins : {std::string("\x89ORO\r\n\x1a\n"), std::string("\x89ORC\r\n\x1a\n"),
                                      std::string("OROGRIDS"), std::string("OROCLUST")}) {
        put(path, begins + rest);
        EXPECT_TRUE(looks_baked(path));
        EXPECT_EQ(
            refusal(path),
            path.string() +
                ": was baked by an older Orograph: bake it again (orograph bake PATH... --out FILE.oro)");
    }
}

// A file with one bit changed, without writing the whole file again.
std::string refusal_with_flip(const fs::path& path, std::uint64_t byte, unsigned bit) {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    const auto change = [&] {
        char c = 0;
        file.seekg(static_cast<std::streamoff>(byte));
        file.get(c);
        c = static_cast<char>(static_cast<unsigned char>(c) ^ (1U << bit));
        file.seekp(static_cast<std::streamoff>(byte));
        file.put(c);
        file.flush();
    };
    change();
    std::string said = refusal(path);
    change();
    return said;
}

TEST(RegionFile, RefusesEveryFlippedBit) {
    const fs::path path = scratch_folder() / "a.oro";
    write_whole(path);
    const std::uint64_t size = fs::file_size(path);
    const auto expect_refused = [&](std::uint64_t byte, unsigned bit) {
        const std::string said = refusal_with_flip(path, byte, bit);
        ASSERT_TRUE(says(said, path.string())) << "byte " << byte << " bit " << bit << ": " << said;
        ASSERT_TRUE(says(said, "byte ")) << "byte " << byte << " bit " << bit << ": " << said;
    };
    for (std::uint64_t byte = 0; byte < made_description_at; ++byte) {
        for (unsigned bit = 0; bit < 8; ++bit) expect_refused(byte, bit);
    }
    const unsigned seed = 99;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    for (int i = 0; i < 3000; ++i) {
        // Half of them where the many small parts are.
        const std::uint64_t byte = random() % (i % 2 == 0 ? size : made_heights_at);
        expect_refused(byte, static_cast<unsigned>(random() % 8));
    }
    EXPECT_EQ(refusal(path), "");
}

TEST(RegionFile, SaysWhatIsDamagedAndWhere) {
    const fs::path path = scratch_folder() / "a.oro";
    write_whole(path);
    EXPECT_TRUE(says(refusal_with_flip(path, 0, 0), "is no region file"));
    EXPECT_TRUE(says(refusal_with_flip(path, 8, 3),
                     "is of version 9 of the region format (byte 8), this program reads version 1"));
    EXPECT_TRUE(says(refusal_with_flip(path, 33, 0), "is damaged at byte 0: the header has checksum"));
    const auto damaged = [&](std::uint64_t byte, const std::string& what) {
        return says(refusal_with_flip(path, byte + 3, 0),
                    "is damaged at byte " + std::to_string(byte) + ": " + what);
    };
    EXPECT_TRUE(damaged(made_outline_at, "the outline has checksum"));
    EXPECT_TRUE(damaged(made_description_at, "the description has checksum"));
    EXPECT_TRUE(damaged(made_undulation_at, "the undulation has checksum"));
    EXPECT_TRUE(damaged(made_records_at + region_format::record_bytes,
                        "the record of the page at level 0 row 0 column 1 has checksum"));
    EXPECT_TRUE(damaged(made_heights_at, "the payload of the page at level 0 row 0 column 0 has checksum"));
}

TEST(RegionFile, RefusesEveryTruncationAndWhatIsLonger) {
    const fs::path path = scratch_folder() / "a.oro";
    write_whole(path);
    const std::string whole = content(path);
    std::vector<std::size_t> lengths;
    for (std::size_t length = 0; length < 300; ++length) lengths.push_back(length);
    for (std::size_t length = 300; length < whole.size(); length += 997) lengths.push_back(length);
    lengths.push_back(whole.size() - 1);
    for (const std::size_t length : lengths) {
        put(path, whole.substr(0, length));
        const auto file = RegionFile::open(path);
        ASSERT_FALSE(file.ok()) << length;
        if (length >= 8) {
            ASSERT_TRUE(says(file.error().what, "is cut off at byte " + std::to_string(length)))
                << file.error().line();
        }
    }
    put(path, whole + "x");
    EXPECT_TRUE(says(refusal(path), "goes on after its end at byte " + std::to_string(whole.size())));
    put(path, whole);
    EXPECT_EQ(refusal(path), "");
}

// The file with one number changed and all checksums right again.
template <class Number>
std::string refusal_with(const fs::path& path, const std::string& whole, std::size_t byte, Number number,
                         bool mends_chunks = true) {
    std::string changed = whole;
    set_number(changed, byte, number);
    put(path, mended(changed, mends_chunks));
    return refusal(path);
}

std::string at(std::size_t byte) {
    return "is damaged at byte " + std::to_string(byte) + ": ";
}

TEST(RegionFile, RefusesTablesThatNoFileHas) {
    const fs::path path = scratch_folder() / "a.oro";
    write_whole(path);
    const std::string whole = content(path);
    const auto with = [&](std::size_t byte, auto number) { return refusal_with(path, whole, byte, number); };
    EXPECT_EQ(with(12, std::uint32_t{5}), "");
    EXPECT_TRUE(says(with(12, std::uint32_t{0}), at(12)));
    EXPECT_TRUE(says(with(12, std::uint32_t{70'000}), at(12)));
    EXPECT_TRUE(says(with(12, std::uint32_t{60'000}), "is cut off at byte "));
    EXPECT_TRUE(says(with(16, std::uint64_t{0}), "is unfinished"));
    EXPECT_TRUE(says(with(16, ~std::uint64_t{0}), "is cut off at byte "));
    EXPECT_TRUE(says(with(16, std::uint64_t{300}), "goes on after its end at byte 300"));
    EXPECT_TRUE(
        says(with(line_of(0), std::uint32_t{7}), at(line_of(0)) + "a chunk of a type that no file has"));
    EXPECT_TRUE(says(with(line_of(0) + 4, std::uint32_t{1}), "lacks the outline of grid 0"));
    EXPECT_TRUE(says(with(line_of(1), static_cast<std::uint32_t>(ChunkType::outline)), "has a chunk twice"));
    EXPECT_TRUE(says(with(line_of(0) + 8, ~std::uint64_t{0}), at(line_of(0) + 8)));
    EXPECT_TRUE(says(with(line_of(0) + 16, std::uint64_t{185}), at(line_of(1) + 8)));
    EXPECT_TRUE(says(with(line_of(1) + 16, ~std::uint64_t{0}), at(line_of(1) + 16)));
    EXPECT_TRUE(says(with(line_of(4) + 16, std::uint64_t{5}), at(16)));
    EXPECT_TRUE(says(refusal_with(path, whole, line_of(1) + 24, std::uint64_t{0}, false),
                     at(made_description_at) + "the description has checksum"));
    // Of what is read page by page: found where all is read.
    EXPECT_TRUE(says(refusal_with(path, whole, line_of(3) + 24, std::uint64_t{0}, false),
                     at(made_records_at) + "the table of pages has checksum"));
    EXPECT_TRUE(says(refusal_with(path, whole, line_of(4) + 24, std::uint64_t{0}, false),
                     at(made_heights_at) + "the chunk of heights has checksum"));
}

TEST(RegionFile, RefusesNumbersThatNoRegionHas) {
    const fs::path path = scratch_folder() / "a.oro";
    write_whole(path);
    const std::string whole = content(path);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    constexpr std::size_t lat = made_outline_at + 8, lon = lat + 32, undulation = lon + 32,
                          radii = made_outline_at + 136, heights = radii + 24, voids = heights + 8;
    const auto with = [&](std::size_t byte, auto number) { return refusal_with(path, whole, byte, number); };
    EXPECT_TRUE(says(with(lat, nan), at(lat)));
    EXPECT_TRUE(says(with(lat, -1200.0), at(lat)));
    EXPECT_TRUE(says(with(lat, 0.0), at(lat)));
    EXPECT_TRUE(says(with(lat + 8, nan), at(lat + 8)));
    EXPECT_TRUE(says(with(lat + 16, std::int64_t{1} << 62), at(lat + 16)));
    EXPECT_TRUE(says(with(lat + 16, std::int64_t{91 * 1200}), at(lat)));
    EXPECT_TRUE(says(with(lat + 24, 1), at(lat + 24)));
    EXPECT_TRUE(says(with(lat + 28, 0), at(lat + 28)));
    EXPECT_TRUE(says(with(lat + 28, -1), at(lat + 28)));
    EXPECT_TRUE(says(with(lat + 28, 0x7fffffff), at(lat + 28)));
    EXPECT_TRUE(says(with(lon + 28, 360 * 1200 + 2), at(lon)));
    EXPECT_TRUE(says(with(lon + 28, 100'000), at(made_records_at) + "records of pages in "));
    EXPECT_TRUE(says(with(undulation + 28, 0), at(undulation + 28)));
    EXPECT_TRUE(says(with(undulation + 28, 3), at(undulation + 28) + "bytes of undulation 24, expected 36"));
    EXPECT_TRUE(says(with(radii, std::numeric_limits<double>::infinity()), at(radii)));
    EXPECT_TRUE(says(with(heights, 5000.0F), at(heights + 4)));
    EXPECT_TRUE(says(with(heights + 4, std::numeric_limits<float>::infinity()), at(heights + 4)));
    EXPECT_TRUE(says(with(voids, std::uint64_t{300 * 290 + 1}), at(voids)));
    EXPECT_TRUE(says(with(voids + 8, std::uint64_t{2 * 299 * 289 + 1}), at(voids + 8)));
    EXPECT_TRUE(says(with(made_undulation_at + 8, std::numeric_limits<float>::quiet_NaN()),
                     at(made_undulation_at + 8)));
    EXPECT_EQ(with(made_outline_at, std::uint64_t{5}), "");  // another fingerprint
}

// A file that is written into while it is open may hold whole pages of another region.
TEST(RegionFile, TellsThatItWasChangedWhileItIsOpen) {
    const fs::path path = scratch_folder() / "a.oro";
    write_whole(path);
    const std::string first = content(path);
    const auto file = RegionFile::open(path);
    ASSERT_TRUE(file.ok());
    const auto payload = std::make_unique<PagePayload>();
    ASSERT_TRUE(file->payload({1, 1, 0}, *payload).ok());
    refusal_with(path, first, made_outline_at,
                 std::uint64_t{5});  // another fingerprint, the pages as whole as before
    for (const Result<void>& read : {file->payload({1, 1, 0}, *payload), file->verify()}) {
        ASSERT_FALSE(read.ok());
        EXPECT_TRUE(says(read.error().line(), path.string() + ": was changed at byte 0"))
            << read.error().line();
    }
    EXPECT_FALSE(file->record({1, 1, 0}).ok());
    put(path, first);
    EXPECT_TRUE(file->verify().ok());
    // One that takes its name does no harm.
    write_whole(path, true);
    EXPECT_TRUE(file->verify().ok());
}

// The most memory that this process has had, bytes.
std::uint64_t peak_memory() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
}

// A file of few bytes with holes, whose header is right and states sizes of gigabytes.
void write_with_holes(const fs::path& path, const RegionOutline& outline, std::uint64_t nodes) {
    const auto numbers =
        region_format::numbers_to_bytes(region_format::numbers_of(outline, made_fingerprint));
    const std::uint64_t pages = PageOrder(outline.grid).count();
    ChunkTable table{0,
                     {{ChunkType::outline, 0, 0, numbers.size(), xxh64(numbers)},
                      {ChunkType::description, 0, 0, outline.description.size(),
                       xxh64(std::as_bytes(std::span(outline.description)))},
                      {ChunkType::undulation, 0, 0, nodes * sizeof(float), nodes == 0 ? xxh64({}) : 0},
                      {ChunkType::pages, 0, 0, pages * region_format::record_bytes, 0},
                      {ChunkType::heights, 0, 0, pages, 0}}};
    table.file_bytes = table.place();
    const auto text = [](const std::vector<std::byte>& bytes) {
        return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    };
    put(path, text(table.to_bytes()) + text(numbers) + outline.description);
    fs::resize_file(path, table.file_bytes);
}

TEST(RegionFile, TakesNoMemoryForHoles) {
    const fs::path path = scratch_folder() / "a.oro";
    constexpr std::uint64_t little = 64U << 20U;
    RegionOutline outline = made_outline();
    // 48 million nodes, 193 MB.
    outline.undulation.lat = {100.0, 0.0, 7000, -1, 6900};
    outline.undulation.lon = {100.0, 0.0, 0, +1, 7000};
    write_with_holes(path, outline, 6900ULL * 7000ULL);
    std::uint64_t before = peak_memory();
    EXPECT_TRUE(says(refusal(path), "the undulation has checksum"));
    EXPECT_LT(peak_memory() - before, little);
    // 40,000 x 40,000 posts, 6.4 GB.
    outline = made_outline();
    outline.undulation = {};
    outline.grid.lat = {1200.0, 0.0, 47 * 1200, -1, 40000};
    outline.grid.lon = {1200.0, 0.0, 8 * 1200, +1, 40000};
    write_with_holes(path, outline, 0);
    before = peak_memory();
    EXPECT_TRUE(says(refusal(path), "the record of the page at level 9 row 0 column 0 has checksum"))
        << refusal(path);
    EXPECT_LT(peak_memory() - before, little);
}

// The same with a last page that is right: then it opens, and what wants all posts in memory does not get it.
TEST(RegionFile, TakesNoMemoryForPostsThatAreNotThere) {
    const fs::path path = scratch_folder() / "a.oro";
    RegionOutline outline = made_outline();
    outline.undulation = {};
    outline.grid.lat = {1200.0, 0.0, 47 * 1200, -1, 40000};
    outline.grid.lon = {1200.0, 0.0, 8 * 1200, +1, 40000};
    write_with_holes(path, outline, 0);
    const PageOrder order(outline.grid);
    const auto page = made_page(order, 0);
    page->record.summary.index = order.index(order.count() - 1);
    const std::uint64_t size = fs::file_size(path);
    const auto record = region_format::record_to_bytes({page->record, order.count() - 1, 1, 0});
    {
        std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
        file.seekp(static_cast<std::streamoff>(size - order.count() - record.size()));
        file.write(reinterpret_cast<const char*>(record.data()), static_cast<std::streamsize>(record.size()));
    }
    const auto file = RegionFile::open(path);
    ASSERT_TRUE(file.ok()) << file.error().line();
    const std::uint64_t before = peak_memory();
    const auto field = field_in_memory(*file);
    ASSERT_FALSE(field.ok());
    EXPECT_TRUE(says(field.error().line(), "the record of the page at level 0 row 0 column 0"));
    EXPECT_LT(peak_memory() - before, 64U << 20U);
}

TEST(RegionFile, SurvivesRandomHeaders) {
    const fs::path path = scratch_folder() / "a.oro";
    write_whole(path);
    const std::string whole = content(path);
    const unsigned seed = 31;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    int refused = 0;
    for (int i = 0; i < 1000; ++i) {
        const std::size_t byte = 12 + 4 * (random() % ((made_description_at - 12) / 4));
        const auto number = static_cast<std::uint32_t>(random() % 2 == 0 ? random() : random() % 512);
        refused += refusal_with(path, whole, byte, number).empty() ? 0 : 1;
    }
    EXPECT_GE(refused, 500);
}

}  // namespace
}  // namespace oro
