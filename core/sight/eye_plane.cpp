#include "core/sight/eye_plane.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include "core/base/parallel.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// A window's column as one of the grid.
int grid_column(const PostGrid& grid, int column) {
    if (!grid.goes_round()) return column;
    const int turn = grid.columns() - 1;
    return ((column % turn) + turn) % turn;
}

}  // namespace

EyePlane::EyePlane(const TrueSurface& surface, const Lookout& lookout, const PostWindow& window, int threads)
    : window_(window),
      stride_(window.columns + 2),
      neighbours_{1, stride_ + 1, stride_, -1, -stride_ - 1, -stride_},
      posts_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(window.rows + 2),
             PlanePost{no_number, no_number, no_number, no_number, no_number}),
      enu_from_ecef_(glm::transpose(ecef_from_enu(lookout.eye().lat_deg, lookout.eye().lon_deg))),
      bend_per_m_(0.5 * lookout.sight().refraction.curvature_per_m()),
      bulge_per_m_(0.5 / std::sqrt(prime_vertical_radius_m(lookout.eye().lat_deg) *
                                   meridian_radius_m(lookout.eye().lat_deg)) -
                   bend_per_m_) {
    const PostGrid& grid = surface.field().grid;
    eye_enu_ = enu_from_ecef_ * lookout.sight().eye.m;
    for (int row = 0; row < window.rows; ++row) {
        const double lat_deg = row_lat_deg(grid, window.first_row + row);
        const SineCosine lat = sine_cosine_deg(lat_deg);
        rows_.push_back({prime_vertical_radius_m(lat_deg), lat.cosine, lat.sine});
    }
    for (int column = 0; column < window.columns; ++column) {
        const SineCosine lon =
            sine_cosine_deg(grid.lon.at_deg(grid_column(grid, window.first_column + column)));
        columns_.push_back(enu_from_ecef_ * glm::dvec3(lon.cosine, lon.sine, 0.0));
    }
    in_parallel(window.rows, threads, [&](int row) { place_row(surface, row); });
    measure(grid, threads);
}

void EyePlane::place_row(const TrueSurface& surface, int row) {
    const PostGrid& grid = surface.field().grid;
    const RowTerms& terms = rows_[static_cast<std::size_t>(row)];
    const glm::dvec3 up = enu_from_ecef_[2];
    double last_h_m = 0.0;
    for (int column = 0; column < window_.columns; ++column) {
        const std::optional<double> found_m =
            surface.post_h_m(window_.first_row + row, grid_column(grid, window_.first_column + column));
        const double h_m = last_h_m = found_m.value_or(last_h_m);
        const double across_m = (terms.normal_m + h_m) * terms.cosine;
        const double along_m = (terms.normal_m * (1.0 - wgs84_e2) + h_m) * terms.sine;
        const glm::dvec3 enu =
            across_m * columns_[static_cast<std::size_t>(column)] + along_m * up - eye_enu_;
        const double across2 = enu.x * enu.x + enu.y * enu.y, distance_m = std::sqrt(across2);
        const double seen_m = found_m ? enu.z + bend_per_m_ * across2 : no_number;
        posts_[static_cast<std::size_t>(number(row, column))] = {enu.x, enu.y, seen_m, distance_m,
                                                                 seen_m / distance_m};
    }
}

glm::dvec3 EyePlane::normal(int row, int column) const {
    const RowTerms& terms = rows_[static_cast<std::size_t>(row)];
    return terms.cosine * columns_[static_cast<std::size_t>(column)] + terms.sine * enu_from_ecef_[2];
}

// How far edges of the ground, which are straight in latitude, longitude and h, are from straight ones: an
// eighth of their second differences. What they are off sideways counts by the ground's steepness.
void EyePlane::measure(const PostGrid& grid, int threads) {
    std::mutex taking;
    double longest2 = 0.0, steepest2 = 0.0, most_rise_m = 0.0;
    in_parallel(window_.rows, threads, [&](int row) {
        double own_longest2 = 0.0, own_steepest2 = 0.0, own_rise_m = 0.0;
        for (int column = 0; column < window_.columns; ++column) {
            const std::int64_t here = number(row, column);
            const PlanePost& a = post(here);
            for (int i = 0; i < 3; ++i) {
                const PlanePost& b = post(here + neighbours_[i]);
                const double dx = b.x - a.x, dy = b.y - a.y, rise_m = std::abs(b.z - a.z);
                const double length2 = dx * dx + dy * dy;
                // Not of what has no place or no height: a comparison with no number is false.
                if (length2 > own_longest2) own_longest2 = length2;
                constexpr double narrowest2 = 1.0e-4;
                const double steep2 = rise_m * rise_m / std::max(length2, narrowest2);
                if (steep2 > own_steepest2) own_steepest2 = steep2;
                if (rise_m > own_rise_m) own_rise_m = rise_m;
            }
        }
        const std::lock_guard lock(taking);
        longest2 = std::max(longest2, own_longest2);
        steepest2 = std::max(steepest2, own_steepest2);
        most_rise_m = std::max(most_rise_m, own_rise_m);
    });
    longest_edge_m_ = std::sqrt(longest2) * (1.0 + 1.0e-9) + 1.0e-6;
    const double tall = radians_from_deg(grid.lat.spacing_deg()).rad;
    const double wide = radians_from_deg(grid.lon.spacing_deg()).rad;
    double cosine = 0.0, sine = 0.0;
    for (const RowTerms& row : rows_) {
        cosine = std::max(cosine, row.cosine);
        sine = std::max(sine, std::abs(row.sine));
    }
    constexpr double radius_m = 6.4e6;
    const double up_m = radius_m / 8.0 * (tall * tall + cosine * cosine * wide * wide) *
                        (1.0 + 2.0 * std::abs(bend_per_m_) * radius_m);
    const double sideways_m = radius_m / 8.0 * sine * (cosine * wide * wide + 2.0 * tall * wide) +
                              most_rise_m * std::max(tall, wide) / 4.0;
    constexpr double rounded_m = 2.0e-6;
    // A triangle is steeper than its edges, by at most twice where these are even.
    error_m_ = 1.2 * (up_m + sideways_m * (1.0 + 2.0 * std::sqrt(steepest2))) + rounded_m;
}

}  // namespace oro
