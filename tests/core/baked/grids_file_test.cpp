// The header of a file of several grids.
#include "core/baked/grids_file.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/base/checksum.h"
#include "core/base/little_endian.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

class GridsFile : public ::testing::Test {
  protected:
    // The header, and as many bytes behind it as its grids have, or others.
    Result<std::vector<GridInFile>> read(std::vector<std::byte> bytes, std::size_t more) {
        bytes.resize(bytes.size() + more);
        write(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
        const auto file = OpenFile::open(path_.string(), OpenFile::Use::read);
        EXPECT_TRUE(file.ok());
        return grids_in(*file);
    }
    void write(const std::string& bytes) { std::ofstream(path_, std::ios::binary) << bytes; }
    // Its checksum made right again.
    static std::vector<std::byte> summed(std::vector<std::byte> bytes) {
        const std::size_t end = bytes.size() - 8;
        to_little_endian(xxh64(std::span(bytes).first(end)), &bytes[end]);
        return bytes;
    }
    const std::vector<std::byte> header_ =
        grids_header(std::vector<std::uint64_t>{100, 30, 7}, std::vector<std::uint32_t>{2, 0, 1});
    const fs::path path_ = test::scratch_folder() / "grids.oro";
};

// 16 bytes, 16 for each grid, 8.
TEST_F(GridsFile, TellsWhereItsGridsAre) {
    ASSERT_EQ(header_.size(), 72U);
    const auto grids = read(header_, 137);
    ASSERT_TRUE(grids.ok()) << grids.error().line();
    ASSERT_EQ(grids->size(), 3U);
    EXPECT_EQ((*grids)[0].offset, 72U);
    EXPECT_EQ((*grids)[1].offset, 172U);
    EXPECT_EQ((*grids)[2].offset, 202U);
    EXPECT_EQ((*grids)[2].bytes, 7U);
    EXPECT_EQ((*grids)[0].rank, 2U);
    EXPECT_TRUE(looks_like_grids_file(path_.string()));
}

TEST_F(GridsFile, IsHeldToItsSize) {
    EXPECT_FALSE(read(header_, 136).ok());
    EXPECT_FALSE(read(header_, 138).ok());
}

TEST_F(GridsFile, LyingHeadersAreRefused) {
    const auto with = [&](std::size_t at, std::uint64_t number, int bytes) {
        std::vector<std::byte> changed = header_;
        for (int i = 0; i < bytes; ++i)
            changed[at + static_cast<std::size_t>(i)] = static_cast<std::byte>(number >> (8 * i));
        return summed(std::move(changed));
    };
    EXPECT_TRUE(read(with(16, 100, 8), 137).ok());
    for (const auto& [bytes, why] :
         {std::pair{with(8, 2, 4), "version 2"}, std::pair{with(12, 1, 4), "1 grids"},
          std::pair{with(12, 4097, 4), "4097 grids"}, std::pair{with(12, 0xffffffff, 4), "grids"},
          std::pair{with(16, 0xffffffffffffffff, 8), "grid number 1"},
          std::pair{with(32, 0xffffffffffffff00, 8), "grid number 2"}, std::pair{with(24, 3, 4), "order"},
          std::pair{with(24, 0, 4), "order"}}) {
        const auto grids = read(bytes, 137);
        ASSERT_FALSE(grids.ok()) << why;
        EXPECT_NE(grids.error().line().find(why), std::string::npos) << grids.error().line();
    }
}

// A part of a file is read as a file of its own, and no byte beyond it.
TEST_F(GridsFile, PartsEndWhereTheyEnd) {
    write("0123456789");
    const auto file = OpenFile::open(path_.string(), OpenFile::Use::read);
    const auto part = file->part(3, 4);
    ASSERT_TRUE(part.ok());
    EXPECT_EQ(part->size().value(), 4U);
    std::array<std::byte, 4> bytes;
    ASSERT_TRUE(part->read(0, bytes).ok());
    EXPECT_EQ(static_cast<char>(bytes[0]), '3');
    EXPECT_EQ(static_cast<char>(bytes[3]), '6');
    const auto beyond = part->read(1, bytes);
    ASSERT_FALSE(beyond.ok());
    EXPECT_NE(beyond.error().line().find("at byte 4"), std::string::npos) << beyond.error().line();
}

}  // namespace
}  // namespace oro
