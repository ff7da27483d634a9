#include "core/terrain/drawn_heights.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/base/parallel.h"

namespace oro {

bool at_pole(const PostGrid& grid, int row) {
    return !grid.net && std::abs(row_lat_deg(grid, row)) == 90.0;
}

std::int32_t height_steps(double h_m) {
    constexpr double limit = highest_height_steps;
    return static_cast<std::int32_t>(
        std::clamp(std::floor(h_m * (1.0 / height_step_m) + 0.5), -limit, limit));
}

int canonical_column(const HeightField& field, int row, int column) {
    const PostGrid& grid = field.grid;
    if (is_void(field.H_at_post_m(row, column))) return column;
    if (at_pole(grid, row)) {
        int first = 0;
        // No further than the post itself, also where a page can no longer be read that could be just now.
        while (first < column && is_void(field.H_at_post_m(row, first))) ++first;
        return first;
    }
    const bool twin = column == grid.columns() - 1 && grid.goes_round();
    return twin && !is_void(field.H_at_post_m(row, 0)) ? 0 : column;
}

double canonical_lon_deg(const PostGrid& grid, int row, int column) {
    const bool twin = column == grid.columns() - 1 && grid.goes_round();
    return grid.lon.at_deg(twin || at_pole(grid, row) ? 0 : column);
}

double row_lat_deg(const PostGrid& grid, std::int64_t row) {
    const double lat_deg = grid.lat.at_deg(row);
    return std::abs(std::abs(lat_deg) - 90.0) < 1.0e-9 ? std::copysign(90.0, lat_deg) : lat_deg;
}

double drawn_h_m(const HeightField& field, int row, int column, double exaggeration) {
    const float H_m = field.H_at_post_m(row, canonical_column(field, row, column));
    if (field.grid.net)
        return height_steps(static_cast<double>(H_m) * exaggeration + field.N_at_post_m(row, column)) *
               height_step_m;
    const double N_m =
        field.undulation.at_m(row_lat_deg(field.grid, row), canonical_lon_deg(field.grid, row, column));
    return height_steps(static_cast<double>(H_m) * exaggeration + N_m) * height_step_m;
}

DrawnHeights drawn_heights(const HeightField& field, double exaggeration, int threads) {
    const PostGrid& grid = field.grid;
    const bool has_N = !field.undulation.N_m.empty() && !grid.net;
    DrawnHeights heights;
    heights.rows = grid.rows();
    heights.columns = grid.columns();
    heights.steps.resize(grid.post_count());
    std::vector<UndulationField::Between> columns;
    for (int column = 0; has_N && column < grid.columns(); ++column)
        columns.push_back(field.undulation.column_between(grid.lon.at_deg(column)));
    in_parallel(grid.rows(), threads, [&](int row) {
        const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns());
        const UndulationField::Between N_row =
            has_N ? field.undulation.row_between(row_lat_deg(grid, row)) : UndulationField::Between{};
        const bool pole = at_pole(grid, row);
        for (int column = 0; column < grid.columns(); ++column) {
            const std::size_t i = static_cast<std::size_t>(column);
            const float H_m = field.posts ? field.posts->H_m(row, column) : field.H_m[first + i];
            if (is_void(H_m)) {
                heights.steps[first + i] = void_height_steps;
            } else if (pole || grid.net || column == grid.columns() - 1) {
                heights.steps[first + i] = height_steps(drawn_h_m(field, row, column, exaggeration));
            } else {
                const double N_m = has_N ? field.undulation.at_m(N_row, columns[i]) : 0.0;
                heights.steps[first + i] = height_steps(static_cast<double>(H_m) * exaggeration + N_m);
            }
        }
    });
    heights.diagonals = CellDiagonals::of(field, threads);
    if (!heights.steps.empty())
        heights.highest_steps = *std::max_element(heights.steps.begin(), heights.steps.end());
    return heights;
}

Ecef post_ecef(const HeightField& field, int row, int column, double exaggeration) {
    assert(!is_void(field.H_at_post_m(row, column)));
    if (field.grid.net)
        return ecef_along(field.grid.net->normal_at(row, column),
                          drawn_h_m(field, row, column, exaggeration));
    return ecef_from_geodetic({row_lat_deg(field.grid, row), canonical_lon_deg(field.grid, row, column),
                               drawn_h_m(field, row, column, exaggeration)});
}

}  // namespace oro
