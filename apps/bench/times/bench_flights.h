// Eyes in motion over a region, frame after frame: as a window's user flies.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/earth/camera.h"
#include "core/frame/region_pages.h"

namespace oro {

struct RandomFlight {
    std::string name;  // tells where it begins and how high
    std::vector<Camera> cameras;
};

// From one camera to the next so much time passes in the world, seconds, however long a frame takes: one seed
// gives the same frames everywhere.
inline constexpr double flight_step_s = 1.0 / 60.0;
// A flight's speed, metres a second, so high above the ground: half of its height each second, 50 to 5,000.
[[nodiscard]] double random_flight_speed_m_s(double above_m);

// `count` flights of so many frames. Each begins over a post that is there, every one with the same chance,
// 2 m to 20 km above the ground (log-uniform), and climbs or sinks evenly by a factor of at most two. It
// turns by up to 20 degrees a second, and back towards the middle near the region's rim; it looks ahead,
// 0 to 30 degrees below the horizon. Errors: a file that cannot be read; a region whose posts lie on a net,
// or that has none.
Result<std::vector<RandomFlight>> random_flights(const RegionPages& pages, int count, int frames,
                                                 std::uint64_t seed, int width_px, int height_px);

}  // namespace oro
