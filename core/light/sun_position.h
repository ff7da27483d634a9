// Where the sun stands: from a time and a place to an azimuth and an elevation, and when it rises and sets
// over a plain horizon.
//
// Times are seconds since 1970-01-01T00:00:00Z without leap seconds, as clocks count them; taken as UT1,
// from which UTC keeps within 0.9 s (0.004 degree of the sky's turn). Before 1972 they are universal time.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/light/refraction.h"

namespace oro {

// TT - UT1 in seconds. From 1900 to 2020 within 1 s of what was observed; later a forecast, which may be
// wrong by a minute in 2100: 3 seconds of arc of the sun. Source: F. Espenak & J. Meeus, Five Millennium
// Canon of Solar Eclipses, NASA/TP-2006-214141, 2006, section 2.2. Outside 1900 to 2150 its parabola only.
double delta_t_s(double time_utc_s);

// The sun as seen from the Earth's centre, apparent (nutation and aberration counted), in the equator and
// equinox of date.
struct GeocentricSun {
    double longitude_deg{};  // along the ecliptic, [0, 360)
    double right_ascension_deg{};
    double declination_deg{};
    double distance_au{};
};
// Gives the sun right within 0.0001 degree from 1900 to 2100, and less exactly before and after. time_tt_s
// counts like the times above, on the scale TT. For any threads at once. Source: the library ERFA, which has
// the IAU's models: the Earth's place and velocity by eraEpv00 (VSOP2000 fitted to DE405), aberration by
// eraAb, precession and nutation by eraPn00b (IAU 2000B).
GeocentricSun geocentric_sun(double time_tt_s);

struct SunPosition {
    double azimuth_deg{};            // clockwise from true north, [0, 360)
    double airless_elevation_deg{};  // above the plane across the ellipsoid's normal
    double elevation_deg{};          // with refraction
    double radius_deg{};             // of the disc, without refraction; 0.262 to 0.271
};
// The sun as seen from the place itself, parallax counted: 8.8 seconds of arc at the horizon. Right within
// 0.005 degree from 1900 to 2100 when the time is UT1, elevations without air. Deflections of the vertical,
// polar motion and diurnal aberration (together below 0.001 degree but for the first) are left out. At a pole
// north is where the place's longitude puts it. Source: as geocentric_sun(); sidereal time by eraGmst00 and
// eraEe00; radius 959.63 seconds of arc at 1 au (J. Meeus, Astronomical Algorithms, 2nd ed. 1998, chapter
// 55).
SunPosition sun_position(double time_utc_s, const Geodetic& place, const Weather& weather = {});

// The elevation of the sun's middle, without air, when its upper limb shows at a plain horizon: 34 minutes of
// arc of refraction and 16 of radius, as almanacs agree on. Source: Meeus 1998, chapter 15.
inline constexpr double plain_horizon_deg = -50.0 / 60.0;

enum class SunDay { rises_or_sets, up_all_day, down_all_day };
struct SunCrossing {
    double time_utc_s{};
    bool rising{};
};
struct SunDayEvents {
    SunDay day{};
    std::vector<SunCrossing> crossings;  // in order of time; empty for the latter two kinds of day
    double highest_utc_s{};              // when it stands highest
    double highest_deg{};                // and how high, without air
};
// What the sun does in the 24 hours from a time on: the crossings of an airless elevation, each within 0.01 s
// of where sun_position() has it. Most days have a rise and a set; near a polar circle there may be one only,
// or three.
SunDayEvents sun_day(double from_utc_s, const Geodetic& place, double horizon_deg = plain_horizon_deg);

// How long it is up in those 24 hours, in seconds.
double up_s(const SunDayEvents& events, double from_utc_s);

// Solar noon: when it crosses the meridian on the side where it stands highest, next to the highest_utc_s of
// the 24 hours from a time on (it may lie seconds before or after them), within 0.01 s. At a pole, where
// there is no meridian, that itself.
double solar_noon_utc_s(double from_utc_s, const Geodetic& place);

// Unit vector east, north, up, towards an azimuth (clockwise from north) and an elevation above level.
glm::dvec3 enu_towards(double azimuth_deg, double elevation_deg);

// From here on to the poles the sun of an equinox is too low to light anything: 20 degrees at ten, 0 at a
// pole. Source: 90 degrees less the obliquity of 2026, 23.44 (J. Meeus, Astronomical Algorithms, 2nd ed.
// 1998, eq. 22.2).
inline constexpr double polar_circle_deg = 66.56;

// Ten o'clock by the sun, two hours before it stands highest: on 20 March 2026, an equinox; within the polar
// circles on the day of 2026 when it is summer's middle there, 21 June in the north and 21 December in the
// south. Seconds since 1970-01-01T00:00:00Z, whole ones; by the place's longitude alone, so that the sun is
// within 15 s of ten o'clock (0.06 degree of its way) at all longitudes.
std::int64_t usual_sun_utc_s(const Geodetic& place);

}  // namespace oro
