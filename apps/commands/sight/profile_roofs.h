// The second line of a profile: what a plumb line meets first, where meshes stand on the ground.
#pragma once

#include <optional>

#include "apps/commands/sight/profile_text.h"
#include "apps/commands/sight/sight_ground.h"

namespace oro {

// Finds the roofs of a profile's points; nothing where the region has no meshes. Unless the points are to be
// `as_asked`, it adds points before and behind each side of a triangle that the line passes over, 1 mm apart:
// between neighbours the top is straight then.
void add_roofs(const SightGround& ground, bool as_asked, Profile& profile);
// Number of the point whose top is highest; nothing where there is none.
std::optional<std::size_t> highest_top(const Profile& profile);
// Metres of the line between points that both have a top.
double over_meshes_m(const Profile& profile);

}  // namespace oro
