#include "apps/commands/sight/horizon_part.h"

#include <algorithm>
#include <cmath>

#include "core/earth/ellipsoid.h"
#include "geo/places/geodesic.h"

namespace oro {
namespace {

constexpr double rounded_posts = 1.0e-6;

// The posts of a net that lie within a box, row by row.
GridPart part_of_net(const PostGrid& grid, const BoundingBox& box) {
    const double width_deg = std::fmod(box.east_deg - box.west_deg + 360.0, 360.0);
    int north = grid.rows(), south = -1, west = grid.columns(), east = -1;
    for (int row = 0; row < grid.rows(); ++row) {
        for (int column = 0; column < grid.columns(); ++column) {
            const PostPlace place = grid.place_at(row, column);
            if (place.lat_deg < box.south_deg || place.lat_deg > box.north_deg) continue;
            const double from_west_deg = std::fmod(place.lon_deg - box.west_deg + 720.0, 360.0);
            if (width_deg > 0.0 && from_west_deg > width_deg) continue;
            north = std::min(north, row);
            south = row;
            west = std::min(west, column);
            east = std::max(east, column);
        }
    }
    if (south < north) return {};
    return {north, south - north + 1, west, east - west + 1};
}

}  // namespace

GridPart part_in_box(const PostGrid& grid, const std::optional<BoundingBox>& box) {
    if (!box) return {0, grid.rows(), 0, grid.columns()};
    if (grid.net) return part_of_net(grid, *box);
    const auto first_of = [](double at) { return static_cast<int>(std::ceil(at - rounded_posts)); };
    const auto last_of = [](double at) { return static_cast<int>(std::floor(at + rounded_posts)); };
    const double north = std::clamp(grid.lat.index_at(box->north_deg), -1.0, grid.rows() + 0.0),
                 south = std::clamp(grid.lat.index_at(box->south_deg), -1.0, grid.rows() + 0.0);
    const double width_deg = box->east_deg - box->west_deg + (box->west_deg > box->east_deg ? 360.0 : 0.0);
    const double half = 0.5 * width_deg * grid.lon.posts_per_deg;
    const double middle = grid.column_at(normalised_lon_deg(box->west_deg + 0.5 * width_deg));
    GridPart part;
    part.first_row = std::max(0, first_of(north));
    part.rows = std::min(grid.rows() - 1, last_of(south)) - part.first_row + 1;
    part.first_column = first_of(middle - half);
    int last_column = last_of(middle + half);
    if (grid.wraps_longitude()) {
        if (last_column - part.first_column + 1 >= grid.columns()) {
            part.first_column = 0;
            last_column = grid.columns() - 1;
        }
    } else {
        part.first_column = std::max(0, part.first_column);
        last_column = std::min(grid.columns() - 1, last_column);
    }
    part.columns = last_column - part.first_column + 1;
    return part.rows > 0 && part.columns > 0 ? part : GridPart{};
}

bool reaches_beyond(const PostGrid& grid, const GridPart& part, double radius_m) {
    for (const int row : {part.first_row, part.first_row + part.rows - 1}) {
        for (const int column : {part.first_column, part.first_column + part.columns - 1}) {
            const PostPlace place = grid.place_at(row, column);
            for (const double bearing_deg : {0.0, 90.0, 180.0, 270.0}) {
                const LatLon rim =
                    geodesic_towards(place.lat_deg, normalised_lon_deg(place.lon_deg), bearing_deg, radius_m);
                const PostNumber post = grid.post_at(rim.lat_deg, rim.lon_deg);
                if (!(post.row >= 0.0 && post.row <= grid.rows() - 1.0)) return true;
                if (grid.wraps_longitude()) continue;
                if (!(post.column >= 0.0 && post.column <= grid.columns() - 1.0)) return true;
            }
        }
    }
    return false;
}

}  // namespace oro
