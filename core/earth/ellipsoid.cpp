#include "core/earth/ellipsoid.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace oro {
namespace {

// Lengths here are from 1e-10 to 1e10: no square overflows, and std::hypot takes as long as all the rest.
double length_of(double x, double y) {
    return std::sqrt(x * x + y * y);
}
// A direction in the meridian plane: sine and cosine of a geodetic latitude.
SineCosine unit(double sine, double cosine) {
    const double length = length_of(sine, cosine);
    return {sine / length, cosine / length};
}

// First guess of the latitude of a point at (rho, z), both in units of a. Outside the evolute (some 43 km
// around the centre) it is exact but for rounding; inside, where nothing is promised, it is merely finite.
SineCosine latitude_by_vermeille(double rho, double z) {
    const double e4 = wgs84_e2 * wgs84_e2;
    const double p = rho * rho;
    const double q = (1.0 - wgs84_e2) * z * z;
    const double r = (p + q - e4) / 6.0;
    if (r <= 0.0) {
        return rho == 0.0 && z == 0.0 ? SineCosine{1.0, 0.0} : unit(z, (1.0 - wgs84_e2) * rho);
    }
    const double s = e4 * p * q / (4.0 * r * r * r);
    const double t = std::cbrt(1.0 + s + std::sqrt(s * (2.0 + s)));
    const double u = r * (1.0 + t + 1.0 / t);
    const double v = std::sqrt(u * u + e4 * q);
    const double w = wgs84_e2 * (u + v - q) / (2.0 * v);
    const double k = (u + v) / (std::sqrt(w * w + u + v) + w);
    return unit(z, k * rho / (k + wgs84_e2));
}

}  // namespace

SineCosine sine_cosine_deg(double angle_deg) {
    // remquo is exact, and its ties go to the even quarter, so whole turns change nothing.
    int quarter = 0;
    const double rest_rad = radians_from_deg(std::remquo(angle_deg, 90.0, &quarter)).rad;
    const double sine = std::sin(rest_rad);
    const double cosine = std::cos(rest_rad);
    // Adding 0 turns -0 into +0: the poles and the antimeridian have one set of bits.
    switch (static_cast<unsigned>(quarter) & 3U) {
        case 0:
            return {sine + 0.0, cosine + 0.0};
        case 1:
            return {cosine + 0.0, -sine + 0.0};
        case 2:
            return {-sine + 0.0, -cosine + 0.0};
        default:
            return {-cosine + 0.0, sine + 0.0};
    }
}

double normalised_lon_deg(double lon_deg) {
    const double rest_deg = std::remainder(lon_deg, 360.0);
    return rest_deg == -180.0 ? 180.0 : rest_deg + 0.0;
}

double prime_vertical_radius_m(double lat_deg) {
    const double sine = sine_cosine_deg(lat_deg).sine;
    return wgs84_a_m / std::sqrt(1.0 - wgs84_e2 * sine * sine);
}

double meridian_radius_m(double lat_deg) {
    const double sine = sine_cosine_deg(lat_deg).sine;
    const double root = std::sqrt(1.0 - wgs84_e2 * sine * sine);
    return wgs84_a_m * (1.0 - wgs84_e2) / (root * root * root);
}

double gaussian_radius_m(double lat_deg) {
    return std::sqrt(prime_vertical_radius_m(lat_deg) * meridian_radius_m(lat_deg));
}

Ecef ecef_from_geodetic(const Geodetic& point) {
    const SineCosine lat = sine_cosine_deg(point.lat_deg);
    const SineCosine lon = sine_cosine_deg(point.lon_deg);
    const double normal_m = wgs84_a_m / std::sqrt(1.0 - wgs84_e2 * lat.sine * lat.sine);
    const double rho_m = (normal_m + point.h_m) * lat.cosine;
    const double z_m = (normal_m * (1.0 - wgs84_e2) + point.h_m) * lat.sine;
    return Ecef{{rho_m * lon.cosine + 0.0, rho_m * lon.sine + 0.0, z_m + 0.0}};
}

Geodetic geodetic_from_ecef(const Ecef& point) {
    const double rho_m = length_of(point.m.x, point.m.y);
    const double z_m = point.m.z;
    SineCosine lat = latitude_by_vermeille(rho_m / wgs84_a_m, z_m / wgs84_a_m);
    double h_m = 0.0;
    // Newton: a step north by the distance between the point and the normal through the guessed foot. The
    // height's error is quadratic in the latitude's.
    for (int step = 0; step < 2; ++step) {
        const double root = std::sqrt(1.0 - wgs84_e2 * lat.sine * lat.sine);
        h_m = rho_m * lat.cosine + z_m * lat.sine - wgs84_a_m * root;
        const double north_m =
            z_m * lat.cosine - rho_m * lat.sine + wgs84_a_m / root * wgs84_e2 * lat.sine * lat.cosine;
        const double radius_m = wgs84_a_m * (1.0 - wgs84_e2) / (root * root * root) + h_m;
        if (!(radius_m > 1.0e3)) break;  // within the evolute
        const double turn_rad = north_m / radius_m;
        lat = unit(lat.sine + turn_rad * lat.cosine, lat.cosine - turn_rad * lat.sine);
        constexpr double squared_is_nothing_rad = 1.0e-10;
        if (std::abs(turn_rad) < squared_is_nothing_rad) break;
    }
    if (rho_m == 0.0) lat = {lat.sine, 0.0};
    const double root = std::sqrt(1.0 - wgs84_e2 * lat.sine * lat.sine);
    h_m = rho_m * lat.cosine + z_m * lat.sine - wgs84_a_m * root;
    const double lat_deg = deg_from_radians(Radians{std::atan2(lat.sine, lat.cosine)});
    const double lon_deg = rho_m == 0.0 ? 0.0 : deg_from_radians(Radians{std::atan2(point.m.y, point.m.x)});
    return {lat_deg, normalised_lon_deg(lon_deg), h_m};
}

glm::dmat3 ecef_from_enu(double lat_deg, double lon_deg) {
    const SineCosine lat = sine_cosine_deg(lat_deg);
    const SineCosine lon = sine_cosine_deg(lon_deg);
    return {glm::dvec3(-lon.sine, lon.cosine, 0.0),
            glm::dvec3(-lat.sine * lon.cosine, -lat.sine * lon.sine, lat.cosine),
            glm::dvec3(lat.cosine * lon.cosine, lat.cosine * lon.sine, lat.sine)};
}

}  // namespace oro
