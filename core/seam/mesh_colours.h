// Colours of meshes that are no ground, as pictures of materials have them (shaders/shade/built_colour.glsl).
#pragma once

#include "shaders/shared.h"

namespace oro {

// Linear light, 0 to 1. Of a building: plaster where it is upright, gravel where it is level, and tiles
// between these. tone: as SeamPiece::tone. slope_deg: 0 level, 90 upright.
gpu::vec3 colour_of_building(float tone, float slope_deg);
// Of a mesh that does not say what it is of.
gpu::vec3 colour_of_plain_mesh();
// Of roads and squares. built: what the style has for built land.
gpu::vec3 colour_of_paving(const gpu::vec3& built);

}  // namespace oro
