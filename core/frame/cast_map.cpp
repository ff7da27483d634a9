#include "core/frame/cast_map.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "core/earth/world_model.h"

namespace oro {
namespace {

constexpr double sun_radius_rad = 0.00465;

// How a line towards the sun rises from anywhere within half_m of a place.
struct SunRise {
    double level;       // cosine of the sun's elevation
    double lowest;      // metres a metre, of the line that rises least, to the sun's lower edge
    double slope;       // ... of those by which casters may be off, 0.02 to 1
    double most_slope;  // ... of the line that rises most
};
SunRise sun_rise(const glm::dvec3& sun_enu, double half_rad) {
    const double level = std::max(std::hypot(sun_enu.x, sun_enu.y), 1e-6);
    const double rise = std::atan2(sun_enu.z, level) - half_rad;
    return {level, std::tan(std::clamp(rise - 1.1 * sun_radius_rad, -1.5, 1.5)),
            std::clamp(std::tan(rise), 0.02, 1.0),
            std::clamp(std::tan(std::min(rise + 2.0 * half_rad, 1.5)), 0.02, 1.0)};
}

}  // namespace

CastMap::Window CastMap::window_of(const CastCells& cells, const Window& seen, const glm::dvec3& sun_enu,
                                   double farthest_m, double lowest_m, double top_m) {
    // The sun stands lower by as much as its direction turns over the ground, and its disc.
    const double rise = std::atan2(sun_enu.z, std::hypot(sun_enu.x, sun_enu.y)) - 1.2 * sun_radius_rad -
                        1.1 * farthest_m / mean_radius_m;
    const double slope = std::tan(std::clamp(rise, -1.5, 1.5)), over_m = std::max(10.0, top_m - lowest_m);
    // slope d + d^2 / 2 R = over, and no line is followed farther than 1,200 km.
    const double way_m =
        std::min(1.25e6, mean_radius_m * (std::sqrt(slope * slope + 2.05 * over_m / mean_radius_m) - slope));
    const auto last_post = [&](std::int64_t cell, int count) {
        return std::min<std::int64_t>(cell * cells.posts(), count - 1);
    };
    const int last_row = seen.first_row + seen.rows, last_column = seen.first_column + seen.columns;
    const PageLayout& all = cells.layout();
    const std::int64_t column = last_post(seen.first_column, cells.grid().columns());
    const CastCells::Frame north =
                               cells.frame_of_post(last_post(seen.first_row, cells.grid().rows()), column),
                           south = cells.frame_of_post(last_post(last_row, cells.grid().rows()), column);
    const auto posts = static_cast<double>(cells.posts());
    const auto cells_of = [&](double cell_m, int most) {
        return static_cast<int>(
            std::min(1.2 * way_m / std::max(1.0, cell_m) + 3.0, static_cast<double>(most)));
    };
    const int rows = cells_of(posts * std::min(north.row_m, south.row_m), all.rows);
    const int columns = cells_of(posts * std::min(north.column_m, south.column_m), all.columns);
    Window window{std::max(0, seen.first_row - rows), std::max(0, seen.first_column - columns), 0, 0};
    window.rows = std::min(all.rows, last_row + rows) - window.first_row;
    window.columns = std::min(all.columns, last_column + columns) - window.first_column;
    return window;
}

CastMap::Patch CastMap::patch(std::int64_t row, std::int64_t column, std::int64_t posts) const {
    const auto first = [](std::int64_t cell, int from) {
        return static_cast<int>(std::max<std::int64_t>(cell - from, 0));
    };
    const auto last = [](std::int64_t cell, int from, int count) {
        return static_cast<int>(std::clamp<std::int64_t>(cell - from, -1, count - 1));
    };
    return {first(row / posts_, window_.first_row),
            last((row + posts - 1) / posts_, window_.first_row, window_.rows),
            first(column / posts_, window_.first_column),
            last((column + posts - 1) / posts_, window_.first_column, window_.columns)};
}

void CastMap::receive(const Patch& patch, double error_per_slope_m, double most_error_per_slope_m,
                      double lowest_m) {
    for (int row = patch.north; row <= patch.south; ++row)
        for (int column = patch.west; column <= patch.east; ++column) {
            Need& need = receivers_[place(row, column)];
            need.error_m = std::min(need.error_m, error_per_slope_m);
            need.most_error_m = std::max(need.most_error_m, most_error_per_slope_m);
            need.low_m = std::min(need.low_m, lowest_m);
        }
}

void CastMap::cast() {
    for (int row = 0; row < window_.rows; ++row)
        for (int column = 0; column < window_.columns; ++column)
            if (receivers_[place(row, column)].low_m < std::numeric_limits<double>::infinity())
                cast_from(row, column);
}

CastMap::Need CastMap::need(const Patch& patch) const {
    Need all;
    for (int row = patch.north; row <= patch.south; ++row)
        for (int column = patch.west; column <= patch.east; ++column) {
            const Need& here = needs_[place(row, column)];
            all.error_m = std::min(all.error_m, here.error_m);
            all.most_error_m = std::max(all.most_error_m, here.most_error_m);
            all.low_m = std::min(all.low_m, here.low_m);
        }
    return all;
}

void CastMap::mark(double north, double south, double west, double east, const Need& need) {
    const auto clamped = [](double cell, int count) {
        return static_cast<int>(std::clamp(std::floor(cell), 0.0, static_cast<double>(count - 1)));
    };
    if (south < 0.0 || east < 0.0 || north >= window_.rows || west >= window_.columns) return;
    any_ = true;
    for (int row = clamped(north, window_.rows); row <= clamped(south, window_.rows); ++row)
        for (int column = clamped(west, window_.columns); column <= clamped(east, window_.columns);
             ++column) {
            Need& there = needs_[place(row, column)];
            there.error_m = std::min(there.error_m, need.error_m);
            there.most_error_m = std::max(there.most_error_m, need.most_error_m);
            there.low_m = std::min(there.low_m, need.low_m);
        }
}

// Moves a cell towards the sun, half a cell at a time, until it is above all terrain.
void CastMap::cast_from(int row, int column) {
    const Need& receiver = receivers_[place(row, column)];
    const auto posts = static_cast<double>(posts_);
    const CastCells::Cell& cell = cells_.cell(row + window_.first_row, column + window_.first_column);
    const CastCells::Frame& local_frame = cell.frame;
    const glm::dvec3 sun = cell.enu_from_ecef * sun_ecef_;
    const double row_m = posts * local_frame.row_m, column_m = std::max(1.0, posts * local_frame.column_m);
    const double half_rad = cell.half_rad;  // the sun's rise differs over the cell
    const SunRise rise = sun_rise(sun, half_rad);
    const double level = rise.level, lowest = rise.lowest;
    const Need need{receiver.error_m * rise.slope, receiver.low_m, receiver.most_error_m * rise.most_slope};
    const double step_m = 0.5 * std::min(row_m, column_m);
    // Cells a metre.
    const double south = (sun.x * local_frame.turn.sine - sun.y * local_frame.turn.cosine) / level / row_m;
    const double east = (sun.x * local_frame.turn.cosine + sun.y * local_frame.turn.sine) / level / column_m;
    double low_m = receiver.low_m;
    for (double from_m = 0.0; low_m <= top_m_ || from_m * lowest < 0.0; from_m += step_m) {
        const double to_m = from_m + step_m;
        // Towards the pole's side the line bends, and the sun's direction differs over the cell.
        const double aside_m = to_m * (half_rad + to_m / (2.0 * mean_radius_m)) * local_frame.bend;
        const double rows = aside_m / row_m + 0.01, columns = aside_m / column_m + 0.01;
        const double sag_m = from_m * from_m / (2.0 * mean_radius_m);
        low_m = receiver.low_m + std::min(from_m * lowest, to_m * lowest) + 0.99 * sag_m;
        if (to_m > 1.2e6) break;
        mark(row + std::min(from_m * south, to_m * south) - rows,
             row + 1.0 + std::max(from_m * south, to_m * south) + rows,
             column + std::min(from_m * east, to_m * east) - columns,
             column + 1.0 + std::max(from_m * east, to_m * east) + columns,
             {need.error_m, low_m, need.most_error_m});
        const double at_row = row + 0.5 + from_m * south, at_column = column + 0.5 + from_m * east;
        if (at_row < -1.0 - rows || at_row > window_.rows + 1.0 + rows || at_column < -1.0 - columns ||
            at_column > window_.columns + 1.0 + columns)
            break;
    }
}

// From a place beside the grid. Where a line is over the ground its straight way through space tells.
void CastMap::cast_from_other_grid(const ShadowReceiver& receiver) {
    const Geodetic at = geodetic_from_ecef(receiver.centre);
    const glm::dvec3 sun = glm::transpose(ecef_from_enu(at.lat_deg, at.lon_deg)) * sun_ecef_;
    const double half_rad = receiver.radius_m / mean_radius_m;
    const SunRise rise = sun_rise(sun, half_rad);
    const double level = std::max(rise.level, 0.02);  // a sun in the zenith: all is within the radius
    const CastCells::Frame middle = cells_.frame_of_post(grid_.rows() / 2, grid_.columns() / 2);
    const double cell_m =
        static_cast<double>(posts_) * std::max(1.0, std::min(middle.row_m, middle.column_m));
    const double step_m = std::max(0.5 * cell_m, 0.25 * receiver.radius_m);
    double low_m = receiver.lowest_m;
    double from_m = 0.0;
    for (double next_m = 0.0; low_m <= top_m_ || from_m * rise.lowest < 0.0; from_m = next_m) {
        const double to_m = next_m = from_m + step_m;
        if (to_m > 1.2e6) break;
        const double sag_m = from_m * from_m / (2.0 * mean_radius_m);
        low_m = receiver.lowest_m + std::min(from_m * rise.lowest, to_m * rise.lowest) + 0.99 * sag_m;
        const glm::dvec3 there = receiver.centre.m + sun_ecef_ * ((from_m + 0.5 * step_m) / level);
        // Around it: what is received, half a step, and lines that are not quite parallel over the ground.
        const double around_m = receiver.radius_m + 0.51 * step_m + to_m * half_rad;
        const double highest_m =
            std::max(top_m_, 0.0) + to_m * to_m / mean_radius_m + 2.0e4 + to_m * std::max(sun.z, 0.0) / level;
        const double off_m =
            glm::length(there - cells_.middle().m) - (cells_.reach_m() + around_m + highest_m);
        if (off_m > 0.0) {
            // Past the grid it does not come back; before it half of the way is free.
            if (glm::dot(there - cells_.middle().m, sun_ecef_) > 0.0) break;
            next_m = std::max(to_m, from_m + 0.5 * off_m * level);
            continue;
        }
        const Geodetic below = geodetic_from_ecef({there});
        const PostNumber post = grid_.post_at(below.lat_deg, below.lon_deg);
        if (!std::isfinite(post.row) || !std::isfinite(post.column)) continue;
        const auto within = [](double number, int count) {
            return static_cast<std::int64_t>(std::clamp(number, 0.0, static_cast<double>(count - 1)));
        };
        const CastCells::Frame local_frame =
            cells_.frame_of_post(within(post.row, grid_.rows()), within(post.column, grid_.columns()));
        const auto posts = static_cast<double>(posts_);
        const double rows = 1.02 * around_m / (posts * local_frame.row_m) + 0.01,
                     columns = 1.02 * around_m / (posts * std::max(local_frame.column_m, 1.0e-2)) + 0.01;
        const double row = post.row / posts - window_.first_row,
                     column = post.column / posts - window_.first_column;
        mark(row - rows, row + rows, column - columns, column + columns,
             {receiver.error_per_slope_m * rise.slope, low_m, receiver.error_per_slope_m * rise.most_slope});
    }
}

}  // namespace oro
