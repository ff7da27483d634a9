#include "core/light/sun_position.h"

#include <cmath>

namespace oro {
namespace {

// When the sun crosses the meridian of Greenwich on these days (sun_position.h, solar_noon_utc_s).
constexpr std::int64_t equinox_noon_s = 1774008446;            // 2026-03-20T12:07:26Z
constexpr std::int64_t northern_solstice_noon_s = 1782043309;  // 2026-06-21T12:01:49Z
constexpr std::int64_t southern_solstice_noon_s = 1797854284;  // 2026-12-21T11:58:04Z

}  // namespace

std::int64_t usual_sun_utc_s(const Geodetic& place) {
    constexpr std::int64_t before_noon_s = 2 * 3600;
    constexpr double s_a_degree = 240.0;
    const std::int64_t noon_s = place.lat_deg >= polar_circle_deg    ? northern_solstice_noon_s
                                : place.lat_deg <= -polar_circle_deg ? southern_solstice_noon_s
                                                                     : equinox_noon_s;
    return noon_s - before_noon_s - std::llround(s_a_degree * place.lon_deg);
}

}  // namespace oro
