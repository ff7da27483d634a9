// How two height fields differ where both have heights.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/terrain/grid_part.h"
#include "core/terrain/post_grid.h"

namespace oro {

// The posts of a grid that lie in the box of another one, and those next to them; all columns of a grid that
// goes round the Earth or meets one wider than half of it, all posts of a grid on a net.
GridPart part_within(const PostGrid& grid, const PostGrid& other);

// H of one surface minus H of another, at posts of the first.
struct HeightDifference {
    GridPart window;
    std::vector<float> difference_m;  // of its posts, row by row; void_height_m where one of them has none
    std::uint64_t posts{};            // that have one
    // Over those, each counted once: metres. All 0 where there are none.
    double mean_m{}, rms_m{};
    double least_m{}, greatest_m{};
    PostPlace least_at{}, greatest_at{};  // the first of them from the north-west
};

// H of a surface at a place, nothing where it has none; asked from several threads.
using HeightAtPlace = std::function<std::optional<double>(double lat_deg, double lon_deg)>;

// H of a field at a place as HeightField::surface_H_m() has it; within a millionth of a post's spacing of a
// post that has a height it is that post's. A post next to void ones is not lost so by a place's rounding.
std::optional<double> H_at_place_m(const HeightField& field, double lat_deg, double lon_deg);

// Takes from H of the field's own posts in a window what another surface has at their places. The work is
// shared between threads, with one result for any number of them. tell_share: 0 to 1, from any thread; null:
// nobody is told. Where stop is requested what is given means nothing. The differences are rounded to float,
// the figures are those of the rounded ones. Posts that cannot be read count as void: field.health() tells.
HeightDifference height_difference(const HeightField& field, const GridPart& window,
                                   const HeightAtPlace& other_H_m, int threads,
                                   const std::function<void(double share)>& tell_share,
                                   const std::stop_token& stop);

// The same the other way round: the other surface minus the field.
void negate(HeightDifference& difference);

}  // namespace oro
