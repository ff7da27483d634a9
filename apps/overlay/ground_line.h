// Lines of latitudes and longitudes laid on the true surface.
#pragma once

#include <functional>
#include <optional>

#include "core/truth/true_ground.h"
#include "geo/vectors/vector_file.h"

namespace oro {

// Takes the next place of a line on the ground; nothing where the ground ends and the line with it.
using PlaceSink = std::function<void(const std::optional<Geodetic>& place)>;

// Follows the way from one place to another on the ground: even in latitude and longitude, the shorter way
// round. Gives the first place, each place where the way comes to another triangle of the ground, and the
// last: between them the ground is as straight as the way. Places without ground end the line. Heights are
// the surface's; error: its own rounding.
void follow_ground(const TrueGround& ground, const VectorPlace& from, const VectorPlace& to,
                   const PlaceSink& sink);

}  // namespace oro
