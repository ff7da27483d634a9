// A world of smooth hills by a formula, and random eyes over it: for tests of how the eye moves.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "apps/navigation/flight_step.h"

namespace oro::test {

// Hills of 400 m, 12 km across, all over the Earth: h between 100 and 900 m, slopes below 0.3.
inline std::optional<double> hill_h_m(double lat_deg, double lon_deg) {
    const glm::dvec3 up = ecef_from_enu(lat_deg, lon_deg)[2];
    return 500.0 +
           400.0 * std::sin(3000.0 * up.x) * std::sin(3100.0 * up.y + 1.0) * std::sin(2900.0 * up.z + 2.0);
}

// What a ray of a picture meets: by steps that no slope of these hills lets pass through one.
inline std::optional<Ecef> hill_at(const Camera& camera, glm::dvec2 point_px) {
    const glm::dvec3 eye_m = camera.eye_ecef().m, direction = camera.ecef_direction_at(point_px);
    const auto above_m = [&](double t_m) {
        const Geodetic at = geodetic_from_ecef({eye_m + t_m * direction});
        return at.h_m - *hill_h_m(at.lat_deg, at.lon_deg);
    };
    double near_m = 0.0, far_m = 0.0;
    for (int i = 0; i < 20000; ++i) {
        const double over_m = above_m(far_m);
        if (over_m < 0.0) break;
        near_m = far_m;
        far_m += std::max(0.05, 0.5 * over_m);
        if (far_m > 1e8) return std::nullopt;
    }
    if (above_m(far_m) >= 0.0) return std::nullopt;
    for (int i = 0; i < 80; ++i) {
        const double middle_m = 0.5 * (near_m + far_m);
        (above_m(middle_m) < 0.0 ? far_m : near_m) = middle_m;
    }
    return Ecef{eye_m + far_m * direction};
}

// Eyes from 5 m to 20,000 km over the hills; poles, the antimeridian and the equator among them.
class RandomEyes {
  public:
    explicit RandomEyes(unsigned seed) : random_(seed) {}

    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    glm::dvec2 pixel(const Camera& camera) {
        return {between(0.0, camera.width_px), between(0.0, camera.height_px)};
    }
    Camera camera() {
        constexpr std::array<double, 6> lats_deg{90.0, -90.0, 89.9999, -89.99, 0.0, 46.5};
        constexpr std::array<double, 5> lons_deg{180.0, -179.99999, 0.0, 90.0, 8.0};
        Camera camera;
        camera.width_px = 960, camera.height_px = 600;
        camera.vertical_fov_deg = between(20.0, 60.0);
        const auto choice = static_cast<std::size_t>(between(0.0, 11.99));
        camera.eye.lat_deg = choice < lats_deg.size() ? lats_deg.at(choice) : between(-90.0, 90.0);
        const auto lon = static_cast<std::size_t>(between(0.0, 9.99));
        camera.eye.lon_deg = lon < lons_deg.size() ? lons_deg.at(lon) : between(-180.0, 180.0);
        camera.eye.h_m = *hill_h_m(camera.eye.lat_deg, camera.eye.lon_deg) +
                         std::exp(between(std::log(5.0), std::log(2e7)));
        camera.attitude = {between(0.0, 360.0), between(0.0, 1.0) < 0.15 ? -90.0 : between(-90.0, 5.0), 0.0};
        return camera;
    }

  private:
    std::mt19937 random_;
};

// Where a point is in a picture, by the camera's axes.
inline glm::dvec2 shown_px(const Camera& camera, const Ecef& point) {
    const glm::dvec3 view = camera.view_from_ecef() * (point.m - camera.eye_ecef().m);
    const double tangent = std::tan(0.5 * radians_from_deg(camera.vertical_fov_deg).rad);
    const double px_per_tangent = 0.5 * camera.height_px / tangent;
    if (view.z >= 0.0) return {1e9, 1e9};
    return {0.5 * camera.width_px - view.x / view.z * px_per_tangent,
            0.5 * camera.height_px + view.y / view.z * px_per_tangent};
}

inline bool is_sound(const Camera& camera) {
    const bool finite = std::isfinite(camera.eye.lat_deg) && std::isfinite(camera.eye.lon_deg) &&
                        std::isfinite(camera.eye.h_m) && std::isfinite(camera.attitude.heading_deg) &&
                        std::isfinite(camera.attitude.pitch_deg) && std::isfinite(camera.attitude.roll_deg);
    const double ground_m = *hill_h_m(camera.eye.lat_deg, camera.eye.lon_deg);
    return finite && std::abs(camera.attitude.pitch_deg) <= 90.0 &&
           camera.eye.h_m >= ground_m + eye_clearance_m - 1e-6;
}

}  // namespace oro::test
