#include "apps/navigation/home.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "apps/navigation/grab.h"
#include "apps/view/overview.h"
#include "core/earth/place_framing.h"
#include "geo/places/geodesic.h"

namespace oro {
namespace {

double width_of_deg(const BoundingBox& box) {
    const double width_deg = box.east_deg - box.west_deg;
    return width_deg > 0.0 ? width_deg : width_deg + 360.0;
}

bool has_place(const BoundingBox& box, const Geodetic& place) {
    const double half_deg = 0.5 * width_of_deg(box);
    const double from_middle_deg = std::remainder(place.lon_deg - (box.west_deg + half_deg), 360.0);
    return place.lat_deg >= box.south_deg && place.lat_deg <= box.north_deg &&
           std::abs(from_middle_deg) <= half_deg;
}

// Distance to where a ray meets the ellipsoid that is h_m higher than WGS84; nothing where it does not.
std::optional<double> ray_to_ellipsoid_m(const glm::dvec3& eye_m, const glm::dvec3& direction, double h_m) {
    const glm::dvec3 axes(wgs84_a_m + h_m, wgs84_a_m + h_m, wgs84_b_m + h_m);
    const glm::dvec3 from = eye_m / axes, along = direction / axes;
    const double a = glm::dot(along, along), b = glm::dot(from, along), c = glm::dot(from, from) - 1.0;
    const double root = b * b - a * c;
    if (root < 0.0) return std::nullopt;
    const double near_m = (-b - std::sqrt(root)) / a, far_m = (-b + std::sqrt(root)) / a;
    if (near_m > 0.0) return near_m;
    return far_m > 0.0 ? std::optional(far_m) : std::nullopt;
}

// Whether the Earth below all ground stands before a point.
bool is_hidden_by_earth(const glm::dvec3& eye_m, const glm::dvec3& point_m, double low_h_m) {
    const double distance_m = glm::distance(eye_m, point_m);
    constexpr double room_m = 100.0;
    const auto met_m =
        ray_to_ellipsoid_m(eye_m, (point_m - eye_m) / distance_m, std::min(low_h_m, 0.0) - room_m);
    return met_m && *met_m < distance_m;
}

bool shows_place_of(const Camera& camera, const GroundBox& ground) {
    constexpr int steps = 8;
    const glm::dvec3 eye_m = camera.eye_ecef().m;
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; j <= steps; ++j) {
            for (const double h_m : {ground.low_h_m, ground.high_h_m}) {
                const BoundingBox& box = ground.box;
                const Ecef point =
                    ecef_from_geodetic({box.south_deg + (box.north_deg - box.south_deg) * i / steps,
                                        box.west_deg + width_of_deg(box) * j / steps, h_m});
                const auto seen_px = pixel_of(camera, point);
                if (!seen_px || seen_px->x < 0.0 || seen_px->x > camera.width_px || seen_px->y < 0.0 ||
                    seen_px->y > camera.height_px)
                    continue;
                if (!is_hidden_by_earth(eye_m, point.m, ground.low_h_m)) return true;
            }
        }
    }
    return false;
}

bool has_ray_to(const Camera& camera, const GroundBox& ground) {
    constexpr int steps = 32;
    const glm::dvec3 eye_m = camera.eye_ecef().m;
    for (int i = 0; i <= steps; ++i) {
        for (int j = 0; j <= steps; ++j) {
            const glm::dvec3 direction =
                camera.ecef_direction_at({camera.width_px * (static_cast<double>(i) / steps),
                                          camera.height_px * (static_cast<double>(j) / steps)});
            for (const double h_m : {ground.low_h_m, ground.high_h_m}) {
                const auto met_m = ray_to_ellipsoid_m(eye_m, direction, h_m);
                if (met_m && has_place(ground.box, geodetic_from_ecef({eye_m + direction * *met_m})))
                    return true;
            }
        }
    }
    return false;
}

}  // namespace

std::optional<Camera> framed_home(const Camera& camera, const GroundPoints& ground) {
    if (ground.all.empty()) return std::nullopt;
    return camera_on_points(camera, ground.middle, ground.radius_m,
                            {0.0, overview_pitch_deg(ground.radius_m)}, ground.all, overview_margin);
}

std::optional<GroundBox> ground_box(const GroundPoints& ground) {
    if (ground.all.empty()) return std::nullopt;
    GroundBox around;
    double west_deg = 0.0, east_deg = 0.0;  // from the middle
    for (const Ecef& point : ground.all) {
        const Geodetic place = geodetic_from_ecef(point);
        const double turn_deg = std::remainder(place.lon_deg - ground.middle.lon_deg, 360.0);
        const bool is_first = &point == ground.all.data();
        const auto take = [&](double& low, double& high, double value) {
            low = is_first ? value : std::min(low, value);
            high = is_first ? value : std::max(high, value);
        };
        take(around.box.south_deg, around.box.north_deg, place.lat_deg);
        take(west_deg, east_deg, turn_deg);
        take(around.low_h_m, around.high_h_m, place.h_m);
    }
    around.box.west_deg = normalised_lon_deg(ground.middle.lon_deg + west_deg);
    around.box.east_deg = normalised_lon_deg(ground.middle.lon_deg + east_deg);
    return around;
}

std::optional<HomeArrow> home_arrow(const Camera& camera, const GroundBox& ground, double inset_px) {
    if (shows_place_of(camera, ground) || has_ray_to(camera, ground)) return std::nullopt;
    const BoundingBox& box = ground.box;
    const Geodetic middle{0.5 * (box.south_deg + box.north_deg),
                          normalised_lon_deg(box.west_deg + 0.5 * width_of_deg(box)),
                          0.5 * (ground.low_h_m + ground.high_h_m)};
    const glm::dvec3 view = camera.view_from_ecef() * (ecef_from_geodetic(middle).m - camera.eye_ecef().m);
    const double across = std::hypot(view.x, view.y);
    constexpr double straight = 1e-9;
    // Right behind the eye every way there is as long.
    const glm::dvec2 towards =
        across > straight * std::abs(view.z) ? glm::dvec2(view.x, -view.y) / across : glm::dvec2(1.0, 0.0);
    const glm::dvec2 half_px(0.5 * camera.width_px, 0.5 * camera.height_px);
    const glm::dvec2 room_px = glm::max(half_px - inset_px, 0.25 * half_px);
    const double length_px = std::min(room_px.x / std::max(std::abs(towards.x), straight),
                                      room_px.y / std::max(std::abs(towards.y), straight));
    const GeodesicPath path =
        geodesic_between(camera.eye.lat_deg, camera.eye.lon_deg, middle.lat_deg, middle.lon_deg);
    const double clockwise_deg = deg_from_radians(Radians{std::atan2(towards.x, -towards.y)});
    return HomeArrow{half_px + towards * length_px,
                     clockwise_deg < 0.0 ? clockwise_deg + 360.0 : clockwise_deg, path.distance_m,
                     path.bearing_deg};
}

}  // namespace oro
