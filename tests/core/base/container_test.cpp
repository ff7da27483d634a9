// The container of baked files: chunks are found quickly however many there are, and no more memory is taken
// for one than it may have.
#include "core/base/container.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include "core/base/checksum.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

void put_container(const fs::path& path, ChunkTable table, const std::string& bodies) {
    table.file_bytes = table.place();
    const std::vector<std::byte> begin = table.to_bytes();
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(begin.data()), static_cast<std::streamsize>(begin.size()));
    file << bodies;
}

// Found: looking for each of 65,536 chunks went through all of them, seconds. The bound is 50 times what it
// takes.
TEST(ContainerChunks, AreFoundQuicklyAmongMany) {
    const fs::path path = test::scratch_folder() / "many.oro";
    ChunkTable table;
    for (std::uint32_t i = 0; i < ChunkTable::most_chunks; ++i)
        table.chunks.push_back({i % 2 == 0 ? ChunkType::heights : ChunkType::outline,
                                (i * 40503U % ChunkTable::most_chunks) / 2, 0, 0, xxh64({})});
    put_container(path, table, "");
    const auto container = Container::open(path);
    ASSERT_TRUE(container.ok()) << container.error().line();
    const auto start = std::chrono::steady_clock::now();
    std::size_t found = 0;
    for (const Chunk& chunk : (*container)->table().chunks)
        found += (*container)->find(chunk.type, chunk.grid) == &chunk ? 1 : 0;
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(found, ChunkTable::most_chunks);
    EXPECT_LT(took.count(), 1.0);
    EXPECT_EQ((*container)->find(ChunkType::net, 0), nullptr);
    EXPECT_EQ((*container)->find(ChunkType::heights, ChunkTable::most_chunks), nullptr);
}

TEST(ContainerChunks, AreReadUpToTheSizeThatTheyMayHave) {
    const fs::path path = test::scratch_folder() / "one.oro";
    const std::string body = "ten bytes.";
    const Chunk chunk{ChunkType::description, 0, 0, body.size(), xxh64(std::as_bytes(std::span(body)))};
    put_container(path, {0, {chunk}}, body);
    const auto container = Container::open(path);
    ASSERT_TRUE(container.ok()) << container.error().line();
    const Chunk& there = (*container)->table().chunks.front();
    const auto read = (*container)->read(there, 10);
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->size(), 10U);
    const auto refused = (*container)->read(there, 9);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().what, "is damaged at byte 64: the description of 10 bytes, expected at most 9");
}

// A chunk of 1 TB that is a hole: refused at once, and by no memory that is lacking.
TEST(ContainerChunks, ThatAreHolesTakeNoMemory) {
    const fs::path path = test::scratch_folder() / "hole.oro";
    constexpr std::uint64_t huge = std::uint64_t{1} << 40U;
    put_container(path, {0, {{ChunkType::description, 0, 0, huge, 0}}}, "");
    std::error_code failed;
    fs::resize_file(path, huge + 64, failed);
    if (failed) GTEST_SKIP() << "needs a file system with holes: " << failed.message();
    const auto container = Container::open(path);
    ASSERT_TRUE(container.ok()) << container.error().line();
    const auto read = (*container)->read((*container)->table().chunks.front(), 64U << 20U);
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.error().line().find("of 1099511627776 bytes, expected at most 67108864"),
              std::string::npos)
        << read.error().line();
}

TEST(ContainerChunks, OfAFileThatIsChangedMeanwhileAreNotRead) {
    const fs::path path = test::scratch_folder() / "one.oro";
    const auto put = [&](const std::string& body) {
        put_container(path, {0, {{ChunkType::description, 0, 0, 4, xxh64(std::as_bytes(std::span(body)))}}},
                      body);
    };
    put("once");
    const auto container = Container::open(path);
    ASSERT_TRUE(container.ok()) << container.error().line();
    put("more");
    const auto read = (*container)->read((*container)->table().chunks.front(), 4);
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.error().line().find("was changed at byte 0"), std::string::npos) << read.error().line();
}

}  // namespace
}  // namespace oro
