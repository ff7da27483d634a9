// Region files of several grids made one file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Where the grid with that number grows on its way into the file `path`: beside it.
std::string path_of_grid(const std::string& path, std::size_t number);

// What must hold before a grid's file is written or replaced there: the name is free, or a region file has
// it, which a bake that was broken off left behind. Errors: it is somebody else's.
Result<void> check_path_of_grid(const std::string& grid_path);

// Whether a grid's file is whole and what is to be baked: then it need not be baked again. Reads all of it.
// split: of the cells that are to be baked; an earlier program split them otherwise.
bool is_baked_grid(const std::string& grid_path, std::uint64_t fingerprint, const std::string& description,
                   CellSplit split);

// Puts the grids' files together as `path`, which appears whole or not at all, and removes them: also
// where another file took the name meanwhile and stays. ranks: as RegionGrid::rank, of each. Errors: those of
// reading and writing.
Result<void> join_grids(const std::string& path, bool overwrite, const std::vector<std::uint32_t>& ranks);

}  // namespace oro
