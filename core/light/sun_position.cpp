#include "core/light/sun_position.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace oro {
namespace {

constexpr double day_s = 86400.0;
constexpr double j2000_utc_s = 946728000.0;  // 2000-01-01T12:00:00Z
constexpr double au_m = 149597870700.0;      // IAU 2012, resolution B2
constexpr double arcsec_deg = 1.0 / 3600.0;

double turned_deg(double angle_deg) {
    const double turned = std::fmod(angle_deg, 360.0);
    return turned < 0.0 ? turned + 360.0 : turned;
}

double sine_of_deg(double angle_deg) {
    return std::sin(radians_from_deg(angle_deg).rad);
}
double cosine_of_deg(double angle_deg) {
    return std::cos(radians_from_deg(angle_deg).rad);
}

// Julian centuries since J2000.0.
double centuries(double time_s) {
    return (time_s - j2000_utc_s) / (36525.0 * day_s);
}

// Nutation in longitude and the true obliquity of the ecliptic. Error: 0.5 and 0.1 seconds of arc.
// Source: Meeus 1998, chapter 22, eq. 22.2 and the formulae after it.
struct Ecliptic {
    double nutation_deg;
    double obliquity_deg;
};
Ecliptic true_ecliptic(double t) {
    const double node_deg = 125.04452 - 1934.136261 * t;
    const double sun_deg = 280.4665 + 36000.7698 * t;
    const double moon_deg = 218.3165 + 481267.8813 * t;
    const double nutation = -17.20 * sine_of_deg(node_deg) - 1.32 * sine_of_deg(2.0 * sun_deg) -
                            0.23 * sine_of_deg(2.0 * moon_deg) + 0.21 * sine_of_deg(2.0 * node_deg);
    const double tilt = 9.20 * cosine_of_deg(node_deg) + 0.57 * cosine_of_deg(2.0 * sun_deg) +
                        0.10 * cosine_of_deg(2.0 * moon_deg) - 0.09 * cosine_of_deg(2.0 * node_deg);
    const double mean = 84381.448 - 46.8150 * t - 0.00059 * t * t + 0.001813 * t * t * t;
    return {nutation * arcsec_deg, (mean + tilt) * arcsec_deg};
}

// A cos(B + C tau), A in 1e-8, tau in thousands of Julian years since J2000.0.
struct Term {
    double amplitude;
    double phase_rad;
    double rate_rad;
};

template <std::size_t count>
double sum_of(const Term (&terms)[count], double tau) {
    double sum = 0.0;
    for (const Term& term : terms) sum += term.amplitude * std::cos(term.phase_rad + term.rate_rad * tau);
    return sum;
}

// The Earth's heliocentric longitude, by powers of tau: terms of 1e-6 rad (0.2 seconds of arc) and more. What
// the tables print beyond them is below 4 seconds of arc even if all of it adds up.
constexpr Term longitude_0[] = {
    {175347046, 0, 0},           {3341656, 4.6692568, 6283.07585},
    {34894, 4.6261, 12566.1517}, {3497, 2.7441, 5753.3849},
    {3418, 2.8289, 3.5231},      {3136, 3.6277, 77713.7715},
    {2676, 4.4181, 7860.4194},   {2343, 6.1352, 3930.2097},
    {1324, 0.7425, 11506.7698},  {1273, 2.0371, 529.691},
    {1199, 1.1096, 1577.3435},   {990, 5.233, 5884.927},
    {902, 2.045, 26.298},        {857, 3.508, 398.149},
    {780, 1.179, 5223.694},      {753, 2.533, 5507.553},
    {505, 4.583, 18849.228},     {492, 4.205, 775.523},
    {357, 2.92, 0.067},          {317, 5.849, 11790.629},
    {284, 1.899, 796.298},       {271, 0.315, 10977.079},
    {243, 0.345, 5486.778},      {206, 4.806, 2544.314},
    {205, 1.869, 5573.143},      {202, 2.458, 6069.777},
    {156, 0.833, 213.299},       {132, 3.411, 2942.463},
    {126, 1.083, 20.775},        {115, 0.645, 0.98},
    {103, 0.636, 4694.003},      {102, 0.976, 15720.839},
    {102, 4.267, 7.114},
};
constexpr Term longitude_1[] = {
    {628331966747.0, 0, 0}, {206059, 2.678235, 6283.07585}, {4303, 2.6351, 12566.1517},
    {425, 1.59, 3.523},     {119, 5.796, 26.298},           {109, 2.966, 1577.344},
};
constexpr Term longitude_2[] = {
    {52919, 0, 0},
    {8720, 1.0721, 6283.0758},
    {309, 0.867, 12566.152},
};
constexpr Term longitude_3[] = {
    {289, 5.844, 6283.076},
};
// Its heliocentric latitude, which the Moon and the planets make: terms of 3e-7 rad and more.
constexpr Term latitude_0[] = {
    {280, 3.199, 84334.662}, {102, 5.422, 5507.553}, {80, 3.88, 5223.69},
    {44, 3.7, 2352.87},      {32, 4.0, 1577.34},
};
// Its distance from the sun, in au: to 1e-5 of it, which is 0.0001 seconds of arc of parallax.
constexpr Term distance_0[] = {
    {100013989, 0, 0},          {1670700, 3.0984635, 6283.07585}, {13956, 3.05525, 12566.1517},
    {3084, 5.1985, 77713.7715}, {1628, 1.1739, 5753.3849},        {1576, 2.8469, 7860.4194},
};
constexpr Term distance_1[] = {
    {103019, 1.10749, 6283.07585},
    {1721, 1.0644, 12566.1517},
};

// Apparent sidereal time at Greenwich. Source: Meeus 1998, eq. 12.4 and the correction after it.
double sidereal_deg(double time_ut_s, const Ecliptic& ecliptic) {
    const double days = (time_ut_s - j2000_utc_s) / day_s;
    const double t = days / 36525.0;
    // The whole days turn whole times: taken out first, so that no digits are lost.
    const double whole_turns = 360.0 * (days - std::floor(days));
    const double mean =
        280.46061837 + 0.98564736629 * days + whole_turns + t * t * (0.000387933 - t / 38710000.0);
    return turned_deg(mean + ecliptic.nutation_deg * cosine_of_deg(ecliptic.obliquity_deg));
}

// The sun's middle from the place, in metres east, north and up.
glm::dvec3 sun_enu_m(double time_utc_s, const Geodetic& place) {
    const double time_tt_s = time_utc_s + delta_t_s(time_utc_s);
    const GeocentricSun sun = geocentric_sun(time_tt_s);
    const double lon_deg =
        sun.right_ascension_deg - sidereal_deg(time_utc_s, true_ecliptic(centuries(time_tt_s)));
    const SineCosine lat = sine_cosine_deg(sun.declination_deg), lon = sine_cosine_deg(lon_deg);
    const glm::dvec3 sun_ecef_m =
        sun.distance_au * au_m * glm::dvec3(lat.cosine * lon.cosine, lat.cosine * lon.sine, lat.sine);
    return glm::transpose(ecef_from_enu(place.lat_deg, place.lon_deg)) *
           (sun_ecef_m - ecef_from_geodetic(place).m);
}

double elevation_of_deg(const glm::dvec3& enu) {
    return deg_from_radians(Radians{std::atan2(enu.z, std::hypot(enu.x, enu.y))});
}

}  // namespace

GeocentricSun geocentric_sun(double time_tt_s) {
    const double t = centuries(time_tt_s), tau = t / 10.0;
    const double earth_rad =
        1e-8 * (sum_of(longitude_0, tau) +
                tau * (sum_of(longitude_1, tau) +
                       tau * (sum_of(longitude_2, tau) + tau * sum_of(longitude_3, tau))));
    GeocentricSun sun;
    sun.distance_au = 1e-8 * (sum_of(distance_0, tau) + tau * sum_of(distance_1, tau));
    const Ecliptic ecliptic = true_ecliptic(t);
    // Seen from the Earth; in the FK5 system; carried by aberration (Meeus 1998, eq. 25.9 and 25.10).
    sun.longitude_deg = turned_deg(deg_from_radians(Radians{earth_rad}) + 180.0 - 0.09033 * arcsec_deg +
                                   ecliptic.nutation_deg - 20.4898 * arcsec_deg / sun.distance_au);
    const double latitude_rad = -1e-8 * sum_of(latitude_0, tau);  // so small that it is its own sine
    const double sine = sine_of_deg(sun.longitude_deg), cosine = cosine_of_deg(sun.longitude_deg);
    const double tilt_sine = sine_of_deg(ecliptic.obliquity_deg);
    const double tilt_cosine = cosine_of_deg(ecliptic.obliquity_deg);
    sun.right_ascension_deg = turned_deg(
        deg_from_radians(Radians{std::atan2(sine * tilt_cosine - latitude_rad * tilt_sine, cosine)}));
    sun.declination_deg = deg_from_radians(Radians{std::asin(sine * tilt_sine + latitude_rad * tilt_cosine)});
    return sun;
}

double delta_t_s(double time_utc_s) {
    const double year = 2000.0 + 100.0 * centuries(time_utc_s);
    if (year >= 1900.0 && year < 1920.0) {
        const double t = year - 1900.0;
        return -2.79 + t * (1.494119 + t * (-0.0598939 + t * (0.0061966 - t * 0.000197)));
    }
    if (year >= 1920.0 && year < 1941.0) {
        const double t = year - 1920.0;
        return 21.20 + t * (0.84493 + t * (-0.076100 + t * 0.0020936));
    }
    if (year >= 1941.0 && year < 1961.0) {
        const double t = year - 1950.0;
        return 29.07 + t * (0.407 + t * (-1.0 / 233.0 + t / 2547.0));
    }
    if (year >= 1961.0 && year < 1986.0) {
        const double t = year - 1975.0;
        return 45.45 + t * (1.067 - t * (1.0 / 260.0 + t / 718.0));
    }
    if (year >= 1986.0 && year < 2005.0) {
        const double t = year - 2000.0;
        return 63.86 +
               t * (0.3345 + t * (-0.060374 + t * (0.0017275 + t * (0.000651814 + t * 0.00002373599))));
    }
    if (year >= 2005.0 && year < 2050.0) {
        const double t = year - 2000.0;
        return 62.92 + t * (0.32217 + t * 0.005589);
    }
    const double from_1820 = (year - 1820.0) / 100.0;
    const double parabola = -20.0 + 32.0 * from_1820 * from_1820;
    return year >= 2050.0 && year < 2150.0 ? parabola - 0.5628 * (2150.0 - year) : parabola;
}

SunPosition sun_position(double time_utc_s, const Geodetic& place, const Weather& weather) {
    const glm::dvec3 enu_m = sun_enu_m(time_utc_s, place);
    SunPosition sun;
    sun.azimuth_deg = turned_deg(deg_from_radians(Radians{std::atan2(enu_m.x, enu_m.y)}));
    sun.airless_elevation_deg = elevation_of_deg(enu_m);
    sun.elevation_deg = sun.airless_elevation_deg + refraction_deg(sun.airless_elevation_deg, weather);
    sun.radius_deg = 959.63 * arcsec_deg * au_m / glm::length(enu_m);
    return sun;
}

glm::dvec3 enu_towards(double azimuth_deg, double elevation_deg) {
    const SineCosine east = sine_cosine_deg(azimuth_deg), up = sine_cosine_deg(elevation_deg);
    return {up.cosine * east.sine, up.cosine * east.cosine, up.sine};
}

}  // namespace oro
