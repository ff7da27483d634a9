// What a style has for pictures in daylight: the air, and what covers the ground. data/README.md lists the
// fields.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "apps/options/view_limits.h"
#include "shaders/shared.h"

namespace oro {

// The air of a style's "air". Throws a JsonFault: a field that is missing, unknown or bad.
gpu::AirModel air_of(const nlohmann::json& object);

// Dust, so that black can be told from the horizon's sky from so far away at sea level; within
// view_limits::visibility_km.
void set_visibility(double visibility_km, gpu::AirModel& air);

// What covers the ground, of a style's "cover"; its colour as the tints are: sRGB codes, or linear light.
// Throws a JsonFault.
gpu::GroundCover cover_of(const nlohmann::json& object, bool as_codes);

}  // namespace oro
