#include "core/cluster_frame/group_rule.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "core/lod/levels.h"

namespace oro::gpu {
namespace {
using std::min;
#define ORO_FUNCTION
#define ORO_PRECISE
#include "shaders/clusters/group_rule.glsl"
#undef ORO_FUNCTION
#undef ORO_PRECISE
}  // namespace
}  // namespace oro::gpu

namespace oro {
namespace {

constexpr std::uint32_t last_cut_level = gpu::no_cut_level - 1;

// One over the largest power of two that is at most a length of 1 to 2^1000: what std::ldexp() by its negated
// std::ilogb() multiplies by.
double one_over_power_below(double length_m) {
    constexpr std::uint64_t exponent_bits = 0x7ffULL << 52U, twice_the_bias = 2046ULL << 52U;
    return std::bit_cast<double>(twice_the_bias - (std::bit_cast<std::uint64_t>(length_m) & exponent_bits));
}

}  // namespace

GroupRule::GroupRule(const Camera& camera, double tau_px, const Air& air, std::optional<std::uint32_t> level)
    : tau_px_(tau_px),
      curvature_per_m_(Refraction(camera.eye, air).curvature_per_m()),
      view_from_ecef_(camera.view_from_ecef()),
      eye_(camera.eye_ecef()),
      up_view_(view_from_ecef_ * ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg)[2]) {
    const LevelView view = level_view(camera, tau_px);
    const auto corner_tangent = static_cast<double>(view.corner_tangent);
    rule_ = {view.pixels_per_tangent, view.corner_tangent,
             static_cast<float>(std::sqrt(1.0 + corner_tangent * corner_tangent)), static_cast<float>(tau_px),
             level ? std::min(*level, last_cut_level) : gpu::no_cut_level};
}

GroupRule::SeenSphere GroupRule::seen(const Ecef& centre, double radius_m) const {
    SeenSphere sphere{view_from_ecef_ * (centre.m - eye_.m), radius_m, 1.0};
    const double c = curvature_per_m_;
    if (c == 0.0) return sphere;
    // The lift c a^2 / 2 of two points whose distances across the vertical, a, differ by at most r differs by
    // at most c r (a + r / 2).
    const double a = glm::length(sphere.centre_m - glm::dot(sphere.centre_m, up_view_) * up_view_);
    sphere.centre_m += 0.5 * c * a * a * up_view_;
    sphere.radius_m = radius_m + std::abs(c) * radius_m * (a + 0.5 * radius_m);
    sphere.stretch = 1.0 + std::abs(c) * (a + radius_m);
    return sphere;
}

double GroupRule::error_px(const ClusterGroup& group) const {
    if (group.error_m <= 0.0) return 0.0;
    const SeenSphere sphere = seen(group.centre, group.radius_m);
    const double e = group.error_m * sphere.stretch;
    const auto pixels_per_tangent = static_cast<double>(rule_.pixels_per_tangent);
    const auto corner_tangent = static_cast<double>(rule_.corner_tangent);
    const double across_m =
        std::sqrt(sphere.centre_m.x * sphere.centre_m.x + sphere.centre_m.y * sphere.centre_m.y);
    const double stretch = std::sqrt(1.0 + corner_tangent * corner_tangent);
    double px = std::numeric_limits<double>::infinity();
    const double z_min_m = -sphere.centre_m.z - sphere.radius_m;
    if (z_min_m > e) {
        const double t = std::min((across_m + sphere.radius_m) / z_min_m, corner_tangent);
        px = pixels_per_tangent * e * std::sqrt(1.0 + t * t) / (z_min_m - e);
    }
    const double d_min_m = glm::length(sphere.centre_m) - sphere.radius_m;
    if (d_min_m > e * stretch)
        px = std::min(px, pixels_per_tangent * e * stretch * stretch / (d_min_m - e * stretch));
    return px;
}

GroupRule GroupRule::coarser(unsigned steps) const {
    GroupRule other = *this;
    if (steps >= most_coarser_steps) {
        other.rule_.level = last_cut_level;
    } else if (rule_.level != gpu::no_cut_level) {
        other.rule_.level = std::min(rule_.level, last_cut_level - steps) + steps;
    } else if (steps > 0) {
        other.tau_px_ = std::max(tau_px_, 1.0 / 16.0) * std::pow(2.0, 0.5 * steps);
        other.rule_.tau_px = static_cast<float>(other.tau_px_);
    }
    return other;
}

// Spheres grow by more than the rule rounds from a level to the next.
gpu::AskedGroup GroupRule::measured(const ClusterGroup& group) const {
    const SeenSphere sphere = seen(group.centre, group.radius_m);
    const double radius_m = sphere.radius_m * (1.0 + 1.0e-6 * (group.level + 1.0));
    const double across_m =
        std::sqrt(sphere.centre_m.x * sphere.centre_m.x + sphere.centre_m.y * sphere.centre_m.y);
    const double distance_m = glm::length(sphere.centre_m);
    const double scale = one_over_power_below(std::min(std::max({distance_m, radius_m, 1.0}), 0x1p1000));
    const auto scaled = [scale](double length_m) { return static_cast<float>(length_m * scale); };
    return {scaled(distance_m),
            scaled(-sphere.centre_m.z),
            scaled(across_m),
            scaled(radius_m),
            scaled(group.error_m * sphere.stretch),
            group.level};
}

bool stands(const gpu::AskedGroup& group, const gpu::CutRule& rule) {
    return gpu::group_stands(group, rule);
}

bool GroupRule::stands(const ClusterGroup& group) const {
    return oro::stands(measured(group), cut_rule());
}

}  // namespace oro
