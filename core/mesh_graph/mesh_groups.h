// Which group each triangle of a level of a mesh's graph goes to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace oro {

// Halves triangles by their middles, across the longest side of the box around these, until `fits` takes what
// is left. level: of equal numbers borders lie alike, and those of the next lie elsewhere. Gives lists of
// triangles' numbers.
using HalvedParts = std::vector<std::vector<std::uint32_t>>;
[[nodiscard]] HalvedParts halved(std::span<const glm::dvec3> middles, std::vector<std::uint32_t> triangles,
                                 std::size_t full, int level,
                                 const std::function<bool(std::span<const std::uint32_t>)>& fits);

// The same lists in the place of the triangles, one after another; each goes to take(list) at once, in that
// order.
void halve_in_place(std::span<const glm::dvec3> middles, std::span<std::uint32_t> triangles, std::size_t full,
                    int level, const std::function<bool(std::span<const std::uint32_t>)>& fits,
                    const std::function<void(std::span<const std::uint32_t>)>& take);

}  // namespace oro
