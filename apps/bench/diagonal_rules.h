// Rules that choose which diagonal splits a cell of posts into two triangles, from the heights around it.
#pragma once

#include <array>
#include <cmath>

#include "core/terrain/cell_diagonal.h"

namespace oro {

// Heights of the 4 x 4 posts around a cell, rows from north to south; the cell's own are at [1..2][1..2].
using CellHeights = std::array<std::array<double, 4>, 4>;

// Where the ground in a cell's middle would be, split by one diagonal: half-way between its posts.
[[nodiscard]] inline double middle_m(const CellHeights& h, Diagonal diagonal) {
    return 0.5 * (diagonal == Diagonal::nw_se ? h[1][1] + h[2][2] : h[1][2] + h[2][1]);
}

[[nodiscard]] inline Diagonal lesser(double nw_se, double sw_ne) {
    return sw_ne < nw_se ? Diagonal::sw_ne : Diagonal::nw_se;
}

// Joins the two posts whose heights are nearest to each other.
[[nodiscard]] inline Diagonal nearest_heights(const CellHeights& h) {
    return lesser(std::abs(h[1][1] - h[2][2]), std::abs(h[1][2] - h[2][1]));
}

// Takes the diagonal along which the ground, with one more post at either end, bends less.
[[nodiscard]] inline Diagonal least_bend(const CellHeights& h) {
    const double nw_se = h[1][1] + h[2][2] - h[0][0] - h[3][3];
    const double sw_ne = h[1][2] + h[2][1] - h[0][3] - h[3][0];
    return lesser(std::abs(nw_se), std::abs(sw_ne));
}

// What is drawn: the diagonal whose middle is nearer to that of the smooth surface through all sixteen posts.
[[nodiscard]] inline Diagonal nearest_smooth(const CellHeights& h) {
    return diagonal_of(
        [&](int row, int column) {
            return decisive_steps(
                static_cast<float>(h[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)]));
        },
        1, 1);
}

}  // namespace oro
