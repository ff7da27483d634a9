#include "core/terrain/ground.h"

#include "core/terrain/drawn_heights.h"
#include "core/terrain/triangle_heights.h"

namespace oro {

std::optional<double> ground_h_m(const HeightField& field, double lat_deg, double lon_deg,
                                 double exaggeration) {
    const auto post_h_m = [&](int row, int column) -> std::optional<double> {
        if (is_void(field.H_at_post_m(row, column))) return std::nullopt;
        const int canonical = canonical_column(field, row, column);
        if (field.grid.net)
            return static_cast<double>(field.H_at_post_m(row, column)) * exaggeration +
                   field.N_at_post_m(row, column);
        return static_cast<double>(field.H_at_post_m(row, canonical)) * exaggeration +
               field.undulation.at_m(row_lat_deg(field.grid, row),
                                     canonical_lon_deg(field.grid, row, canonical));
    };
    const auto diagonal_at = [&](int row, int column) { return cell_diagonal(field, row, column); };
    return h_on_grid_m(field.grid, post_h_m, diagonal_at, lat_deg, lon_deg);
}

}  // namespace oro
