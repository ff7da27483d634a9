// Another way to make a group of triangles coarser, in the place of SpaceSimplifier: for comparisons.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace oro {

struct LevelTriangle;

// A group that is to be made coarser.
struct GroupToSimplify {
    std::span<const glm::dvec3> vertices;  // of the whole mesh, metres
    std::span<const std::array<std::uint32_t, 3>> triangles;
    // Whether a vertex of the mesh has to stay, with its edges to others that have to: a neighbour has it,
    // too.
    std::function<bool(std::uint32_t)> stays;
    std::size_t aim{};  // triangles
    double most_m{};    // at which SpaceSimplifier would stop before
};

// Gives triangles of the mesh's vertices in the place of the group's. Where it gives none, the group stays as
// it is. It is called from several threads at once.
using CustomSimplifier =
    std::function<std::vector<std::array<std::uint32_t, 3>>(const GroupToSimplify& group)>;

// What a simplifier makes of a level's triangles. Those that it made are to be measured; they have the
// feature of a triangle of the group at their first corner.
[[nodiscard]] std::vector<LevelTriangle> simplified_by(const CustomSimplifier& simplifier,
                                                       GroupToSimplify group,
                                                       std::vector<LevelTriangle> triangles);

}  // namespace oro
