// Where a stitched triangle of a node is compared with the coarse octaves of made terrain: the same places
// for all whole nodes of a level, found once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/terrain/drawn_heights.h"

namespace oro {

// A post, by its row and column: of a node, or of a grid.
struct PostOffset {
    int row{}, column{};
};

// The samples of one triangle: the posts in it and on its edges, and where its edges cross those of the
// surface that is linear between posts, over cells that are all nw_se.
class StitchedSamples {
  public:
    struct PostRow {
        int number, first_column, last_column;
    };
    // corners: posts of the triangle, from its node's north-western one. columns: of the grid.
    StitchedSamples(const std::array<PostOffset, 3>& corners, int columns);
    // Largest difference in steps between the triangle of the drawn heights, which the grid has at all
    // corners, and the coarse octaves (CoarseDeviations). node: its north-western post. Any thread.
    [[nodiscard]] double largest_steps(const DrawnHeights& heights,
                                       std::span<const std::int32_t> coarse_steps,
                                       const PostOffset& node) const;

  private:
    // On the way from one post to the next one, by their places in the grid from the node's on.
    struct Crossing {
        std::ptrdiff_t post, next_post;
        double share;  // of the triangle's edge
        // From the node: along the way's axis, where the edge begins, where the first post is, and how far
        // the crossing is from where the edge begins.
        double begin, first, far;
        bool is_along_row;
    };
    struct Edge {
        std::size_t from{}, to{};
        std::vector<Crossing> crossings;
    };
    void add_crossings(Edge& edge);
    void add_crossing(Edge& edge, double share, PostOffset post, double far, bool is_along_row);
    void add_posts();
    [[nodiscard]] std::ptrdiff_t number_of(const PostOffset& post) const {
        return static_cast<std::ptrdiff_t>(post.row) * columns_ + post.column;
    }

    std::array<PostOffset, 3> corners_;
    int columns_;
    std::array<Edge, 3> edges_;
    std::vector<PostRow> rows_;
};

}  // namespace oro
