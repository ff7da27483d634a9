// How far a node's triangles lie from what the coarse octaves of made terrain give alone, at the posts of a
// finer level.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lod/node_deviations.h"
#include "core/made_pages/stitched_samples.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Of the nodes of one level of a grid without voids. The triangles have the drawn heights, all octaves of
// them, at their corners. What they are compared with are the coarse octaves at all posts of the grid, and
// linear between these: over triangles of which each lies in one of the node's, or cells of one diagonal, as
// is least work; the bound of what is between posts holds for any (MadeLevelBound::coarse).
class CoarseDeviations {
  public:
    // coarse_steps: drawn heights of the coarse octaves alone, post by post as those of `heights`. All are
    // read where they are.
    CoarseDeviations(const PostGrid& grid, const DrawnHeights& heights,
                     std::span<const std::int32_t> coarse_steps, int level);

    // Largest difference of a node as it is, metres. Quads that are not square are left out. Any thread.
    [[nodiscard]] double own_m(int node_row, int node_column) const;
    // The same of the triangles that are there where an edge is stitched to a coarser neighbour
    // (NodeDeviation::stitched_m). edges: those with a neighbour. 0 of those that are not asked for.
    [[nodiscard]] PerEdge stitched_m(int node_row, int node_column, std::uint32_t edges,
                                     std::uint32_t asked_edges) const;

  private:
    [[nodiscard]] std::size_t number_of(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(heights_.columns) +
               static_cast<std::size_t>(column);
    }
    [[nodiscard]] bool is_whole(int node_row, int node_column) const;

    const DrawnHeights& heights_;
    std::span<const std::int32_t> coarse_;
    LevelGrid level_;
    int level_posts_;                             // along a quad
    std::vector<StitchedSamples> of_whole_node_;  // of each triangle
};

}  // namespace oro
