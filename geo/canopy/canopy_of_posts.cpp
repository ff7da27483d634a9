#include "geo/canopy/canopy_of_posts.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/base/parallel.h"

namespace oro {
namespace {

// The places of a row's posts, WGS84 degrees.
void places_of_row(const PostGrid& grid, int row, std::vector<double>& lat_deg,
                   std::vector<double>& lon_deg) {
    for (int column = 0; column < grid.columns(); ++column) {
        const auto i = static_cast<std::size_t>(column);
        if (grid.net) {
            const PostPlace place = grid.net->place_at(row, column);
            lat_deg[i] = place.lat_deg;
            lon_deg[i] = place.lon_deg;
        } else {
            lat_deg[i] = row_lat_deg(grid, row);
            lon_deg[i] = grid.lon.at_deg(column);
        }
    }
}

// How far the posts of a row are from each other, and from those of the next row, in its middle.
CellSize cell_of_row(const PostGrid& grid, int row) {
    if (!grid.net) return {grid.lat.spacing_deg(), grid.lon.spacing_deg()};
    const double column = 0.5 * (grid.columns() - 1);
    const PostPlace north = grid.net->place_at(row - 0.5, column),
                    south = grid.net->place_at(row + 0.5, column);
    const PostPlace west = grid.net->place_at(row, column - 0.5),
                    east = grid.net->place_at(row, column + 0.5);
    const auto turn_deg = [](double from_deg, double to_deg) {
        return std::abs(std::remainder(to_deg - from_deg, 360.0));
    };
    return {std::max(std::abs(north.lat_deg - south.lat_deg), std::abs(east.lat_deg - west.lat_deg)),
            std::max(turn_deg(west.lon_deg, east.lon_deg), turn_deg(north.lon_deg, south.lon_deg))};
}

}  // namespace

Result<void> canopy_of_row(const PostGrid& grid, int row, const CanopyMap& canopy,
                           std::span<float> canopy_m) {
    std::vector<double> lat_deg(canopy_m.size()), lon_deg(canopy_m.size());
    places_of_row(grid, row, lat_deg, lon_deg);
    return canopy.heights_around(lat_deg, lon_deg, cell_of_row(grid, row), canopy_m);
}

Result<std::vector<float>> canopy_of_posts(const PostGrid& grid, const CanopyMap& canopy) {
    const auto columns = static_cast<std::size_t>(grid.columns());
    std::vector<float> canopy_m(grid.post_count());
    std::mutex together;
    Result<void> first_fault;
    in_parallel(grid.rows(), thread_count(), [&](int row) {
        {
            const std::scoped_lock lock(together);
            if (!first_fault.ok()) return;
        }
        const Result<void> done = canopy_of_row(
            grid, row, canopy, std::span(canopy_m).subspan(static_cast<std::size_t>(row) * columns, columns));
        if (done.ok()) return;
        const std::scoped_lock lock(together);
        if (first_fault.ok()) first_fault = done;
    });
    ORO_CHECK(first_fault);
    return canopy_m;
}

}  // namespace oro
