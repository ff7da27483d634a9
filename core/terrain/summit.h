// The summit of a mapped place: maps and grids of posts put it some metres beside each other.
#pragma once

#include <functional>
#include <optional>

#include "core/earth/ellipsoid.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Mapped summits stand beside those of a grid of posts, and then lower on its slopes. A place is moved to the
// highest post so few posts from it, along rows and columns, if that is higher than the ground below the
// place.
inline constexpr int posts_to_summit = 2;

// Gives the height of a post above the ellipsoid, in metres; nothing where it is void.
using PostHeight = std::function<std::optional<double>(int row, int column)>;

// The highest post at most posts_to_summit from the post nearest to a place, as high as post_h_m tells;
// nothing where none of them is higher than place.h_m. Of several as high, the first by row and column.
std::optional<Geodetic> highest_post_near(const PostGrid& grid, const Geodetic& place,
                                          const PostHeight& post_h_m);

// How a place was moved to the highest post nearby.
struct MovedToSummit {
    Geodetic from;      // the place that was given, on the ground
    Geodetic to;        // the post, on the ground; the place itself where no post nearby is higher
    double H_m{};       // of the ground there, not exaggerated
    double moved_m{};   // along the ellipsoid
    double higher_m{};  // than the ground of the place, not exaggerated
};

}  // namespace oro
