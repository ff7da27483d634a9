#include "core/drawn_heights.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/parallel.h"

namespace oro {
namespace {

struct Post {
    int row;
    int column;
};

// The post that stands for all that are the same point: column 0 for the last one of a region that goes round
// the Earth, and at a pole the first that is not void.
Post canonical_post(const HeightField& field, int row, int column) {
    const PostGrid& grid = field.grid;
    if (is_void(field.H_at_post_m(row, column))) return {row, column};
    if (std::abs(row_lat_deg(grid, row)) == 90.0) {
        int first = 0;
        while (is_void(field.H_at_post_m(row, first))) ++first;
        return {row, first};
    }
    const bool twin = column == grid.columns() - 1 && grid.goes_round();
    return {row, twin && !is_void(field.H_at_post_m(row, 0)) ? 0 : column};
}

// The nearest step, halves upwards; what an exaggeration lifts beyond 1,000 km stays there.
std::int32_t height_steps(double h_m) {
    constexpr double limit = std::numeric_limits<std::int32_t>::max();
    return static_cast<std::int32_t>(
        std::clamp(std::floor(h_m * (1.0 / height_step_m) + 0.5), -limit, limit));
}

}  // namespace

double row_lat_deg(const PostGrid& grid, std::int64_t row) {
    const double lat_deg = grid.lat.at_deg(row);
    return std::abs(std::abs(lat_deg) - 90.0) < 1.0e-9 ? std::copysign(90.0, lat_deg) : lat_deg;
}

double drawn_h_m(const HeightField& field, int row, int column, double exaggeration) {
    const Post post = canonical_post(field, row, column);
    const double h_m =
        static_cast<double>(field.H_at_post_m(post.row, post.column)) * exaggeration +
        field.undulation.at_m(row_lat_deg(field.grid, post.row), field.grid.lon.at_deg(post.column));
    return height_steps(h_m) * height_step_m;
}

DrawnHeights drawn_heights(const HeightField& field, double exaggeration, int threads) {
    const PostGrid& grid = field.grid;
    const bool has_N = !field.undulation.N_m.empty();
    DrawnHeights heights;
    heights.rows = grid.rows();
    heights.columns = grid.columns();
    heights.steps.resize(grid.post_count());
    std::vector<UndulationField::Between> columns;
    for (int column = 0; has_N && column < grid.columns(); ++column)
        columns.push_back(field.undulation.column_between(grid.lon.at_deg(column)));
    in_parallel(grid.rows(), threads, [&](int row) {
        const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns());
        const double lat_deg = row_lat_deg(grid, row);
        const UndulationField::Between N_row =
            has_N ? field.undulation.row_between(lat_deg) : UndulationField::Between{};
        const bool at_pole = std::abs(lat_deg) == 90.0;
        for (int column = 0; column < grid.columns(); ++column) {
            const std::size_t i = static_cast<std::size_t>(column);
            const float H_m = field.H_m[first + i];
            if (is_void(H_m)) {
                heights.steps[first + i] = void_height_steps;
            } else if (at_pole || column == grid.columns() - 1) {
                heights.steps[first + i] = height_steps(drawn_h_m(field, row, column, exaggeration));
            } else {
                const double N_m = has_N ? field.undulation.at_m(N_row, columns[i]) : 0.0;
                heights.steps[first + i] = height_steps(static_cast<double>(H_m) * exaggeration + N_m);
            }
        }
    });
    if (!heights.steps.empty())
        heights.highest_steps = *std::max_element(heights.steps.begin(), heights.steps.end());
    return heights;
}

Ecef post_ecef(const HeightField& field, int row, int column, double exaggeration) {
    const Post post = canonical_post(field, row, column);
    assert(!is_void(field.H_at_post_m(post.row, post.column)));
    return ecef_from_geodetic({row_lat_deg(field.grid, post.row), field.grid.lon.at_deg(post.column),
                               drawn_h_m(field, row, column, exaggeration)});
}

}  // namespace oro
