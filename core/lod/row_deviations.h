// What is measured of a page's nodes against the full resolution, apart from what is made of it: so that one
// machine may measure it and another build the levels.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "core/lod/node_deviations.h"
#include "core/lod/pyramid.h"

namespace oro {

inline constexpr std::size_t nodes_per_row = gpu::meshlets_per_side;

// Of a row of a page's nodes, from west to east: own_m is NodeDeviation::own_m, at most gpu::unfit_error_m;
// stitched_m are those of StitchedDeviations. 0 of nodes that the level does not have.
struct RowDeviations {
    std::array<double, nodes_per_row> own_m{};
    std::array<std::array<float, 4>, nodes_per_row> stitched_m{};
};

// Measures row `row` (0 .. nodes_per_row - 1) of a page of the level that `deviations` is of. From any
// thread.
RowDeviations measured_row(const NodeDeviations& deviations, const LevelGrid& level, const PageIndex& page,
                           int row);

// What was measured of a row before; false where it is not known, and is measured then. From several threads.
using KnownDeviations = std::function<bool(const PageIndex& page, int row, RowDeviations& deviations)>;

// build_pyramid_with(), with what `known` tells of nodes in place of measuring them: the same levels.
Result<LevelPyramid> build_pyramid_from(const PostGrid& grid, const RegionShape& shape,
                                        const DrawnHeights& heights, int threads, const PyramidHooks& hooks,
                                        bool keep_levels, const KnownDeviations& known);

}  // namespace oro
