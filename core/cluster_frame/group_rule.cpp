#include "core/cluster_frame/group_rule.h"

#include <algorithm>
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

GroupRule::GroupRule(const Camera& camera, double tau_px, const Air& air, std::optional<std::uint32_t> level)
    : level_(level),
      curvature_per_m_(Refraction(camera.eye, air).curvature_per_m()),
      view_from_ecef_(camera.view_from_ecef()),
      eye_(camera.eye_ecef()),
      up_view_(view_from_ecef_ * ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg)[2]) {
    const LevelView view = level_view(camera, tau_px);
    pixels_per_tangent_ = static_cast<double>(view.pixels_per_tangent);
    corner_tangent_ = static_cast<double>(view.corner_tangent);
    tau_px_ = tau_px;
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
    const double across_m =
        std::sqrt(sphere.centre_m.x * sphere.centre_m.x + sphere.centre_m.y * sphere.centre_m.y);
    const double stretch = std::sqrt(1.0 + corner_tangent_ * corner_tangent_);
    double px = std::numeric_limits<double>::infinity();
    const double z_min_m = -sphere.centre_m.z - sphere.radius_m;
    if (z_min_m > e) {
        const double t = std::min((across_m + sphere.radius_m) / z_min_m, corner_tangent_);
        px = pixels_per_tangent_ * e * std::sqrt(1.0 + t * t) / (z_min_m - e);
    }
    const double d_min_m = glm::length(sphere.centre_m) - sphere.radius_m;
    if (d_min_m > e * stretch)
        px = std::min(px, pixels_per_tangent_ * e * stretch * stretch / (d_min_m - e * stretch));
    return px;
}

GroupRule GroupRule::coarser(unsigned steps) const {
    GroupRule other = *this;
    if (steps >= most_coarser_steps) {
        other.level_ = std::numeric_limits<std::uint32_t>::max();
    } else if (level_) {
        other.level_ = std::min(*level_, std::numeric_limits<std::uint32_t>::max() - steps) + steps;
    } else if (steps > 0) {
        other.tau_px_ = std::max(tau_px_, 1.0 / 16.0) * std::pow(2.0, 0.5 * steps);
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
    const double largest_m = std::max({distance_m, radius_m, 1.0});
    const auto scaled = [down = -std::ilogb(largest_m)](double length_m) {
        return static_cast<float>(std::ldexp(length_m, down));
    };
    return {scaled(distance_m),
            scaled(-sphere.centre_m.z),
            scaled(across_m),
            scaled(radius_m),
            scaled(group.error_m * sphere.stretch),
            group.level};
}

gpu::CutRule GroupRule::cut_rule() const {
    const double stretch = std::sqrt(1.0 + corner_tangent_ * corner_tangent_);
    return {static_cast<float>(pixels_per_tangent_), static_cast<float>(corner_tangent_),
            static_cast<float>(stretch), static_cast<float>(tau_px_),
            level_ ? std::min(*level_, gpu::no_cut_level - 1) : gpu::no_cut_level};
}

bool stands(const gpu::AskedGroup& group, const gpu::CutRule& rule) {
    return gpu::group_stands(group, rule);
}

bool GroupRule::stands(const ClusterGroup& group) const {
    return oro::stands(measured(group), cut_rule());
}

}  // namespace oro
