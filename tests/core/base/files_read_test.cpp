// Files that change while they are read, and files that are read and would be replaced.
#include "core/base/files_read.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/open_file.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

class FilesRead : public testing::Test {
  protected:
    const fs::path folder = test::scratch_folder();
    const fs::path file = folder / "dem.tif";

    void SetUp() override {
        write("four");
        remember_files_read();
    }
    void TearDown() override { forget_files_read(); }
    void write(const std::string& bytes) const { std::ofstream(file, std::ios::binary) << bytes; }
    void read() const { EXPECT_TRUE(OpenFile::open(file, OpenFile::Use::read).ok()); }
    static std::string change() {
        const Result<void> checked = check_files_unchanged();
        return checked.ok() ? "" : checked.error().line();
    }
};

TEST_F(FilesRead, AreWhatTheyWere) {
    read();
    EXPECT_EQ(change(), "");
    read();
    EXPECT_EQ(change(), "");
}

TEST_F(FilesRead, ThatGrowAreTold) {
    read();
    write("longer");
    EXPECT_EQ(change(), file.string() +
                            ": was changed while it was read (it had 4 bytes, and has 6): nothing is made of "
                            "it; try again when it is complete");
}

// At once, within one tick of the clock that files' times are taken from.
TEST_F(FilesRead, ThatAreRewrittenWithAsManyBytesAreTold) {
    for (int i = 0; i < 20; ++i) {
        forget_files_read();
        remember_files_read();
        write("four");
        read();
        write("five");
        ASSERT_NE(change().find("it was written to meanwhile"), std::string::npos) << i;
    }
}

// Found: a file that was rewritten and had its time set back was one that had not changed.
TEST_F(FilesRead, ThatAreRewrittenAndHaveTheirTimeSetBackAreTold) {
    const fs::file_time_type time = fs::last_write_time(file);
    read();
    write("five");
    fs::last_write_time(file, time);
    EXPECT_NE(change().find("it was written to meanwhile, and its time was set back"), std::string::npos)
        << change();
}

// A backup may link a file or its rights be changed while it is read: its bytes are what they were.
TEST_F(FilesRead, MayBeLinkedAndGetOtherRights) {
    read();
    fs::create_hard_link(file, folder / "hard");
    fs::permissions(file, fs::perms::owner_read);
    EXPECT_EQ(change(), "");
    read();
    EXPECT_EQ(change(), "");
}

TEST_F(FilesRead, ThatAreReplacedOrGoneAreTold) {
    read();
    std::ofstream(folder / "new") << "four";
    fs::rename(folder / "new", file);
    EXPECT_NE(change().find("another file has its name now"), std::string::npos);
    fs::remove(file);
    EXPECT_NE(change().find("it is gone"), std::string::npos);
}

// Opened twice, it was two files, whatever it is at the end.
TEST_F(FilesRead, ThatWereAnotherMeanwhileAreTold) {
    read();
    fs::rename(file, folder / "kept");
    write("longer");
    read();
    fs::rename(folder / "kept", file);
    EXPECT_NE(change().find("another file has its name now"), std::string::npos);
}

TEST_F(FilesRead, AreNotReplacedByAnyName) {
    read();
    fs::create_hard_link(file, folder / "hard");
    fs::create_symlink("dem.tif", folder / "soft");
    for (const char* name : {"dem.tif", "hard", "soft"}) {
        const Result<void> spared = check_not_read(folder / name);
        ASSERT_FALSE(spared.ok()) << name;
        EXPECT_EQ(spared.error().kind, ErrorKind::usage);
        EXPECT_NE(spared.error().line().find("would replace " + file.string()), std::string::npos)
            << spared.error().line();
    }
    EXPECT_TRUE(check_not_read(folder / "other").ok());
    let_replace(file);
    EXPECT_TRUE(check_not_read(file).ok());
}

TEST_F(FilesRead, OfTheProgramItselfAreNotRemembered) {
    EXPECT_TRUE(OpenFile::open(file, OpenFile::Use::read_own).ok());
    write("longer");
    EXPECT_EQ(change(), "");
    EXPECT_TRUE(check_not_read(file).ok());
}

}  // namespace
}  // namespace oro
