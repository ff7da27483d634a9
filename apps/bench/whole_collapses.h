// A mesh made coarser as a whole, without groups, by the collapses that make groups coarser.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace oro {

struct WholeMesh {
    std::size_t triangles{};  // the fewest found within an error
    // What the collapses themselves, by samples, believe to be within it, and its true error: a bound to 2 %.
    std::size_t believed{};
    double true_m{};
};

// For each error, metres, rising: one run in which what a collapse may cost rises, in twelve steps to the
// error. After each step the whole is measured, both ways, and the fewest triangles of what is within the
// error count. Where no step is, the mesh itself does: here one place decides for all.
[[nodiscard]] std::vector<WholeMesh> whole_collapses(std::span<const glm::dvec3> vertices,
                                                     std::span<const std::array<std::uint32_t, 3>> triangles,
                                                     std::span<const double> errors_m);

}  // namespace oro
