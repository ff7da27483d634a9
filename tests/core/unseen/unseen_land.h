// Made regions, and what is unseen from a camera in them.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/unseen/unseen_ground.h"
#include "tests/support/made_terrain.h"

namespace oro::test {

inline constexpr double ceiling_m = usual_unseen_ceiling_m;

// A region with all that it takes to look at it.
struct Land {
    HeightField field;
    std::unique_ptr<TrueSurface> surface;
    std::unique_ptr<KnownGround> known;

    Land(HeightField of, const std::vector<DegreeCell>& missing, bool has_rims = false,
         double exaggeration = 1.0)
        : field(std::move(of)) {
        for (int row = 0; row < field.grid.rows(); ++row) {
            for (int column = 0; column < field.grid.columns(); ++column) {
                const double lat = field.grid.lat.at_deg(row), lon = field.grid.lon.at_deg(column);
                // Posts on a cell's edge belong to its neighbour, too.
                const bool inside = std::ranges::any_of(missing, [&](const DegreeCell& cell) {
                    const double east = std::remainder(lon - cell.lon_deg - 0.5, 360.0);
                    return std::abs(lat - cell.lat_deg - 0.5) < 0.5 - 1e-9 && std::abs(east) < 0.5 - 1e-9;
                });
                if (inside)
                    field.H_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(field.grid.columns()) +
                              static_cast<std::size_t>(column)] = void_height_m;
            }
        }
        surface = std::make_unique<TrueSurface>(field, exaggeration, thread_count());
        known = std::make_unique<KnownGround>(field, missing, has_rims);
    }
    [[nodiscard]] UnseenPicture look(const Camera& camera, const Air& air, double ceiling = ceiling_m) const {
        return unseen_picture(*surface, *known, sight_from(camera.eye, air), camera, ceiling, thread_count());
    }
};

// Hills with features of some kilometres, so that steps see them.
inline double hills_m(double lat_deg, double lon_deg) {
    return 900.0 + 700.0 * std::sin(90.0 * lat_deg) * std::cos(70.0 * lon_deg) +
           300.0 * std::sin(310.0 * lat_deg + 1.0) * std::cos(290.0 * lon_deg);
}
inline HeightField hills(double north_deg, double west_deg, double posts_per_deg, int rows, int columns) {
    return made_field(north_deg, west_deg, posts_per_deg, rows, columns,
                      [](double lat, double lon) { return static_cast<float>(hills_m(lat, lon)); });
}

// A square turned by 30 degrees.
inline HeightField turned_square() {
    return made_field(47.0, 9.0, 240.0, 241, 241, [](double lat, double lon) {
        const double x = lon - 9.5, y = lat - 46.5;
        const double u = 0.866 * x + 0.5 * y, v = 0.866 * y - 0.5 * x;
        const bool inside = std::max(std::abs(u), std::abs(v)) < 0.36;
        return inside ? static_cast<float>(hills_m(lat, lon)) : void_height_m;
    });
}
}  // namespace oro::test
