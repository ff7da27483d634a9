// How far what is drawn of meshes is from the meshes, and these from what is drawn of them: place by place.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>

#include "core/measure/drawn_point.h"
#include "core/measure/ground_error.h"
#include "core/truth/oracle.h"
#include "core/truth/true_ground.h"
#include "core/truth/true_mesh.h"

namespace oro {

// A place of a mesh has no row and no column that tell which one it is: it is held against the nearest place
// of the other set of triangles. Distances are those in space, metres, and on the picture those between the
// two places. For any number of threads at once; what it is made of outlives it.
class MeshMeter {
  public:
    // drawn: the triangles that are drawn in the place of the ground's meshes. The ground has meshes.
    MeshMeter(const TrueGround& ground, const Sight& sight, const GroundMeter& meter,
              std::span<const TrueMesh> drawn);

    // From what a pixel shows of a mesh, of what is left beside it or of a step between grids to the nearest
    // true place of these.
    [[nodiscard]] Distance from_true(const glm::dvec2& point_px, const DrawnPoint& point) const;
    // From a place of a mesh that is truly seen to the nearest that is drawn of meshes, or where it is nearer
    // to the true ground, onto which parts of meshes may be dropped.
    [[nodiscard]] Distance from_drawn(const Geodetic& seen) const;

  private:
    [[nodiscard]] Distance apart(const glm::dvec3& drawn_m, const glm::dvec3& true_m) const;

    const TrueGround& ground_;
    const Sight& sight_;
    const GroundMeter& meter_;
    std::span<const TrueMesh> drawn_;
    TrueMesh pieces_;  // what lies between grids, and walls along the rims of cuts
};

}  // namespace oro
