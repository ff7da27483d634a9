// Whether what a baked grid says of itself is what its pages hold: for who checks a file as a whole.
#pragma once

#include <string>

#include "core/baked/region_file.h"
#include "core/base/result.h"

namespace oro {

// This reads all pages of a grid, up to `threads` of them at a time, and holds against their heights: each
// page's record (its place, its bounds, its triangles and how good its nodes are), and of the outline the
// lowest and the highest height, the void posts and the triangles. A grid that goes round the Earth or to a
// pole, where posts are one point, is asked for its records alone. Errors: those of reading; the first
// difference, with the value, what is said and what the pages have. name: how the error begins, "grid 1: ",
// or
// "" in a file of one grid.
[[nodiscard]] Result<void> check_contents(const RegionFile& file, int threads, const std::string& name = "");

}  // namespace oro
