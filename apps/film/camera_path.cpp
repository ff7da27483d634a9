#include "apps/film/camera_path.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "core/earth/rotation.h"
#include "geo/places/geodesic.h"

namespace oro {
namespace {

constexpr double same_time_s = 1e-9;
// A shorter way has no direction worth the name.
constexpr double shortest_way_m = 1e-3;

// From axes right, ahead, up of the camera to east, north, up.
glm::dquat quaternion_of(const Attitude& attitude) {
    return rotation_about(-attitude.heading_deg, {0.0, 0.0, 1.0}) *
           rotation_about(attitude.pitch_deg, {1.0, 0.0, 0.0}) *
           rotation_about(attitude.roll_deg, {0.0, 1.0, 0.0});
}

Attitude attitude_of(const glm::dquat& turn) {
    const glm::dmat3 axes = glm::mat3_cast(glm::normalize(turn));
    const glm::dvec3 &right = axes[0], &ahead = axes[1], &up = axes[2];
    const auto angle_deg = [](double y, double x) { return deg_from_radians(Radians{std::atan2(y, x)}); };
    const double level = std::hypot(ahead.x, ahead.y);
    Attitude attitude;
    attitude.pitch_deg = angle_deg(ahead.z, level);
    // Straight up or down heading and roll are one turn: it is the heading's.
    if (level < 1e-9) {
        attitude.heading_deg = turned_to_circle_deg(angle_deg(-right.y, right.x));
        return attitude;
    }
    attitude.heading_deg = turned_to_circle_deg(angle_deg(ahead.x, ahead.y));
    attitude.roll_deg = angle_deg(-right.z, up.z);
    return attitude;
}

double bearing_deg(const LatLon& from, const LatLon& to) {
    return geodesic_between(from.lat_deg, from.lon_deg, to.lat_deg, to.lon_deg).bearing_deg;
}

LatLon place_of(const CameraKey& key) {
    return {key.eye.lat_deg, key.eye.lon_deg};
}

Attitude headed(Attitude attitude, double by_deg) {
    attitude.heading_deg = turned_to_circle_deg(attitude.heading_deg + by_deg);
    return attitude;
}

template <class Value>
MonotoneCubic cubic_of(const std::vector<CameraKey>& keys, Value value) {
    std::vector<double> times_s, values;
    for (const CameraKey& key : keys) {
        times_s.push_back(key.time_s);
        values.push_back(value(key));
    }
    return {std::move(times_s), std::move(values)};
}

}  // namespace

Attitude turned_between(const Attitude& from, const Attitude& to, double part) {
    return attitude_of(glm::slerp(quaternion_of(from), quaternion_of(to), part));
}

CameraPath::CameraPath(std::vector<CameraKey> keys) : keys_(std::move(keys)) {
    assert(!keys_.empty());
    std::vector<double> along_m{0.0};
    for (std::size_t i = 0; i + 1 < keys_.size(); ++i) {
        const LatLon from = place_of(keys_[i]), to = place_of(keys_[i + 1]);
        const GeodesicPath way = geodesic_between(from.lat_deg, from.lon_deg, to.lat_deg, to.lon_deg);
        Leg leg{way.distance_m, way.bearing_deg, way.bearing_deg};
        if (leg.length_m > shortest_way_m) leg.end_bearing_deg = bearing_deg(to, from) + 180.0;
        legs_.push_back(leg);
        along_m.push_back(along_m.back() + leg.length_m);
    }
    for (std::size_t i = 0; i < keys_.size(); ++i)
        if (keys_[i].time_utc_s) clock_keys_.push_back(i);
    std::size_t number = 0;
    along_m_ = cubic_of(keys_, [&](const CameraKey&) { return along_m[number++]; });
    h_m_ = cubic_of(keys_, [](const CameraKey& key) { return key.eye.h_m; });
    fov_deg_ = cubic_of(keys_, [](const CameraKey& key) { return key.vertical_fov_deg; });
}

std::optional<std::int64_t> CameraPath::clock_at(double time_s) const {
    if (clock_keys_.empty()) return std::nullopt;
    const auto key_time_s = [&](std::size_t number) { return keys_[number].time_s; };
    const auto first = std::ranges::lower_bound(clock_keys_, time_s, {}, key_time_s);
    const CameraKey* const behind = first == clock_keys_.end() ? nullptr : &keys_[*first];
    const bool is_at_key = behind != nullptr && behind->time_s == time_s;
    const CameraKey* const before = is_at_key                      ? behind
                                    : first != clock_keys_.begin() ? &keys_[*(first - 1)]
                                                                   : nullptr;
    const CameraKey& from = before != nullptr ? *before : *behind;
    double rate = 1.0;
    if (before != nullptr && behind != nullptr && behind != before)
        rate = static_cast<double>(*behind->time_utc_s - *before->time_utc_s) /
               (behind->time_s - before->time_s);
    // A second that begins within rounding has begun.
    return *from.time_utc_s + static_cast<std::int64_t>(std::floor((time_s - from.time_s) * rate + 1e-6));
}

CameraKey CameraPath::at(double time_s) const {
    const double held_s = std::clamp(time_s, keys_.front().time_s, keys_.back().time_s);
    const auto near = std::ranges::lower_bound(keys_, held_s - same_time_s, {}, &CameraKey::time_s);
    if (near != keys_.end() && near->time_s - held_s <= same_time_s) {
        CameraKey there = *near;
        there.time_utc_s = clock_at(near->time_s);
        return there;
    }
    const auto next = std::ranges::upper_bound(keys_, held_s, {}, &CameraKey::time_s);
    const auto i = static_cast<std::size_t>(next - keys_.begin()) - 1;
    const CameraKey &from = keys_[i], &to = keys_[i + 1];
    const Leg& leg = legs_[i];
    const double part = (held_s - from.time_s) / (to.time_s - from.time_s);
    CameraKey there{held_s, from.eye, {}, fov_deg_.at(held_s), clock_at(held_s)};
    there.eye.h_m = h_m_.at(held_s);
    if (!(leg.length_m > shortest_way_m)) {
        there.attitude = turned_between(from.attitude, to.attitude, part);
        return there;
    }
    const double before_m = along_m_.at(from.time_s);
    const double along_m = std::clamp(along_m_.at(held_s) - before_m, 0.0, leg.length_m);
    const LatLon place = geodesic_towards(from.eye.lat_deg, from.eye.lon_deg, leg.bearing_deg, along_m);
    there.eye.lat_deg = place.lat_deg;
    there.eye.lon_deg = place.lon_deg;
    // Asked of the end that is farther away, so that its direction is sure.
    const double ahead_deg = 2.0 * along_m < leg.length_m ? bearing_deg(place, place_of(to))
                                                          : bearing_deg(place, place_of(from)) + 180.0;
    there.attitude = headed(turned_between(headed(from.attitude, -leg.bearing_deg),
                                           headed(to.attitude, -leg.end_bearing_deg), part),
                            ahead_deg);
    return there;
}

}  // namespace oro
