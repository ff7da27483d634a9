// Brute force: a skyline from the oracle for each fiftieth of a degree, and the sun's whole disc held against
// it every second. Knows nothing of limbs, steps and bisection in time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/base/parallel.h"
#include "core/light/sun_position.h"
#include "core/truth/oracle.h"

namespace oro::test {

inline constexpr int skyline_cells = 18000;
inline std::size_t skyline_cell(double azimuth_deg) {
    return static_cast<std::size_t>((std::lround(azimuth_deg * 50.0) % skyline_cells + skyline_cells) %
                                    skyline_cells);
}

// The skyline's elevation in each cell that is `wanted`, to 0.001 degree; -90 where nothing is hit.
inline std::vector<double> skyline_deg(const TrueSurface& surface, const Geodetic& eye, const Air& air,
                                       const std::vector<std::uint8_t>& wanted, int threads) {
    const Oracle oracle(surface, sight_from(eye, air));
    const glm::dmat3 frame = ecef_from_enu(eye.lat_deg, eye.lon_deg);
    std::vector<double> skyline(skyline_cells, -90.0);
    in_parallel(skyline_cells, threads, [&](int i) {
        if (!wanted[static_cast<std::size_t>(i)]) return;
        const double azimuth = radians_from_deg(i * 0.02).rad;
        const auto blocked = [&](double elevation_deg) {
            const double up = radians_from_deg(elevation_deg).rad;
            return oracle
                .first_hit(frame * glm::dvec3(std::sin(azimuth) * std::cos(up),
                                              std::cos(azimuth) * std::cos(up), std::sin(up)),
                           sight_reach_m(eye.h_m))
                .has_value();
        };
        double low_deg = -4.0, high_deg = 89.0;
        if (!blocked(low_deg)) return;
        while (high_deg - low_deg > 0.001) {
            const double middle_deg = 0.5 * (low_deg + high_deg);
            (blocked(middle_deg) ? low_deg : high_deg) = middle_deg;
        }
        skyline[static_cast<std::size_t>(i)] = high_deg;
    });
    return skyline;
}

// Calls take(azimuth, airless elevation) for 41 columns of the disc, with the top of each, while the sun may
// show.
template <class Take>
void for_columns(double time_utc_s, const Geodetic& eye, const Take& take) {
    const SunPosition sun = sun_position(time_utc_s, eye);
    if (sun.airless_elevation_deg < -5.0) return;
    const double across = std::cos(radians_from_deg(sun.airless_elevation_deg).rad);
    for (int x = -20; x <= 20; ++x) {
        double highest = -1.0;
        for (int y = -20; y <= 20; ++y) {
            if (x * x + y * y <= 400) highest = std::max(highest, y / 20.0);
        }
        take(sun.azimuth_deg + x / 20.0 * sun.radius_deg / across,
             sun.airless_elevation_deg + highest * sun.radius_deg);
    }
}

// When any point of the disc comes out over the skyline or the last one goes: to the second, over 24 hours.
// Where the sun stands higher than 45 degrees it is taken to show.
inline std::vector<SunCrossing> scanned_crossings(const TrueSurface& surface, const Geodetic& eye,
                                                  const Air& air, double from_utc_s, int threads) {
    constexpr double surely_free_deg = 45.0;
    constexpr int seconds = 86400;
    std::vector<std::uint8_t> wanted(skyline_cells);
    for (int i = 0; i <= seconds; i += 4)
        for_columns(from_utc_s + i, eye, [&](double azimuth_deg, double airless_deg) {
            for (int step = -1; step <= 1; ++step) {
                if (airless_deg < surely_free_deg + 1.0) wanted[skyline_cell(azimuth_deg + step * 0.02)] = 1;
            }
        });
    const std::vector<double> skyline = skyline_deg(surface, eye, air, wanted, threads);
    std::vector<std::uint8_t> seen(seconds + 1);
    in_parallel(seconds + 1, threads, [&](int i) {
        bool shows = false;
        for_columns(from_utc_s + i, eye, [&](double azimuth_deg, double airless_deg) {
            shows = shows || airless_deg >= surely_free_deg ||
                    seen_elevation_deg(airless_deg, eye.h_m) > skyline[skyline_cell(azimuth_deg)];
        });
        seen[static_cast<std::size_t>(i)] = shows ? 1 : 0;
    });
    std::vector<SunCrossing> crossings;
    for (std::size_t i = 0; i + 1 < seen.size(); ++i) {
        if (seen[i] != seen[i + 1])
            crossings.push_back({from_utc_s + static_cast<double>(i) + 0.5, seen[i + 1] != 0});
    }
    return crossings;
}

}  // namespace oro::test
