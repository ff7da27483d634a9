// How far from the eye single trees are drawn, of a whole picture.
#pragma once

#include "core/earth/camera.h"

namespace oro {

// Metres from the eye: no tree of a picture is farther (shaders/growth/reach.glsl).
double reach_of_trees_m(const Camera& camera, double tau_px);

}  // namespace oro
