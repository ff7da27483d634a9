#include "core/mesh_graph/longest_axis.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

namespace oro {

void divide_along_longest_axis(std::span<std::uint32_t> triangles, std::span<const glm::dvec3> middles,
                               std::size_t first) {
    constexpr double endless = std::numeric_limits<double>::infinity();
    glm::dvec3 low(endless), high(-endless);
    for (const std::uint32_t triangle : triangles)
        low = glm::min(low, middles[triangle]), high = glm::max(high, middles[triangle]);
    const glm::dvec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(first),
                     triangles.end(), [&](std::uint32_t a, std::uint32_t b) {
                         const double one = middles[a][axis], other = middles[b][axis];
                         return one != other ? one < other : a < b;
                     });
}

}  // namespace oro
