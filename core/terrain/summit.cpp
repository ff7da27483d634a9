#include "core/terrain/summit.h"

#include <cmath>

namespace oro {

std::optional<Geodetic> highest_post_near(const PostGrid& grid, const Geodetic& place,
                                          const PostHeight& post_h_m) {
    std::optional<Geodetic> highest;
    const auto [row, column] = grid.post_at(place.lat_deg, place.lon_deg);
    const double most = 2.0 * posts_to_summit;
    if (!(row > -most && row < grid.rows() + most && column > -most && column < grid.columns() + most))
        return highest;
    for (int down = -posts_to_summit; down <= posts_to_summit; ++down) {
        for (int right = -posts_to_summit; right <= posts_to_summit; ++right) {
            const int r = static_cast<int>(std::lround(row)) + down,
                      c = static_cast<int>(std::lround(column)) + right;
            if (r < 0 || c < 0 || r >= grid.rows() || c >= grid.columns()) continue;
            const auto h_m = post_h_m(r, c);
            if (!h_m || !(*h_m > (highest ? highest->h_m : place.h_m))) continue;
            const PostPlace at =
                grid.net ? grid.net->place_at(r, c) : PostPlace{grid.lat.at_deg(r), grid.lon.at_deg(c)};
            highest = Geodetic{at.lat_deg, normalised_lon_deg(at.lon_deg), *h_m};
        }
    }
    return highest;
}

}  // namespace oro
