// What holds for all pages of a region.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

#include "core/base/parallel.h"
#include "core/terrain/page.h"

namespace oro {

RegionShape region_shape(const HeightField& field, double exaggeration) {
    assert(exaggeration >= 0.0);
    const PostGrid& grid = field.grid;
    const std::vector<float>& N_m = field.undulation.N_m;
    const double lowest_N_m = N_m.empty() ? 0.0 : *std::min_element(N_m.begin(), N_m.end());
    // Of each row: the lowest height, or 0, and the longest diagonal of its cells.
    std::vector<double> lowest_h_m(static_cast<std::size_t>(grid.rows()), 0.0);
    std::vector<double> diagonals_m(lowest_h_m.size(), 0.0);
    in_parallel(grid.rows(), thread_count(), [&](int row) {
        double& lowest_here = lowest_h_m[static_cast<std::size_t>(row)];
        for (int column = 0; column < grid.columns(); ++column) {
            const float H_m = field.H_at_post_m(row, column);
            // Most posts cannot be the lowest whatever their undulation.
            if (is_void(H_m) || static_cast<double>(H_m) * exaggeration + lowest_N_m >= lowest_here) continue;
            lowest_here = std::min(lowest_here, drawn_h_m(field, row, column, exaggeration));
        }
        if (grid.net) return;
        const double lat_deg = grid.lat.at_deg(row);
        const double south_m = meridian_radius_m(lat_deg) * radians_from_deg(grid.lat.spacing_deg()).rad;
        const double east_m = prime_vertical_radius_m(lat_deg) * sine_cosine_deg(lat_deg).cosine *
                              radians_from_deg(grid.lon.spacing_deg()).rad;
        diagonals_m[static_cast<std::size_t>(row)] = std::hypot(south_m, east_m);
    });
    double lowest = 0.0, diagonal_m = grid.net ? std::hypot(grid.net->row_m(), grid.net->column_m()) : 0.0;
    for (const double of_row : lowest_h_m) lowest = std::min(lowest, of_row);
    for (const double of_row : diagonals_m) diagonal_m = std::max(diagonal_m, of_row);
    return {occluder_below(lowest, diagonal_m), exaggeration};
}

}  // namespace oro
