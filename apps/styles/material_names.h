// What styles call the materials of the ground.
#pragma once

#include <array>

#include "shaders/shared.h"

namespace oro {

// By number: gpu::material_rock and so on.
inline constexpr std::array<const char*, gpu::material_count> material_fields{
    "rock",  "scree", "meadow", "shrub", "needle_forest", "broad_forest",
    "crops", "bare",  "snow",   "water", "built",         "wetland"};

}  // namespace oro
