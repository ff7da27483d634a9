// The true ground below a mesh's small parts, for its cluster graph.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "core/base/scratch_memory.h"
#include "core/mesh_graph/mesh_ground.h"
#include "core/streamed_mesh/ground_cells.h"
#include "geo/region/region.h"

namespace oro {

struct StoredMesh;

// The cells of a region's grids below and around those parts of a mesh that hang together with nothing and
// have at most 1,152 triangles; a cell more on each side. No grids where there are no such parts, where any
// mesh of the region cuts ground out, and where there would be more than 500,000 cells of one grid, or more
// than most_ground_cells. vertices: metres from `origin`, ECEF. The result does not depend on the order of
// triangles. scratch: where what is of the mesh's size lies; null: in memory.
[[nodiscard]] GroundCells ground_cells_below_parts(std::span<const glm::dvec3> vertices,
                                                   std::span<const std::array<std::uint32_t, 3>> triangles,
                                                   const glm::dvec3& origin_ecef_m, const Region& region,
                                                   ScratchMemory* scratch = nullptr);
// The same of a mesh that was baked.
[[nodiscard]] GroundCells ground_cells_below_parts(const StoredMesh& mesh, const Region& region);

// The triangles of such cells, at full resolution and that exaggeration. Left out is what may not be the
// ground: cells with a void post, and cells that a grid of a smaller rank may cover or change; and cells that
// are so large that a flat triangle is more than 2 cm off. Empty where there would be more than a million,
// where any mesh of the region cuts ground out, and where the region has other grids there than those that
// the cells are of.
[[nodiscard]] MeshGround ground_in_cells(const GroundCells& cells, const glm::dvec3& origin_ecef_m,
                                         const Region& region, double exaggeration);

// Both: the ground below a mesh's small parts.
[[nodiscard]] MeshGround ground_below_parts(std::span<const glm::dvec3> vertices,
                                            std::span<const std::array<std::uint32_t, 3>> triangles,
                                            const glm::dvec3& origin_ecef_m, const Region& region,
                                            double exaggeration);
[[nodiscard]] MeshGround ground_below_parts(const StoredMesh& mesh, const Region& region,
                                            double exaggeration);

// Of its triangles' corners on the lattice of 2^-11 m; 0 where it is empty.
[[nodiscard]] std::uint64_t fingerprint_of(const MeshGround& ground, const glm::dvec3& origin_ecef_m);

}  // namespace oro
