// The levels of a region with what is needed to choose between them: how far each node's triangles are from
// the full resolution, and where.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "core/base/result.h"
#include "core/earth/culling.h"
#include "core/terrain/page.h"
#include "core/terrain/post_grid.h"

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

// A page of a level. nodes: its meshlets, with their errors, row by row, as in the page's block; so are
// boxes.
struct PyramidPage : PageRecord {
    std::array<gpu::MeshletBounds, gpu::meshlets_per_page> nodes;
    std::array<gpu::uint, gpu::meshlets_per_page> boxes;

    // The one of its nodes that has this place among the nodes of its level.
    [[nodiscard]] const gpu::MeshletBounds& node(int row, int column) const {
        constexpr auto side = gpu::meshlets_per_side;
        return nodes[static_cast<std::size_t>(row) % side * side + static_cast<std::size_t>(column) % side];
    }
};

struct PyramidLevel {
    LevelGrid grid;
    PageLayout layout;
    std::vector<PyramidPage> pages;  // row by row

    [[nodiscard]] const PyramidPage& page(int row, int column) const {
        return pages[layout.number(row, column)];
    }
    // The page of a node that is numbered over the level, and the node.
    [[nodiscard]] const PyramidPage& page_of_node(int row, int column) const {
        return page(row / static_cast<int>(gpu::meshlets_per_side),
                    column / static_cast<int>(gpu::meshlets_per_side));
    }
    [[nodiscard]] const gpu::MeshletBounds& node(int row, int column) const {
        return page_of_node(row, column).node(row, column);
    }
};

// All levels, the finest first; the last is one page. Errors and lod spheres of a node are at least (strictly
// more than rounding in float makes of them) those of the four nodes below it and of the nodes of their level
// that share an edge with these from outside. So a node that is good enough for an eye has only good ones
// below it, and neighbours that are drawn differ by at most one level. Round the Earth the last column's
// neighbour is the first, on every level.
struct LevelPyramid {
    RegionShape shape;
    bool wraps_longitude{};
    std::vector<PyramidLevel> levels;
};

// Gets each page when it is complete, block and all: level by level from the finest, row by row, on the
// caller's thread. The block is good during the call only.
using PageSink = std::function<void(const PyramidPage& page, const gpu::PageBlock& block)>;

// Deviations, metres, of the four stitched edges of each node of a page (NodeDeviation::stitched_m), rounded
// up.
using StitchedDeviations = std::array<std::array<float, 4>, gpu::meshlets_per_page>;

// What a builder does beside building; any of them may be empty.
struct PyramidHooks {
    // What was measured of a page before: its nodes' errors and lod radii, and its stitched edges. False
    // when there is nothing of it. Called from several threads, once for each page.
    struct Measured {
        std::array<float, gpu::meshlets_per_page> error_m;
        std::array<float, gpu::meshlets_per_page> lod_radius_m;
        StitchedDeviations stitched;
    };
    std::function<bool(const PageIndex& page, Measured& measured)> recall;
    // Work on a complete page, from several threads; `slot` is 0 .. pages_at_a_time - 1, another one for each
    // of the pages that are worked on.
    std::function<void(int slot, const PyramidPage& page, const gpu::PageBlock& block)> work;
    // Gets each page in order, after its work, on the caller's thread. An error ends the building.
    std::function<Result<void>(int slot, const PyramidPage& page, const gpu::PageBlock& block,
                               const StitchedDeviations& stitched)>
        sink;
    static constexpr int pages_at_a_time = 32;
    MeshletBounding bounding{MeshletBounding::whole};
};

// Builds all levels of a region with up to `threads` threads (at least 1); the result does not depend on
// their number. Keeps 12 KB a page, and 4 bytes a post while it works; a post costs about 110 ns of processor
// time.
LevelPyramid build_pyramid(const HeightField& field, const RegionShape& shape, int threads,
                           const PageSink& sink = {});
// Builds a pyramid from heights that are there already: the field's own, with the shape's exaggeration.
LevelPyramid build_pyramid(const PostGrid& grid, const RegionShape& shape, const DrawnHeights& heights,
                           int threads, const PageSink& sink = {});
// Builds a pyramid with hooks. keep_levels: false drops the pages of a level once those of the next are
// built, so that only the last two levels are in memory. Errors: the sink's.
Result<LevelPyramid> build_pyramid_with(const PostGrid& grid, const RegionShape& shape,
                                        const DrawnHeights& heights, int threads, const PyramidHooks& hooks,
                                        bool keep_levels = true);

}  // namespace oro
