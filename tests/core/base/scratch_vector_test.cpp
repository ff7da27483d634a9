// Vectors whose arrays lie in files where they are large.
#include "core/base/scratch_vector.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>

#include "tests/support/test_data.h"

namespace oro {
namespace {

// 750,000 numbers of 4 bytes are 3,000,000.
TEST(ScratchVector, LiesInFilesFromThreeMegabytesOn) {
    const auto scratch = std::make_shared<ScratchMemory>(test::scratch_folder().string());
    const ScratchVector<std::uint32_t> few(749'999, scratch);
    EXPECT_EQ(scratch->bytes().in_files, 0U);
    {
        ScratchVector<std::uint32_t> many(750'000, scratch);
        EXPECT_EQ(scratch->bytes().in_files, 3'000'000U);
        std::iota(many.begin(), many.end(), 0U);
        drop_pages_after(scratch.get(), std::size_t{1} << 18U);
        const ScratchVector<std::uint32_t> copy = many;
        EXPECT_EQ(scratch->bytes().in_files, 6'000'000U);
        EXPECT_EQ(copy, many);
        EXPECT_EQ(copy[749'999], 749'999U);
        const ScratchVector<std::uint32_t> moved = std::move(many);
        EXPECT_EQ(scratch->bytes().in_files, 6'000'000U);
        EXPECT_EQ(moved, copy);
    }
    EXPECT_EQ(scratch->bytes().in_files, 0U);
}

TEST(ScratchVector, LiesInMemoryWithoutFiles) {
    const auto scratch = std::make_shared<ScratchMemory>(test::scratch_folder().string());
    ScratchVector<double> in_memory(1'000'000, 0.5);
    ScratchVector<double> in_files(scratch);
    in_files = in_memory;  // lies where the original does
    EXPECT_EQ(scratch->bytes().most_in_files, 0U);
    EXPECT_EQ(in_files.get_allocator().scratch(), nullptr);
    EXPECT_EQ(in_files, in_memory);
}

// Its files are there as long as any vector in them is.
TEST(ScratchVector, HoldsOnToItsFiles) {
    ScratchVector<std::uint64_t> numbers;
    {
        const auto scratch = std::make_shared<ScratchMemory>(test::scratch_folder().string());
        numbers = ScratchVector<std::uint64_t>(500'000, 7U, scratch);
    }
    EXPECT_EQ(numbers.get_allocator().scratch()->bytes().in_files, 4'000'000U);
    EXPECT_EQ(numbers[499'999], 7U);
}

}  // namespace
}  // namespace oro
