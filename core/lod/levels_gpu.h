// The GPU's own choice of levels (shaders/choose/levels.glsl) compiled for the CPU, in float.
#pragma once

#include <algorithm>
#include <cmath>

#include "shaders/shared.h"

namespace oro::gpu {
using std::min;
using std::sqrt;
#define ORO_FUNCTION inline
#define ORO_PRECISE
#include "shaders/choose/levels.glsl"
#undef ORO_FUNCTION
#undef ORO_PRECISE
}  // namespace oro::gpu
