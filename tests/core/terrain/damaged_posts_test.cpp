// Posts of a region file that cannot be read: void, but never taken for a void of the data.
#include <gtest/gtest.h>

#include <thread>
#include <vector>

#include "core/baked/bake.h"
#include "core/baked/file_pages.h"
#include "core/terrain/ground.h"
#include "core/truth/true_surface.h"
#include "tests/core/baked/made_region_file.h"
#include "tests/support/mended_container.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

// 300 x 280 posts in 9 pages.
class DamagedPosts : public testing::Test {
  protected:
    void SetUp() override {
        field_ = rough_field(47.0, 8.0, 300, 280);
        BakeOptions how;
        how.path = path_.string();
        const auto done = bake_region(field_, how);
        ASSERT_TRUE(done.ok()) << done.error().line();
    }
    std::shared_ptr<const RegionFile> open() const {
        auto file = RegionFile::open(path_.string());
        EXPECT_TRUE(file.ok()) << file.error().line();
        return std::make_shared<const RegionFile>(std::move(*file));
    }
    // Flips a bit of the payload of the page in the middle; the byte at which the payload begins.
    std::uint64_t damage_middle_page() const {
        const auto input = OpenFile::open(path_.string(), OpenFile::Use::read);
        const PageOrder order(field_.grid);
        const Chunk heights = chunk_of(path_, ChunkType::heights);
        const RegionOffsets offsets{chunk_of(path_, ChunkType::pages).offset, heights.offset,
                                    heights.offset + heights.bytes};
        const auto record = region_format::read_record(*input, offsets, order, order.number({1, 1, 0}));
        EXPECT_TRUE(record.ok());
        std::string bytes = content(path_);
        const std::size_t at = offsets.payloads + record->payload_offset + record->payload_bytes / 2;
        bytes[at] = static_cast<char>(bytes[at] ^ 4);
        put(path_, bytes);
        return offsets.payloads + record->payload_offset;
    }

    const fs::path path_ = scratch_folder() / "a.oro";
    HeightField field_;
};

TEST_F(DamagedPosts, AreToldOnceTheyAreAskedForAndNotBefore) {
    const std::uint64_t byte = damage_middle_page();
    const HeightField field = field_of_file(open(), 1U << 20U);
    EXPECT_EQ(field.H_at_post_m(0, 0), field_.H_at_post_m(0, 0));
    EXPECT_TRUE(field.health().ok());
    EXPECT_TRUE(is_void(field.H_at_post_m(150, 150)));
    ASSERT_FALSE(field.health().ok());
    EXPECT_TRUE(says(field.health().error().line(),
                     path_.string() + ": is damaged at byte " + std::to_string(byte) +
                         ": the payload of the page at level 0 row 1 column 1 has checksum"))
        << field.health().error().line();
    // Whole pages are what they are, and the fault stays.
    EXPECT_EQ(field.H_at_post_m(299, 279), field_.H_at_post_m(299, 279));
    EXPECT_FALSE(field.health().ok());
    EXPECT_TRUE(field_.health().ok());
}

TEST_F(DamagedPosts, FailWhatAsksForGround) {
    (void)damage_middle_page();
    const HeightField field = field_of_file(open(), 1U << 20U);
    const PostGrid& grid = field.grid;
    EXPECT_FALSE(ground_h_m(field, grid.lat.at_deg(150), grid.lon.at_deg(150)));
    EXPECT_FALSE(field.health().ok());
    const HeightField other = field_of_file(open(), 1U << 20U);
    const TrueSurface surface(other, 1.0, 1);
    EXPECT_TRUE(other.health().ok());
    EXPECT_FALSE(surface.h_m(grid.lat.at_deg(150), grid.lon.at_deg(150)));
    EXPECT_FALSE(other.health().ok());
}

TEST_F(DamagedPosts, AreToldByWhicheverThreadMeetsThem) {
    (void)damage_middle_page();
    const HeightField field = field_of_file(open(), 1U << 20U);
    {
        std::vector<std::jthread> threads;
        for (int first = 0; first < 4; ++first) {
            threads.emplace_back([&field, first] {
                for (int row = first; row < 300; row += 4) (void)field.H_at_post_m(row, row % 280);
            });
        }
    }
    EXPECT_FALSE(field.health().ok());
}

TEST_F(DamagedPosts, OfAFileThatIsCutOffWhileItIsOpen) {
    const HeightField field = field_of_file(open(), 1U << 20U);
    fs::resize_file(path_, fs::file_size(path_) / 2);
    for (int row = 0; row < 300; row += 10) (void)field.H_at_post_m(row, 200);
    ASSERT_FALSE(field.health().ok());
    EXPECT_TRUE(says(field.health().error().line(), "it ends here")) << field.health().error().line();
}

// A page that a bake found, and that cannot be read any more when its turn comes, ends the bake; the finished
// file has never a page that is damaged.
TEST(BakeThatGoesOn, EndsAtAPageThatIsDamagedMeanwhile) {
    const fs::path folder = scratch_folder();
    const HeightField field = rough_field(47.0, 8.0, 700, 800);  // 6 x 7 pages of level 0
    BakeOptions how;
    how.threads = 2;
    how.path = (folder / "whole.oro").string();
    ASSERT_TRUE(bake_region(field, how).ok());
    how.path = (folder / "a.oro").string();
    ASSERT_FALSE(bake_region(field, how, [](double share) { return share < 0.9; }).ok());
    bool first = true;
    const auto damaged = bake_region(field, how, [&](double) {
        if (!first) return true;
        first = false;  // the first 32 pages are done
        std::string bytes = content(folder / "a.oro.partial");
        char& late = bytes[bytes.size() / 8 * 7];
        late = static_cast<char>(late ^ 1);
        std::fstream file(folder / "a.oro.partial", std::ios::binary | std::ios::in | std::ios::out);
        file << bytes;
        return true;
    });
    ASSERT_FALSE(damaged.ok());
    EXPECT_TRUE(says(damaged.error().line(), "a.oro.partial: is damaged at byte")) << damaged.error().line();
    EXPECT_FALSE(fs::exists(folder / "a.oro"));
    const auto again = bake_region(field, how);
    ASSERT_TRUE(again.ok()) << again.error().line();
    EXPECT_TRUE(content(folder / "a.oro") == content(folder / "whole.oro"));
}

}  // namespace
}  // namespace oro
