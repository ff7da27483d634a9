#include "apps/light/sun.h"

#include <string_view>

#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"
#include "apps/options/view_limits.h"
#include "apps/report/json_text.h"
#include "core/light/refraction.h"
#include "core/light/sun_position.h"
#include "core/light/utc_time.h"

namespace oro {

Result<SunDirection> parse_sun(const std::string& text) {
    SunDirection sun{};
    const std::size_t comma = text.find(',');
    const std::string_view all(text);
    if (comma == std::string::npos || !read_whole(all.substr(0, comma), sun.azimuth_deg) ||
        !read_whole(all.substr(comma + 1), sun.elevation_deg))
        return refused("--sun", text, "must be AZIMUTH,ELEVATION in degrees, e.g. 315,45");
    constexpr Limits azimuth = view_limits::sun_azimuth_deg, elevation = view_limits::sun_elevation_deg;
    if (!azimuth.hold(sun.azimuth_deg))
        return refused("--sun", text, "the azimuth " + between_words(azimuth.low, azimuth.high));
    if (!elevation.hold(sun.elevation_deg))
        return refused("--sun", text, "the elevation " + between_words(elevation.low, elevation.high));
    return sun;
}

Result<SunTime> parse_time(const std::string& option, const std::string& text) {
    const Result<std::int64_t> utc_s = utc_time_from(text);
    if (!utc_s.ok()) return refused(option, text, utc_s.error().what);
    return SunTime{text, *utc_s};
}

SunDirection usual_sun() {
    return {0.0, 0.0, std::nullopt, true};
}

void aim_sun(std::optional<SunDirection>& sun, const Geodetic& eye) {
    if (sun && sun->is_usual) {
        const std::int64_t utc_s = usual_sun_utc_s(eye);
        sun->time = SunTime{time_text(utc_s), utc_s};
    }
    if (!sun || !sun->time) return;
    const SunPosition position = sun_position(static_cast<double>(sun->time->utc_s), eye);
    sun->azimuth_deg = position.azimuth_deg;
    sun->elevation_deg = seen_elevation_deg(position.airless_elevation_deg, eye.h_m);
}

std::string note_of_year(std::int64_t time_utc_s) {
    constexpr std::int64_t year_1900_s = -2208988800, year_2101_s = 4133980800;
    if (time_utc_s >= year_1900_s && time_utc_s < year_2101_s) return "";
    return "note: the sun is less exact before 1900 and after 2100; between them it is within 0.01 degree";
}

std::string note_of_year(const std::optional<SunDirection>& sun) {
    return sun && sun->time ? note_of_year(sun->time->utc_s) : "";
}

double direct_light(const SunDirection& sun) {
    if (sun.time) return share_of_disc(sun.elevation_deg);
    return sun.elevation_deg >= 0.0 ? 1.0 : 0.0;
}

}  // namespace oro
