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

Elevations elevations_for(const TrueSurface& surface, const Geodetic& eye, const WorldModel& model,
                          double from_deg, double sweep_deg, int threads) {
    const Oracle oracle(surface, sight_of(model, eye));
    const double reach_m = sight_reach_m(eye.h_m);
    std::vector<double> skyline(static_cast<std::size_t>(std::ceil(sweep_deg / step_deg)) + 1);
    in_parallel(static_cast<int>(skyline.size()), threads, [&](int i) {
        skyline[static_cast<std::size_t>(i)] =
            skyline_deg(oracle, eye, from_deg + std::min(sweep_deg, i * step_deg), reach_m);
    });
    // Azimuths that look past all data tell nothing.
    constexpr double no_ground_deg = -89.0;
    std::erase_if(skyline, [](double deg) { return deg < no_ground_deg; });
    if (skyline.empty()) return {-ground_deg, ground_deg, -90.0};
    const auto [lowest, highest] = std::ranges::minmax(skyline);
    Elevations elevations;
    elevations.skyline_deg = highest;
    elevations.low_deg = std::max(std::min(lowest, 0.0) - ground_deg, -most_unasked_deg);
    const double top_deg = std::max(highest, 0.0);
    const double sky_deg = std::max(least_sky_deg, sky_share * (top_deg - elevations.low_deg));
    elevations.high_deg = std::min(top_deg + sky_deg, most_unasked_deg);
    return elevations;
}

}  // namespace oro
