// What is drawn of a region when its error in metres, not in pixels, decides: the nodes of a region's levels
// as one mesh.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/bench/bench_mesh.h"
#include "core/lod/pyramid.h"

namespace oro {

struct BlockMesh {
    std::vector<MeshTriangle> triangles;  // stitched, those without an area left out
    std::vector<std::size_t> nodes;       // by level
};

// The coarsest nodes that are certified (MeshletBounds::error_m: heights, sag and stitching, grown as level
// choice needs it) to at most error_m metres, level 0 where nothing coarser is: select_nodes() with metres
// for pixels. A region without voids that does not go round the Earth.
BlockMesh block_mesh(const LevelPyramid& pyramid, const DrawnHeights& heights, double error_m);

}  // namespace oro
