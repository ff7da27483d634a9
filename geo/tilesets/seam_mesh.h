// Some of what is between grids as a mesh around a centre, with walls that hang from its outer edges.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "core/seam/seam.h"
#include "core/terrain/post_grid.h"
#include "geo/tilesets/ground_mesh.h"
#include "geo/tilesets/tile_bounds.h"

namespace oro {

// Where positions may be: whole steps along three axes from an origin. One for all tiles between grids, so
// that a corner has one place in all of them.
struct SeamLattice {
    glm::dvec3 origin_m{0.0};        // ECEF
    glm::dmat3 ecef_from_axes{1.0};  // at right angles, of length 1
    double step_m{1.0};
};

// pieces, skirts: numbers in `seam`. A skirt is an upright step, and a wall hangs from its foot as far down
// and outwards as `reach` says, at a corner of two skirts between both. Ground are the pieces; steps and
// walls follow. Places are numbered by `grid`. Needs a piece or a skirt.
GroundMesh seam_mesh(const Seam& seam, std::span<const std::uint32_t> pieces,
                     std::span<const std::uint32_t> skirts, const PostGrid& grid, const WallReach& reach,
                     const SeamLattice& lattice, bool normals);

}  // namespace oro
