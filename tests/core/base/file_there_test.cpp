// Names that lead nowhere are answered "no"; that nobody could tell is another matter (tests/faults).
#include "core/base/file_there.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/test_data.h"

namespace {

TEST(FileThere, IsAnsweredOfEveryName) {
    const std::filesystem::path folder = oro::test::scratch_folder(), file = folder / "a";
    std::ofstream(file) << "a";
    std::filesystem::create_symlink("b", folder / "b");
    for (const auto& [name, there] : {std::pair{folder.string(), true},
                                      {file.string(), true},
                                      {(folder / "none").string(), false},
                                      {(file / "in a file").string(), false},
                                      {(folder / "b").string(), false},
                                      {(folder / std::string(5000, 'c')).string(), false},
                                      {std::string(), false}}) {
        const auto found = oro::is_there(name);
        ASSERT_TRUE(found.ok()) << found.error().line();
        EXPECT_EQ(*found, there) << name;
        const auto same = oro::is_same_file(name, file.string());
        ASSERT_TRUE(same.ok()) << same.error().line();
        EXPECT_EQ(*same, name == file.string()) << name;
    }
}

TEST(FileThere, OnlyNamesMakeANo) {
    for (const auto failed : {std::errc::not_enough_memory, std::errc::io_error,
                              std::errc::too_many_files_open_in_system, std::errc::interrupted})
        EXPECT_TRUE(oro::is_no_answer(std::make_error_code(failed)));
    for (const auto failed : {std::errc::no_such_file_or_directory, std::errc::not_a_directory,
                              std::errc::filename_too_long, std::errc::permission_denied})
        EXPECT_FALSE(oro::is_no_answer(std::make_error_code(failed)));
    EXPECT_FALSE(oro::is_no_answer({}));
}

}  // namespace
