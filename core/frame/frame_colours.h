// The colours of pictures that explain a frame (shaders/shade/show_colours.glsl), for their legends.
#pragma once

#include "shaders/shared.h"

namespace oro {

// sRGB, 0 to 1. Of a level of pages, or of a cluster graph.
gpu::vec3 colour_of_level(gpu::uint level);
// The colour of a meshlet that the frame's last round drew, or one before it.
gpu::vec3 colour_of_round(bool before_last);
// The colour of a pixel that so many triangles cover.
gpu::vec3 colour_of_overdraw(gpu::uint triangles);
// The colour of a meshlet or a triangle by its number.
gpu::vec3 colour_of_number(gpu::uint number);

}  // namespace oro
