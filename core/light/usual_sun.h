// The light of a picture for which nobody asks for a time: one that its place really has.
#pragma once

#include <cstdint>

#include "core/earth/ellipsoid.h"

namespace oro {

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
