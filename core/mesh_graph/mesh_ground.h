// The ground below a mesh, where it is known.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

namespace oro {

// Triangles of the terrain at full resolution around a mesh: of that near its small parts.
struct MeshGround {
    std::vector<std::array<glm::dvec3, 3>> triangles;  // metres from the place that vertices are from
    // How far a place of one of them may be from the terrain that it stands for.
    double off_m{};
};

// The user of a piece of a mesh that lies on the ground: no group answers for it any more.
inline constexpr int on_ground = std::numeric_limits<int>::max();

// A box around some part of a mesh.
struct PartBox {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& place);
    [[nodiscard]] double diagonal_m() const;
};

}  // namespace oro
