// The ground of one tile as a mesh around a centre, and the walls along its edges.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geo/tilesets/cut_rims.h"
#include "geo/tilesets/level_cut.h"
#include "geo/tilesets/tile_bounds.h"

namespace oro {

// A box of latitudes, longitudes and heights above the ellipsoid. west_deg <= east_deg, in any whole turn.
struct TileBox {
    double west_deg{}, south_deg{}, east_deg{}, north_deg{};
    double lowest_h_m{}, highest_h_m{};
};

// Where a vertex lies on the map. A foot of a wall has the place of the vertex above it.
struct VertexPlace {
    double row{}, column{};  // among the posts of the grid
    double lat_deg{}, lon_deg{};
};

// Triangles are anticlockwise, seen from above or, of walls, from outside.
struct GroundMesh {
    glm::dvec3 centre_m{0.0};  // ECEF
    // Axes of the mesh: east, north and up at its centre, in ECEF.
    glm::dmat3 ecef_from_mesh{1.0};
    // Along these axes, from the centre, in whole steps: half a step off at most.
    double step_m{};
    std::vector<glm::ivec3> positions;
    // Unit, along the same axes, of the ground around the vertex; a wall has those of its edge. Empty where
    // none are wanted.
    std::vector<glm::vec3> normals;
    std::vector<VertexPlace> places;
    std::vector<std::uint32_t> indices;  // three a triangle: those of the ground, then those of walls
    std::size_t ground_triangles{};
    TileBox box;  // holds all triangles, walls included
};

// What a tile has of a cut, divided along the tile's edges, and its walls; each corner in its place in double
// before it is rounded. rims: of the cut. normals: of each vertex of the surface (normals_of()), or none.
GroundMesh ground_mesh(const ClusteredGround& ground, const TilesetLayout& layout, const LevelCut& cut,
                       const CutRims& rims, const TileIndex& tile, const TileWalls& walls,
                       std::span<const glm::vec3> normals);

}  // namespace oro
