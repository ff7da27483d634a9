// What sight finds between two points, with what grows on the ground.
#pragma once

#include "apps/commands/sight/sight_ground.h"
#include "apps/commands/sight/sight_text.h"

namespace oro {

// How a line of sight from one point to another runs, over the ground or over the canopy on it where there is
// one: an eye in the canopy sees nothing. Nothing of how the eye came there. Posts that cannot be read count
// as void: ground.region.health() tells.
SightReport sight_between(const Geodetic& from, const Geodetic& to, const Air& air,
                          const SightGround& ground);

}  // namespace oro
