// The WGS84 ellipsoid and the frames around it, in double precision.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <numbers>

namespace oro {

// An angle in radians. Degrees are plain doubles whose names end in _deg; the type marks the other kind.
struct Radians {
    double rad{};
    explicit constexpr Radians(double value_rad = 0.0) : rad(value_rad) {}
};
constexpr Radians radians_from_deg(double angle_deg) {
    return Radians{angle_deg * (std::numbers::pi / 180.0)};
}
constexpr double deg_from_radians(Radians angle) {
    return angle.rad * (180.0 / std::numbers::pi);
}

// WGS84. Source: NIMA TR8350.2, third edition, 2000, table 3.1.
inline constexpr double wgs84_a_m = 6378137.0;
inline constexpr double wgs84_f = 1.0 / 298.257223563;
inline constexpr double wgs84_b_m = wgs84_a_m * (1.0 - wgs84_f);
inline constexpr double wgs84_e2 = wgs84_f * (2.0 - wgs84_f);

// A point by latitude [-90, 90], longitude (any real number; outputs are in (-180, 180]) and height above the
// ellipsoid. Never the height above the geoid: that one is written H and has no place in this type.
struct Geodetic {
    double lat_deg{};
    double lon_deg{};
    double h_m{};
};

// A point in the Earth-centred, Earth-fixed frame: x through (0 N, 0 E), z through the north pole.
struct Ecef {
    glm::dvec3 m{0.0};
};

// A direction or an offset in the local frame of a place: x east, y north, z up along the ellipsoid's normal.
struct Enu {
    glm::dvec3 m{0.0};
};

struct SineCosine {
    double sine;
    double cosine;
};
// Sine and cosine of an angle in degrees, exact at every multiple of 90, and the same bits for angles that
// differ by whole turns (so -180 and 180 are one meridian, and 90 N is one point). Error: 2 units in the last
// place.
SineCosine sine_cosine_deg(double angle_deg);

// A longitude in degrees turned into (-180, 180].
double normalised_lon_deg(double lon_deg);

// Radius of curvature across the meridian at a latitude, in metres.
// Source: Torge & Müller, Geodesy, 4th ed. 2012, eq. 4.14.
double prime_vertical_radius_m(double lat_deg);
// Radius of curvature along the meridian, in metres. Source: the same, eq. 4.13.
double meridian_radius_m(double lat_deg);
// The Gaussian radius of curvature in metres: the geometric mean of the two above, which are the principal
// ones.
double gaussian_radius_m(double lat_deg);

// Position of a geodetic point. Error: below 4 nm up to heights of 10 km (against GeographicLib).
Ecef ecef_from_geodetic(const Geodetic& point);

// The inverse of ecef_from_geodetic(). Valid from 6,300 km below the surface (not at the centre) to beyond
// the Moon; error: below 1e-6 m and 1e-13 degree wherever |h| < 1,000 km. At a pole the longitude is 0; on
// the axis the nearer pole is given. Source: H. Vermeille, An analytical method to transform geocentric into
// geodetic coordinates, J. Geodesy 85, 2011, refined by Newton steps.
Geodetic geodetic_from_ecef(const Ecef& point);

// Columns east, north, up at a place, in ECEF axes: ecef offset = ecef_from_enu * enu offset. Orthonormal to
// 1e-15.
glm::dmat3 ecef_from_enu(double lat_deg, double lon_deg);

}  // namespace oro
