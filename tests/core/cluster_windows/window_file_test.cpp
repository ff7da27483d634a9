// The file of a window whose index points beyond its blocks.
#include "core/cluster_windows/window_file.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/core/cluster_file/made_cluster_file.h"
#include "tests/support/mended_container.h"

namespace oro {
namespace {

TEST(WindowFileIndex, PointsIntoItsBlocks) {
    const std::filesystem::path path = test::scratch_folder() / "window";
    WindowIndex index;
    index.posts = {2, 2};
    index.groups.resize(1);
    const std::vector<std::vector<std::byte>> blocks{std::vector<std::byte>(100)};
    ASSERT_TRUE(write_window(path, index, blocks).ok());
    ASSERT_TRUE(WindowFile::open(path).ok());
    const std::string whole = test::bytes_of(path);
    // Of the index: six numbers of the window, two counts, and of the first group all before its place.
    const std::size_t offset = test::chunk_of(path, ChunkType::window).offset + 24 + 16 + 104;
    const auto refusal_with = [&](std::size_t at, auto number) {
        std::string bytes = whole;
        test::set_number(bytes, at, number);
        test::put_bytes(path, test::mended(bytes));
        const auto opened = WindowFile::open(path);
        return opened.ok() ? std::string() : opened.error().line();
    };
    EXPECT_EQ(refusal_with(offset, std::uint64_t{0}), "");
    for (const std::uint64_t far : {std::uint64_t{1}, std::numeric_limits<std::uint64_t>::max()})
        EXPECT_NE(refusal_with(offset, far).find("of its blocks, which have 100"), std::string::npos);
    EXPECT_NE(refusal_with(offset + 8, std::uint32_t{101}).find("a group of 101 bytes"), std::string::npos);
}

}  // namespace
}  // namespace oro
