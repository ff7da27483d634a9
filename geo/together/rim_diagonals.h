// Where finer ground lies over a grid, cells of the grid beside it are split along other diagonals than by
// themselves.
#pragma once

#include <cstdint>
#include <optional>

#include "core/terrain/post_grid.h"
#include "geo/together/grid_clip.h"

namespace oro {

// A cell's diagonal is decided by the 4 x 4 posts around it (core/terrain/cell_diagonal.h), and falls where one
// of them is cut out. So the ground of cells within two posts of a rim is not what it is without the finer
// file.
struct RimDiagonals {
    std::uint64_t cells{};  // that are split otherwise, and not wholly covered
    double most_m{};        // how far apart the two surfaces are in the middle of such a cell, at most
    PostPlace place{};      // there
};

// What a cut changes of the diagonals of its grid; nothing where it changes none. A middle may itself lie
// under the finer ground. Costs 16 posts for each cell within two posts of a rim. Errors in reading posts: as
// HeightField::health() tells them.
[[nodiscard]] std::optional<RimDiagonals> rim_diagonals(const HeightField& field, const GridClip& cut);

}  // namespace oro
