// A mesh divided into parts, each of which has four smaller ones.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace oro {

// One of the parts of a depth: 4^depth of them are the mesh. At depth 0 it is the mesh itself.
struct NestedPart {
    int depth{};
    std::uint32_t number{};

    // The part of that depth, at most its own, that it is in.
    [[nodiscard]] NestedPart above(int at_depth) const {
        return {at_depth, number >> 2 * (depth - at_depth)};
    }
    friend bool operator==(const NestedPart&, const NestedPart&) = default;
};
// The smallest part that both are in.
[[nodiscard]] NestedPart common_part(NestedPart a, NestedPart b);

struct NestedParts {
    int depth{};                         // of the smallest parts
    std::vector<std::uint32_t> part_of;  // of each triangle the number of its smallest part

    [[nodiscard]] NestedPart smallest(std::uint32_t triangle) const { return {depth, part_of[triangle]}; }
};

// Halves triangles by their middles, across the longest side of the box around these, and the halves
// likewise, 2 * depth times. Of n triangles a part then has n / 4^depth, rounded down or up. depth: 0 to 15,
// and no more parts than triangles. The result depends on nothing else.
[[nodiscard]] NestedParts nested_parts(std::span<const glm::dvec3> middles, int depth);

// How many triangles stand well for all parts of a depth: `inside` for each, and three for each vertex that a
// part has in common with others, where triangles must stay small. triangles: of the mesh.
[[nodiscard]] std::size_t coarse_triangles(const NestedParts& parts,
                                           std::span<const std::array<std::uint32_t, 3>> triangles, int depth,
                                           std::size_t inside);

}  // namespace oro
