#include "core/light/sun_position.h"

#include <erfa.h>

#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "core/earth/rotation.h"

namespace oro {
namespace {

constexpr double day_s = 86400.0, hour_s = 3600.0;
constexpr double j2000_utc_s = 946728000.0;  // 2000-01-01T12:00:00Z
constexpr double j2000_jd = 2451545.0;
constexpr double au_m = 149597870700.0;  // IAU 2012, resolution B2
constexpr double light_m_s = 299792458.0;
constexpr double arcsec_deg = 1.0 / 3600.0;

// Days since J2000.0, on the scale of the time: the second part of a Julian date of two.
double days_of(double time_s) {
    return (time_s - j2000_utc_s) / day_s;
}

// The sun seen from the Earth's centre at a time, and what nutation is then.
struct SunOfDate {
    glm::dvec3 towards;  // unit, along axes of the true equator and equinox of date
    double distance_au;
    double nutation_rad;   // in longitude
    double obliquity_rad;  // mean
    double tilt_rad;       // nutation in obliquity
};
SunOfDate computed_sun(double time_tt_s) {
    const double days = days_of(time_tt_s);
    // TDB is within 2 ms of TT. The status tells that a time is outside 1900 to 2100.
    double of_sun[2][3], of_barycentre[2][3];
    eraEpv00(j2000_jd, days, of_sun, of_barycentre);
    SunOfDate sun{};
    double away[3], towards[3], velocity[3], apparent[3], of_date[3];
    eraPn(of_sun[0], &sun.distance_au, away);
    eraSxp(-1.0, away, towards);
    eraSxp(au_m / (day_s * light_m_s), of_barycentre[1], velocity);
    eraAb(towards, velocity, sun.distance_au, std::sqrt(1.0 - eraPdp(velocity, velocity)), apparent);
    double bias[3][3], precession[3][3], both[3][3], nutation[3][3], of_date_from_gcrs[3][3];
    eraPn00b(j2000_jd, days, &sun.nutation_rad, &sun.tilt_rad, &sun.obliquity_rad, bias, precession, both,
             nutation, of_date_from_gcrs);
    eraRxp(of_date_from_gcrs, apparent, of_date);
    sun.towards = {of_date[0], of_date[1], of_date[2]};
    return sun;
}

// Linear between whole hours, which is right within 0.001 seconds of arc; each thread keeps the last two of
// them, for whoever asks for many times of a day.
SunOfDate sun_of_date(double time_tt_s) {
    thread_local double hour = std::nan("");
    thread_local std::array<SunOfDate, 2> ends;
    const double asked = std::floor(time_tt_s / hour_s);
    if (asked != hour) {
        const std::array<SunOfDate, 2> kept = ends;
        ends[0] = asked == hour + 1.0 ? kept[1] : computed_sun(asked * hour_s);
        ends[1] = asked == hour - 1.0 ? kept[0] : computed_sun((asked + 1.0) * hour_s);
        hour = asked;
    }
    const double share = time_tt_s / hour_s - asked;
    const auto between = [&](double SunOfDate::*member) {
        return std::lerp(ends[0].*member, ends[1].*member, share);
    };
    return {glm::normalize(glm::mix(ends[0].towards, ends[1].towards, share)),
            between(&SunOfDate::distance_au), between(&SunOfDate::nutation_rad),
            between(&SunOfDate::obliquity_rad), between(&SunOfDate::tilt_rad)};
}

// The sun's middle from the place, in metres east, north and up.
glm::dvec3 sun_enu_m(double time_utc_s, const Geodetic& place) {
    const double time_tt_s = time_utc_s + delta_t_s(time_utc_s), tt_days = days_of(time_tt_s);
    const SunOfDate sun = sun_of_date(time_tt_s);
    // Apparent sidereal time at Greenwich.
    const double turn_rad = eraGmst00(j2000_jd, days_of(time_utc_s), j2000_jd, tt_days) +
                            eraEe00(j2000_jd, tt_days, sun.obliquity_rad, sun.nutation_rad);
    const double sine = std::sin(turn_rad), cosine = std::cos(turn_rad);
    const glm::dvec3& of_date = sun.towards;
    const glm::dvec3 sun_ecef_m =
        sun.distance_au * au_m *
        glm::dvec3(cosine * of_date.x + sine * of_date.y, cosine * of_date.y - sine * of_date.x, of_date.z);
    return glm::transpose(ecef_from_enu(place.lat_deg, place.lon_deg)) *
           (sun_ecef_m - ecef_from_geodetic(place).m);
}

double elevation_of_deg(const glm::dvec3& enu) {
    return deg_from_radians(Radians{std::atan2(enu.z, std::hypot(enu.x, enu.y))});
}

}  // namespace

GeocentricSun geocentric_sun(double time_tt_s) {
    const SunOfDate sun = sun_of_date(time_tt_s);
    const glm::dvec3& of_date = sun.towards;
    const double tilt_rad = sun.obliquity_rad + sun.tilt_rad;
    const double along = of_date.y * std::cos(tilt_rad) + of_date.z * std::sin(tilt_rad);
    return {turned_to_circle_deg(deg_from_radians(Radians{std::atan2(along, of_date.x)})),
            turned_to_circle_deg(deg_from_radians(Radians{std::atan2(of_date.y, of_date.x)})),
            deg_from_radians(Radians{std::asin(of_date.z)}), sun.distance_au};
}

double delta_t_s(double time_utc_s) {
    const double year = 2000.0 + days_of(time_utc_s) / 365.25;
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
    sun.azimuth_deg = turned_to_circle_deg(deg_from_radians(Radians{std::atan2(enu_m.x, enu_m.y)}));
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
