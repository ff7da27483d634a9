// Colours of posts over the ground: which texels have which, and what is below them.
#include "core/drape/post_colours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "tests/support/made_terrain.h"

namespace oro {
namespace {

// The same colour everywhere.
class Plain final : public GroundImage {
  public:
    explicit Plain(std::uint32_t texel) : texel_(texel) {}
    [[nodiscard]] int finest_level() const override { return -2; }
    [[nodiscard]] int coarsest_level() const override { return 0; }
    Result<bool> load(const ImageTile&, std::span<std::uint32_t> texels) const override {
        std::ranges::fill(texels, texel_);
        return true;
    }

  private:
    std::uint32_t texel_;
};

// 41 x 51 posts, ten a degree; rows 3 to 5 and columns 7 to 9 have colours: their numbers, from 1.
PostColours nine_posts() {
    PostColours colours;
    colours.grid = test::made_field(47.0, 8.0, 10.0, 41, 51, [](double, double) { return 100.0F; }).grid;
    colours.part.first_row = 3;
    colours.part.first_column = 7;
    colours.part.rows = colours.part.columns = 3;
    for (std::uint32_t i = 1; i <= 9; ++i) colours.rgba.push_back(0xFF000000U | i);
    return colours;
}

struct LoadedTile {
    bool any{};
    std::vector<std::uint32_t> texels = std::vector<std::uint32_t>(gpu::drape_words);
    [[nodiscard]] std::uint32_t at(int row, int column) const {
        return texels[static_cast<std::size_t>((row + 1) * static_cast<int>(gpu::drape_stride) + column + 1)];
    }
};
LoadedTile loaded(const GroundImage& image, const ImageTile& tile) {
    LoadedTile one;
    one.any = image.load(tile, one.texels).value();
    return one;
}

TEST(PostColours, ATexelHasTheColourOfTheNearestPost) {
    const PostColours colours = nine_posts();
    const auto shared = std::make_shared<PostColours>(colours);
    // The second grid lies at the same places under another number: texels go by their places there.
    for (const std::size_t number : {0U, 1U}) {
        const auto image = colours_over_ground(colours.grid, number, shared, nullptr, 1.0);
        EXPECT_EQ(image->finest_level(), 0);
        const LoadedTile tile = loaded(*image, {0, 0, 0});
        ASSERT_TRUE(tile.any);
        // A texel is half a post wide: post p is the nearest of texels 2 p - 1 and 2 p.
        for (int row = 0; row < 100; ++row) {
            for (int column = 0; column < 120; ++column) {
                const int down = (row + 1) / 2 - 3, right = (column + 1) / 2 - 7;
                const bool is_in = down >= 0 && down < 3 && right >= 0 && right < 3;
                const std::uint32_t expected =
                    is_in ? 0xFF000000U | static_cast<std::uint32_t>(3 * down + right + 1) : 0U;
                ASSERT_EQ(tile.at(row, column), expected) << number << ": " << row << ", " << column;
            }
        }
    }
    EXPECT_FALSE(loaded(*colours_over_ground(colours.grid, 0, shared, nullptr, 1.0), {0, 1, 0}).any);
}

// What a window shows at first of a grid: every fourth post of it, under the same number.
TEST(PostColours, LieWhereTheyAreOverCoarserPosts) {
    const auto colours = std::make_shared<PostColours>(nine_posts());
    PostGrid coarse = colours->grid;
    coarse.lat = {2.5, 47.0, 0, -1, 11};
    coarse.lon = {2.5, 8.0, 0, +1, 13};
    const LoadedTile tile = loaded(*colours_over_ground(coarse, 0, colours, nullptr, 1.0), {0, 0, 0});
    ASSERT_TRUE(tile.any);
    // Texel i stands at post 2 i + 1 of the colours' grid.
    for (int row = 0; row < 20; ++row) {
        for (int column = 0; column < 24; ++column) {
            const bool is_in = (row == 1 || row == 2) && (column == 3 || column == 4);
            const int number = 3 * (row == 1 ? 0 : 2) + (column == 3 ? 1 : 3);
            ASSERT_EQ(tile.at(row, column), is_in ? 0xFF000000U | static_cast<std::uint32_t>(number) : 0U)
                << row << ", " << column;
        }
    }
}

TEST(PostColours, AreMixedInCoarseLevels) {
    PostColours colours = nine_posts();
    // Four posts along a side of a texel, from post 4 on: half of them, those of even columns.
    colours.part.first_row = colours.part.first_column = 4;
    colours.part.rows = colours.part.columns = 4;
    colours.rgba.clear();
    for (int i = 0; i < 16; ++i) colours.rgba.push_back(i % 2 == 0 ? 0xFF0000C8U : 0U);
    const PostGrid grid = colours.grid;
    const auto image =
        colours_over_ground(grid, 0, std::make_shared<PostColours>(std::move(colours)), nullptr, 1.0);
    // Texel 1 of level 3 is over posts 4 to 8; its four samples stand at posts 4.5, 5.5, 6.5 and 7.5, whose
    // nearest is the next: 5, 6, 7 and 8, which has no colour. Rows likewise: 3 of 4, and of columns 6 alone.
    const LoadedTile tile = loaded(*image, {3, 0, 0});
    const double share = 3.0 / 4.0 * 1.0 / 4.0;
    EXPECT_EQ(tile.at(1, 1) & 0xFFU, static_cast<std::uint32_t>(200.0 * share + 0.5));
    EXPECT_EQ(tile.at(1, 1) >> 24U, static_cast<std::uint32_t>(255.0 * share + 0.5));
}

TEST(PostColours, LieOverImages) {
    PostColours colours = nine_posts();
    const PostGrid grid = colours.grid;
    // 255 x 0.55 = 140.25, 176 x 0.55 = 96.8, 32 x 0.55 = 17.6.
    const std::uint32_t tint = texel_of(255, 176, 32, 0.55);
    EXPECT_EQ(tint, 0x8C12618CU);
    colours.rgba.assign(9, tint);
    const auto shared = std::make_shared<PostColours>(std::move(colours));
    const auto over = [&](double opacity) {
        return colours_over_ground(grid, 0, shared, std::make_unique<Plain>(0xFF646464U), opacity);
    };
    EXPECT_EQ(over(1.0)->finest_level(), -2);
    const LoadedTile whole = loaded(*over(1.0), {0, 0, 0});
    EXPECT_EQ(whole.at(0, 0), 0xFF646464U);
    // Of the image 1 - 140 / 255 is left: 45.1 of 100.
    EXPECT_EQ(whole.at(8, 16), 0xFF3F8EB9U);
    const LoadedTile faint = loaded(*over(0.4), {0, 0, 0});
    EXPECT_EQ(faint.at(0, 0), 0x66282828U);
    // 18.04 of 100, and of its alpha 46 of 255.
    EXPECT_EQ(faint.at(8, 16), 0xBA24739EU);
}

}  // namespace
}  // namespace oro
