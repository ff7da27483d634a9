// What meshes may hide from an eye: how high they stand in each direction. Within core.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

#include "core/truth/oracle.h"

namespace oro {

// By directions, of the triangles of a ground that are those of meshes: how near the nearest of them comes,
// and how steeply one looks up to the highest. Both are bounds: what they do not hide no mesh hides.
class MeshSilhouette {
  public:
    MeshSilhouette(const TrueGround& ground, const Sight& sight);
    // False: the ground has no meshes.
    [[nodiscard]] bool any() const { return any_; }
    // Whether a mesh may stand before a point, as it is seen from the eye. Without an error of the kind that
    // says no where one does.
    [[nodiscard]] bool may_hide(const Geodetic& point) const;

  private:
    void add(const std::array<glm::dvec3, 3>& corners_m);

    static constexpr std::size_t directions = 8192;
    struct Direction {
        double nearest_m, highest;  // level metres; tangent of the elevation
    };
    Sight sight_;
    glm::dmat3 enu_from_ecef_{};
    std::vector<Direction> by_direction_;
    bool any_{};
};

}  // namespace oro
