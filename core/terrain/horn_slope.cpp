#include "core/terrain/horn_slope.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/terrain/post_spacing.h"

namespace oro {
namespace {

struct Rise {
    double east{}, north{};  // metres a post
};

std::optional<double> H_m(const HeightField& field, int row, int column) {
    const PostGrid& grid = field.grid;
    if (grid.wraps_longitude()) {
        const int turn = grid.columns() - 1;
        column = (column % turn + turn) % turn;
    }
    if (row < 0 || column < 0 || row >= grid.rows() || column >= grid.columns()) return std::nullopt;
    const float height_m = field.H_at_post_m(row, column);
    if (is_void(height_m)) return std::nullopt;
    return static_cast<double>(height_m);
}

// By weights 1, 2, 1 across.
std::optional<Rise> rise_at_post(const HeightField& field, int row, int column) {
    const auto here = H_m(field, row, column);
    if (!here) return std::nullopt;
    const auto change = [&](int down, int right) {
        if (const auto there = H_m(field, row + down, column + right)) return *there - *here;
        if (const auto opposite = H_m(field, row - down, column - right)) return *here - *opposite;
        return 0.0;
    };
    const double north_west = change(-1, -1), north = change(-1, 0), north_east = change(-1, 1),
                 east = change(0, 1), south_east = change(1, 1), south = change(1, 0),
                 south_west = change(1, -1), west = change(0, -1);
    return Rise{0.125 * ((north_east + 2.0 * east + south_east) - (north_west + 2.0 * west + south_west)),
                0.125 * ((north_west + 2.0 * north + north_east) - (south_west + 2.0 * south + south_east))};
}

}  // namespace

std::optional<double> horn_slope_deg(const HeightField& field, double row, double column) {
    const PostGrid& grid = field.grid;
    if (!(row >= 0.0 && column >= 0.0 && row <= grid.rows() - 1.0 && column <= grid.columns() - 1.0))
        return std::nullopt;
    const int first_row = std::clamp(static_cast<int>(row), 0, std::max(0, grid.rows() - 2));
    const int first_column = std::clamp(static_cast<int>(column), 0, std::max(0, grid.columns() - 2));
    const double down = row - first_row, right = column - first_column;
    Rise rise;
    double whole = 0.0;
    for (int i = 0; i < 4; ++i) {
        const double share = (i / 2 == 0 ? 1.0 - down : down) * (i % 2 == 0 ? 1.0 - right : right);
        if (share <= 0.0) continue;
        const auto corner = rise_at_post(field, first_row + i / 2, first_column + i % 2);
        if (!corner) continue;
        rise.east += share * corner->east;
        rise.north += share * corner->north;
        whole += share;
    }
    if (whole <= 0.0) return std::nullopt;
    const PostSpacing spacing = post_spacing_at(grid, row, column);
    const double steepness = std::hypot(rise.east / spacing.column_m, rise.north / spacing.row_m) / whole;
    return deg_from_radians(Radians{std::atan(steepness)});
}

}  // namespace oro
