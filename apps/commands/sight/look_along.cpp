#include "apps/commands/sight/look_along.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace oro {
namespace {

// Longitude counted from the 180th meridian, east of it positive.
double past_180_deg(double lon_deg) {
    return std::remainder(lon_deg - 180.0, 360.0);
}

// Where the line passes the 180th meridian between two of its points that lie on either side.
ProfilePoint crossing_between(const LineAlong& line, const ProfilePoint& from, const ProfilePoint& to,
                              const TrueGround& ground) {
    if (past_180_deg(from.lon_deg) == 0.0) return from;
    if (past_180_deg(to.lon_deg) == 0.0) return to;
    const bool from_east = past_180_deg(from.lon_deg) > 0.0;
    double before_m = from.along_m, after_m = to.along_m;
    for (int i = 0; i < 60; ++i) {
        const double middle_m = 0.5 * (before_m + after_m);
        const bool is_east = past_180_deg(place_on_line(line, middle_m).lon_deg) > 0.0;
        const bool is_before = is_east == from_east;
        (is_before ? before_m : after_m) = middle_m;
    }
    return profile_point(ground, {place_on_line(line, before_m).lat_deg, 180.0, 0.0}, before_m);
}

}  // namespace

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
                                         const TrueGround& ground, const ProfileProgress& progress) {
    std::vector<ProfilePoint> points;
    const double length_m = line.distances_m.back();
    std::size_t reported = 0;
    const auto report_some = [&](double along_m) {
        constexpr std::size_t apart = 4096;
        if (!progress || points.size() < reported + apart) return;
        reported = points.size();
        progress(along_m);
    };
    if (step_m) {
        const auto steps = static_cast<std::size_t>(std::ceil(length_m / *step_m - 1e-9));
        for (std::size_t i = 0; i <= steps; ++i) {
            const double along_m = i == steps ? length_m : static_cast<double>(i) * *step_m;
            const LatLon place = place_on_line(line, along_m);
            points.push_back(profile_point(ground, {place.lat_deg, place.lon_deg, 0.0}, along_m));
            report_some(along_m);
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
        if (to_m > from_m) add_profile(ground, way, from_m, to_m, points, report_some);
        report_some(to_m);
    }
    return points;
}

std::vector<MeridianCrossing> crossings_of(const LineAlong& line, std::span<const ProfilePoint> points,
                                           const TrueGround& ground) {
    std::vector<MeridianCrossing> crossings;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const ProfilePoint &from = points[i], &to = points[i + 1];
        if (from.has_ground && to.has_ground && std::abs(from.lon_deg - to.lon_deg) > 180.0)
            crossings.push_back({i, crossing_between(line, from, to, ground)});
    }
    return crossings;
}

}  // namespace oro
