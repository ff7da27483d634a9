#include "apps/styles/contour_interval.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/terrain/post_spacing.h"

namespace oro {
namespace {

constexpr int across = 25, down = 16;  // sight lines
constexpr double wanted_px = 11.0;     // 5 to 40 is wanted, and steep ground has half of the middle
constexpr double least_px = 5.5;
constexpr double wanted_lines = 5.0;  // from the low ground to the high, where there is room for them
constexpr double highest_m = 9000.0;  // no ground above it
constexpr double otherwise_m = 100.0;

// Follows a sight line to the first ground that its steps meet.
std::optional<Geodetic> ground_seen(const HeightField& field, double exaggeration, const Ecef& eye,
                                    const glm::dvec3& direction) {
    constexpr int steps = 600;
    double along_m = 0.5, last_h_m = 1e300;
    for (int i = 0; i < steps; ++i) {
        const Geodetic at = geodetic_from_ecef({eye.m + along_m * direction});
        const auto H_m = field.surface_H_m(at.lat_deg, at.lon_deg);
        const double over_m =
            H_m ? at.h_m - (*H_m * exaggeration + field.undulation.at_m(at.lat_deg, at.lon_deg)) : at.h_m;
        if (H_m && over_m <= 0.0) return at;
        if (at.h_m > highest_m * exaggeration && at.h_m > last_h_m) return std::nullopt;
        if (!H_m && at.h_m < -1000.0) return std::nullopt;
        last_h_m = at.h_m;
        const double above_all_m = at.h_m - highest_m * exaggeration;
        along_m += std::max({0.5 * over_m, above_all_m, 0.003 * along_m, 0.5});
    }
    return std::nullopt;
}

// How fast H changes on the picture at a place, metres per pixel; 0 on level ground.
std::optional<double> H_per_px(const HeightField& field, double exaggeration, const Geodetic& place,
                               const glm::dvec3& from_eye, double px_rad) {
    PostSpacing post = post_spacing(field.grid, place.lat_deg);
    double row_deg = field.grid.lat.spacing_deg(), column_deg = field.grid.lon.spacing_deg();
    if (field.grid.net) {
        post.row_m = post.column_m = field.grid.net->row_m();
        row_deg = deg_from_radians(Radians(post.row_m / meridian_radius_m(place.lat_deg)));
        column_deg = deg_from_radians(Radians(
            post.row_m / (prime_vertical_radius_m(place.lat_deg) * sine_cosine_deg(place.lat_deg).cosine)));
    }
    const auto north = field.surface_H_m(place.lat_deg + row_deg, place.lon_deg),
               south = field.surface_H_m(place.lat_deg - row_deg, place.lon_deg),
               east = field.surface_H_m(place.lat_deg, place.lon_deg + column_deg),
               west = field.surface_H_m(place.lat_deg, place.lon_deg - column_deg);
    if (!north || !south || !east || !west) return std::nullopt;
    const glm::dvec3 normal =
        glm::normalize(glm::dvec3(-exaggeration * (*east - *west) / (2.0 * post.column_m),
                                  -exaggeration * (*north - *south) / (2.0 * post.row_m), 1.0));
    const glm::dvec3 ray =
        glm::normalize(glm::transpose(ecef_from_enu(place.lat_deg, place.lon_deg)) * from_eye);
    const double facing = glm::dot(normal, ray);
    if (facing > -0.02) return std::nullopt;
    const double px_m = px_rad * glm::length(from_eye);
    const glm::dvec3 side = std::abs(ray.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(ray, side)), up = glm::cross(right, ray);
    const auto rise = [&](const glm::dvec3& step) {  // of the ground, from one sight line to the next
        return (px_m * step - ray * (glm::dot(normal, px_m * step) / facing)).z / exaggeration;
    };
    return std::hypot(rise(right), rise(up));
}

// The nearest to what is wanted of those that are at least so large; 5,000 where none is.
double round_interval_m(double wanted_m, double least_m) {
    double best_m = 5000.0;
    for (const double power : {1.0, 10.0, 100.0, 1000.0}) {
        for (const double step : {1.0, 2.0, 5.0}) {
            const double off = std::abs(std::log(step * power / wanted_m));
            if (step * power >= least_m && off < std::abs(std::log(best_m / wanted_m))) best_m = step * power;
        }
    }
    return best_m;
}

// The value that so large a share of them is below.
double quantile(std::vector<double> values, double share) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
}

}  // namespace

double contour_interval_m(const Camera& camera, double exaggeration, const HeightField& field) {
    const Ecef eye = camera.eye_ecef();
    const double px_rad = 2.0 * camera.half_fov_tangent().y / camera.height_px;
    std::vector<double> rises_m, heights_m;
    for (int y = 0; y < down; ++y) {
        for (int x = 0; x < across; ++x) {
            const glm::dvec2 at((x + 0.5) * camera.width_px / across, (y + 0.5) * camera.height_px / down);
            const auto ground = ground_seen(field, exaggeration, eye, camera.ecef_direction_at(at));
            if (!ground) continue;
            const auto rise_m =
                H_per_px(field, exaggeration, *ground, ecef_from_geodetic(*ground).m - eye.m, px_rad);
            if (!rise_m || *rise_m <= 0.0) continue;
            rises_m.push_back(*rise_m);
            heights_m.push_back(*field.surface_H_m(ground->lat_deg, ground->lon_deg));
        }
    }
    if (rises_m.empty()) return otherwise_m;
    const double rise_m = quantile(rises_m, 0.5);
    const double relief_m = quantile(heights_m, 0.95) - quantile(heights_m, 0.05);
    return round_interval_m(std::min(wanted_px * rise_m, relief_m / wanted_lines), least_px * rise_m);
}

double steady_interval_m(double shown_m, double wanted_m) {
    constexpr double one_step = 2.6;  // at most 2.5 lies between two of them
    const double off = shown_m > 0.0 ? std::max(wanted_m / shown_m, shown_m / wanted_m) : one_step + 1.0;
    return off <= one_step ? shown_m : wanted_m;
}

}  // namespace oro
