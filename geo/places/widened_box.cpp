#include "geo/places/widened_box.h"

#include <algorithm>
#include <cmath>

#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

// In which the distance is seen from the middle of a sphere that is nowhere less curved than the ellipsoid is
// around the box: its radius is that of the meridian where that is least, nearest to the equator.
double angle_rad(const BoundingBox& box, double by_m) {
    constexpr double spare = 1.001;
    const bool has_equator = box.south_deg <= 0.0 && box.north_deg >= 0.0;
    const double nearest_deg = has_equator ? 0.0 : std::min(std::abs(box.south_deg), std::abs(box.north_deg));
    const double most_deg = deg_from_radians(Radians(by_m / meridian_radius_m(0.0)));
    return spare * by_m / meridian_radius_m(std::max(0.0, nearest_deg - most_deg));
}

}  // namespace

BoundingBox widened_box(const BoundingBox& box, double by_m) {
    const double by_rad = angle_rad(box, by_m), by_deg = deg_from_radians(Radians(by_rad));
    BoundingBox wide{-180.0, std::max(-90.0, box.south_deg - by_deg), 180.0,
                     std::min(90.0, box.north_deg + by_deg)};
    if (wide.south_deg <= -90.0 || wide.north_deg >= 90.0) return wide;
    // Source: of a small circle on a sphere, where it touches a meridian: the sine of the longitude from its
    // middle is the sine of its radius by the cosine of the latitude of its middle.
    const double farthest_deg = std::max(std::abs(box.south_deg), std::abs(box.north_deg));
    const double share = std::sin(by_rad) / sine_cosine_deg(farthest_deg).cosine;
    if (!(share < 1.0)) return wide;
    const double sideways_deg = deg_from_radians(Radians(std::asin(share)));
    const double width_deg =
        box.east_deg - box.west_deg + (box.west_deg > box.east_deg ? 360.0 : 0.0) + 2.0 * sideways_deg;
    if (width_deg >= 360.0) return wide;
    wide.west_deg = normalised_lon_deg(box.west_deg - sideways_deg);
    wide.east_deg = normalised_lon_deg(box.east_deg + sideways_deg);
    return wide;
}

}  // namespace oro
