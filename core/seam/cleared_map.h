// Ground near meshes, seen from above: where no trees are planted, and where a town's ground begins.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "core/earth/camera.h"
#include "core/seam/mesh_casters.h"
#include "shaders/shared.h"

namespace oro {

// A map in the plane that touches the ellipsoid in the meshes' middle.
struct ClearedMap {
    glm::dvec3 middle_m{0.0};          // ECEF: the plane's origin, in the map's middle
    glm::dvec3 east{0.0}, south{0.0};  // unit vectors along columns and rows, ECEF
    double cell_m{};      // a cell's edge: 4 m, more where the map would be larger than 1,024 cells
    glm::uvec2 side{0U};  // columns, rows; 0: there are no meshes
    std::vector<std::uint32_t> cells;  // row by row, as gpu::ClearedGround has them
};

// The map of these triangles. Distances are from cells' middles to those of the cells that triangles touch,
// and up to 8 % too large (they go along rows, columns and diagonals). Takes some 0.1 us a triangle and
// 20 ms for a million cells, on one thread.
ClearedMap cleared_map_of(const MeshCasters& casters);

// The map as a frame has it, of a camera over the ellipsoid; but for the cells' address.
gpu::ClearedGround cleared_in_view(const ClearedMap& map, const Camera& camera);

}  // namespace oro
