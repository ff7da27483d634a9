#include "apps/commands/film/tour_keys.h"

#include <algorithm>
#include <cmath>

#include "apps/film/written_keys.h"
#include "core/earth/rotation.h"

namespace oro {
namespace {

Attitude attitude_of_camera(const TourView& view) {
    double pitch_deg = view.tilt_deg - 90.0, heading_deg = view.heading_deg, roll_deg = view.roll_deg;
    // Beyond straight up or down it looks the other way, upside down.
    if (std::abs(pitch_deg) > 90.0) {
        pitch_deg = (pitch_deg > 0.0 ? 180.0 : -180.0) - pitch_deg;
        heading_deg += 180.0;
        roll_deg += roll_deg > 0.0 ? -180.0 : 180.0;
    }
    return {turned_to_circle_deg(heading_deg), pitch_deg, roll_deg};
}

// The eye that looks at a place: so far from it, against its heading, as high as the tilt leaves it.
void look_at(const Geodetic& place, const TourView& view, CameraKey& key) {
    const SineCosine tilt = sine_cosine_deg(view.tilt_deg), heading = sine_cosine_deg(view.heading_deg);
    const glm::dvec3 back(-tilt.sine * heading.sine, -tilt.sine * heading.cosine, tilt.cosine);
    const double range_m = std::max(view.range_m, 1.0);
    key.eye = geodetic_from_ecef(
        Ecef{ecef_from_geodetic(place).m + ecef_from_enu(place.lat_deg, place.lon_deg) * (back * range_m)});
    key.attitude = attitude_towards(key.eye, place);
    constexpr double straight_down = 1e-6;
    if (std::abs(tilt.sine) < straight_down)
        key.attitude.heading_deg = turned_to_circle_deg(view.heading_deg);
}

}  // namespace

Result<std::vector<CameraKey>> keys_of_tour(const std::vector<TourStop>& stops, double vertical_fov_deg,
                                            const Region& region, double exaggeration,
                                            const std::string& where) {
    constexpr double shortest_s = 1e-3;
    std::vector<CameraKey> keys;
    for (const TourStop& stop : stops) {
        const TourView& view = stop.view;
        CameraKey key;
        key.time_s = keys.empty() ? 0.0 : keys.back().time_s + std::max(stop.duration_s, shortest_s);
        key.vertical_fov_deg = vertical_fov_deg;
        key.time_utc_s = view.time_utc_s;
        Geodetic place{view.lat_deg, view.lon_deg, view.height_m};
        ORO_TRY(place.h_m, h_over_region(place, view.heights, region, exaggeration, where));
        if (view.looks_at) {
            look_at(place, view, key);
        } else {
            key.eye = place;
            key.attitude = attitude_of_camera(view);
        }
        keys.push_back(key);
    }
    ORO_CHECK(check_keys(keys, where));
    return keys;
}

}  // namespace oro
