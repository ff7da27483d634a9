#include "core/sight/eye_plane.h"

#include <algorithm>
#include <limits>
#include <mutex>
#include <span>

#include "core/base/parallel.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr float float_infinite = std::numeric_limits<float>::infinity();

// A window's column as one of the grid.
int grid_column(const PostGrid& grid, int column) {
    if (!grid.wraps_longitude()) return column;
    const int turn = grid.columns() - 1;
    return ((column % turn) + turn) % turn;
}

}  // namespace

EyePlane::EyePlane(const TrueSurface& surface, const Observer& observer, const GridPart& window, int threads)
    : window_(window),
      stride_(window.columns + 2),
      count_(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(window.rows + 2)),
      posts_(std::make_unique_for_overwrite<PlanePost[]>(count_)),
      sw_ne_(count_, 0),
      enu_from_ecef_(glm::transpose(ecef_from_enu(observer.eye().lat_deg, observer.eye().lon_deg))),
      bend_per_m_(0.5 * observer.sight().refraction.curvature_per_m()),
      bulge_per_m_(0.5 / gaussian_radius_m(observer.eye().lat_deg) - bend_per_m_) {
    const PostGrid& grid = surface.field().grid;
    eye_enu_ = enu_from_ecef_ * observer.sight().eye.m;
    net_ = grid.net;
    for (int row = 0; !net_ && row < window.rows; ++row) {
        const double lat_deg = row_lat_deg(grid, window.first_row + row);
        const SineCosine lat = sine_cosine_deg(lat_deg);
        rows_.push_back({prime_vertical_radius_m(lat_deg), lat.cosine, lat.sine});
    }
    for (int column = 0; !net_ && column < window.columns; ++column) {
        const SineCosine lon =
            sine_cosine_deg(grid.lon.at_deg(grid_column(grid, window.first_column + column)));
        columns_.push_back(enu_from_ecef_ * glm::dvec3(lon.cosine, lon.sine, 0.0));
    }
    constexpr PlanePost no_place{no_number, no_number, no_number, no_number, no_number};
    std::fill_n(posts_.get(), stride_, no_place);
    std::fill_n(posts_.get() + count_ - stride_, stride_, no_place);
    in_parallel(window.rows, threads, [&](int row) {
        posts_[static_cast<std::size_t>(number(row, -1))] = no_place;
        posts_[static_cast<std::size_t>(number(row, window.columns))] = no_place;
        place_row(surface, row);
    });
    measure(grid, threads);
}

void EyePlane::place_row(const TrueSurface& surface, int row) {
    const PostGrid& grid = surface.field().grid;
    const glm::dvec3 up = enu_from_ecef_[2];
    std::vector<glm::dvec3> normals;
    if (net_) {
        normals.resize(static_cast<std::size_t>(window_.columns));
        net_->normals_of_row(window_.first_row + row, window_.first_column, normals);
    }
    const auto enu_of = [&](int column, double h_m) {
        if (net_)
            return enu_from_ecef_ * ecef_along(normals[static_cast<std::size_t>(column)], h_m).m - eye_enu_;
        const RowTerms& terms = rows_[static_cast<std::size_t>(row)];
        const double across_m = (terms.normal_m + h_m) * terms.cosine;
        const double along_m = (terms.normal_m * (1.0 - wgs84_e2) + h_m) * terms.sine;
        return across_m * columns_[static_cast<std::size_t>(column)] + along_m * up - eye_enu_;
    };
    const bool wraps = grid.wraps_longitude();
    const auto column_of = [&](int column) {
        const int number = window_.first_column + column;
        return wraps ? grid_column(grid, number) : number;
    };
    std::vector<double> heights_m(static_cast<std::size_t>(window_.columns));
    if (!wraps) surface.row_h_m(window_.first_row + row, window_.first_column, heights_m);
    for (int column = 0; wraps && column < window_.columns; ++column)
        surface.row_h_m(window_.first_row + row, column_of(column),
                        std::span(heights_m).subspan(static_cast<std::size_t>(column), 1));
    double last_h_m = 0.0;
    for (int column = 0; column < window_.columns; ++column) {
        const double found_m = heights_m[static_cast<std::size_t>(column)];
        const bool is_found = !std::isnan(found_m);
        const double h_m = last_h_m = is_found ? found_m : last_h_m;
        const glm::dvec3 enu = enu_of(column, h_m);
        const double across2 = enu.x * enu.x + enu.y * enu.y, distance_m = std::sqrt(across2);
        const double seen_m = is_found ? enu.z + bend_per_m_ * across2 : no_number;
        posts_[static_cast<std::size_t>(number(row, column))] = {enu.x, enu.y, seen_m, distance_m,
                                                                 seen_m / distance_m};
    }
    if (row + 1 >= window_.rows) return;
    for (int column = 0; column + 1 < window_.columns; ++column) {
        const Diagonal diagonal = surface.diagonal_of_many(window_.first_row + row, column_of(column));
        sw_ne_[static_cast<std::size_t>(number(row, column))] = diagonal == Diagonal::sw_ne ? 1 : 0;
    }
}

glm::dvec3 EyePlane::normal(int row, int column) const {
    if (net_) return enu_from_ecef_ * net_->normal_at(window_.first_row + row, window_.first_column + column);
    const RowTerms& terms = rows_[static_cast<std::size_t>(row)];
    return terms.cosine * columns_[static_cast<std::size_t>(column)] + terms.sine * enu_from_ecef_[2];
}

// How far edges of the ground, which are straight in latitude, longitude and h, are from straight ones: an
// eighth of their second differences. What they are off sideways counts by the ground's steepness.
void EyePlane::measure(const PostGrid& grid, int threads) {
    std::mutex taking;
    double longest2 = 0.0, right2 = infinite, down2 = infinite, steepest2 = 0.0, most_rise_m = 0.0;
    in_parallel(window_.rows, threads, [&](int row) {
        double own_longest2 = 0.0, own_right2 = infinite, own_down2 = infinite, own_steepest2 = 0.0,
               own_rise_m = 0.0;
        for (int column = 0; column < window_.columns; ++column) {
            const std::int64_t here = number(row, column);
            // Eastwards, down the cell's own diagonal, southwards.
            const std::int64_t across = sw_ne_[static_cast<std::size_t>(here)] != 0 ? here + 1 : here;
            const std::array<std::array<std::int64_t, 2>, 3> edges{
                {{here, here + 1},
                 {across, here + stride_ + (across == here ? 1 : 0)},
                 {here, here + stride_}}};
            for (std::size_t i = 0; i < 3; ++i) {
                const PlanePost &a = post(edges[i][0]), &b = post(edges[i][1]);
                const double dx = b.x - a.x, dy = b.y - a.y, rise_m = std::abs(b.z - a.z);
                const double length2 = dx * dx + dy * dy;
                // Not of what has no place or no height: a comparison with no number is false.
                if (length2 > own_longest2) own_longest2 = length2;
                if (i == 0 && length2 < own_right2) own_right2 = length2;
                if (i == 2 && length2 < own_down2) own_down2 = length2;
                constexpr double narrowest2 = 1.0e-4;
                const double steep2 = rise_m * rise_m / std::max(length2, narrowest2);
                if (steep2 > own_steepest2) own_steepest2 = steep2;
                if (rise_m > own_rise_m) own_rise_m = rise_m;
            }
        }
        const std::lock_guard lock(taking);
        longest2 = std::max(longest2, own_longest2);
        right2 = std::min(right2, own_right2);
        down2 = std::min(down2, own_down2);
        steepest2 = std::max(steepest2, own_steepest2);
        most_rise_m = std::max(most_rise_m, own_rise_m);
    });
    longest_edge_m_ = std::sqrt(longest2) * (1.0 + 1.0e-9) + 1.0e-6;
    shortest_right_m_ = std::sqrt(right2);
    shortest_down_m_ = std::sqrt(down2);
    const double tall = grid.row_step_rad(), wide = grid.column_step_rad();
    if (net_) {
        constexpr double radius_m = 6.4e6;
        // Of the longest edge, a diagonal: whatever way it bends.
        const double off_m = radius_m / 8.0 * net_->bend() * (tall + wide) * (tall + wide) +
                             radius_m / 4.0 * net_->kink() * (tall + wide);
        set_error(off_m * (1.0 + 2.0 * std::abs(bend_per_m_) * radius_m),
                  off_m + most_rise_m * (tall + wide) / 4.0, steepest2);
        return;
    }
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
    set_error(up_m, sideways_m, steepest2);
}

void EyePlane::set_error(double up_m, double sideways_m, double steepest2) {
    constexpr double rounded_m = 2.0e-6;
    // A triangle is steeper than its edges, by at most twice where these are even.
    error_m_ = 1.2 * (up_m + sideways_m * (1.0 + 2.0 * std::sqrt(steepest2))) + rounded_m;
}

// The largest of the posts of a box around each: first along rows, then along columns.
void EyePlane::bound_tangents(double around_m, int threads) {
    constexpr int most_posts = 8;
    const double right = around_m / shortest_right_m_, down = around_m / shortest_down_m_;
    if (!(right < most_posts && down < most_posts)) return;
    around_m_ = around_m;
    const int columns = static_cast<int>(stride_), rows = window_.rows + 2;
    const int far_right = static_cast<int>(right), far_down = static_cast<int>(down);
    std::vector<float> along_rows(count_);
    in_parallel(rows, threads, [&](int row) {
        const PlanePost* const posts = posts_.get() + row * stride_;
        float* const most = along_rows.data() + row * stride_;
        std::vector<float> own(static_cast<std::size_t>(columns + 2 * far_right), float_infinite);
        for (int column = 0; column < columns; ++column) {
            const double tangent = posts[column].tangent;
            // Rounded up; no number (no place, no height) is no bound.
            own[static_cast<std::size_t>(column + far_right)] =
                std::isnan(tangent) ? float_infinite
                                    : static_cast<float>(tangent + 1.0e-7 * std::abs(tangent));
        }
        for (int column = 0; column < columns; ++column) most[column] = own[static_cast<std::size_t>(column)];
        for (int i = 1; i <= 2 * far_right; ++i) {
            for (int column = 0; column < columns; ++column)
                most[column] = std::max(most[column], own[static_cast<std::size_t>(column + i)]);
        }
    });
    most_tangents_.assign(count_, float_infinite);
    in_parallel(rows - 2 * far_down, threads, [&](int row) {
        float* const most = most_tangents_.data() + (row + far_down) * stride_;
        std::copy_n(along_rows.data() + row * stride_, columns, most);
        for (int i = 1; i <= 2 * far_down; ++i) {
            const float* const other = along_rows.data() + (row + i) * stride_;
            for (int column = 0; column < columns; ++column)
                most[column] = std::max(most[column], other[column]);
        }
    });
}

}  // namespace oro
