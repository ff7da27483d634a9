// Triangles in a tree of boxes, to find which are near a place.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory_resource>
#include <span>
#include <vector>

#include "core/base/scratch_memory.h"
#include "core/base/wide.h"
#include "core/mesh_graph/triangle_block.h"

namespace oro {

// Triangles are asked for by their places in the tree: four times the number of a block, and which of its
// four. The tree depends on where they lie alone, not on the order that they are given in, nor on the corner
// that each begins with; but for numbers of triangles that lie in one place.
class NearestTriangles {
  public:
    static constexpr std::uint32_t nothing = ~std::uint32_t{0};
    struct Near {
        double distance2{};
        std::uint32_t place{nothing};
    };
    struct Node {
        FourVectors low, high;                 // boxes of what is below
        std::array<std::uint32_t, 4> below{};  // nodes, or blocks where is_block
        std::uint8_t count{};
        bool is_block{};  // all of them
        std::uint32_t parent{nothing};
        // A ball around all triangles below.
        glm::dvec3 middle{};
        double radius{};
    };
    struct Block {
        TriangleBlock triangles;
        std::array<std::uint32_t, 4> numbers{};
        std::uint8_t count{};
        std::uint32_t parent{nothing};
        glm::dvec3 middle{};
        double radius{};
    };

    // Of one triangle or more. Takes some 0.5 us a triangle, and 250 bytes.
    explicit NearestTriangles(std::span<const std::array<glm::dvec3, 3>> triangles);
    // The same tree, of triangles by their vertices. All that takes much lies in `scratch`, which outlives
    // it; null: in memory.
    NearestTriangles(std::span<const glm::dvec3> vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles, ScratchMemory* scratch);

    // A triangle within sqrt(good2) of `at`, or where there is none the nearest within sqrt(reach2); nothing
    // where there is none of these either. hint: a place in the tree to begin with, or nothing.
    [[nodiscard]] Near within(const glm::dvec3& at, double good2, double reach2, std::uint32_t hint) const;
    [[nodiscard]] Near nearest(const glm::dvec3& at, std::uint32_t hint = nothing) const;

    [[nodiscard]] std::uint32_t number(std::uint32_t place) const {
        return blocks_[place / 4].numbers[place % 4];
    }
    [[nodiscard]] double distance2(std::uint32_t place, const glm::dvec3& at) const {
        return blocks_[place / 4].triangles.distance2(static_cast<int>(place % 4), at);
    }
    // Its least corner first, by x, y and z.
    [[nodiscard]] std::array<glm::dvec3, 3> triangle(std::uint32_t place) const {
        return blocks_[place / 4].triangles.triangle(static_cast<int>(place % 4));
    }
    // The first node is the root. A node's number is less than those of the nodes below.
    [[nodiscard]] std::span<const Node> nodes() const { return nodes_; }
    [[nodiscard]] std::span<const Block> blocks() const { return blocks_; }

  private:
    struct Making;
    void make(Making& making);
    std::uint32_t make_node(Making& making, std::uint32_t first, std::uint32_t last, std::uint32_t parent);
    std::uint32_t make_block(Making& making, std::uint32_t first, std::uint32_t last, std::uint32_t parent);

    std::pmr::vector<Node> nodes_;
    std::pmr::vector<Block> blocks_;
};

}  // namespace oro
