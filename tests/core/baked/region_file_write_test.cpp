// Writing a region file, broken off and gone on with.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <cstring>
#include <limits>
#include <thread>

#include "tests/core/baked/made_region_file.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

TEST(RegionFileWriter, NamesTheFileOnlyInFinish) {
    const fs::path folder = scratch_folder();
    auto writer = begin(folder / "a.oro");
    ASSERT_TRUE(writer.ok()) << writer.error().line();
    EXPECT_EQ(names_in(folder), (Names{"a.oro.partial", "a.oro.partial-stitched"}));
    ASSERT_TRUE(append_until(*writer, made_pages - 1).ok());
    const auto early = writer->finish();
    ASSERT_FALSE(early.ok());
    EXPECT_TRUE(says(early.error().what, "has 13 pages, expected 14")) << early.error().line();
    EXPECT_FALSE(fs::exists(folder / "a.oro"));
    EXPECT_TRUE(says(refusal(folder / "a.oro.partial"), "is unfinished"));
    ASSERT_TRUE(append_until(*writer, made_pages).ok());
    EXPECT_FALSE(fs::exists(folder / "a.oro"));
    ASSERT_TRUE(writer->finish().ok());
    EXPECT_EQ(names_in(folder), Names{"a.oro"});
}

TEST(RegionFileWriter, LeavesAnExistingFileAlone) {
    const fs::path path = scratch_folder() / "a.oro";
    put(path, "old");
    const auto refused = begin(path);
    ASSERT_FALSE(refused.ok());
    EXPECT_TRUE(says(refused.error().what, "exists already"));
    EXPECT_EQ(names_in(path.parent_path()), Names{"a.oro"});
    {
        auto writer = begin(path, true);
        ASSERT_TRUE(writer.ok());
        ASSERT_TRUE(append_until(*writer, 3).ok());
    }
    EXPECT_EQ(content(path), "old");
    fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write);
    write_whole(path, true);
    EXPECT_EQ(refusal(path), "");
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST(RegionFileWriter, LeavesAFileAloneThatAppearsMeanwhile) {
    const fs::path path = scratch_folder() / "a.oro";
    {
        auto writer = begin(path);
        ASSERT_TRUE(writer.ok());
        ASSERT_TRUE(append_until(*writer, made_pages).ok());
        put(path, "other");
        const auto finished = writer->finish();
        ASSERT_FALSE(finished.ok());
        EXPECT_TRUE(says(finished.error().what, "appeared while it was being written"));
    }
    EXPECT_EQ(content(path), "other");
    auto again = begin(path, true);  // nothing is lost: the name alone was missing
    ASSERT_TRUE(again.ok());
    EXPECT_EQ(again->pages_done(), made_pages);
    ASSERT_TRUE(again->finish().ok());
    EXPECT_EQ(refusal(path), "");
}

TEST(RegionFileWriter, KeepsASecondOneOut) {
    const fs::path path = scratch_folder() / "a.oro";
    const auto first = begin(path);
    ASSERT_TRUE(first.ok());
    const auto second = begin(path);
    ASSERT_FALSE(second.ok());
    EXPECT_TRUE(says(second.error().what, "is being written by another program"));
}

TEST(RegionFileWriter, RefusesPagesOutOfOrderAndNumbersThatNoRegionHas) {
    const fs::path path = scratch_folder() / "a.oro";
    auto writer = begin(path);
    ASSERT_TRUE(writer.ok());
    const auto page = made_page(writer->order(), 1);
    const auto refused = writer->append(encode_page(page->record, page->payload).value(), page->stitched);
    ASSERT_FALSE(refused.ok());
    EXPECT_TRUE(says(refused.error().what, "level 0 row 0 column 1, expected level 0 row 0 column 0"));
    EXPECT_EQ(writer->pages_done(), 0U);
    RegionOutline outline = made_outline();
    outline.grid.lat.count = 0;
    EXPECT_FALSE(RegionFileWriter::create(path.string() + "2", outline, 0, false).ok());
    outline = made_outline();
    outline.undulation.N_m[2] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(RegionFileWriter::create(path.string() + "2", outline, 0, false).ok());
    outline = made_outline();
    outline.undulation = {};
    EXPECT_TRUE(RegionFileWriter::create(path.string() + "2", outline, 0, false).ok());
    EXPECT_FALSE(RegionFileWriter::create("/nowhere/a.oro", made_outline(), 0, false).ok());
    EXPECT_FALSE(RegionFileWriter::create("", made_outline(), 0, false).ok());
    EXPECT_FALSE(RegionFileWriter::create(path.parent_path(), made_outline(), 0, true).ok());
}

// Everything that is there after a break must be what was appended.
void expect_done_pages(const RegionFileWriter& writer) {
    const auto payload = std::make_unique<PagePayload>();
    const auto stitched = std::make_unique<StitchedDeviations>();
    for (std::uint64_t number = 0; number < writer.pages_done(); ++number) {
        const auto page = made_page(writer.order(), number);
        const auto record = writer.record(number);
        ASSERT_TRUE(record.ok()) << record.error().line();
        ASSERT_TRUE(same(*record, page->record));
        ASSERT_TRUE(writer.payload(number, *payload).ok());
        ASSERT_EQ(std::memcmp(payload.get(), &page->payload, sizeof(PagePayload)), 0);
        const auto read = writer.stitched(number, *stitched);
        ASSERT_TRUE(read.ok()) << read.error().line();
        ASSERT_EQ(*stitched, page->stitched);
    }
}

TEST(RegionFileWriter, GoesOnAfterAnyBreak) {
    const fs::path folder = scratch_folder();
    write_whole(folder / "whole.oro");
    const std::string whole = content(folder / "whole.oro");
    const fs::path path = folder / "a.oro", partial = folder / "a.oro.partial",
                   stitched = folder / "a.oro.partial-stitched";
    const unsigned seed = 2024;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uint64_t resumed = 0;
    for (int run = 0; run < 150; ++run) {
        for (int breaks = 0; breaks < 3; ++breaks) {
            std::uint64_t done = 0;
            {
                auto writer = begin(path);
                ASSERT_TRUE(writer.ok()) << writer.error().line();
                ASSERT_TRUE(append_until(*writer, std::max(writer->pages_done(), random() % 15)).ok());
                done = writer->pages_done();
            }
            const auto damage = random() % 5;  // 0: none
            const fs::path& victim = random() % 4 == 0 ? stitched : partial;
            const std::uintmax_t size = fs::file_size(victim);
            if (damage == 1) fs::resize_file(victim, random() % (size + 1));
            if (damage == 2 && size > 4000) fs::resize_file(victim, size - random() % 4000);
            if (damage >= 3 && size > 0) {  // a torn tail, or anywhere
                std::fstream file(victim, std::ios::binary | std::ios::in | std::ios::out);
                const std::uint64_t from =
                    damage == 3 ? size - 1 - random() % std::min<std::uint64_t>(size, 900) : random() % size;
                file.seekp(static_cast<std::streamoff>(from));
                for (std::uint64_t i = 0; i < 40 && from + i < size; ++i)
                    file.put(static_cast<char>(random()));
            }
            auto writer = begin(path);
            ASSERT_TRUE(writer.ok()) << writer.error().line();
            ASSERT_LE(writer->pages_done(), done);
            if (damage == 0) {
                ASSERT_EQ(writer->pages_done(), done);
            }
            resumed += writer->pages_done();
            expect_done_pages(*writer);
            if (HasFatalFailure()) return;
        }
        ASSERT_FALSE(fs::exists(path));
        write_whole(path);
        if (HasFatalFailure()) return;
        ASSERT_EQ(content(path) == whole, true) << "run " << run;
        fs::remove(path);
        ASSERT_EQ(names_in(folder), Names{"whole.oro"});
    }
    EXPECT_GE(resumed, 450U);  // going on is what happened, not starting over
}

TEST(RegionFileWriter, GoesOnAfterABreakInFinish) {
    const fs::path folder = scratch_folder();
    write_whole(folder / "whole.oro");
    const std::string whole = content(folder / "whole.oro");
    // All on the disk, the stitched deviations gone or not, the name not yet given.
    for (const bool stitched_there : {false, true}) {
        put(folder / "a.oro.partial", whole);
        if (stitched_there) put(folder / "a.oro.partial-stitched", "torn");
        for (int attempt = 0; attempt < 2; ++attempt) {  // the first is stopped again
            auto writer = begin(folder / "a.oro");
            ASSERT_TRUE(writer.ok()) << writer.error().line();
            EXPECT_EQ(writer->pages_done(), made_pages);
            if (attempt == 0) continue;
            const auto finished = writer->finish();
            ASSERT_TRUE(finished.ok()) << finished.error().line();
        }
        EXPECT_TRUE(content(folder / "a.oro") == whole);
        fs::remove(folder / "a.oro");
    }
    // A damaged one is not mistaken for finished.
    std::string damaged = whole;
    damaged[damaged.size() - 5] = static_cast<char>(damaged[damaged.size() - 5] ^ 1);
    put(folder / "a.oro.partial", damaged);
    auto writer = begin(folder / "a.oro");
    ASSERT_TRUE(writer.ok());
    EXPECT_EQ(writer->pages_done(), 0U);
    EXPECT_TRUE(says(refusal(folder / "a.oro.partial"), "is unfinished"));
}

TEST(RegionFileWriter, StartsOverWhereAnythingElseWasBegun) {
    const fs::path path = scratch_folder() / "a.oro";
    const auto begin_five = [&] {
        auto writer = begin(path);
        ASSERT_TRUE(writer.ok());
        ASSERT_TRUE(append_until(*writer, 5).ok());
    };
    begin_five();
    {
        const auto other = RegionFileWriter::create(path, made_outline(), made_fingerprint + 1, false);
        ASSERT_TRUE(other.ok());
        EXPECT_EQ(other->pages_done(), 0U);
    }
    begin_five();
    {
        RegionOutline outline = made_outline();
        outline.description += " ";
        const auto other = RegionFileWriter::create(path, outline, made_fingerprint, false);
        ASSERT_TRUE(other.ok());
        EXPECT_EQ(other->pages_done(), 0U);
    }
    // Also where the first bytes of a header were all that a break let through.
    for (const std::size_t bytes : {0U, 3U, 8U, 9U, 255U}) {
        put(path.string() + ".partial", content(path.string() + ".partial").substr(0, bytes));
        const auto other = begin(path);
        ASSERT_TRUE(other.ok()) << other.error().line();
        EXPECT_EQ(other->pages_done(), 0U);
    }
}

// What bears the names that a bake uses, and no bake left behind, is refused as it is.
TEST(RegionFileWriter, LeavesForeignPartialsAlone) {
    const fs::path folder = scratch_folder(), path = folder / "a.oro";
    const auto expect_refused = [&](const fs::path& file, const std::string& words) {
        const Names before = names_in(folder);
        for (const bool overwrite : {false, true}) {
            for (const Result<void>& checked : {RegionFileWriter::check(path.string(), overwrite)})
                EXPECT_FALSE(checked.ok()) << file;
            const auto refused = begin(path, overwrite);
            ASSERT_FALSE(refused.ok()) << file;
            EXPECT_TRUE(says(refused.error().line(), file.string() + ": ")) << refused.error().line();
            EXPECT_TRUE(says(refused.error().what, words)) << refused.error().line();
        }
        EXPECT_EQ(names_in(folder), before);
    };
    const std::string precious(100'000, 'x');
    for (const char* name : {"a.oro.partial", "a.oro.partial-stitched"}) {
        SCOPED_TRACE(name);
        const fs::path file = folder / name, other = folder / "precious";
        put(file, precious);
        expect_refused(file, "no bake has left it behind");
        EXPECT_TRUE(content(file) == precious);
        // Too short for a magic, and not the beginning of one.
        put(file, "x");
        expect_refused(file, "no bake has left it behind");
        fs::remove(file);
        // A link, to a file or to nothing.
        put(other, precious);
        fs::create_symlink(other, file);
        expect_refused(file, "is a link");
        fs::remove(file);
        fs::create_symlink(folder / "nothing", file);
        expect_refused(file, "is a link");
        fs::remove(file);
        // A second name, of anything and of a region file.
        fs::create_hard_link(other, file);
        expect_refused(file, "a hard link");
        EXPECT_TRUE(content(other) == precious);
        fs::remove(file);
        write_whole(other, true);
        const std::string region = content(other);
        fs::create_hard_link(other, file);
        expect_refused(file, "a hard link");
        EXPECT_TRUE(content(other) == region);
        fs::remove(file);
        fs::create_directory(file);
        expect_refused(file, "is a folder");
        fs::remove(file);
        fs::remove(other);
    }
    EXPECT_TRUE(RegionFileWriter::check(path.string(), false).ok());
    EXPECT_EQ(names_in(folder), Names{});
    write_whole(path);
}

TEST(RegionFileWriter, NamesTheFilesOfABake) {
    const fs::path folder = scratch_folder();
    const std::string path = (folder / "a.oro").string(), link = (folder / "b.oro").string();
    const std::vector<std::string> files{path, path + ".partial", path + ".partial-stitched"};
    EXPECT_EQ(files_of_bake(path), files);
    put(path, "old");
    fs::create_symlink(path, link);
    std::vector<std::string> real;
    for (const std::string& file : files)
        real.push_back((fs::canonical(folder) / fs::path(file).filename()).string());
    EXPECT_EQ(files_of_bake(link), real);
}

TEST(RegionFileWriter, IsReadByOthersWhileItAppends) {
    auto writer = begin(scratch_folder() / "a.oro");
    ASSERT_TRUE(writer.ok());
    ASSERT_TRUE(append_until(*writer, 4).ok());
    std::atomic<int> wrong{0};
    const auto read_again = [&] {
        const auto payload = std::make_unique<PagePayload>();
        const auto stitched = std::make_unique<StitchedDeviations>();
        for (std::uint64_t i = 0; i < 40; ++i) {
            const auto page = made_page(writer->order(), i % 4);
            const auto record = writer->record(i % 4);
            if (!record.ok() || !same(*record, page->record)) ++wrong;
            if (!writer->payload(i % 4, *payload).ok() ||
                std::memcmp(payload.get(), &page->payload, sizeof(PagePayload)) != 0)
                ++wrong;
            if (!writer->stitched(i % 4, *stitched).ok() || *stitched != page->stitched) ++wrong;
        }
    };
    {
        const std::jthread first(read_again), second(read_again);
        EXPECT_TRUE(append_until(*writer, made_pages).ok());
    }
    EXPECT_EQ(wrong, 0);
}

TEST(RegionFileWriter, GoesOnAfterAFullDisk) {
    const fs::path folder = scratch_folder();
    write_whole(folder / "whole.oro");
    auto writer = begin(folder / "a.oro");
    ASSERT_TRUE(writer.ok());
    ASSERT_TRUE(append_until(*writer, 2).ok());
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit small = before;
    small.rlim_cur = fs::file_size(folder / "a.oro.partial") + 1000;  // within the next payload
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto full = append_until(*writer, made_pages);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    ASSERT_FALSE(full.ok());
    EXPECT_EQ(full.error().line(),
              (folder / "a.oro.partial").string() + ": cannot be written: File too large");
    const std::uint64_t done = writer->pages_done();
    EXPECT_GE(done, 2U);
    EXPECT_LT(done, made_pages);
    ASSERT_TRUE(append_until(*writer, made_pages).ok());
    ASSERT_TRUE(writer->finish().ok());
    EXPECT_TRUE(content(folder / "a.oro") == content(folder / "whole.oro"));
}

}  // namespace
}  // namespace oro
