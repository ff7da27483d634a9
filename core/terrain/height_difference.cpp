#include "core/terrain/height_difference.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "core/base/parallel.h"

namespace oro {
namespace {

// Of one row: what is put together afterwards, row by row, so that sums do not depend on threads.
struct RowFigures {
    std::uint64_t posts{};
    double sum_m{}, sum_m2{};
    float least_m{}, greatest_m{};
    int least_column{}, greatest_column{};
};

RowFigures measured_row(const HeightField& field, const GridPart& window, int row,
                        const HeightAtPlace& other_H_m, float* differences_m) {
    RowFigures figures;
    for (int column = window.first_column; column < window.first_column + window.columns; ++column) {
        float& difference_m = differences_m[column - window.first_column];
        const float H_m = field.H_at_post_m(row, column);
        if (is_void(H_m)) continue;
        const PostPlace place = field.grid.place_at(row, column);
        const auto other_m = other_H_m(place.lat_deg, place.lon_deg);
        if (!other_m) continue;
        difference_m = static_cast<float>(static_cast<double>(H_m) - *other_m);
        if (figures.posts == 0 || difference_m < figures.least_m) {
            figures.least_m = difference_m;
            figures.least_column = column;
        }
        if (figures.posts == 0 || difference_m > figures.greatest_m) {
            figures.greatest_m = difference_m;
            figures.greatest_column = column;
        }
        const auto m = static_cast<double>(difference_m);
        figures.sum_m += m;
        figures.sum_m2 += m * m;
        ++figures.posts;
    }
    return figures;
}

}  // namespace

GridPart part_within(const PostGrid& grid, const PostGrid& other) {
    constexpr double half_turn_deg = 180.0;
    GridPart window{0, grid.rows(), 0, grid.columns()};
    if (grid.net) return window;
    // Of `count` posts those from one to the next but one, both taken in.
    const auto part = [](double from, double to, int count, int& first, int& size) {
        constexpr double slack_posts = 1e-6;  // of places on the rim
        const double last = count - 1;
        from -= slack_posts;
        to += slack_posts;
        first = static_cast<int>(std::clamp(std::floor(from), 0.0, last));
        const int end = static_cast<int>(std::clamp(std::ceil(to), 0.0, last));
        size = to < 0.0 || from > last ? 0 : end - first + 1;
    };
    part(grid.lat.index_at(other.north_deg()), grid.lat.index_at(other.south_deg()), grid.rows(),
         window.first_row, window.rows);
    const double width_deg = other.east_deg() - other.west_deg();
    if (grid.wraps_longitude() || width_deg > half_turn_deg) return window;
    const double west = grid.column_at(other.west_deg());
    const double east = grid.column_at(other.east_deg());
    const double width = width_deg * grid.lon.posts_per_deg;
    // The whole turn in which either of its borders is nearer to the grid.
    const auto beside = [&](double column) {
        return std::max({0.0 - column, column - (grid.columns() - 1), 0.0});
    };
    const double from = beside(west) <= beside(east) ? west : east - width;
    part(from, from + width, grid.columns(), window.first_column, window.columns);
    return window;
}

std::optional<double> H_at_place_m(const HeightField& field, double lat_deg, double lon_deg) {
    constexpr double near_posts = 1e-6;
    const PostNumber at = field.grid.post_at(lat_deg, lon_deg);
    const double row = std::round(at.row), column = std::round(at.column);
    const bool is_post = std::abs(at.row - row) < near_posts && std::abs(at.column - column) < near_posts &&
                         row >= 0.0 && row < field.grid.rows() && column >= 0.0 &&
                         column < field.grid.columns();
    if (is_post) {
        const float H_m = field.H_at_post_m(static_cast<int>(row), static_cast<int>(column));
        if (!is_void(H_m)) return static_cast<double>(H_m);
    }
    return field.surface_H_m(lat_deg, lon_deg);
}

HeightDifference height_difference(const HeightField& field, const GridPart& window,
                                   const HeightAtPlace& other_H_m, int threads,
                                   const std::function<void(double share)>& tell_share,
                                   const std::stop_token& stop) {
    HeightDifference found;
    found.window = window;
    found.difference_m.assign(window.count(), void_height_m);
    if (window.count() == 0) return found;
    std::vector<RowFigures> rows(static_cast<std::size_t>(window.rows));
    std::atomic<int> done{0};
    in_parallel(window.rows, threads, [&](int i) {
        if (stop.stop_requested()) return;
        const auto number = static_cast<std::size_t>(i);
        rows[number] =
            measured_row(field, window, window.first_row + i, other_H_m,
                         found.difference_m.data() + number * static_cast<std::size_t>(window.columns));
        if (tell_share) tell_share(static_cast<double>(++done) / window.rows);
    });
    double sum_m = 0.0, sum_m2 = 0.0;
    for (int i = 0; i < window.rows; ++i) {
        const RowFigures& row = rows[static_cast<std::size_t>(i)];
        if (row.posts == 0) continue;
        const auto least_m = static_cast<double>(row.least_m);
        const auto greatest_m = static_cast<double>(row.greatest_m);
        if (found.posts == 0 || least_m < found.least_m) {
            found.least_m = least_m;
            found.least_at = field.grid.place_at(window.first_row + i, row.least_column);
        }
        if (found.posts == 0 || greatest_m > found.greatest_m) {
            found.greatest_m = greatest_m;
            found.greatest_at = field.grid.place_at(window.first_row + i, row.greatest_column);
        }
        sum_m += row.sum_m;
        sum_m2 += row.sum_m2;
        found.posts += row.posts;
    }
    if (found.posts == 0) return found;
    const auto posts = static_cast<double>(found.posts);
    found.mean_m = sum_m / posts;
    found.rms_m = std::sqrt(sum_m2 / posts);
    return found;
}

void negate(HeightDifference& difference) {
    for (float& m : difference.difference_m)
        if (!is_void(m)) m = -m;
    difference.mean_m = -difference.mean_m;
    std::swap(difference.least_m, difference.greatest_m);
    std::swap(difference.least_at, difference.greatest_at);
    difference.least_m = -difference.least_m;
    difference.greatest_m = -difference.greatest_m;
}

}  // namespace oro
