// Where no trees are planted because meshes stand there: buildings, a survey.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace oro {

// Tiles of the lattice of sites (core/growth/tree_sites.h) over which triangles lie.
class ClearedTiles {
  public:
    // Corners of triangles, three by three, ECEF metres. A tile counts that the box of latitudes and
    // longitudes of a triangle meets, so that of long slanted ones more count than they lie over; of a
    // triangle more than 64 tiles long none does.
    explicit ClearedTiles(std::span<const glm::dvec3> corners);

    // Whether triangles lie over a tile, by its row and column in the lattice.
    [[nodiscard]] bool contains(std::uint32_t row, std::uint32_t column) const;
    [[nodiscard]] std::size_t size() const { return tiles_.size(); }

  private:
    std::vector<std::uint64_t> tiles_;  // row and column in one, sorted
};

}  // namespace oro
