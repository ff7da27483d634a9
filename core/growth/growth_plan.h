// Where trees may stand in a frame: tiles of the lattice of sites (core/growth/tree_sites.h) around the eye.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/earth/camera.h"
#include "core/terrain/page.h"
#include "core/terrain/post_grid.h"
#include "shaders/shared_growth.h"

namespace oro {

// Ready for the GPU but for the addresses of its buffers.
struct GrowthPlan {
    std::vector<gpu::GrowthTile> tiles;  // nearest first; none: no trees
    float reach_m{};                     // no tree is farther from the eye
    gpu::uint first_page{};              // of triangle ids, once the frame's pages are numbered
};

// From where trees are seen.
struct GrowthView {
    Camera camera;
    Tile tile;  // of the camera's picture
    double tau_px{1.0};
    double exaggeration{1.0};  // of the ground, and of what grows on it
};

// Lowest and highest ground of one of the frame's pages, metres above the ellipsoid, as drawn.
struct GroundRange {
    double low_m, high_m;
};
using GroundRangeOf = std::function<GroundRange(std::size_t page)>;

// The tiles within reach (shaders/growth/reach.glsl) of the eye that may show and have a part in the grid, at
// most gpu::growth_tiles_max, the nearest. A tile belongs to the finest of the frame's pages that covers all
// of it; without one it is left out. page_indices: of the frame, in its order. Errors: none; an eye near a
// pole or far from the grid has no tiles.
GrowthPlan plan_growth(const PostGrid& grid, std::span<const PageIndex> page_indices,
                       const GroundRangeOf& ground, const GrowthView& view);

// How many pixels a forest without drawn trees rises above its ground at most, of ground that is not
// exaggerated.
int canopy_rise_px(const Camera& camera, double tau_px);

}  // namespace oro
