#include "apps/light/sun.h"

#include <string_view>

#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"
#include "apps/view/view_limits.h"
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

void aim_sun(std::optional<SunDirection>& sun, const Geodetic& eye) {
    if (!sun || !sun->time) return;
    const SunPosition position = sun_position(static_cast<double>(sun->time->utc_s), eye);
    sun->azimuth_deg = position.azimuth_deg;
    sun->elevation_deg = seen_elevation_deg(position.airless_elevation_deg, eye.h_m);
}

double direct_light(const SunDirection& sun) {
    if (sun.time) return share_of_disc(sun.elevation_deg);
    return sun.elevation_deg >= 0.0 ? 1.0 : 0.0;
}

}  // namespace oro
