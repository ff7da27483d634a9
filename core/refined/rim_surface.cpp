#include "core/refined/rim_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/terrain/post_grid.h"

namespace oro {
namespace {

constexpr double noise_posts = 6.0;     // over which noise grows from the rim on
constexpr double straight_posts = 3.0;  // over which the straight ways of the rim become the bicubic

double smooth_step(double t) {
    const double in = std::clamp(t, 0.0, 1.0);
    return in * in * (3.0 - 2.0 * in);
}

// Over how many posts something changes, in a part of so many.
double width_in(int posts, double most) {
    return std::min(most, std::max(1.0, 0.25 * (posts - 1)));
}

// Of four numbers in line, for a place between the second and the third.
std::array<double, 4> weights_at(double t) {
    return {0.5 * t * ((2.0 - t) * t - 1.0), 0.5 * ((3.0 * t - 5.0) * t * t + 2.0),
            0.5 * t * ((4.0 - 3.0 * t) * t + 1.0), 0.5 * t * t * (t - 1.0)};
}

// The cell of a place along one direction.
int cell_at(double number, int posts) {
    return std::clamp(static_cast<int>(std::floor(number)), 0, posts - 2);
}

// The same for posts in line.
template <class At>
double bulge_m(const At& post_m, double number, int posts) {
    const int first = cell_at(number, posts);
    const double t = number - first;
    const std::array<double, 4> weights = weights_at(t);
    double sum_m = 0.0;
    for (int i = 0; i < 4; ++i) sum_m += weights[static_cast<std::size_t>(i)] * post_m(first - 1 + i);
    const double bulge = sum_m - std::lerp(post_m(first), post_m(first + 1), t);
    return std::isfinite(bulge) ? bulge : 0.0;
}

}  // namespace

RimSurface::RimSurface(const TakenPosts& taken, const GridPart& part)
    : taken_(taken),
      rows_(part.rows),
      columns_(part.columns),
      first_row_(taken.row_of(part.first_row)),
      first_column_(taken.column_of(part.first_column)),
      noise_rows_(width_in(part.rows, noise_posts)),
      noise_columns_(width_in(part.columns, noise_posts)),
      straight_rows_(width_in(part.rows, straight_posts)),
      straight_columns_(width_in(part.columns, straight_posts)) {}

double RimSurface::noise_share(double row, double column) const {
    return smooth_step(std::min(row, rows_ - 1 - row) / noise_rows_) *
           smooth_step(std::min(column, columns_ - 1 - column) / noise_columns_);
}

double RimSurface::post_m(int row, int column) const {
    const int down = first_row_ + row, right = first_column_ + column;
    if (down < 0) return 2.0 * post_m(row + 1, column) - post_m(row + 2, column);
    if (down >= taken_.rows()) return 2.0 * post_m(row - 1, column) - post_m(row - 2, column);
    if (right < 0) return 2.0 * post_m(row, column + 1) - post_m(row, column + 2);
    if (right >= taken_.columns()) return 2.0 * post_m(row, column - 1) - post_m(row, column - 2);
    const float H_m = taken_.H_m(down, right);
    return is_void(H_m) ? std::nan("") : double{H_m};
}

double RimSurface::bulge_of_row_m(int row, double column) const {
    return bulge_m([&](int number) { return post_m(row, number); }, column, columns_);
}

double RimSurface::bulge_of_column_m(double row, int column) const {
    return bulge_m([&](int number) { return post_m(number, column); }, row, rows_);
}

double RimSurface::H_m(double row, double column) const {
    const int first_row = cell_at(row, rows_), first_column = cell_at(column, columns_);
    const std::array<double, 4> down = weights_at(row - first_row), right = weights_at(column - first_column);
    double H_m = 0.0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            H_m += down[static_cast<std::size_t>(i)] * right[static_cast<std::size_t>(j)] *
                   post_m(first_row - 1 + i, first_column - 1 + j);
    // Of rims that face each other the nearer one counts.
    const double rows_off = std::min(row, rows_ - 1 - row),
                 columns_off = std::min(column, columns_ - 1 - column);
    if (rows_off < straight_rows_)
        H_m -= (1.0 - smooth_step(rows_off / straight_rows_)) *
               bulge_of_row_m(row == rows_off ? 0 : rows_ - 1, column);
    if (columns_off < straight_columns_)
        H_m -= (1.0 - smooth_step(columns_off / straight_columns_)) *
               bulge_of_column_m(row, column == columns_off ? 0 : columns_ - 1);
    return H_m;
}

}  // namespace oro
