#include "core/seam/cleared_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

constexpr float far_away = 1.0e9F;
using PlaneCorners = std::array<glm::dvec2, 3>;

// Triangles in the plane, metres east and south of the middle.
std::vector<PlaneCorners> in_plane(const MeshCasters& casters, const ClearedMap& map) {
    std::vector<PlaneCorners> all;
    all.reserve(casters.triangles.size());
    const glm::dvec3 from = casters.origin_m - map.middle_m;
    for (const gpu::MeshTriangle& triangle : casters.triangles) {
        const glm::dvec3 corner = from + glm::dvec3(triangle.corner);
        PlaneCorners& at = all.emplace_back();
        const std::array corners{corner, corner + glm::dvec3(triangle.one),
                                 corner + glm::dvec3(triangle.other)};
        for (std::size_t i = 0; i < 3; ++i)
            at[i] = {glm::dot(corners[i], map.east), glm::dot(corners[i], map.south)};
    }
    return all;
}

// Whether a cell, by its middle and half its edge, and a triangle have a place in common: no line across the
// triangle's sides lies between them. Source: S. Gottschalk et al., OBBTree, SIGGRAPH 1996 (separating axes).
bool touches(const PlaneCorners& at, const glm::dvec2& middle, double half) {
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec2 side = at[(i + 1) % 3] - at[i], across(-side.y, side.x);
        double low = std::numeric_limits<double>::max(), high = -low;
        for (const glm::dvec2& corner : at) {
            low = std::min(low, glm::dot(across, corner - middle));
            high = std::max(high, glm::dot(across, corner - middle));
        }
        const double reach = half * (std::abs(across.x) + std::abs(across.y));
        if (low > reach || high < -reach) return false;
    }
    return true;
}

// Calls visit(cell) for each cell that a triangle touches.
template <class Visit>
void for_touched(const ClearedMap& map, const PlaneCorners& at, const Visit& visit) {
    const glm::dvec2 half = 0.5 * map.cell_m * glm::dvec2(map.side);
    const auto cell_of = [&](const glm::dvec2& place) {
        return glm::clamp(glm::floor((place + half) / map.cell_m), glm::dvec2(0.0),
                          glm::dvec2(map.side) - 1.0);
    };
    const glm::uvec2 first(cell_of(glm::min(at[0], glm::min(at[1], at[2])))),
        last(cell_of(glm::max(at[0], glm::max(at[1], at[2]))));
    for (unsigned row = first.y; row <= last.y; ++row)
        for (unsigned column = first.x; column <= last.x; ++column) {
            const glm::dvec2 middle = (glm::dvec2(column, row) + 0.5) * map.cell_m - half;
            if (touches(at, middle, 0.5 * map.cell_m)) visit(std::size_t{row} * map.side.x + column);
        }
}

// Distances to the nearest cell of 0, in cells: there and back over rows and columns.
// Source: G. Borgefors, Distance transformations in digital images, CVGIP 34, 1986.
void spread(const glm::uvec2& side, std::vector<float>& distances) {
    const auto width = static_cast<std::ptrdiff_t>(side.x), height = static_cast<std::ptrdiff_t>(side.y);
    const float aslant = std::numbers::sqrt2_v<float>;
    const auto take = [&](std::ptrdiff_t row, std::ptrdiff_t column, std::ptrdiff_t back) {
        float& own = distances[static_cast<std::size_t>(row * width + column)];
        const auto from = [&](std::ptrdiff_t rows, std::ptrdiff_t columns, float step) {
            const std::ptrdiff_t y = row + rows, x = column + columns;
            if (y < 0 || y >= height || x < 0 || x >= width) return;
            own = std::min(own, distances[static_cast<std::size_t>(y * width + x)] + step);
        };
        from(0, back, 1.0F);
        from(back, 0, 1.0F);
        from(back, -1, aslant);
        from(back, 1, aslant);
    };
    for (std::ptrdiff_t row = 0; row < height; ++row)
        for (std::ptrdiff_t column = 0; column < width; ++column) take(row, column, -1);
    for (std::ptrdiff_t row = height; row-- > 0;)
        for (std::ptrdiff_t column = width; column-- > 0;) take(row, column, 1);
}

std::uint32_t nearness(float distance_m) {
    const float share = 1.0F - distance_m / gpu::cleared_reach_m;
    return share <= 0.0F ? 0U : static_cast<std::uint32_t>(std::lround(255.0F * share));
}

}  // namespace

ClearedMap cleared_map_of(const MeshCasters& casters) {
    ClearedMap map;
    if (casters.nodes.empty()) return map;
    const Geodetic middle = geodetic_from_ecef(Ecef{casters.origin_m});
    const glm::dmat3 axes = ecef_from_enu(middle.lat_deg, middle.lon_deg);
    map.east = axes[0], map.south = -axes[1], map.middle_m = casters.origin_m;
    std::vector<PlaneCorners> triangles = in_plane(casters, map);
    glm::dvec2 low(std::numeric_limits<double>::max()), high(-low);
    for (const PlaneCorners& at : triangles)
        for (const glm::dvec2& corner : at) low = glm::min(low, corner), high = glm::max(high, corner);
    const glm::dvec2 centre = 0.5 * (low + high);
    map.middle_m += centre.x * map.east + centre.y * map.south;
    for (PlaneCorners& at : triangles)
        for (glm::dvec2& corner : at) corner -= centre;
    constexpr double least_cell_m = 4.0, most_cells = 1024.0;
    const glm::dvec2 size_m = high - low + 2.0 * static_cast<double>(gpu::cleared_reach_m);
    map.cell_m = std::max(least_cell_m, std::max(size_m.x, size_m.y) / most_cells);
    map.side = glm::uvec2(glm::ceil(size_m / map.cell_m));
    const std::size_t count = std::size_t{map.side.x} * map.side.y;
    std::vector<float> any(count, far_away), built(count, far_away);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const bool is_built = casters.looks[i] == gpu::mesh_look_built;
        for_touched(map, triangles[i], [&](std::size_t cell) {
            any[cell] = 0.0F;
            if (is_built) built[cell] = 0.0F;
        });
    }
    spread(map.side, any);
    spread(map.side, built);
    const auto cell_m = static_cast<float>(map.cell_m);
    map.cells.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
        map.cells.push_back(nearness(any[i] * cell_m) | nearness(built[i] * cell_m) << 8U);
    return map;
}

gpu::ClearedGround cleared_in_view(const ClearedMap& map, const Camera& camera) {
    gpu::ClearedGround ground{};
    ground.side = map.side;
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const glm::dvec3 eye = camera.eye_ecef().m - map.middle_m;
    ground.eye = gpu::vec2(glm::dvec2(glm::dot(eye, map.east), glm::dot(eye, map.south)) / map.cell_m +
                           0.5 * glm::dvec2(map.side));
    ground.along_x = gpu::vec3(view_from_ecef * map.east / map.cell_m);
    ground.along_y = gpu::vec3(view_from_ecef * map.south / map.cell_m);
    return ground;
}

}  // namespace oro
