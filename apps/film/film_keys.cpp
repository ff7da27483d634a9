#include "apps/film/film_keys.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace oro {

void add_key(std::vector<CameraKey>& keys, const Camera& camera, double after_s) {
    CameraKey key;
    if (!keys.empty()) key.time_s = keys.back().time_s + std::max(after_s, least_key_gap_s);
    key.eye = camera.eye;
    key.attitude = camera.attitude;
    key.vertical_fov_deg = camera.vertical_fov_deg;
    keys.push_back(key);
}

void remove_key(std::vector<CameraKey>& keys, std::size_t number) {
    assert(number < keys.size());
    keys.erase(keys.begin() + static_cast<std::ptrdiff_t>(number));
}

void swap_with_next(std::vector<CameraKey>& keys, std::size_t number) {
    if (number + 1 >= keys.size()) return;
    CameraKey &one = keys[number], &next = keys[number + 1];
    std::swap(one, next);
    std::swap(one.time_s, next.time_s);
    std::swap(one.time_utc_s, next.time_utc_s);
}

void set_key_time(std::vector<CameraKey>& keys, std::size_t number, double time_s) {
    assert(number < keys.size());
    if (number > 0) time_s = std::max(time_s, keys[number - 1].time_s + least_key_gap_s);
    const double moved_s = time_s - keys[number].time_s;
    for (std::size_t i = number; i < keys.size(); ++i) keys[i].time_s += moved_s;
    keys[number].time_s = time_s;
}

}  // namespace oro
