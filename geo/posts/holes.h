// Posts of a region that have no height, and why: void in their source, outside every source, in a missing
// cell.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/terrain/post_grid.h"

namespace oro {

// Of the posts without a height, those that no source covers: `covered` tells of a post by its number. Names
// are of whole-degree cells ("N46E008"); what is no such name holds no post.
struct Uncovered {
    std::uint64_t outside{};     // in a cell that some source touches
    std::uint64_t in_missing{};  // in a cell that none does
};
Uncovered count_uncovered(const HeightField& field, const std::vector<std::string>& missing_cells,
                          const std::function<bool(std::size_t post)>& covered);

}  // namespace oro
