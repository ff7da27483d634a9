// The ground of one page as a mesh around a centre, and the walls along its edges.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/base/result.h"
#include "core/frame/region_pages.h"
#include "geo/tilesets/tile_bounds.h"

namespace oro {

// A box of latitudes, longitudes and heights above the ellipsoid. west_deg <= east_deg, in any whole turn.
struct TileBox {
    double west_deg{}, south_deg{}, east_deg{}, north_deg{};
    double lowest_h_m{}, highest_h_m{};
};

// Triangles are anticlockwise, seen from above or, of walls, from outside.
struct GroundMesh {
    glm::dvec3 centre_m{0.0};  // ECEF
    // ECEF less the centre, in whole steps: half a step off along each axis at most. Those of ground have 23
    // bits and a sign, and so are the same in float.
    double step_m{};
    std::vector<glm::vec3> positions_m;
    std::vector<glm::vec3>
        normals;  // unit, ECEF, of the ground around the vertex; a wall has those of its edge
    std::vector<std::uint32_t> indices;  // three a triangle: those of the ground, then those of walls
    std::size_t ground_triangles{};
    TileBox box;  // holds all triangles, walls included
};

// The page with all its quads and its walls, each post in its place in double before it is rounded; posts
// without a height leave out what lies between them. Errors: a file that cannot be read.
Result<GroundMesh> ground_mesh(const RegionPages& pages, const PageIndex& page, const TileBounds& bounds);

}  // namespace oro
