// Triangles divided where they reach farthest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

namespace oro {

// Puts those of the triangles first whose middles are lowest along the axis on which the middles reach
// farthest: so many, the others behind them. Ties go by number, so the two sets depend on nothing else.
// middles: of each triangle by its number, in any unit. first: at most triangles.size(). Any thread.
void divide_along_longest_axis(std::span<std::uint32_t> triangles, std::span<const glm::dvec3> middles,
                               std::size_t first);

}  // namespace oro
