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

// The nodes of a quarter of a page (8 x 8 of them: what one page of the level below covers), all together: a
// sphere in the page's frame that holds their lod spheres, and their largest error. A bound on these in
// double holds for each of them in float.
struct PageQuarter {
    glm::dvec3 centre_m{0.0};
    double lod_radius_m{-1.0};  // negative: none of them has a triangle
    float largest_error_m{};    // unfit_error_m where one is unfit; may be so without a triangle, too
};

// What the choice of pages needs to know of one.
struct PageRecord {
    PageSummary summary;
    // What the page's triangles lie in, and those of all pages below it (the four that cover the same ground,
    // and so on): a sphere around summary.centre_m, negative for none, and a horizon cone.
    double reach_m{-1.0};
    HorizonCone horizon;
    std::array<PageQuarter, 4> quarters;  // north-west, north-east, south-west, south-east
};

// A page of a level. nodes: its meshlets, with their errors, row by row, as in the page's block.
struct PyramidPage : PageRecord {
    std::array<gpu::MeshletBounds, gpu::meshlets_per_page> nodes;
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
