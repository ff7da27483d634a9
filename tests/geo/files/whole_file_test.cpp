#include "geo/files/whole_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void put(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

using Names = std::vector<std::string>;

// A file without a name gets one by way of /proc; a bare root file system has none, and files have temporary
// names there.
bool has_nameless_files() {
    return fs::exists("/proc/self/fd");
}

TEST(WholeFile, AppearsOnlyWhenCommitted) {
    const fs::path folder = test::scratch_folder();
    auto file = WholeFile::create(folder / "a.txt", false);
    ASSERT_TRUE(file.ok()) << file.error().line();
    ASSERT_TRUE(file->write("height", 6).ok());
    EXPECT_FALSE(fs::exists(folder / "a.txt"));
    const auto committed = file->commit();
    ASSERT_TRUE(committed.ok()) << committed.error().line();
    EXPECT_EQ(content(folder / "a.txt"), "height");
    EXPECT_EQ(names_in(folder), Names{"a.txt"});
}

TEST(WholeFile, LeavesNothingWhenDestroyed) {
    const fs::path folder = test::scratch_folder();
    put(folder / "a.txt", "old");
    {
        auto file = WholeFile::create(folder / "a.txt", true);
        ASSERT_TRUE(file.ok());
        ASSERT_TRUE(file->write("new", 3).ok());
        EXPECT_EQ(names_in(folder).size(), has_nameless_files() ? 1U : 2U)
            << "no name that a kill could leave";
    }
    EXPECT_EQ(names_in(folder), Names{"a.txt"});
    EXPECT_EQ(content(folder / "a.txt"), "old");
}

TEST(WholeFile, ReplacesOnlyWhenAllowed) {
    const fs::path folder = test::scratch_folder();
    put(folder / "a.txt", "old");
    const auto refused = write_whole_file(folder / "a.txt", "new", false);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::failed);
    EXPECT_NE(refused.error().line().find("a.txt: exists already"), std::string::npos)
        << refused.error().line();
    EXPECT_EQ(content(folder / "a.txt"), "old");
    ASSERT_TRUE(write_whole_file(folder / "a.txt", "new", true).ok());
    EXPECT_EQ(content(folder / "a.txt"), "new");
    EXPECT_EQ(names_in(folder), Names{"a.txt"});
}

TEST(WholeFile, KeepsAFileThatAppearedMeanwhile) {
    const fs::path folder = test::scratch_folder();
    auto file = WholeFile::create(folder / "a.txt", false);
    ASSERT_TRUE(file.ok());
    ASSERT_TRUE(file->write("mine", 4).ok());
    put(folder / "a.txt", "theirs");
    const auto committed = file->commit();
    ASSERT_FALSE(committed.ok());
    EXPECT_NE(committed.error().what.find("appeared"), std::string::npos) << committed.error().line();
    EXPECT_EQ(content(folder / "a.txt"), "theirs");
    EXPECT_EQ(names_in(folder), Names{"a.txt"});
}

TEST(WholeFile, RefusesPlacesThatCannotBeWritten) {
    const fs::path folder = test::scratch_folder();
    put(folder / "plain", "text");
    fs::create_directory(folder / "inner");
    fs::create_symlink("nowhere/at/all", folder / "dangling");
    const struct {
        std::string path;
        ErrorKind kind;
        std::string reason;
    } rows[] = {
        {"", ErrorKind::usage, "empty"},
        {folder / "inner/", ErrorKind::usage, "names a folder"},
        {folder / "inner", ErrorKind::failed, "is a folder"},
        {folder / "missing/a.txt", ErrorKind::failed,
         "the folder " + (folder / "missing").string() + " is not there"},
        {folder / "plain/a.txt", ErrorKind::failed, "Not a directory"},
        {folder / "dangling", ErrorKind::failed, "leads nowhere"},
        {folder / std::string(256, 'n'), ErrorKind::failed, "File name too long"},
        {std::string("a\0b", 3), ErrorKind::usage, "zero byte"},
        {"/proc/a.txt", ErrorKind::failed, "the folder /proc takes no new files"},
        {"/dev/full", ErrorKind::failed, "device"},
        {"/dev/null", ErrorKind::failed, "device"},
    };
    for (const auto& row : rows) {
        const auto file = WholeFile::create(row.path, true);
        ASSERT_FALSE(file.ok()) << row.path;
        EXPECT_EQ(file.error().kind, row.kind) << row.path;
        EXPECT_NE(file.error().line().find(row.reason), std::string::npos) << file.error().line();
    }
    EXPECT_EQ(names_in(folder), (Names{"dangling", "inner", "plain"}));
    EXPECT_TRUE(fs::is_empty(folder / "inner"));
}

// Root may write anywhere: as root, a child that becomes "nobody" tries.
TEST(WholeFile, SaysThatAFolderIsNotWritable) {
    const fs::path folder = test::scratch_folder();
    fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::others_read |
                                fs::perms::others_exec);
    const pid_t child = fork();
    if (child == 0) {
        constexpr uid_t nobody = 65534;
        if (geteuid() == 0 && seteuid(nobody) != 0) _exit(3);
        const auto written = write_whole_file(folder / "a.txt", "text", false);
        const bool said =
            !written.ok() && written.error().line().find("Permission denied") != std::string::npos;
        _exit(said ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
    fs::permissions(folder, fs::perms::owner_all);
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(WholeFile, TakesTheLongestName) {
    const fs::path folder = test::scratch_folder();
    const std::string name(255, 'n');
    ASSERT_TRUE(write_whole_file(folder / name, "text", false).ok());
    EXPECT_EQ(names_in(folder), Names{name});
}

TEST(WholeFile, WritesIntoTheCurrentFolder) {
    const fs::path before = fs::current_path();
    const fs::path folder = test::scratch_folder();
    fs::current_path(folder);
    const auto written = write_whole_file("a.txt", "text", false);
    fs::current_path(before);
    ASSERT_TRUE(written.ok()) << written.error().line();
    EXPECT_EQ(content(folder / "a.txt"), "text");
}

TEST(WholeFile, FollowsALinkAndKeepsIt) {
    const fs::path folder = test::scratch_folder();
    fs::create_directory(folder / "inner");
    put(folder / "inner/target", "old");
    fs::create_symlink("inner/target", folder / "link");
    ASSERT_FALSE(write_whole_file(folder / "link", "new", false).ok());
    ASSERT_TRUE(write_whole_file(folder / "link", "new", true).ok());
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(content(folder / "inner/target"), "new");
}

TEST(WholeFile, HasTheModeOfTheUmaskOrOfTheFileReplaced) {
    const fs::path folder = test::scratch_folder();
    const mode_t before = umask(027);
    const auto fresh = write_whole_file(folder / "fresh", "text", false);
    umask(before);
    put(folder / "private", "text");
    fs::permissions(folder / "private", fs::perms::owner_read | fs::perms::owner_write);
    const auto replaced = write_whole_file(folder / "private", "text", true);
    ASSERT_TRUE(fresh.ok() && replaced.ok());
    EXPECT_EQ(static_cast<unsigned>(fs::status(folder / "fresh").permissions()), 0640U);
    EXPECT_EQ(static_cast<unsigned>(fs::status(folder / "private").permissions()), 0600U);
}

TEST(WholeFile, MovesWithItsFile) {
    const fs::path folder = test::scratch_folder();
    auto first = WholeFile::create(folder / "first", false);
    auto second = WholeFile::create(folder / "second", false);
    ASSERT_TRUE(first.ok() && second.ok());
    WholeFile file = std::move(*first);
    ASSERT_TRUE(file.write("text", 4).ok());
    *second = std::move(file);  // "second" is abandoned
    EXPECT_EQ(names_in(folder).size(), has_nameless_files() ? 0U : 1U);
    ASSERT_TRUE(second->commit().ok());
    EXPECT_EQ(names_in(folder), Names{"first"});
    EXPECT_EQ(content(folder / "first"), "text");
}

// Where a file system has no files without names.
TEST(WholeFile, MayHaveATemporaryName) {
    const fs::path folder = test::scratch_folder();
    {
        auto file = WholeFile::create(folder / "a.txt", false, Temporary::named);
        ASSERT_TRUE(file.ok()) << file.error().line();
        ASSERT_TRUE(file->write("new", 3).ok());
        ASSERT_EQ(names_in(folder).size(), 1U);
        EXPECT_TRUE(names_in(folder).front().starts_with(".orograph-"));
    }
    EXPECT_EQ(names_in(folder), Names{});
    auto file = WholeFile::create(folder / "a.txt", false, Temporary::named);
    ASSERT_TRUE(file.ok() && file->write("new", 3).ok() && file->commit().ok());
    EXPECT_EQ(names_in(folder), Names{"a.txt"});
    EXPECT_EQ(content(folder / "a.txt"), "new");
}

// A child that is killed leaves a file under a temporary name; the next run removes it. One that somebody
// still holds stays, and so does what only looks alike.
TEST(WholeFile, RemovesWhatAKilledProgramLeft) {
    const fs::path folder = test::scratch_folder();
    const pid_t child = fork();
    if (child == 0) {
        const auto file = WholeFile::create(folder / "a.txt", false, Temporary::named);
        (void)raise(file.ok() ? SIGKILL : SIGTERM);
    }
    int status = -1;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    const Names left = names_in(folder);
    ASSERT_EQ(left.size(), 1U);
    const std::string name = left.front();
    std::string alike = name;
    alike.back() = alike.back() == '0' ? '1' : '0';
    put(folder / alike, "mine");
    fs::copy_file(folder / name, folder / "kept");
    const int held = open((folder / name).c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(flock(held, LOCK_EX), 0);
    { const auto file = WholeFile::create(folder.string() + "/./b.txt", false); }
    EXPECT_EQ(names_in(folder).size(), 3U) << "somebody holds it";
    close(held);
    { const auto file = WholeFile::create(folder / "b.txt", false); }
    EXPECT_EQ(names_in(folder), (Names{alike, "kept"}));
}

// The second of two cannot have its name: the first gives its own back.
TEST(WholeFile, FilesThatBelongTogetherAppearTogether) {
    for (const Temporary kind : {Temporary::nameless, Temporary::named}) {
        for (const bool was_there : {true, false}) {
            const fs::path folder = test::scratch_folder();
            if (was_there) put(folder / "a.txt", "old a");
            auto a = WholeFile::create(folder / "a.txt", true, kind);
            auto b = WholeFile::create(folder / "b.txt", true, kind);
            ASSERT_TRUE(a.ok() && b.ok() && a->write("new a", 5).ok() && b->write("new b", 5).ok());
            fs::create_directory(folder / "b.txt");  // no file's name from now on
            const auto committed = commit_together({&*a, &*b});
            ASSERT_FALSE(committed.ok());
            EXPECT_NE(committed.error().line().find("b.txt: cannot be written"), std::string::npos)
                << committed.error().line();
            EXPECT_EQ(names_in(folder), was_there ? (Names{"a.txt", "b.txt"}) : Names{"b.txt"});
            if (!was_there) continue;
            EXPECT_EQ(content(folder / "a.txt"), "old a");
        }
        const fs::path folder = test::scratch_folder();
        put(folder / "a.txt", "old a");
        auto a = WholeFile::create(folder / "a.txt", true, kind);
        auto b = WholeFile::create(folder / "b.txt", false, kind);
        ASSERT_TRUE(a.ok() && b.ok() && a->write("new a", 5).ok() && b->write("new b", 5).ok());
        ASSERT_TRUE(commit_together({&*a, &*b}).ok());
        EXPECT_EQ(content(folder / "a.txt"), "new a");
        EXPECT_EQ(content(folder / "b.txt"), "new b");
        EXPECT_EQ(names_in(folder), (Names{"a.txt", "b.txt"}));
    }
}

// A limit on the size of files stands in for a full disk: both fail in write(2), at any later moment. The
// signal that comes with it must not end the program.
TEST(WholeFile, ReportsAFullDiskAndLeavesNothing) {
    const fs::path folder = test::scratch_folder();
    put(folder / "a.txt", "old");
    struct rlimit before {};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    for (const rlim_t limit : {0U, 1U, 4096U, 5000U}) {
        auto file = WholeFile::create(folder / "a.txt", true);
        ASSERT_TRUE(file.ok());
        const std::string text(6000, 'x');
        const struct rlimit small { limit, before.rlim_max };
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
        Result<void> written = file->write(text.data(), text.size());
        if (written.ok()) written = file->commit();
        ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
        ASSERT_FALSE(written.ok()) << limit;
        EXPECT_NE(written.error().line().find("a.txt: cannot be written: File too large"), std::string::npos)
            << written.error().line();
        { const WholeFile gone = std::move(*file); }
        EXPECT_EQ(names_in(folder), Names{"a.txt"}) << limit;
        EXPECT_EQ(content(folder / "a.txt"), "old") << limit;
    }
}

// Bytes that wait in the stream's buffer are lost by the flush in commit(), and that is noticed as well.
TEST(WholeFile, ReportsAFullDiskAtTheLastFlush) {
    const fs::path folder = test::scratch_folder();
    auto file = WholeFile::create(folder / "a.txt", false);
    ASSERT_TRUE(file.ok());
    ASSERT_TRUE(file->write("text", 4).ok());
    struct rlimit before {};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const struct rlimit none { 0, before.rlim_max };
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &none), 0);
    const auto committed = file->commit();
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
    ASSERT_FALSE(committed.ok());
    EXPECT_NE(committed.error().what.find("File too large"), std::string::npos) << committed.error().line();
    EXPECT_TRUE(fs::is_empty(folder));
}

}  // namespace
}  // namespace oro
