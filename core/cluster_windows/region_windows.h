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
};

// How many levels windows build, and how many posts one has at most; where that is too few for the margin
// around its own posts, it has as many own ones as margin.
struct WindowSizes {
    int levels{8};
    std::size_t posts{7'000'000};
    double kept_share{0.65};
    // How much wider than usual margins are; what windows own stays the same.
    double widened{1.0};
};

[[nodiscard]] std::vector<RegionWindow> windows_of(int rows, int columns, const WindowSizes& sizes);

// The post in the middle of a tile, or the region's nearest to it.
[[nodiscard]] SurfaceVertex middle_of(const GroupTiling& tiling, const GroupTile& tile, int rows,
                                      int columns);

}  // namespace oro
