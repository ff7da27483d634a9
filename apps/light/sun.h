// The sun that lights a view: a direction, or where it stands at a time over the eye's place.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/earth/ellipsoid.h"

namespace oro {

struct SunTime {
    std::string text;  // as it was given
    std::int64_t utc_s{};
};

struct SunDirection {
    double azimuth_deg;    // clockwise from true north
    double elevation_deg;  // as it is seen, [-90, 90]
    // That time put it there; nothing: the direction itself was asked for.
    std::optional<SunTime> time{};
    // Nobody asked for a time or a direction: the time is one that every place has (core/light/sun_position.h).
    bool is_usual{};
};
// The usual sun of a place that is not known yet: aim_sun() gives it a time and a direction.
SunDirection usual_sun();

// "315,45". Errors: usage, of --sun.
Result<SunDirection> parse_sun(const std::string& text);
// "2026-06-21T05:30+02:00", as utc_time_from() takes it. Errors: usage, of that option.
Result<SunTime> parse_time(const std::string& option, const std::string& text);

// Puts a sun that is asked for by time where an eye sees it then (core/light/refraction.h), within 0.01
// degree from 1900 to 2100; the usual one at the usual time of the eye's place. Leaves directions as they
// are.
void aim_sun(std::optional<SunDirection>& sun, const Geodetic& eye);

// What to tell of a sun at a time for which nobody has held it against an ephemeris: years other than 1900 to
// 2100. "" of others.
std::string note_of_year(std::int64_t time_utc_s);
// The note on the year of a view's sun, where it goes by a time.
std::string note_of_year(const std::optional<SunDirection>& sun);

// The share of full direct light that it gives, 0 to 1. By time: the share of its disc that is above the
// level line. A direction is a point of light: all from elevation 0 up, nothing below.
double direct_light(const SunDirection& sun);

}  // namespace oro
