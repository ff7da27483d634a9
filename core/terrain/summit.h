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

// A place is not moved for less than this: summits that differ by less are as high as each other.
inline constexpr double least_higher_m = 0.05;

// Gives the height of a post in metres, above whatever the heights of places are told above (the geoid, the
// ellipsoid); nothing where it is void.
using PostHeight = std::function<std::optional<double>(int row, int column)>;

// The highest post at most posts_to_summit from the post nearest to a place, as high as post_h_m tells;
// nothing where none of them is higher than place.h_m. Of several as high, the first by row and column.
std::optional<Geodetic> highest_post_near(const PostGrid& grid, const Geodetic& place,
                                          const PostHeight& post_h_m);

// Whether a post that highest_post_near() gave for `place` is no summit: a post beside it, farther from the
// place than posts_to_summit, is higher than it.
bool rises_beyond(const PostGrid& grid, const Geodetic& place, const Geodetic& highest,
                  const PostHeight& post_h_m);

// How a place was moved to the highest post nearby.
struct MovedToSummit {
    Geodetic from;     // the place that was given, on the ground
    Geodetic to;       // the post, on the ground; the place itself where no post nearby is higher
    double H_m{};      // of the ground there, not exaggerated
    double moved_m{};  // along the ellipsoid
    // Than the ground of the place, not exaggerated; nothing where the place itself has none.
    std::optional<double> higher_m{};
    bool goes_on_rising{};  // rises_beyond(): the post is no summit
};

}  // namespace oro
