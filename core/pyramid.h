// The levels of a region with what is needed to choose between them: how far each node's triangles are from
// the full resolution, and where.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/culling.h"
#include "core/page.h"
#include "core/post_grid.h"

namespace oro {

// A page of a level. nodes: its meshlets, with their errors, row by row, as in the page's block.
struct PyramidPage {
    PageSummary summary;
    std::array<gpu::MeshletBounds, gpu::meshlets_per_page> nodes;
    // What the page's triangles lie in, and those of all pages below it (the four that cover the same ground,
    // and so on): a sphere around summary.centre_m, negative for none, and a horizon cone.
    double reach_m{-1.0};
    HorizonCone horizon;
};

struct PyramidLevel {
    LevelGrid grid;
    PageLayout layout;
    std::vector<PyramidPage> pages;  // row by row

    [[nodiscard]] const PyramidPage& page(int row, int column) const {
        return pages[static_cast<std::size_t>(row) * static_cast<std::size_t>(layout.columns) +
                     static_cast<std::size_t>(column)];
    }
    // The page of a node that is numbered over the level, and the node.
    [[nodiscard]] const PyramidPage& page_of_node(int row, int column) const {
        return page(row / static_cast<int>(gpu::meshlets_per_side),
                    column / static_cast<int>(gpu::meshlets_per_side));
    }
    [[nodiscard]] const gpu::MeshletBounds& node(int row, int column) const {
        constexpr auto side = gpu::meshlets_per_side;
        return page_of_node(row, column)
            .nodes[static_cast<std::size_t>(row) % side * side + static_cast<std::size_t>(column) % side];
    }
};

// All levels, the finest first; the last is one page. Errors and lod spheres of a node are at least (strictly
// more than rounding in float makes of them) those of the four nodes below it and of the nodes of their level
// that share an edge with these from outside. So a node that is good enough for an eye has only good ones
// below it, and neighbours that are drawn differ by at most one level. Round the Earth the last column's
// neighbour is the first, on every level.
struct LevelPyramid {
    RegionShape shape;
    bool goes_round{};
    std::vector<PyramidLevel> levels;
};

// Gets each page when it is complete, block and all: level by level from the finest, row by row, on the
// caller's thread. The block is good during the call only.
using PageSink = std::function<void(const PyramidPage& page, const gpu::PageBlock& block)>;

// Builds all levels of a region with up to `threads` threads (at least 1); the result does not depend on
// their number. Keeps 12 KB a page, and 4 bytes a post while it works; a post costs about 110 ns of processor
// time.
LevelPyramid build_pyramid(const HeightField& field, const RegionShape& shape, int threads,
                           const PageSink& sink = {});

}  // namespace oro
