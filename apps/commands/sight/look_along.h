// What sight and profile find, for whoever has the ground: the commands, and a window that measures.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "apps/commands/sight/line_along.h"
#include "apps/commands/sight/profile_text.h"
#include "apps/commands/sight/sight_text.h"
#include "core/sight/ground_profile.h"
#include "core/truth/true_ground.h"

namespace oro {

// How a line of sight from one point to another runs. Nothing of how the eye came there.
SightReport look_along(const Geodetic& from, const Geodetic& to, const Air& air, const TrueGround& ground);

// The points of a profile: one each step_m and the last, or where nothing is given all that the ground has
// (add_profile()). `progress` is told how far it is after some thousand points each.
std::vector<ProfilePoint> profile_points(const LineAlong& line, const std::optional<double>& step_m,
                                         const TrueGround& ground, const ProfileProgress& progress = {});

// Where the points of a profile along a line pass the 180th meridian.
std::vector<MeridianCrossing> crossings_of(const LineAlong& line, std::span<const ProfilePoint> points,
                                           const TrueGround& ground);

}  // namespace oro
