// What holds for all pages of a region.
#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/terrain/page.h"

namespace oro {

RegionShape region_shape(const HeightField& field, double exaggeration) {
    assert(exaggeration >= 0.0);
    const PostGrid& grid = field.grid;
    const std::vector<float>& N_m = field.undulation.N_m;
    const double lowest_N_m = N_m.empty() ? 0.0 : *std::min_element(N_m.begin(), N_m.end());
    double lowest_h_m = 0.0;
    double diagonal_m = 0.0;
    for (int row = 0; row < grid.rows(); ++row) {
        for (int column = 0; column < grid.columns(); ++column) {
            const float H_m = field.H_at_post_m(row, column);
            // Most posts cannot be the lowest whatever their undulation.
            if (is_void(H_m) || static_cast<double>(H_m) * exaggeration + lowest_N_m >= lowest_h_m) continue;
            lowest_h_m = std::min(lowest_h_m, drawn_h_m(field, row, column, exaggeration));
        }
        if (grid.net) continue;
        const double lat_deg = grid.lat.at_deg(row);
        const double south_m = meridian_radius_m(lat_deg) * radians_from_deg(grid.lat.spacing_deg()).rad;
        const double east_m = prime_vertical_radius_m(lat_deg) * sine_cosine_deg(lat_deg).cosine *
                              radians_from_deg(grid.lon.spacing_deg()).rad;
        diagonal_m = std::max(diagonal_m, std::hypot(south_m, east_m));
    }
    if (grid.net) diagonal_m = std::hypot(grid.net->row_m(), grid.net->column_m());
    return {occluder_below(lowest_h_m, diagonal_m), exaggeration};
}

}  // namespace oro
