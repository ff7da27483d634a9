#include "core/growth/covering_pages.h"

#include <glm/common.hpp>

namespace oro {

CoveringPages::CoveringPages(std::span<const PageIndex> page_indices) {
    for (std::size_t i = 0; i < page_indices.size(); ++i) {
        const PageIndex& page = page_indices[i];
        const auto level = static_cast<std::size_t>(page.level);
        if (levels_.size() <= level) levels_.resize(level + 1);
        levels_[level].insert(page.row, page.column, static_cast<gpu::uint>(i));
    }
}

std::optional<gpu::uint> CoveringPages::find(glm::ivec2 low, glm::ivec2 high) const {
    constexpr int page_bits = 7;
    static_assert(1U << page_bits == gpu::page_quads);
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        const int shift = static_cast<int>(level) + page_bits;
        if (low.x >> shift != high.x >> shift || low.y >> shift != high.y >> shift) continue;
        const std::uint32_t found = levels_[level].find(low.x >> shift, low.y >> shift);
        if (found != PageTable::none) return found;
    }
    return {};
}

std::optional<gpu::GrowthTile> growth_tile(const PostGrid& grid, const CoveringPages& pages,
                                           std::uint32_t row, std::uint32_t column,
                                           const TileCorners& corners) {
    glm::dvec2 low = corners[0], high = low;
    for (const glm::dvec2& corner : corners) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    // What grows may stand a little beside its tile. Round the Earth a tile has its columns on one side, or
    // is left out.
    const glm::dvec2 beyond = 0.02 * (high - low);
    low -= beyond;
    high += beyond;
    const glm::dvec2 end(grid.rows() - 1, grid.columns() - 1);
    if (!(high.x > 0.0 && high.y > 0.0 && low.x < end.x && low.y < end.y)) return {};
    // Posts of the quads that it lies on.
    low = glm::max(low, glm::dvec2(0.0));
    high = glm::min(high, end - 0.5);
    const auto page = pages.find(glm::ivec2(low), glm::ivec2(high));
    if (!page) return {};
    gpu::GrowthTile tile{row, column, *page, {}, {}};
    const glm::dvec2 base = glm::floor(corners[0]);
    tile.post[0] = static_cast<int>(base.x);
    tile.post[1] = static_cast<int>(base.y);
    for (std::size_t i = 0; i < 4; ++i) tile.corners[i] = gpu::vec2(corners[i] - base);
    return tile;
}

}  // namespace oro
