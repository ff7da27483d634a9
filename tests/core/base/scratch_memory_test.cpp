// Arrays in files without names.
#include "core/base/scratch_memory.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>
#include <vector>

#include "tests/support/test_data.h"

namespace oro {
namespace {

TEST(ScratchMemory, KeepsWhatIsInItsFilesAndLeavesNoName) {
    const std::filesystem::path folder = test::scratch_folder();
    ScratchMemory scratch(folder.string());
    {
        std::pmr::vector<std::uint32_t> numbers(1'000'000, &scratch), few(10, &scratch);
        std::iota(numbers.begin(), numbers.end(), 0U);
        EXPECT_EQ(scratch.bytes().in_files, 4'000'000U);
        EXPECT_EQ(scratch.bytes().in_memory, 40U);
        EXPECT_TRUE(std::filesystem::is_empty(folder));
        scratch.drop_pages();
        for (std::uint32_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(numbers[i], i);
        numbers.push_back(7);
        EXPECT_EQ(numbers[999'999], 999'999U);
    }
    EXPECT_EQ(scratch.bytes().in_files, 0U);
    EXPECT_EQ(scratch.bytes().in_memory, 0U);
    EXPECT_EQ(scratch.bytes().most_in_files, 12'000'000U);  // while it grew
    EXPECT_FALSE(scratch.error().has_value());
}

TEST(ScratchMemory, WithoutRoomSaysWhy) {
    const std::filesystem::path folder = test::scratch_folder();
    ScratchMemory scratch(folder.string());
    EXPECT_THROW((void)scratch.allocate(std::size_t{1} << 60U, 16), std::bad_alloc);
    ASSERT_TRUE(scratch.error().has_value());
    EXPECT_TRUE(scratch.error()->line().starts_with(folder.string() + ": no room for a scratch file of "))
        << scratch.error()->line();
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace oro
