// A baked file whose checksums are all right, and which says of its pages what they have not.
#include "core/baked/contents_check.h"

#include "core/baked/bake.h"
#include "core/base/checksum.h"
#include "tests/core/baked/made_region_file.h"
#include "tests/support/mended_container.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

// 300 x 290 posts with holes: 9, 4 and 1 pages.
class ContentsCheckOf : public ::testing::Test {
  protected:
    const fs::path path_ = scratch_folder() / "a.oro";
    std::string whole_;

    void bake(const HeightField& field) {
        BakeOptions how;
        how.path = path_;
        how.overwrite = true;
        how.threads = 2;
        const auto done = bake_region(field, how);
        ASSERT_TRUE(done.ok()) << done.error().line();
        whole_ = content(path_);
    }
    void SetUp() override {
        HeightField field = rough_field(47.0, 8.0, 300, 290);
        for (std::size_t post = 40'000; post < 40'120; ++post) field.H_m[post] = void_height_m;
        field.H_m.back() = void_height_m;
        bake(field);
    }
    // What is said of the file; "": nothing.
    [[nodiscard]] std::string refusal_of_contents() const {
        const auto file = RegionFile::open(path_);
        if (!file.ok()) return file.error().line();
        const auto verified = file->verify();
        EXPECT_TRUE(verified.ok()) << verified.error().line();
        const auto checked = check_contents(*file, 2, "grid 3: ");
        return checked.ok() ? "" : checked.error().line();
    }
    template <class Number>
    std::string with_outline(std::size_t byte, Number number) {
        std::string bytes = whole_;
        put(path_, whole_);
        set_number(bytes, chunk_of(path_, ChunkType::outline).offset + byte, number);
        put(path_, mended(bytes));
        return refusal_of_contents();
    }
    // The record of a page, by its number, with a byte of it and all checksums made right again.
    template <class Number>
    std::string with_record(std::size_t page, std::size_t byte, Number number) {
        std::string bytes = whole_;
        put(path_, whole_);
        const std::size_t begin =
            chunk_of(path_, ChunkType::pages).offset + page * region_format::record_bytes;
        set_number(bytes, begin + byte, number);
        const auto record = std::as_bytes(std::span(bytes)).subspan(begin, region_format::record_bytes - 8);
        set_number(bytes, begin + region_format::record_bytes - 8, xxh64(record));
        put(path_, mended(bytes));
        return refusal_of_contents();
    }
};

TEST_F(ContentsCheckOf, AWholeFileFindsNothing) {
    EXPECT_EQ(refusal_of_contents(), "");
}

// Also where posts lie on a net, go round the Earth, or come to a pole.
TEST_F(ContentsCheckOf, FilesOfOtherShapesFindNothing) {
    const PlaneOfPosts plane{200, 150, {46.5, 8.0}, 40.0, 12.0};
    bake(net_field(plane, [](double row, double column) {
        return row > 50 && row < 60 && column < 9 ? void_height_m : static_cast<float>(row + 2.0 * column);
    }));
    EXPECT_EQ(refusal_of_contents(), "");
    bake(made_field(90.0, -180.0, 1.0, 181, 361, rough_H_m));
    EXPECT_EQ(refusal_of_contents(), "");
}

TEST_F(ContentsCheckOf, OutlinesThatLieAreTold) {
    const auto begin = path_.string() + ": grid 3: its outline says ";
    EXPECT_EQ(with_outline(
                  8, from_little_endian<double>(std::as_bytes(std::span(whole_))
                                                    .subspan(chunk_of(path_, ChunkType::outline).offset + 8)
                                                    .data())),
              "");
    EXPECT_TRUE(
        says(with_outline(160, -9000.0F), begin + "a lowest H in metres of -9000, but its posts give "));
    EXPECT_TRUE(
        says(with_outline(164, 9000.0F), begin + "a highest H in metres of 9000, but its posts give "));
    EXPECT_TRUE(says(with_outline(168, std::uint64_t{0}), begin + "void posts 0, but its posts give 121"));
    EXPECT_TRUE(says(with_outline(176, std::uint64_t{7}), begin + "triangles 7, but its posts give "));
}

TEST_F(ContentsCheckOf, RecordsThatLieAreTold) {
    const auto begin = [](const char* page) {
        return std::string("grid 3: the record of the page at ") + page;
    };
    EXPECT_TRUE(says(with_record(0, 212, std::uint32_t{5}),
                     begin("level 0 row 0 column 0 says triangles 5, but its posts give ")));
    EXPECT_TRUE(says(with_record(1, 216, std::uint32_t{6}), begin("level 0 row 0 column 1 says meshlets 6")));
    EXPECT_TRUE(
        says(with_record(3, 156, 12.5), begin("level 0 row 1 column 0 says a radius in metres of 12.5")));
    EXPECT_TRUE(says(with_record(9, 196, -500.0), begin("level 1 row 0 column 0 says a lowest h in metres")));
    EXPECT_TRUE(
        says(with_record(13, 204, 1.0e5), begin("level 2 row 0 column 0 says a highest h in metres")));
    EXPECT_TRUE(
        says(with_record(13, 12, 47.5), begin("level 2 row 0 column 0 says a middle at latitude 47.5")));
    EXPECT_TRUE(
        says(with_record(9, 220, 0.0F), begin("level 1 row 0 column 0 says a largest error in metres of 0")));
    EXPECT_TRUE(says(with_record(9, 188, 3.0), begin("level 1 row 0 column 0 says a cone in radians of 3")));
}

}  // namespace
}  // namespace oro
