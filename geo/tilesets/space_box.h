// A box along the axes of ECEF.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace oro {

// Empty at first. Metres.
struct SpaceBox {
    glm::dvec3 low_m{std::numeric_limits<double>::infinity()};
    glm::dvec3 high_m{-std::numeric_limits<double>::infinity()};

    void add(const glm::dvec3& place_m) {
        low_m = glm::min(low_m, place_m);
        high_m = glm::max(high_m, place_m);
    }
    // Of one that is not empty.
    [[nodiscard]] glm::dvec3 middle_m() const { return 0.5 * (low_m + high_m); }
    [[nodiscard]] double diagonal_m() const { return glm::distance(low_m, high_m); }
    // Along the axis where it is widest; negative of an empty one.
    [[nodiscard]] double widest_m() const {
        const glm::dvec3 sides_m = high_m - low_m;
        return std::max({sides_m.x, sides_m.y, sides_m.z});
    }
};

}  // namespace oro
