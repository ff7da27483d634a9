// The rim of the ground that a grid has: where its surface ends, around it and around its holes.
#pragma once

#include <vector>

#include "core/terrain/post_grid.h"

namespace oro {

struct GridPost {
    int row;
    int column;
    bool operator==(const GridPost&) const = default;
};

// From a post to the next along a row, a column or a diagonal: with a triangle of the surface on one side,
// and none on the other.
struct RimEdge {
    GridPost from;
    GridPost to;
};

// All of them, in no order that means anything. Takes each post once. A grid that goes round the Earth has
// none along its first and last column.
std::vector<RimEdge> coverage_rim(const HeightField& field);

}  // namespace oro
