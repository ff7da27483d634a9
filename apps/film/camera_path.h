// The way of a camera through time: keys, and what is between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "apps/film/monotone_cubic.h"
#include "core/earth/camera.h"

namespace oro {

// Where a camera is at a time of the film, and how it looks.
struct CameraKey {
    double time_s{};  // of the film
    Geodetic eye;
    Attitude attitude;
    double vertical_fov_deg{45.0};
    std::optional<std::int64_t> time_utc_s{};  // what a clock shows then; nothing: nobody says
};

// A camera's way, by keys whose times ascend. Between two keys the eye follows the shortest way over the
// ellipsoid. How far along all these ways it is, its height and its angle of view are monotone cubics in
// time: they pass through each key without a kink, and between two keys they never leave what these have. The
// attitude turns evenly in time about one axis, by the shorter way, relative to the direction of the shortest
// way over the ground: what flies straight over a pole looks straight ahead there, too.
//     const CameraPath path(keys);
//     const CameraKey there = path.at(2.5);
class CameraPath {
  public:
    // keys: one or more, whose times ascend strictly (the caller checks that).
    explicit CameraPath(std::vector<CameraKey> keys);

    // At a time, which is held to that of the first and of the last key. At the time of a key it is the key,
    // to the bit; a time within 1 ns of a key's is that. The heading is in [0, 360). The clock's time is
    // linear between keys that have one, goes on by seconds of the film beyond them, and is rounded down to
    // whole seconds.
    [[nodiscard]] CameraKey at(double time_s) const;
    [[nodiscard]] const std::vector<CameraKey>& keys() const { return keys_; }
    // From the first key to the last.
    [[nodiscard]] double duration_s() const { return keys_.back().time_s - keys_.front().time_s; }

  private:
    // From a key to the next, over the ellipsoid.
    struct Leg {
        double length_m{};
        double bearing_deg{};      // true, where it begins
        double end_bearing_deg{};  // and where it ends
    };
    [[nodiscard]] std::optional<std::int64_t> clock_at(double time_s) const;

    std::vector<CameraKey> keys_;
    std::vector<std::size_t> clock_keys_;  // those whose clock is known, ascending
    std::vector<Leg> legs_;
    MonotoneCubic along_m_;
    MonotoneCubic h_m_;
    MonotoneCubic fov_deg_;
};

// The attitude that lies the share `part` (0 to 1) of the turn from one to another, by the shorter way. Which
// way a turn of exactly half a circle goes is not promised. The heading is in [0, 360).
Attitude turned_between(const Attitude& from, const Attitude& to, double part);

}  // namespace oro
