// What was done where somebody asked to stand on a summit, for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "core/terrain/summit.h"

namespace oro {

// "the eye stands on the highest post nearby: 46.536944 8.126111, H 4274.0 m, 41 m from the place that was
// given and 55.0 m higher"; that the ground goes on rising from there; or that it stays on the place because
// no post nearby is higher. who_stands: "the eye stands".
std::string summit_words(const std::string& who_stands, const MovedToSummit& moved);

// "a post 66 m away is 106.5 m higher"
std::string wall_words(const MovedToSummit& post);

// {"asked_lat_deg", "asked_lon_deg", "lat_deg", "lon_deg", "H_m", "moved_m", "higher_m", "goes_on_rising"}: H
// of the ground there; higher_m is null where the place itself has no height.
nlohmann::ordered_json summit_json(const MovedToSummit& moved);

// Tells people of a view's eye that was asked to stand on a summit; nothing of others, or where it is quiet.
void say_summit(const std::optional<MovedToSummit>& moved, bool quiet);

// Tells people of a post that stands as a wall before an eye (Standpoint::wall), and of --on-summit; nothing
// of others, or where it is quiet.
void say_wall(const std::optional<MovedToSummit>& wall, bool quiet);

}  // namespace oro
