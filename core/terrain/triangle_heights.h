// Heights between the posts of a grid: linear in latitude and longitude over the two triangles of each cell.
#pragma once

#include <algorithm>
#include <optional>

#include "core/terrain/cell_diagonal.h"
#include "core/terrain/post_grid.h"

namespace oro {

// A rounded angle on the region's rim is in it.
inline constexpr double rim_slack_posts = 1.0e-6;

// h at a place of a cell, (down, right) of its north-west post in 0 .. 1, from the posts of the triangle that
// holds it. post_h_m(row, column): of a post, nothing where it is void; diagonal_at(row, column): of a cell.
template <class PostHeight, class DiagonalAt>
std::optional<double> h_in_cell_m(const PostHeight& post_h_m, const DiagonalAt& diagonal_at, int row,
                                  int column, double down, double right) {
    const std::optional<double> north_west = post_h_m(row, column),
                                south_east = post_h_m(row + 1, column + 1);
    if (diagonal_at(row, column) == Diagonal::sw_ne) {
        const std::optional<double> north_east = post_h_m(row, column + 1),
                                    south_west = post_h_m(row + 1, column);
        // A cell without one of its posts is never sw_ne; but a file may no longer be readable.
        if (!north_west || !north_east || !south_west || !south_east) return std::nullopt;
        const bool west = west_of_diagonal(Diagonal::sw_ne, down, right) >= 0.0;
        const CellPlane plane =
            cell_plane(Diagonal::sw_ne, west, *north_west, *north_east, *south_west, *south_east);
        return plane.at_corner + down * plane.change_down + right * plane.change_right;
    }
    if (!north_west || !south_east) return std::nullopt;
    // On the diagonal either triangle will do.
    if (down >= right) {
        if (const std::optional<double> south_west = post_h_m(row + 1, column))
            return *north_west + down * (*south_west - *north_west) + right * (*south_east - *south_west);
        if (down > right) return std::nullopt;
    }
    const std::optional<double> north_east = post_h_m(row, column + 1);
    if (!north_east) return std::nullopt;
    return *north_west + right * (*north_east - *north_west) + down * (*south_east - *north_east);
}

// The height at a fractional row and column of the region; nothing outside it.
template <class PostHeight, class DiagonalAt>
std::optional<double> h_at_row_column_m(const PostGrid& grid, const PostHeight& post_h_m,
                                        const DiagonalAt& diagonal_at, double y, double x) {
    const double last_row = grid.rows() - 1, last_column = grid.columns() - 1;
    if (!(y >= -rim_slack_posts && y <= last_row + rim_slack_posts)) return std::nullopt;
    if (!(x >= -rim_slack_posts && x <= last_column + rim_slack_posts)) return std::nullopt;
    y = std::clamp(y, 0.0, last_row);
    x = std::clamp(x, 0.0, last_column);
    const int row = static_cast<int>(y), column = static_cast<int>(x);
    const double down = y - row, right = x - column;
    // A place on the edge of a cell belongs to the cells on both sides: either may have the triangle that
    // holds it.
    for (int up = 0; up <= (down == 0.0 ? 1 : 0); ++up) {
        for (int left = 0; left <= (right == 0.0 ? 1 : 0); ++left) {
            if (row - up < 0 || row - up > grid.rows() - 2) continue;
            if (column - left < 0 || column - left > grid.columns() - 2) continue;
            if (const auto h =
                    h_in_cell_m(post_h_m, diagonal_at, row - up, column - left, down + up, right + left))
                return h;
        }
    }
    return std::nullopt;
}

// The height at a place; nothing where there is no triangle.
template <class PostHeight, class DiagonalAt>
std::optional<double> h_on_grid_m(const PostGrid& grid, const PostHeight& post_h_m,
                                  const DiagonalAt& diagonal_at, double lat_deg, double lon_deg) {
    const PostNumber at = grid.post_at(lat_deg, lon_deg);
    return h_at_row_column_m(grid, post_h_m, diagonal_at, at.row, at.column);
}

}  // namespace oro
