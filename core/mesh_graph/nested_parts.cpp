#include "core/mesh_graph/nested_parts.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <numeric>
#include <utility>

namespace oro {
namespace {

class PartHalving {
  public:
    PartHalving(std::span<const glm::dvec3> middles, std::vector<std::uint32_t>& part_of)
        : middles_(middles), part_of_(part_of) {}

    void halve(std::span<std::uint32_t> triangles, int times, std::uint32_t number) {
        if (times == 0) {
            for (const std::uint32_t triangle : triangles) part_of_[triangle] = number;
            return;
        }
        constexpr double beyond_all = std::numeric_limits<double>::infinity();
        glm::dvec3 low(beyond_all), high(-beyond_all);
        for (const std::uint32_t triangle : triangles)
            low = glm::min(low, middles_[triangle]), high = glm::max(high, middles_[triangle]);
        const glm::dvec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t half = triangles.size() / 2;
        std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(half),
                         triangles.end(), [&](std::uint32_t a, std::uint32_t b) {
                             const double one = middles_[a][axis], other = middles_[b][axis];
                             return one != other ? one < other : a < b;
                         });
        halve(triangles.first(half), times - 1, 2 * number);
        halve(triangles.subspan(half), times - 1, 2 * number + 1);
    }

  private:
    std::span<const glm::dvec3> middles_;
    std::vector<std::uint32_t>& part_of_;
};

}  // namespace

NestedPart common_part(NestedPart a, NestedPart b) {
    int depth = std::min(a.depth, b.depth);
    while (a.above(depth) != b.above(depth)) --depth;
    return a.above(depth);
}

NestedParts nested_parts(std::span<const glm::dvec3> middles, int depth) {
    NestedParts parts;
    parts.depth = depth;
    parts.part_of.resize(middles.size());
    std::vector<std::uint32_t> all(middles.size());
    std::iota(all.begin(), all.end(), 0U);
    PartHalving(middles, parts.part_of).halve(all, 2 * depth, 0);
    return parts;
}

std::size_t coarse_triangles(const NestedParts& parts,
                             std::span<const std::array<std::uint32_t, 3>> triangles, int depth,
                             std::size_t inside) {
    using VertexOfPart = std::pair<std::uint32_t, std::uint32_t>;
    std::vector<VertexOfPart> vertices;
    vertices.reserve(3 * triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        for (const std::uint32_t corner : triangles[i])
            vertices.emplace_back(corner, parts.smallest(i).above(depth).number);
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    constexpr std::size_t of_vertex = 3;
    std::size_t count = inside << 2 * depth;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const bool is_shared = (i > 0 && vertices[i - 1].first == vertices[i].first) ||
                               (i + 1 < vertices.size() && vertices[i + 1].first == vertices[i].first);
        if (is_shared) count += of_vertex;
    }
    return count;
}

}  // namespace oro
