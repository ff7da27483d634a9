// Errors of the nodes of some levels of made terrain over a part of it, measured against posts a few levels
// finer and bounded by proven constants below those.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/made/made_rule.h"
#include "core/made/post_maker.h"
#include "core/made_pages/level_bounds.h"
#include "core/terrain/level_grid.h"
#include "core/terrain/page.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Made terrain as its pages need it: its rule, its grid and what holds for each of its levels.
struct MadeRegion {
    MadeTerrain terrain;  // fbm or ridged; its outermost posts are the grid's
    gpu::MadeRule rule;
    PostGrid grid;
    UndulationField undulation;
    std::vector<std::vector<MadeLevelBound>> bounds_from_deg;  // made_level_bounds()
    double undulation_range_m{};
    std::int32_t highest_steps{};            // no drawn height is above it
    std::shared_ptr<MadePostMaker> maker{};  // asked for posts first; null: threads make them
    // Of levels, wherever they are.
    [[nodiscard]] const std::vector<MadeLevelBound>& bounds() const { return bounds_from_deg.front(); }
};
MadeRegion made_region(const MadeTerrain& terrain, const PostGrid& grid, const UndulationField& undulation);

// H of posts of one row, each metres, as made terrain has them: of the region's columns whose places are
// `columns`. row: of the region. Any thread.
void made_posts_of_row(const MadeRegion& region, int row, std::span<const MadeColumn> columns,
                       std::span<float> H_m);

// Error and lod sphere of a node, as MeshletBounds has them.
struct MadeNode {
    float error_m{};
    float lod_radius_m{};
};
// Of a node for which nothing is measured.
MadeNode unmeasured_node(const MadeRegion& region, int level);

// Three levels are measured together: 1 to 3 against level 0, which is exact, 4 to 6 against the coarse
// octaves at the posts of level 2, 7 to 9 at those of level 5, and so on; where heights may be cut off,
// against level 2, 5 and so on itself.
inline constexpr int levels_of_block = 3;
inline int measured_against(int top_level) {
    return top_level <= levels_of_block ? 0 : top_level - levels_of_block - 1;
}
inline int block_top(int level) {
    return (level + levels_of_block - 1) / levels_of_block * levels_of_block;
}
// The highest level that is measured; 0: none is.
int highest_measured_level(const MadeRegion& region);

// What a picture needs of a block, by nodes of the block's top level: rows and columns are of the region.
struct BlockPicture {
    // Whether anything over the node may be in the picture.
    std::function<bool(int row, int column)> may_show;
    // Whether the node and those below it, whose errors are no less, are too far from the truth for it: then
    // something finer than all of the block's levels is drawn in its stead.
    std::function<bool(int row, int column, double error_m)> is_bad;
    // Whether the node, with such an error and sphere, is near enough to the truth there: then nothing finer
    // is drawn in its stead.
    std::function<bool(int row, int column, const MadeNode& node)> is_good;
    // Whether light to what the picture shows may need to be known past the node; empty: light does not
    // matter. The three above tell of that, too, and errors are then bounds wherever they are not 0.
    std::function<bool(int row, int column)> may_cast{};
};

// What no node of a block, whose top page is given, has an error below, whatever is measured.
double least_error_m(const MadeRegion& region, const PageIndex& top);

// The nodes of the levels of a block over the ground of one page of its top level.
class MeasuredBlock {
  public:
    // top: a page whose level is a multiple of levels_of_block and at most highest_measured_level(); it may
    // be beyond the levels that the region has. Takes some 1.3 million posts, above level 3 5.3
    // million, and 24 bytes for each while it works.
    // picture: the only one that the block is for; it is then measured as coarsely as decides what is drawn.
    // Nodes of the top level that may show, and those beside them, are either what they are without a
    // picture, to the bit, and so are all below them; or they are good, with an error that is no less than
    // that one, and those below them have an error and a sphere of 0; or they are bad, and they and those
    // below them have an error that is no more than without, and a sphere of 0. All others have 0 of both.
    // known: the same block for another picture; what is exact in it is not measured again.
    MeasuredBlock(const MadeRegion& region, const PageIndex& top, int threads,
                  const BlockPicture* picture = nullptr, const MeasuredBlock* known = nullptr);

    // A node by its place among those of its level, which is one of the block's; over the block's page.
    [[nodiscard]] const MadeNode& node(int level, int row, int column) const {
        const Level& at = levels_[static_cast<std::size_t>(top_.level - level)];
        return at.nodes[at.number_of(row, column)];
    }
    // Whether a node of the top level, and all below it, are what they are without a picture.
    [[nodiscard]] bool is_exact(int row, int column) const {
        return is_exact_[levels_.front().number_of(row, column)] != 0;
    }
    // Bytes that it keeps.
    [[nodiscard]] std::uint64_t bytes() const;

  private:
    struct Level {
        int first_row{}, first_column{}, rows{}, columns{};
        std::vector<MadeNode> nodes;  // row by row
        [[nodiscard]] std::size_t number_of(int row, int column) const {
            return static_cast<std::size_t>(row - first_row) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(column - first_column);
        }
        MadeNode& at(int row, int column) { return nodes[number_of(row, column)]; }
    };
    void make_levels(const MadeRegion& region);
    // Of a node of the top level and all below it: asked(level, row, column) gives each.
    template <class Asked>
    void set_below(int top_row, int top_column, const Asked& asked);
    template <class Asked>
    void set_exact(int top_row, int top_column, const Asked& asked);
    PageIndex top_;
    std::vector<Level> levels_;   // the top first
    std::vector<char> is_exact_;  // of nodes of the top level
};

}  // namespace oro
