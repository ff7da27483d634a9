// A crown and what of it a ray meets, in double: shaders/growth/growth.glsl and crown.glsl written a second time,
// for tests that ask each crown for each pixel.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "tests/support/drawn/lattice_sites.h"

namespace oro::test {

struct ReferenceCrown {
    std::uint32_t row{}, column{};  // of its site in the whole lattice
    bool is_needle{};
    bool is_doubtful{};  // its size is on the edge of two
    std::uint32_t hash{};
    glm::dvec3 foot;
    glm::dmat3 axes;  // columns: east, north, along the stem
    double low_m{}, high_m{}, radius_m{}, shell{};
    double pixel_m{};   // that a pixel covers at its foot
    glm::dvec3 middle;  // all of it is no farther from there
    double ball_m{};
};

// What stands there: shaders/shared_growth.h.
struct StandingTree {
    std::uint32_t hash{};
    bool is_needle{}, is_alone{};
    double size{};  // of a grown one's height
};
// up, pole: of the foot, and the Earth's, unit vectors in view coordinates.
inline ReferenceCrown reference_crown(const StandingTree& standing, const glm::dvec3& foot,
                                      const glm::dvec3& up, const glm::dvec3& pole, double pixel_m,
                                      double exaggeration) {
    namespace rule = gpu::site_rule;
    const rule::Tree tree =
        rule::tree_of_site(standing.hash, standing.is_needle ? gpu::site_needle : gpu::site_broad,
                           static_cast<float>(standing.size));
    ReferenceCrown crown;
    crown.hash = standing.hash;
    crown.is_needle = standing.is_needle;
    crown.foot = foot;
    glm::dvec3 east = glm::normalize(glm::cross(pole, up));
    const glm::dvec3 north = glm::cross(up, east),
                     along = glm::normalize(up + static_cast<double>(tree.lean.x) * east +
                                            static_cast<double>(tree.lean.y) * north);
    east = glm::normalize(east - glm::dot(east, along) * along);
    crown.axes = glm::dmat3(east, glm::cross(along, east), along);
    crown.pixel_m = pixel_m;
    crown.low_m = (standing.is_alone ? 0.4 : 1.0) * static_cast<double>(tree.crown_m) * exaggeration;
    crown.high_m = static_cast<double>(tree.height_m) * exaggeration;
    crown.shell = 1.0 + 0.25 * std::clamp(1.6 - 11.0 * pixel_m, 0.0, 1.0);
    crown.radius_m = (standing.is_alone ? 1.25 : 1.0) * static_cast<double>(tree.radius_m) * crown.shell;
    if (!standing.is_needle) {
        const double beyond_m = 0.5 * (crown.shell - 1.0) * (crown.high_m - crown.low_m);
        crown.high_m += beyond_m;
        crown.low_m = std::max(crown.low_m - beyond_m, 0.0);
    }
    crown.middle = foot + 0.5 * crown.high_m * along;
    crown.ball_m = std::hypot(0.5 * crown.high_m, crown.radius_m);
    return crown;
}

namespace crown_parts {

constexpr double nothing = std::numeric_limits<double>::infinity();

inline double leaf_at_corner(std::uint32_t h) {
    h ^= h >> 15U;
    h *= 0x846ca68bU;
    h ^= h >> 16U;
    return static_cast<double>(h >> 8U) / 16777216.0;
}
inline double leaf_noise(const glm::dvec3& at, std::uint32_t seed) {
    const glm::dvec3 cell = glm::floor(at), part = at - cell, on = part * part * (3.0 - 2.0 * part);
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        std::uint32_t h = seed;
        double share = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            constexpr std::uint32_t steps[3]{0x9e3779b1U, 0x85ebca77U, 0xc2b2ae3dU};
            const int high = corner >> axis & 1;
            h += static_cast<std::uint32_t>(static_cast<std::int32_t>(cell[axis]) + high) * steps[axis];
            share *= high != 0 ? on[axis] : 1.0 - on[axis];
        }
        sum += share * leaf_at_corner(h);
    }
    return sum;
}

inline double enters_cone(const ReferenceCrown& crown, double radius_m, const glm::dvec3& p,
                          const glm::dvec3& d) {
    const double k = radius_m / (crown.high_m - crown.low_m), kk = k * k, down = crown.high_m - p.z;
    const double a = d.x * d.x + d.y * d.y - kk * d.z * d.z, b = p.x * d.x + p.y * d.y + kk * down * d.z,
                 c = p.x * p.x + p.y * p.y - kk * down * down, square = b * b - a * c;
    double best = nothing;
    if (square > 0.0 && std::abs(a) > 1.0e-9) {
        for (const double root : {-std::sqrt(square), std::sqrt(square)}) {
            const double s = (-b + root) / a, z = p.z + s * d.z;
            if (z >= crown.low_m && z <= crown.high_m) best = std::min(best, s);
        }
    }
    if (d.z > 0.0) {
        const double s = (crown.low_m - p.z) / d.z;
        if (std::hypot(p.x + s * d.x, p.y + s * d.y) <= radius_m) best = std::min(best, s);
    }
    return best;
}
inline double enters_ellipsoid(const ReferenceCrown& crown, const glm::dvec3& p, const glm::dvec3& d) {
    const glm::dvec3 scale =
        1.0 / glm::dvec3(crown.radius_m, crown.radius_m, 0.5 * (crown.high_m - crown.low_m));
    const glm::dvec3 from = (p - glm::dvec3(0.0, 0.0, 0.5 * (crown.low_m + crown.high_m))) * scale,
                     along = d * scale;
    const double a = glm::dot(along, along), b = glm::dot(from, along),
                 square = b * b - a * (glm::dot(from, from) - 1.0);
    return square > 0.0 ? (-b - std::sqrt(square)) / a : nothing;
}
inline double enters_stem(const ReferenceCrown& crown, const glm::dvec3& p, const glm::dvec3& d) {
    const double radius_m = 0.011 * crown.high_m, high_m = crown.low_m + 0.3 * (crown.high_m - crown.low_m);
    const double a = d.x * d.x + d.y * d.y, b = p.x * d.x + p.y * d.y,
                 c = p.x * p.x + p.y * p.y - radius_m * radius_m, square = b * b - a * c;
    if (square <= 0.0 || a <= 0.0) return nothing;
    const double s = (-b - std::sqrt(square)) / a, z = p.z + s * d.z;
    return z >= 0.0 && z <= high_m ? s : nothing;
}

inline double out_in_crown(const ReferenceCrown& crown, const glm::dvec3& at) {
    const double length_m = crown.high_m - crown.low_m;
    if (crown.is_needle)
        return crown.shell * std::hypot(at.x, at.y) /
               std::max(crown.radius_m * (crown.high_m - at.z) / length_m, 0.05);
    return crown.shell * glm::length((at - glm::dvec3(0.0, 0.0, 0.5 * (crown.low_m + crown.high_m))) /
                                     glm::dvec3(crown.radius_m, crown.radius_m, 0.5 * length_m));
}

// Of a place in a crown whose bunches of leaves are larger than pixels by a share; negative among leaves.
inline double outside_leaves(const ReferenceCrown& crown, glm::dvec3 at, double detail,
                             const glm::dvec2& leaves) {
    const double out_share = out_in_crown(crown, at), length_m = crown.high_m - crown.low_m;
    if (crown.is_needle && crown.shell > 1.0 && at.z > crown.low_m + 0.97 * length_m)
        return std::max(out_share, 0.5);
    at *= std::clamp(7.0 / length_m, 1.0, 3.0);
    double reach = 0.0;
    if (crown.is_needle) {
        const glm::dvec3 branch(1.1 * at.x, 1.1 * at.y, (at.z + 0.6 * std::hypot(at.x, at.y)) * 1.7);
        reach = 0.42 + 0.75 * leaf_noise(branch, crown.hash) +
                0.3 * leaf_noise(branch * 3.3, crown.hash + 1U) - 0.1;
    } else {
        reach = 0.4 + 0.78 * leaf_noise(at * 0.62, crown.hash) +
                0.36 * leaf_noise(at * 1.9, crown.hash + 1U) - 0.1;
    }
    if (leaves.x > 0.0) reach += leaves.x * 0.42 * (leaf_noise(at * 6.7, crown.hash + 2U) - 0.5);
    if (leaves.y > 0.0) reach += leaves.y * 0.3 * (leaf_noise(at * 19.0, crown.hash + 3U) - 0.5);
    return out_share - (0.9 + detail * (reach - 0.9));
}

// Steps along a ray until it is among leaves; where they ended.
struct LeafSteps {
    double hit{nothing}, last{}, least_outside{nothing};  // of 0, from either side
    int count{};
};
// From where the ray enters the crown, at s.
inline LeafSteps meets_leaves(const ReferenceCrown& crown, const glm::dvec3& p, const glm::dvec3& d, double s,
                              double detail) {
    const glm::dvec2 leaves(std::clamp(1.4 - 18.0 * crown.pixel_m, 0.0, 1.0),
                            std::clamp(1.5 - 60.0 * crown.pixel_m, 0.0, 1.0));
    const bool is_near = crown.shell > 1.0;
    const double step = 0.5 * crown.radius_m / glm::length(d);
    double before = 1.0, last = s;
    LeafSteps steps;
    for (; steps.count < (is_near ? 22 : 16); ++steps.count) {
        const glm::dvec3 at = p + s * d;
        const double outside = outside_leaves(crown, at, detail, leaves);
        steps.least_outside = std::min(steps.least_outside, std::abs(outside));
        if (outside < 0.0) {
            steps.hit = last + (s - last) * std::clamp(before / std::max(before - outside, 1.0e-6), 0.0, 1.0);
            break;
        }
        if (steps.count > 0 &&
            (out_in_crown(crown, at) > 1.001 * crown.shell || at.z < crown.low_m || at.z > crown.high_m))
            break;
        before = outside;
        last = s;
        const double tip = crown.is_needle && is_near
                               ? std::clamp((crown.high_m - at.z) / (crown.high_m - crown.low_m), 0.04, 1.0)
                               : 1.0;
        s += step * std::clamp(outside, 0.12, 0.5) * tip;
    }
    steps.last = s;
    return steps;
}

}  // namespace crown_parts

// The depth at which a ray from the eye, of depth 1, meets a crown, metres; infinity: it does not.
struct CrownMet {
    double depth_m;
    // The ray's steps do not come to the same end when they begin a little farther on: what is rounded
    // decides it, from that depth on. Infinity: they do.
    double doubtful_from_m{std::numeric_limits<double>::infinity()};
};
inline CrownMet meets_crown(const ReferenceCrown& crown, const glm::dvec3& ray, bool asks_doubt) {
    using namespace crown_parts;
    constexpr double least_m = 0.3, rounded_m = 0.001;
    const double begin = glm::dot(crown.middle, ray) / glm::dot(ray, ray);
    const glm::dvec3 p = (ray * begin - crown.foot) * crown.axes, d = ray * crown.axes;
    const double detail = std::clamp(1.5 - 1.15 * crown.pixel_m, 0.0, 1.0);
    double best = crown.is_needle ? enters_cone(crown, (detail > 0.0 ? 1.0 : 0.9) * crown.radius_m, p, d)
                                  : enters_ellipsoid(crown, p, d);
    CrownMet met{nothing};
    if (detail > 0.0 && best < nothing) {
        const double from = std::max(best, least_m - begin);
        const LeafSteps steps = meets_leaves(crown, p, d, from, detail);
        best = steps.hit;
        if (asks_doubt) {
            constexpr double near_m = 0.02;
            bool alike = steps.least_outside > 0.01;
            for (const double more_m : {1.0e-4, -1.0e-4, 3.0e-5}) {
                const LeafSteps other = meets_leaves(crown, p, d, from + more_m, detail);
                alike = alike && steps.count == other.count && std::abs(steps.last - other.last) < near_m &&
                        (steps.hit == nothing) == (other.hit == nothing) &&
                        !(std::abs(steps.hit - other.hit) > near_m);
            }
            if (!alike) met.doubtful_from_m = begin + from;
        }
    }
    if (crown.pixel_m < 0.25) best = std::min(best, enters_stem(crown, p, d));
    met.depth_m = begin + best >= least_m - rounded_m ? begin + best : nothing;
    return met;
}

}  // namespace oro::test
