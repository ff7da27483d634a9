// Which nodes of a region's pyramid a picture is drawn with, so that nothing in it is farther than tau pixels
// from where the full resolution would put it. The reference that the GPU's own choice is held against.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/earth/camera.h"
#include "core/lod/levels_gpu.h"
#include "core/lod/pyramid.h"
#include "core/lod/pyramid_pages.h"

namespace oro {

// What level choice needs to know of a picture. One for all tiles of a picture: levels do not depend on the
// tile.
struct LevelView {
    // Half the picture's height in pixels / the tangent of half its field of view.
    float pixels_per_tangent{};
    // Of the angle between the axis and the picture's farthest corner, and a pixel more.
    float corner_tangent{};
    float tau_px{};
};
LevelView level_view(const Camera& camera, double tau_px);

// A node to draw, numbered over its level, and its edges (shaders/choose/levels.glsl) that are stitched
// because what is drawn beyond them is one level coarser.
struct DrawnNode {
    int level{};
    int row{};
    int column{};
    std::uint32_t edges{};
};

struct NodeSelection {
    std::vector<DrawnNode> nodes;  // coarsest first, then by page and node
    std::size_t pages_seen{};      // whose nodes were looked at
    std::size_t pages_beyond_frustum{};
    std::size_t pages_beyond_horizon{};
};

// The nodes of a tile of a picture: each place of the region that can be seen is covered by exactly one of
// them, the levels of two that share an edge differ by at most one, and every full-resolution place in the
// picture is within tau_px of the one drawn in its stead (and of placement_far_share of its distance, the
// rounding of its place). Pages that cannot be seen are left out with all below them; single nodes of the
// others are not tested. Level 0 is drawn where nothing coarser will do; tau_px 0 draws it everywhere. Pages
// are asked for that can be seen and whose nodes may be drawn, and those around them, one level coarser.
NodeSelection select_nodes(const PyramidPages& pages, const Camera& camera, const Tile& tile, double tau_px);
NodeSelection select_nodes(const LevelPyramid& pyramid, const Camera& camera, const Tile& tile,
                           double tau_px);

}  // namespace oro
