#include "core/earth/cylinder.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oro {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;

}  // namespace

double turned_deg(double azimuth_deg) {
    const double turned = azimuth_deg - 360.0 * std::floor(azimuth_deg / 360.0);
    return turned < 360.0 ? turned : 0.0;
}

double Cylinder::px_per_rad() const {
    return width_px / (sweep_deg * rad_per_deg);
}

glm::dvec2 Cylinder::place_px(const glm::dvec3& enu) const {
    const double azimuth_deg = std::atan2(enu.x, enu.y) / rad_per_deg;
    return {turned_deg(azimuth_deg - from_deg) / sweep_deg * width_px,
            above_px - enu.z / std::hypot(enu.x, enu.y) * px_per_rad()};
}

bool Cylinder::holds(const glm::dvec2& place_px) const {
    return place_px.x >= 0.0 && place_px.x < width_px && place_px.y >= 0.0 && place_px.y < height_px();
}

double Cylinder::azimuth_deg_at(double x_px) const {
    return turned_deg(from_deg + x_px / width_px * sweep_deg);
}

double Cylinder::elevation_deg_at(double y_px) const {
    return std::atan((above_px - y_px) / px_per_rad()) / rad_per_deg;
}

glm::dvec3 Cylinder::enu_at(const glm::dvec2& place_px) const {
    const double azimuth_rad = (from_deg + place_px.x / width_px * sweep_deg) * rad_per_deg;
    return {std::sin(azimuth_rad), std::cos(azimuth_rad), (above_px - place_px.y) / px_per_rad()};
}

Cylinder cylinder_around(double from_deg, double sweep_deg, double low_deg, double high_deg, int width_px) {
    Cylinder around{turned_deg(from_deg), sweep_deg, width_px, 0, 0};
    const auto rows = [&](double elevation_deg) {
        return static_cast<int>(std::lround(std::tan(elevation_deg * rad_per_deg) * around.px_per_rad()));
    };
    around.above_px = rows(high_deg);
    around.below_px = std::max(1 - around.above_px, -rows(low_deg));
    return around;
}

}  // namespace oro
