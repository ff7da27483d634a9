// Sides of triangles that have one triangle so far, while a mesh is told.
#pragma once

#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

namespace oro {

// Of each vertex the vertices at the other ends of its sides, the last first. Where there are many, the first
// ones are forgotten: telling a mesh takes no longer for a vertex of many triangles.
class OpenSides {
  public:
    static constexpr std::size_t most_sides = 48;

    explicit OpenSides(std::pmr::memory_resource* memory = std::pmr::new_delete_resource())
        : first_(memory), sides_(memory) {}
    // Room for the sides of so many triangles. Of it, only what is used takes memory.
    void expect(std::size_t triangles) { sides_.reserve(6 * triangles); }
    void add(const std::array<std::uint32_t, 3>& triangle);
    // Adds the far ends of open sides of `vertex` to `ends`, those that are there already but once.
    void ends_at(std::uint32_t vertex, std::vector<std::uint32_t>& ends) const;

  private:
    struct Side {
        std::uint32_t to;
        std::uint32_t next;
        bool open;
    };
    static constexpr std::uint32_t none = ~std::uint32_t{0};
    void add(std::uint32_t from, std::uint32_t to);

    std::pmr::vector<std::uint32_t> first_;  // by vertex
    std::pmr::vector<Side> sides_;
};

}  // namespace oro
