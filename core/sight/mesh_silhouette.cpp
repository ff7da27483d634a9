#include "core/sight/mesh_silhouette.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

namespace oro {
namespace {

constexpr double infinite_m = std::numeric_limits<double>::infinity();

double turns_of(const glm::dvec3& level) {
    return std::atan2(level.x, level.y) / (2.0 * std::numbers::pi);
}

// From the origin to a side, level.
double level_distance_m(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec2 a(from), side = glm::dvec2(to) - a;
    const double length2 = glm::dot(side, side);
    const double share = length2 > 0.0 ? std::clamp(-glm::dot(a, side) / length2, 0.0, 1.0) : 0.0;
    return glm::length(a + share * side);
}

// A triangle as it is seen, along east, north and up at the eye.
struct SeenTriangle {
    std::array<glm::dvec3, 3> at;

    // Whether the eye is over or under it, level.
    [[nodiscard]] bool is_around() const {
        std::array<double, 3> turn{};
        for (std::size_t i = 0; i < 3; ++i) {
            const glm::dvec3 &a = at[i], &b = at[(i + 1) % 3];
            turn[i] = a.x * b.y - a.y * b.x;
        }
        return std::ranges::min(turn) >= 0.0 || std::ranges::max(turn) <= 0.0;
    }
    [[nodiscard]] double nearest_m() const {
        return std::min(
            {level_distance_m(at[0], at[1]), level_distance_m(at[1], at[2]), level_distance_m(at[2], at[0])});
    }
    [[nodiscard]] double highest(double nearest) const {
        const double up_m = std::max({at[0].z, at[1].z, at[2].z});
        const double farthest_m = std::max(
            {std::hypot(at[0].x, at[0].y), std::hypot(at[1].x, at[1].y), std::hypot(at[2].x, at[2].y)});
        constexpr double least_m = 1.0e-6;
        return up_m > 0.0 ? up_m / std::max(nearest, least_m) : up_m / std::max(farthest_m, least_m);
    }
};

}  // namespace

MeshSilhouette::MeshSilhouette(const TrueGround& ground, const Sight& sight)
    : sight_(sight), by_direction_(directions, {infinite_m, -infinite_m}) {
    const Geodetic eye = geodetic_from_ecef(sight.eye);
    enu_from_ecef_ = glm::transpose(ecef_from_enu(eye.lat_deg, eye.lon_deg));
    for (const SurfaceTriangle& piece : ground.pieces()) {
        if (piece.mesh == 0) continue;
        std::array<glm::dvec3, 3> corners_m{};
        for (std::size_t i = 0; i < 3; ++i) corners_m[i] = ecef_from_geodetic(piece.corners[i]).m;
        add(corners_m);
    }
    for (const TrueMesh& mesh : ground.meshes())
        for (std::size_t i = 0; i < mesh.size(); ++i) add(mesh.corners_m(i));
}

void MeshSilhouette::add(const std::array<glm::dvec3, 3>& corners_m) {
    any_ = true;
    SeenTriangle seen;
    for (std::size_t i = 0; i < 3; ++i)
        seen.at[i] = enu_from_ecef_ * sight_.refraction.apparent_m(corners_m[i] - sight_.eye.m);
    const bool around = seen.is_around();
    const double near_m = around ? 0.0 : seen.nearest_m(), high = seen.highest(near_m);
    const double first = turns_of(seen.at[0]);
    double low = 0.0, most = 0.0;
    for (std::size_t i = 1; i < 3; ++i) {
        const double beside = std::remainder(turns_of(seen.at[i]) - first, 1.0);
        low = std::min(low, beside), most = std::max(most, beside);
    }
    const auto count = static_cast<double>(directions);
    const auto begin = static_cast<long long>(std::floor((first + low) * count)) - 1,
               end = around ? begin + static_cast<long long>(directions)
                            : static_cast<long long>(std::floor((first + most) * count)) + 2;
    for (long long i = begin; i < end; ++i) {
        const auto number = static_cast<std::size_t>(
            (i % static_cast<long long>(directions) + static_cast<long long>(directions)) %
            static_cast<long long>(directions));
        Direction& direction = by_direction_[number];
        direction.nearest_m = std::min(direction.nearest_m, near_m);
        direction.highest = std::max(direction.highest, high);
    }
}

bool MeshSilhouette::may_hide(const Geodetic& point) const {
    const glm::dvec3 at =
        enu_from_ecef_ * sight_.refraction.apparent_m(ecef_from_geodetic(point).m - sight_.eye.m);
    const auto count = static_cast<double>(directions);
    const double turns = turns_of(at);
    const auto number = static_cast<std::size_t>((turns - std::floor(turns)) * count) % directions;
    const Direction& direction = by_direction_[number];
    const double far_m = std::hypot(at.x, at.y);
    constexpr double slack_m = 1.0e-3;
    return far_m + slack_m > direction.nearest_m && at.z - slack_m <= direction.highest * far_m;
}

}  // namespace oro
