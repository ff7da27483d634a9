// Grids of posts that lie over each other.
#pragma once

#include <utility>

#include "geo/region/region.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"

namespace oro::test {

// A grid on degrees, another turned over its middle with a step and holes, a third of closer posts over a
// corner of that.
inline Region three_grids(int coarse_posts) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = rough_field(47.0, 8.0, coarse_posts, coarse_posts);
    region.grids[0].rank = 2;
    const double middle = 0.5 * coarse_posts / 1200.0;
    const auto over = [&](const PlaneOfPosts& plane, double step_m, int rank) {
        RegionGrid& other = region.grids.emplace_back();
        other.field = net_field(plane, [&](double row, double column) {
            const PostPlace at = plane.place_of(row, column);
            return static_cast<float>(rough_H_m(at.lat_deg, at.lon_deg) + step_m);
        });
        other.rank = rank;
    };
    const PostPlace at{47.0 - middle, 8.0 + middle};
    over({81, 121, at, 40.0, 27.0}, 15.0, 1);
    over({101, 91, {at.lat_deg + 0.008, at.lon_deg + 0.02}, 15.0, -51.0}, -10.0, 0);
    HeightField& holed = region.grids[1].field;
    for (const auto& [first_row, first_column] : {std::pair{20, 30}, std::pair{55, 100}, std::pair{0, 60}})
        for (int row = first_row; row < first_row + 7; ++row)
            for (int column = first_column; column < first_column + 9; ++column)
                holed.H_m[static_cast<std::size_t>(row * holed.grid.columns() + column)] = void_height_m;
    return region;
}

}  // namespace oro::test
