// Which posts lie within a radius around an eye.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/sight/viewshed.h"

namespace oro {
namespace {

constexpr double least_radius_m = 6.33e6, spare_cells = 3.0;  // no radius of curvature is smaller

// Of a grid on a net: what holds a circle around the place.
GridPart window_on_net(const LatticeGeoreference& net, const Geodetic& place, double reach) {
    constexpr int bearings = 256;
    constexpr double between = 1.001;  // a circle's reach beyond the chords from bearing to bearing, and more
    const glm::dmat3 enu = ecef_from_enu(place.lat_deg, place.lon_deg);
    const PostNumber middle = net.post_at(place.lat_deg, place.lon_deg);
    double north = middle.row, south = north, west = middle.column, east = west;
    for (int i = 0; i < bearings; ++i) {
        const double bearing = 2.0 * std::numbers::pi * i / bearings;
        const glm::dvec3 normal = std::cos(reach) * enu[2] +
                                  std::sin(reach) * (std::cos(bearing) * enu[1] + std::sin(bearing) * enu[0]);
        const PostPlace rim = place_of_normal(normal);
        const PostNumber post = net.post_at(rim.lat_deg, rim.lon_deg);
        // A quarter of the Earth away from the grid there are no numbers.
        constexpr double far = 1.0e8;
        if (!(std::max(std::abs(post.row), std::abs(post.column)) < far))
            return {0, net.rows(), 0, net.columns()};
        north = std::min(north, post.row);
        south = std::max(south, post.row);
        west = std::min(west, post.column);
        east = std::max(east, post.column);
    }
    const double tall = between * 0.5 * (south - north) + spare_cells,
                 wide = between * 0.5 * (east - west) + spare_cells;
    const double row = 0.5 * (north + south), column = 0.5 * (west + east);
    const double last_row = net.rows() - 1.0, last_column = net.columns() - 1.0;
    if (row + tall < 0.0 || row - tall > last_row || column + wide < 0.0 || column - wide > last_column)
        return {};
    const auto held = [](double number, double last) {
        return static_cast<int>(std::clamp(number, 0.0, last));
    };
    GridPart window;
    window.first_row = held(std::floor(row - tall), last_row);
    window.first_column = held(std::floor(column - wide), last_column);
    window.rows = held(std::ceil(row + tall), last_row) - window.first_row + 1;
    window.columns = held(std::ceil(column + wide), last_column) - window.first_column + 1;
    return window;
}

}  // namespace

GridPart window_around(const PostGrid& grid, const Geodetic& place, double radius_m) {
    const double reach = radius_m / least_radius_m;
    if (grid.net) return window_on_net(*grid.net, place, reach);
    const double reach_deg = deg_from_radians(Radians{reach});
    const double middle = grid.lat.index_at(place.lat_deg);
    const double rows = reach_deg * grid.lat.posts_per_deg + spare_cells;
    GridPart window;
    window.first_row = static_cast<int>(std::clamp(std::floor(middle - rows), 0.0, grid.rows() - 1.0));
    const int last_row = static_cast<int>(std::clamp(std::ceil(middle + rows), 0.0, grid.rows() - 1.0));
    if (middle + rows < 0.0 || middle - rows > grid.rows() - 1.0) return {};
    window.rows = last_row - window.first_row + 1;
    window.first_column = 0;
    window.columns = grid.columns();
    const SineCosine lat = sine_cosine_deg(place.lat_deg);
    if (std::sin(reach) < 0.99 * lat.cosine) {
        const double wide_deg = deg_from_radians(Radians{std::asin(std::sin(reach) / lat.cosine)});
        const double columns = wide_deg * grid.lon.posts_per_deg + spare_cells;
        const double column = grid.column_at(place.lon_deg);
        double first = std::floor(column - columns), last = std::ceil(column + columns);
        if (grid.wraps_longitude()) {
            if (last - first >= grid.columns() - 1) return window;
        } else {
            // The circle may reach into the grid from behind.
            const double turn_columns = 360.0 * grid.lon.posts_per_deg;
            if (last < 0.0 && last + turn_columns > 0.0 && first + turn_columns < grid.columns())
                return window;
            first = std::max(first, 0.0);
            last = std::min(last, grid.columns() - 1.0);
            if (first > last) return {};
        }
        window.first_column = static_cast<int>(first);
        window.columns = static_cast<int>(last - first) + 1;
    }
    return window;
}

}  // namespace oro
