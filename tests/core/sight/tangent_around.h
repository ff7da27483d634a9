// A bound of how high the edges around one post are seen, for that post alone: what SweptPosts makes of many.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/sight/eye_plane.h"

namespace oro::test {

// No edge between two posts within the plane's bound_tangents() of a post is seen higher than at this
// tangent; infinite where that is not known, or the post is too near.
inline double most_tangent_around(const EyePlane& plane, std::int64_t number) {
    const EyePlane::TangentBound bound = plane.tangent_bound();
    const double nearest_m = plane.post(number).distance_m - bound.around_m;
    if (!(nearest_m > 4.0 * bound.longest_edge_m)) return std::numeric_limits<double>::infinity();
    const double most = plane.most_tangent_of_box(number), across = bound.longest_edge_m / nearest_m;
    return most + std::abs(most) * across * across + 3.0 * bound.error_m / nearest_m;
}

}  // namespace oro::test
