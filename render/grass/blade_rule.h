// The rule of blades as the GPU has it (shaders/grass/blade.glsl), compiled as C++: where clumps stand, what
// their blades look like, which of them a picture needs.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shaders/grass/shared_grass.h"

namespace oro::gpu {

using glm::abs;
using glm::dot;
using std::cos;
using std::floor;
using std::max;
using std::min;
using std::sin;
using std::sqrt;
#define ORO_FUNCTION inline
#define ORO_PRECISE
#include "shaders/grass/blade.glsl"
#undef ORO_FUNCTION
#undef ORO_PRECISE

}  // namespace oro::gpu
