// Builds a window of a region, and writes what it answers for.
#pragma once

#include <cstdint>
#include <string>

#include "core/cluster_windows/begun_graph.h"
#include "core/cluster_windows/region_windows.h"
#include "core/surface/ground_bounds.h"
#include "core/terrain/cell_diagonals.h"
#include "core/terrain/post_grid.h"

namespace oro {

// A region whose windows are built.
struct WindowedRegion {
    const HeightField& field;        // does not go round the Earth; posts on latitudes and longitudes
    const CellDiagonals* diagonals;  // of all of it
    const GroundBounds& bounds;
    WindowSizes sizes;
    int threads{1};
};

// Drawn heights (core/terrain/drawn_heights.h) of some posts alone.
[[nodiscard]] DrawnHeights heights_of(const WindowedRegion& region, const RegionWindow& window);

// False where the margin is too narrow: a group that the window answers for, or one that uses what it made,
// depends on what lies beyond. Then nothing is written. plan: WindowIndex. Errors: those of writing.
Result<bool> build_window(const WindowedRegion& region, const RegionWindow& window, std::uint64_t plan,
                          const std::string& path);
// Builds a window from what other windows have left (begun_graph_in()).
Result<bool> build_window_from(const WindowedRegion& region, BegunGraph begun, std::uint64_t plan,
                               const std::string& path);

}  // namespace oro
