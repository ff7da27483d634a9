// The windows that a region is cut into whose graph is too large to be built in one go.
#pragma once

#include <cstdint>
#include <vector>

#include "core/clusters/group_tiling.h"
#include "core/surface/grid_surface.h"

namespace oro {

// Posts of a region that are built together, and those among them that the window answers for: the groups
// whose tiles have their middle there. All windows' own posts together are the region's, each once.
struct RegionWindow {
    GridWindow window;
    int rows{};
    int columns{};
    PlaneBox own;

    [[nodiscard]] bool owns(std::int64_t row, std::int64_t column) const {
        return row >= own.first_row && row <= own.last_row && column >= own.first_column &&
               column <= own.last_column;
    }
    // All posts.
    [[nodiscard]] PlaneBox box() const {
        return {window.first_row, std::int64_t{window.first_row} + rows - 1, window.first_column,
                std::int64_t{window.first_column} + columns - 1};
    }
};

// Which levels windows build, and how many posts one has at most; where that is too few for the margin
// around its own posts, it has as many own ones as margin.
struct WindowSizes {
    int levels{4};
    std::size_t posts{10'000'000};
    double kept_share{0.65};
    // How much wider than usual margins are; what windows own stays the same.
    double widened{1.0};
    // Levels that are built already: those from the next on are built out of what it made.
    int above{0};
};

// As few posts in margins as can be.
[[nodiscard]] std::vector<RegionWindow> windows_of(int rows, int columns, const WindowSizes& sizes);

// The post in the middle of a tile, or the region's nearest to it.
[[nodiscard]] SurfaceVertex middle_of(const GroupTiling& tiling, const GroupTile& tile, int rows,
                                      int columns);

}  // namespace oro
