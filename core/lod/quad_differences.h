// How far the posts of a quad are from its two triangles.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/earth/extremes.h"
#include "core/terrain/cell_diagonal.h"

namespace oro {

struct QuadDifferences {
    double largest_steps;
    std::int32_t lowest_steps;  // of its posts, and 0: void_height_steps where one is void
};

// north_west: the first of (size + 1) x (size + 1) posts, `stride` from row to row. The
// planes are those of the quad's western and eastern triangle.
QuadDifferences quad_differences(const std::int32_t* north_west, std::ptrdiff_t stride, int size,
                                 Diagonal diagonal, const CellPlane& west, const CellPlane& east);

}  // namespace oro
