#include "core/light/sun_over_terrain.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"

namespace oro {
namespace {

constexpr double step_s = 10.0;
constexpr int steps = 8640;

// How far below level the sea's horizon is seen by an eye over it, 0 or less.
double sea_horizon_deg(const Sight& sight, double above_sea_m) {
    const double per_m = 1.0 / mean_radius_m - sight.refraction.curvature_per_m();
    if (above_sea_m <= 0.0 || per_m <= 0.0) return 0.0;
    return -deg_from_radians(Radians{std::acos(1.0 / (1.0 + above_sea_m * per_m))});
}

}  // namespace

SunOverTerrain::SunOverTerrain(const TrueGround& ground, const Geodetic& eye, const Air& air, double sea_h_m)
    : eye_(eye),
      ecef_from_enu_(ecef_from_enu(eye.lat_deg, eye.lon_deg)),
      oracle_(ground, sight_from(eye, air)),
      reach_m_(sight_reach_m(eye.h_m)),
      sea_horizon_deg_(sea_horizon_deg(sight_from(eye, air), eye.h_m - sea_h_m)) {}

bool SunOverTerrain::is_free(double azimuth_deg, double seen_deg) const {
    return seen_deg >= sea_horizon_deg_ &&
           !oracle_.first_hit(ecef_from_enu_ * enu_towards(azimuth_deg, seen_deg), reach_m_);
}

bool SunOverTerrain::shows_at(double time_utc_s) const {
    constexpr int half = 32;
    const SunPosition sun = sun_position(time_utc_s, eye_);
    const double across = std::max(1e-6, sine_cosine_deg(sun.airless_elevation_deg).cosine);
    // From the middle outwards: by day the first asked is free, by night it is below all horizons.
    for (int i = 0; i <= 2 * half; ++i) {
        const double share = (i % 2 == 0 ? -1.0 : 1.0) * ((i + 1) / 2) / half;
        const double airless_deg =
            sun.airless_elevation_deg + sun.radius_deg * std::sqrt(1.0 - share * share);
        const double seen_deg = seen_elevation_deg(airless_deg, eye_.h_m);
        if (i == 0 && seen_deg < sea_horizon_deg_) return false;
        if (is_free(sun.azimuth_deg + share * sun.radius_deg / across, seen_deg)) return true;
    }
    return false;
}

SunDayEvents sun_day(double from_utc_s, const SunOverTerrain& sun, int threads) {
    std::vector<std::uint8_t> shows(steps + 1);
    in_parallel(steps + 1, threads, [&](int i) {
        shows[static_cast<std::size_t>(i)] = sun.shows_at(from_utc_s + i * step_s) ? 1 : 0;
    });
    SunDayEvents events = sun_day(from_utc_s, sun.eye());
    events.crossings.clear();
    for (int i = 0; i < steps; ++i) {
        const bool was = shows[static_cast<std::size_t>(i)] != 0;
        if (was == (shows[static_cast<std::size_t>(i) + 1] != 0)) continue;
        double low_s = from_utc_s + i * step_s, high_s = low_s + step_s;
        while (high_s - low_s > 0.1) {
            const double middle_s = 0.5 * (low_s + high_s);
            (sun.shows_at(middle_s) == was ? low_s : high_s) = middle_s;
        }
        events.crossings.push_back({0.5 * (low_s + high_s), !was});
    }
    events.day = !events.crossings.empty() ? SunDay::rises_or_sets
                 : shows.front() != 0      ? SunDay::up_all_day
                                           : SunDay::down_all_day;
    return events;
}

}  // namespace oro
