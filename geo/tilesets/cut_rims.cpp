#include "geo/tilesets/cut_rims.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

namespace oro {
namespace {

// Whether two posts after each other on a straight side touch what another grid has.
bool touches(const OriginalSurface& surface, VertexNumber from, VertexNumber to, int columns,
             std::span<const char> beside) {
    const SurfaceVertex a = surface.vertex(from), b = surface.vertex(to);
    const int rows = b.row - a.row, across = b.column - a.column,
              steps = std::gcd(std::abs(rows), std::abs(across));
    bool before = false;
    for (int i = 0; i <= steps; ++i) {
        const auto row = static_cast<std::size_t>(a.row + rows / steps * i),
                   column = static_cast<std::size_t>(a.column + across / steps * i);
        const bool here = beside[row * static_cast<std::size_t>(columns) + column] != 0;
        if (here && before) return true;
        before = here;
    }
    return false;
}

// What is outside of the sides at a corner.
struct Corner {
    std::array<glm::dvec3, 2> away{};
    int sides{};
};

}  // namespace

glm::dvec3 level_away(const glm::dvec3& from_m, const glm::dvec3& to_m, const glm::dvec3& third_m) {
    const glm::dvec3 up = glm::normalize(from_m / glm::dvec3(1.0, 1.0, 1.0 - wgs84_e2));
    glm::dvec3 across = glm::cross(to_m - from_m, up);
    const double length = glm::length(across);
    if (length == 0.0) return glm::dvec3(0.0);
    across /= length;
    return glm::dot(across, third_m - from_m) > 0.0 ? -across : across;
}

// Both are 1 long: the sum is 1 + cosine along each.
glm::dvec3 across_both(const glm::dvec3& one, const glm::dvec3& other, double longest) {
    const glm::dvec3 sum = one + other;
    const double length = glm::length(sum);
    constexpr double facing = 1.0e-3;
    if (length < facing) return glm::dvec3(0.0);
    return sum / length * std::min(longest, 2.0 / length);
}

CutRims CutRims::of(const ClusteredGround& ground, const LevelCut& cut, std::span<const char> beside) {
    CutRims rims;
    if (beside.empty()) return rims;
    std::unordered_set<std::uint64_t> all;
    all.reserve(3 * cut.triangles.size());
    for (const VertexTriangle& triangle : cut.triangles)
        for (std::size_t i = 0; i < 3; ++i) all.insert(key(triangle[i], triangle[(i + 1) % 3]));
    std::unordered_map<VertexNumber, Corner> corners;
    for (const VertexTriangle& triangle : cut.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const VertexNumber from = triangle[i], to = triangle[(i + 1) % 3];
            if (all.contains(key(to, from)) ||
                !touches(ground.surface(), from, to, ground.grid().columns(), beside))
                continue;
            rims.sides_.insert(key(from, to));
            const auto at = [&](VertexNumber number) {
                return ground.ecef(ground.surface().vertex(number)).m;
            };
            const glm::dvec3 away = level_away(at(from), at(to), at(triangle[(i + 2) % 3]));
            for (const VertexNumber end : {from, to}) {
                Corner& corner = corners[end];
                if (corner.sides < 2) corner.away[static_cast<std::size_t>(corner.sides)] = away;
                ++corner.sides;
            }
        }
    }
    for (const auto& [number, corner] : corners) {
        if (corner.sides > 2) continue;
        rims.outwards_[number] = corner.sides == 1
                                     ? corner.away[0]
                                     : across_both(corner.away[0], corner.away[1], longest_outwards);
    }
    return rims;
}

}  // namespace oro
