#include "core/terrain/summit.h"

#include <cmath>
#include <cstdlib>
#include <utility>

namespace oro {
namespace {

// The post nearest to a place.
std::pair<int, int> nearest_post(const PostGrid& grid, const Geodetic& place) {
    const auto [row, column] = grid.post_at(place.lat_deg, place.lon_deg);
    return {static_cast<int>(std::lround(row)), static_cast<int>(std::lround(column))};
}

bool is_in_grid(const PostGrid& grid, int row, int column) {
    return row >= 0 && column >= 0 && row < grid.rows() && column < grid.columns();
}

}  // namespace

std::optional<Geodetic> highest_post_near(const PostGrid& grid, const Geodetic& place,
                                          const PostHeight& post_h_m) {
    std::optional<Geodetic> highest;
    const auto [row, column] = grid.post_at(place.lat_deg, place.lon_deg);
    const double most = 2.0 * posts_to_summit;
    if (!(row > -most && row < grid.rows() + most && column > -most && column < grid.columns() + most))
        return highest;
    const auto [middle_row, middle_column] = nearest_post(grid, place);
    for (int down = -posts_to_summit; down <= posts_to_summit; ++down) {
        for (int right = -posts_to_summit; right <= posts_to_summit; ++right) {
            const int r = middle_row + down, c = middle_column + right;
            if (!is_in_grid(grid, r, c)) continue;
            const auto h_m = post_h_m(r, c);
            if (!h_m || !(*h_m > (highest ? highest->h_m : place.h_m))) continue;
            const PostPlace at =
                grid.net ? grid.net->place_at(r, c) : PostPlace{grid.lat.at_deg(r), grid.lon.at_deg(c)};
            highest = Geodetic{at.lat_deg, normalised_lon_deg(at.lon_deg), *h_m};
        }
    }
    return highest;
}

bool rises_beyond(const PostGrid& grid, const Geodetic& place, const Geodetic& highest,
                  const PostHeight& post_h_m) {
    const auto [middle_row, middle_column] = nearest_post(grid, place);
    const auto [row, column] = nearest_post(grid, highest);
    for (int r = row - 1; r <= row + 1; ++r) {
        for (int c = column - 1; c <= column + 1; ++c) {
            const bool was_looked_at =
                std::abs(r - middle_row) <= posts_to_summit && std::abs(c - middle_column) <= posts_to_summit;
            if (was_looked_at || !is_in_grid(grid, r, c)) continue;
            if (const auto h_m = post_h_m(r, c); h_m && *h_m > highest.h_m) return true;
        }
    }
    return false;
}

}  // namespace oro
