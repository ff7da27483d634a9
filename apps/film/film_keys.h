// Changes of a film's keys, one at a time, as a person makes them. Times always ascend.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/film/camera_path.h"

namespace oro {

// Two keys are so far apart in time at least.
inline constexpr double least_key_gap_s = 0.01;

// Adds what a camera sees as the last key, so much after the one that was last: at 0 where there was none.
void add_key(std::vector<CameraKey>& keys, const Camera& camera, double after_s);
// Removes a key; the times of all others stay.
void remove_key(std::vector<CameraKey>& keys, std::size_t number);
// A key and the one after it change places; each takes the other's time, and what the clock shows then.
// Nothing where there is none after it.
void swap_with_next(std::vector<CameraKey>& keys, std::size_t number);
// Gives a key a time, least_key_gap_s after the key before it at least; all keys after it are moved by as
// much.
void set_key_time(std::vector<CameraKey>& keys, std::size_t number, double time_s);

}  // namespace oro
