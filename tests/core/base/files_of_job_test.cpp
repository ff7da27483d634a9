// What one job of several has read and written.
#include "core/base/files_of_job.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/base/file_target.h"
#include "core/base/files_read.h"
#include "core/base/open_file.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

class FilesOfJob : public testing::Test {
  protected:
    const fs::path folder_ = test::scratch_folder();

    void TearDown() override {
        end_files_of_jobs();
        forget_files_read();
    }
    [[nodiscard]] std::string file(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        // Older than what might be changed in the same tick of the clock.
        fs::last_write_time(folder_ / name, fs::last_write_time(folder_ / name) - std::chrono::seconds(5));
        return (folder_ / name).string();
    }
    static void read(const std::string& path) {
        EXPECT_TRUE(OpenFile::open(path, OpenFile::Use::read).ok()) << path;
    }
    // Writes a whole file in the way of those that bake does.
    void write(const std::string& path) const {
        const std::string partial = file("partial", "new");
        EXPECT_TRUE(give_name(partial, path, true).ok()) << path;
    }
};

TEST_F(FilesOfJob, EachJobHasItsOwn) {
    const std::string a = file("a", "one"), b = file("b", "two");
    begin_files_of_job();
    read(a);
    // A command that reads files of its own making from then on.
    forget_files_read();
    const std::vector<FileOfJob> first = files_read_of_job();
    ASSERT_EQ(first.size(), 1U);
    EXPECT_EQ(first[0].path, a);
    EXPECT_EQ(first[0].bytes, 3);
    begin_files_of_job();
    read(b);
    ASSERT_EQ(files_read_of_job().size(), 1U);
    EXPECT_EQ(files_read_of_job()[0].path, b);
    // What the first job read may be written by the second.
    EXPECT_TRUE(check_not_read(a).ok());
    EXPECT_FALSE(check_not_read(b).ok());
}

TEST_F(FilesOfJob, WhatAnotherJobWroteIsSpared) {
    const std::string out = (folder_ / "out").string();
    begin_files_of_job();
    write(out);
    write(out);
    EXPECT_EQ(files_written_of_job(), std::vector<std::string>{out});
    EXPECT_TRUE(check_not_read(out).ok()) << "its own";
    begin_files_of_job();
    EXPECT_TRUE(files_written_of_job().empty());
    fs::create_hard_link(out, folder_ / "link");
    const auto spared = check_not_read((folder_ / "link").string());
    ASSERT_FALSE(spared.ok());
    EXPECT_NE(spared.error().what.find("which another job wrote"), std::string::npos);
    end_files_of_jobs();
    EXPECT_TRUE(check_not_read(out).ok());
    write(out);
    EXPECT_TRUE(files_written_of_job().empty()) << "no job is watched";
}

TEST_F(FilesOfJob, WhatWasReadOnceIsReadByALaterJob) {
    const std::string a = file("a", "one");
    begin_files_of_job();
    read(a);
    const auto kept = files_read_so_far();
    begin_files_of_job();
    EXPECT_TRUE(are_unchanged(*kept));
    remember_again(*kept);
    ASSERT_EQ(files_read_of_job().size(), 1U);
    EXPECT_TRUE(check_files_unchanged().ok());
    EXPECT_FALSE(check_not_read(a).ok());
    std::ofstream(a) << "other";
    EXPECT_FALSE(are_unchanged(*kept));
    EXPECT_FALSE(check_files_unchanged().ok());
}

}  // namespace
}  // namespace oro
