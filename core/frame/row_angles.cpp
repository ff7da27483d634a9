#include "core/frame/row_angles.h"

#include <algorithm>

#include "core/earth/ellipsoid.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

RowAngles::Row angles_of(const PostGrid& grid, std::int64_t row) {
    const double lat_deg =
        grid.net ? grid.net->place_at(static_cast<double>(row), 0.5 * (grid.columns() - 1)).lat_deg
                 : row_lat_deg(grid, row);
    const SineCosine lat = sine_cosine_deg(lat_deg);
    return {lat.sine, lat.cosine, prime_vertical_radius_m(lat_deg)};
}

}  // namespace

RowAngles::Row RowAngles::at(std::int64_t row) {
    if (grid_->net) row = std::min<std::int64_t>(row, grid_->rows() - 1);
    if (row < 0 || row >= grid_->rows()) return angles_of(*grid_, row);
    if (rows_.empty()) rows_.resize(static_cast<std::size_t>(grid_->rows()), {0.0, 0.0, 0.0});
    Row& there = rows_[static_cast<std::size_t>(row)];
    if (there.normal_m == 0.0) there = angles_of(*grid_, row);
    return there;
}

}  // namespace oro
