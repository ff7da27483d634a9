// Rules that choose which diagonal splits a cell of posts into two triangles, from the heights around it.
#pragma once

#include <array>
#include <cmath>

namespace oro {

// Heights of the 4 x 4 posts around a cell, rows from north to south; the cell's own are at [1..2][1..2].
using CellHeights = std::array<std::array<double, 4>, 4>;

// Which diagonal: from the north-west post to the south-east one, or across that.
enum class Diagonal { falls, rises };

// Where the ground in a cell's middle would be, split by one diagonal: half-way between its posts.
[[nodiscard]] inline double middle_m(const CellHeights& h, Diagonal diagonal) {
    return 0.5 * (diagonal == Diagonal::falls ? h[1][1] + h[2][2] : h[1][2] + h[2][1]);
}

[[nodiscard]] inline Diagonal lesser(double falls, double rises) {
    return rises < falls ? Diagonal::rises : Diagonal::falls;
}

// Joins the two posts whose heights are nearest to each other.
[[nodiscard]] inline Diagonal nearest_heights(const CellHeights& h) {
    return lesser(std::abs(h[1][1] - h[2][2]), std::abs(h[1][2] - h[2][1]));
}

// Takes the diagonal along which the ground, with one more post at either end, bends less.
[[nodiscard]] inline Diagonal least_bend(const CellHeights& h) {
    const double falls = h[1][1] + h[2][2] - h[0][0] - h[3][3];
    const double rises = h[1][2] + h[2][1] - h[0][3] - h[3][0];
    return lesser(std::abs(falls), std::abs(rises));
}

// Takes the diagonal whose middle is nearer to that of the smooth surface through all sixteen posts (Source:
// R. Keys, Cubic convolution interpolation for digital image processing, 1981: weights -1, 9, 9, -1 of 16).
[[nodiscard]] inline Diagonal nearest_smooth(const CellHeights& h) {
    constexpr std::array<double, 4> weights{-1.0 / 16.0, 9.0 / 16.0, 9.0 / 16.0, -1.0 / 16.0};
    double smooth_m = 0.0;
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column)
            smooth_m += weights[row] * weights[column] * h[row][column];
    }
    return lesser(std::abs(middle_m(h, Diagonal::falls) - smooth_m),
                  std::abs(middle_m(h, Diagonal::rises) - smooth_m));
}

}  // namespace oro
