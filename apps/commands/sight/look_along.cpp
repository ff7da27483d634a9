#include "apps/commands/sight/look_along.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace oro {

SightReport look_along(const Geodetic& from, const Geodetic& to, const Air& air, const TrueGround& ground) {
    SightReport report;
    report.from = from;
    report.to = to;
    report.air = air;
    report.path = geodesic_between(from.lat_deg, from.lon_deg, to.lat_deg, to.lon_deg);
    const Observer observer(ground, from, air);
    const glm::dvec3 offset_m = ecef_from_geodetic(to).m - observer.sight().eye.m;
    report.slant_m = glm::length(offset_m);
    const glm::dvec3 seen_m = observer.sight().refraction.apparent_m(offset_m);
    const glm::dvec3 enu_m = seen_m * ecef_from_enu(from.lat_deg, from.lon_deg);
    report.elevation_deg = deg_from_radians(Radians{std::atan2(enu_m.z, std::hypot(enu_m.x, enu_m.y))});
    report.line = observer.line_to(to);
    report.obstacle = observer.obstacle(to);
    if (!report.obstacle) return report;
    const Geodetic& at = report.obstacle->point;
    report.obstacle_distance_m =
        geodesic_between(from.lat_deg, from.lon_deg, at.lat_deg, at.lon_deg).distance_m;
    report.target_clearance_deficit_m = observer.clearance_deficit_m(to);
    report.eye_clearance_deficit_m = eye_clearance_deficit_m(ground, from, air, to);
    return report;
}

std::vector<ProfilePoint> profile_points(const LineAlong& line, const std::optional<double>& step_m,
                                         const TrueGround& ground) {
    std::vector<ProfilePoint> points;
    const double length_m = line.distances_m.back();
    if (step_m) {
        const auto steps = static_cast<std::size_t>(std::ceil(length_m / *step_m - 1e-9));
        for (std::size_t i = 0; i <= steps; ++i) {
            const double along_m = i == steps ? length_m : static_cast<double>(i) * *step_m;
            const LatLon place = place_on_line(line, along_m);
            points.push_back(profile_point(ground, {place.lat_deg, place.lon_deg, 0.0}, along_m));
        }
        return points;
    }
    for (std::size_t leg = 0; leg + 1 < line.places.size(); ++leg) {
        const LatLon &from = line.places[leg], &to = line.places[leg + 1];
        const double from_m = line.distances_m[leg], to_m = line.distances_m[leg + 1];
        const auto way = [&](double along_m) {
            // Exactly the line's own places, where it has them.
            if (along_m == from_m) return Geodetic{from.lat_deg, from.lon_deg, 0.0};
            if (along_m == to_m) return Geodetic{to.lat_deg, to.lon_deg, 0.0};
            const LatLon place = place_on_leg(line, leg, along_m);
            return Geodetic{place.lat_deg, place.lon_deg, 0.0};
        };
        if (to_m > from_m) add_profile(ground, way, from_m, to_m, points);
    }
    return points;
}

}  // namespace oro
