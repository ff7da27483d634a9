#include "core/growth/meadow_blades.h"

#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shaders/shared_meadow.h"

namespace oro::gpu {
namespace {
using glm::clamp;
using glm::cross;
using glm::dot;
using glm::mix;
using glm::normalize;
using std::abs;
using std::cos;
using std::floor;
using std::sin;
using std::sqrt;
#define ORO_FUNCTION [[maybe_unused]]
// In the order in which they need each other.
// clang-format off
#include "shaders/growth/tree_rule.glsl"
#include "shaders/growth/meadow_reach.glsl"
#include "shaders/growth/blade_rule.glsl"
#include "shaders/growth/light_of_blade.glsl"
// clang-format on
#undef ORO_FUNCTION
}  // namespace
}  // namespace oro::gpu

namespace oro {

namespace {

gpu::MeadowBlade blade_of(const MeadowStand& stand, std::uint32_t number, double grown) {
    return gpu::blade_of_clump(gpu::site_hash(stand.row, stand.column), number,
                               static_cast<float>(stand.size), gpu::vec2(stand.slope), gpu::vec2(stand.wind),
                               static_cast<float>(grown));
}

}  // namespace

MeadowCurve meadow_curve(const MeadowStand& stand, std::uint32_t number, double grown) {
    const gpu::MeadowBlade blade = blade_of(stand, number, grown);
    return {{glm::dvec3(blade.foot), glm::dvec3(blade.middle), glm::dvec3(blade.tip)},
            glm::dvec2(blade.side)};
}

glm::dvec3 meadow_light(const MeadowStand& stand, std::uint32_t number, double along, double pixel_m,
                        const glm::dvec3& sun, const glm::dvec3& to_eye) {
    const gpu::MeadowBlade blade = blade_of(stand, number, 1.0);
    const gpu::vec3 ground = gpu::normalize(
        gpu::vec3(-static_cast<float>(stand.slope.x), -static_cast<float>(stand.slope.y), 1.0F));
    const gpu::vec3 seen_from(to_eye);
    return glm::dvec3(
        gpu::light_of_blade(blade, static_cast<float>(along), gpu::vec3(sun), seen_from) /
        (gpu::meadow_seen(gpu::dot(ground, seen_from)) * gpu::widened_light(static_cast<float>(pixel_m))));
}

double meadow_floor_light(double distance_m, double sine) {
    return static_cast<double>(
        gpu::meadow_floor_at(static_cast<float>(distance_m), static_cast<float>(sine)));
}

double meadow_blades_kept(double pixel_m) {
    return static_cast<double>(gpu::blades_kept(static_cast<float>(pixel_m)));
}

double meadow_grown(double kept, std::uint32_t number) {
    return static_cast<double>(gpu::blade_grown(static_cast<float>(kept), static_cast<float>(number)));
}

double meadow_share_at(double distance_m) {
    return static_cast<double>(gpu::meadow_at(static_cast<float>(distance_m)));
}

double meadow_blade_width_m() {
    return static_cast<double>(gpu::blade_width_m);
}

double meadow_taper(double along) {
    return static_cast<double>(gpu::blade_taper(static_cast<float>(along)));
}

double meadow_reach_m(double size) {
    return static_cast<double>(gpu::clump_reach_m(static_cast<float>(size)));
}

double meadow_height_m(double size) {
    return static_cast<double>(gpu::clump_height_m(static_cast<float>(size)));
}

double meadow_size_most() {
    return static_cast<double>(gpu::clump_size_most);
}

glm::dvec2 meadow_wind(std::uint32_t row, std::uint32_t column, double strength, double time_s) {
    return glm::dvec2(gpu::wind_on_clump(gpu::site_hash(row, column), row / gpu::clumps_per_side,
                                         column / gpu::clumps_per_side, gpu::vec2(0.5F, 0.5F),
                                         static_cast<float>(strength), static_cast<float>(time_s)));
}

}  // namespace oro
