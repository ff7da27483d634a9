#include "geo/files/whole_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "geo/files/temporary_file.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

void put_text(const fs::path& path, const std::string& text) {
    std::ofstream(path) << text;
}

std::ptrdiff_t entries_in(const fs::path& folder) {
    return std::distance(fs::directory_iterator(folder), {});
}

TEST(WholeFolder, HasItsNameOnceItIsWhole) {
    const fs::path around = test::scratch_folder(), path = around / "tiles";
    {
        auto folder = WholeFolder::create(path.string() + "/", false);
        ASSERT_TRUE(folder.ok());
        put_text(fs::path(folder->path()) / "a", "1");
        EXPECT_FALSE(fs::exists(path));
        EXPECT_TRUE(folder->commit().ok());
    }
    EXPECT_TRUE(fs::exists(path / "a"));
    EXPECT_EQ(entries_in(around), 1);
}

TEST(WholeFolder, LeavesNothingWithoutCommit) {
    const fs::path around = test::scratch_folder();
    {
        auto folder = WholeFolder::create(around / "tiles", false);
        ASSERT_TRUE(folder.ok());
        fs::create_directories(fs::path(folder->path()) / "1" / "2");
        put_text(fs::path(folder->path()) / "1" / "2" / "a", "1");
    }
    EXPECT_EQ(entries_in(around), 0);
}

TEST(WholeFolder, ReplacesWhenItIsToldTo) {
    const fs::path around = test::scratch_folder(), path = around / "tiles";
    fs::create_directories(path / "old");
    EXPECT_FALSE(WholeFolder::create(path, false).ok());
    {
        auto folder = WholeFolder::create(path, true);
        ASSERT_TRUE(folder.ok());
        put_text(fs::path(folder->path()) / "new", "1");
        EXPECT_TRUE(fs::exists(path / "old"));
        EXPECT_TRUE(folder->commit().ok());
    }
    EXPECT_TRUE(fs::exists(path / "new"));
    EXPECT_FALSE(fs::exists(path / "old"));
    EXPECT_EQ(entries_in(around), 1);
}

TEST(WholeFolder, TakesAnEmptyOnesPlaceAndNoFiles) {
    const fs::path around = test::scratch_folder();
    fs::create_directory(around / "empty");
    put_text(around / "file", "1");
    auto folder = WholeFolder::create(around / "empty", false);
    ASSERT_TRUE(folder.ok());
    EXPECT_TRUE(folder->commit().ok());
    EXPECT_FALSE(WholeFolder::create(around / "file", true).ok());
    EXPECT_FALSE(WholeFolder::create(around / "none" / "tiles", true).ok());
    EXPECT_EQ(entries_in(around), 2);
}

TEST(WholeFolder, TheFolderAroundItIsNamed) {
    const fs::path around = test::scratch_folder(), none = around / "none";
    const auto said = [](const std::string& path) {
        const auto folder = WholeFolder::create(path, false);
        return folder.ok() ? "is made" : folder.error().line();
    };
    const std::string words = ": the folder " + none.string() + " is not there";
    EXPECT_EQ(said(none / "tiles"), (none / "tiles").string() + words);
    EXPECT_EQ(said(none.string() + "//tiles//"), none.string() + "//tiles//" + words);
    EXPECT_EQ(said("none/tiles"), "none/tiles: the folder none is not there");
    put_text(around / "file", "1");
    EXPECT_EQ(said(around / "file" / "tiles"), (around / "file" / "tiles").string() + ": the folder " +
                                                   (around / "file").string() +
                                                   " cannot be written in: Not a directory");
}

// One that came while the folder was written stays.
TEST(WholeFolder, SparesWhatTookTheNameSince) {
    const fs::path path = test::scratch_folder() / "tiles";
    auto folder = WholeFolder::create(path, false);
    ASSERT_TRUE(folder.ok());
    fs::create_directory(path);
    put_text(path / "theirs", "1");
    EXPECT_FALSE(folder->commit().ok());
    EXPECT_TRUE(fs::exists(path / "theirs"));
}

TEST(WholeFolder, GoesWithTheProgramThatASignalEnds) {
    const fs::path around = test::scratch_folder();
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
        auto folder = WholeFolder::create(around / "tiles", false);
        if (folder.ok()) put_text(fs::path(folder->path()) / "a", "1");
        remove_unfinished_files();
        _exit(folder.ok() ? 0 : 1);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(entries_in(around), 0);
}

}  // namespace
}  // namespace oro
