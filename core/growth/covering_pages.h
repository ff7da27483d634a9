// Which page of a frame a tile of a lattice on the ground belongs to.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/terrain/page.h"
#include "core/terrain/page_table.h"
#include "core/terrain/post_grid.h"
#include "shaders/shared_growth.h"

namespace oro {

// The pages of a frame by level and place.
class CoveringPages {
  public:
    explicit CoveringPages(std::span<const PageIndex> page_indices);
    // The number of the finest page that covers all posts between two (row, column); nothing where none does.
    [[nodiscard]] std::optional<gpu::uint> find(glm::ivec2 low, glm::ivec2 high) const;

  private:
    std::vector<PageTable> levels_;
};

// Corners of a tile in posts (row, column): south-west, south-east, north-west, north-east.
using TileCorners = std::array<glm::dvec2, 4>;

// A tile of a lattice on the grid, by its row and column in that; nothing where no part of it is there, or no
// page covers what is. What of it is beyond the grid has no ground (shaders/growth/growth.glsl).
std::optional<gpu::GrowthTile> growth_tile(const PostGrid& grid, const CoveringPages& pages,
                                           std::uint32_t row, std::uint32_t column,
                                           const TileCorners& corners);

}  // namespace oro
