#include "core/frame/cast_cells.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/earth/world_model.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

// The ellipsoid's point at a place of a grid.
glm::dvec3 sea_level_ecef(const PostGrid& grid, double row, double column) {
    const PostPlace at = grid.place_at(row, column);
    return ecef_from_geodetic({at.lat_deg, at.lon_deg, 0.0}).m;
}

}  // namespace

int CastCells::level_of_whole(const RegionPages& pages) {
    constexpr int cells_max = 128;
    int level = 0;
    while (level + 1 < pages.levels() &&
           std::max(pages.layout(level).rows, pages.layout(level).columns) > cells_max)
        ++level;
    return level;
}

CastCells::CastCells(const RegionPages& pages, int level)
    : grid_(pages.facts().grid), layout_(pages.layout(level)) {
    posts_ = std::int64_t{gpu::page_quads} << level;
    const double last_row = grid_.rows() - 1, last_column = grid_.columns() - 1;
    middle_ = {sea_level_ecef(grid_, 0.5 * last_row, 0.5 * last_column)};
    for (int i = 0; i < 9; ++i)
        reach_m_ = std::max(reach_m_, glm::length(sea_level_ecef(grid_, 0.5 * (i / 3) * last_row,
                                                                 0.5 * (i % 3) * last_column) -
                                                  middle_.m));
    reach_m_ *= 1.1;  // rims are curved
}

const CastCells::Cell& CastCells::cell(int row, int column) {
    const auto known = cells_.find(layout_.number(row, column));
    if (known != cells_.end()) return known->second;
    const auto posts = static_cast<double>(posts_);
    const std::int64_t at_post_row = std::min<std::int64_t>(row * posts_ + posts_ / 2, grid_.rows() - 1);
    const std::int64_t at_post_column =
        std::min<std::int64_t>(column * posts_ + posts_ / 2, grid_.columns() - 1);
    const Frame frame = frame_of_post(at_post_row, at_post_column);
    const double row_m = posts * frame.row_m, column_m = std::max(1.0, posts * frame.column_m);
    return cells_
        .emplace(layout_.number(row, column),
                 Cell{frame, glm::transpose(ecef_from_enu(frame.place.lat_deg, frame.place.lon_deg)),
                      0.5 * std::hypot(row_m, column_m) / mean_radius_m})
        .first->second;
}

CastCells::Frame CastCells::frame_of_post(std::int64_t row, std::int64_t column) const {
    if (grid_.net) {
        const auto y = static_cast<double>(row), x = static_cast<double>(column);
        const LatticeGeoreference::LatticeFrame local_frame = grid_.net->local_frame_at(y, x);
        return {grid_.net->place_at(y, x), local_frame.row_m, local_frame.column_m,
                sine_cosine_deg(deg_from_radians(Radians(local_frame.turn_rad))), 1.0 + grid_.net->bend()};
    }
    const double lat_deg = row_lat_deg(grid_, row);
    return {{lat_deg, grid_.lon.at_deg(column)},
            meridian_radius_m(lat_deg) * grid_.row_step_rad(),
            prime_vertical_radius_m(lat_deg) * sine_cosine_deg(lat_deg).cosine * grid_.column_step_rad(),
            {0.0, 1.0},
            1.0 + std::abs(std::tan(radians_from_deg(lat_deg).rad))};
}

}  // namespace oro
