#include "apps/panorama/elevations.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/base/parallel.h"
#include "core/light/sun_position.h"

namespace oro {
namespace {

constexpr double exact_deg = 0.01;
constexpr double step_deg = 0.5;     // from azimuth to azimuth
constexpr double ground_deg = 10.0;  // below the lowest place of the skyline
constexpr double sky_share = 0.16;   // of all elevations, above its highest
constexpr double least_sky_deg = 1.5;
constexpr double no_ground_deg = -89.0;

}  // namespace

double skyline_deg(const Oracle& oracle, const Geodetic& eye, double azimuth_deg, double reach_m) {
    const glm::dmat3 turn = ecef_from_enu(eye.lat_deg, eye.lon_deg);
    double free_deg = 90.0, hidden_deg = -90.0;
    while (free_deg - hidden_deg > exact_deg) {
        const double middle_deg = 0.5 * (free_deg + hidden_deg);
        const bool is_free = !oracle.first_hit(turn * enu_towards(azimuth_deg, middle_deg), reach_m);
        (is_free ? free_deg : hidden_deg) = middle_deg;
    }
    return free_deg;
}

Elevations elevations_for(const TrueGround& ground, const Geodetic& eye, const WorldModel& model,
                          double from_deg, double sweep_deg, int threads) {
    const Oracle oracle(ground, sight_of(model, eye));
    const double reach_m = sight_reach_m(eye.h_m);
    const glm::dmat3 turn = ecef_from_enu(eye.lat_deg, eye.lon_deg);
    struct Place {
        double deg;
        bool is_near;
    };
    std::vector<Place> skyline(static_cast<std::size_t>(std::ceil(sweep_deg / step_deg)) + 1);
    in_parallel(static_cast<int>(skyline.size()), threads, [&](int i) {
        const double azimuth_deg = from_deg + std::min(sweep_deg, i * step_deg),
                     deg = skyline_deg(oracle, eye, azimuth_deg, reach_m);
        const auto below = oracle.first_hit(turn * enu_towards(azimuth_deg, deg - 2.0 * exact_deg), reach_m);
        skyline[static_cast<std::size_t>(i)] = {deg, below && below->distance_m < at_the_feet_m};
    });
    double lowest_deg = 0.0, highest_deg = 0.0, nearest_deg = -90.0;
    for (const Place& place : skyline) {
        // Azimuths that look past all data tell nothing.
        if (place.deg < no_ground_deg) continue;
        if (place.is_near) {
            nearest_deg = std::max(nearest_deg, place.deg);
            continue;
        }
        lowest_deg = std::min(lowest_deg, place.deg);
        highest_deg = std::max(highest_deg, place.deg);
    }
    Elevations elevations;
    elevations.skyline_deg = highest_deg;
    elevations.low_deg = std::max(lowest_deg - ground_deg, -most_unasked_deg);
    const double sky_deg = std::max(least_sky_deg, sky_share * (highest_deg - elevations.low_deg));
    elevations.high_deg = std::min(highest_deg + sky_deg, most_unasked_deg);
    elevations.leaves_out_near = nearest_deg > elevations.high_deg;
    return elevations;
}

}  // namespace oro
