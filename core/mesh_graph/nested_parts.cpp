#include "core/mesh_graph/nested_parts.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/mesh_graph/longest_axis.h"

namespace oro {
namespace {

// number: of the part that these triangles are, among those of as many divisions.
void halve(std::span<std::uint32_t> triangles, std::span<const glm::dvec3> middles, int times,
           std::uint32_t number, std::vector<std::uint32_t>& part_of) {
    if (times == 0) {
        for (const std::uint32_t triangle : triangles) part_of[triangle] = number;
        return;
    }
    const std::size_t half = triangles.size() / 2;
    divide_along_longest_axis(triangles, middles, half);
    halve(triangles.first(half), middles, times - 1, 2 * number, part_of);
    halve(triangles.subspan(half), middles, times - 1, 2 * number + 1, part_of);
}

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
    halve(all, middles, 2 * depth, 0, parts.part_of);
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
