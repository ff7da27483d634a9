// Doubles as pairs of floats, for positions that one float is too coarse for.
#pragma once

#include <glm/vec3.hpp>

#include "shaders/shared.h"

namespace oro {

// A double vector as two floats, high + low: high holds the leading 24 bits (cut off, not rounded), low the
// float nearest to the rest. Error of the sum: 2^-48 of the value.
void split_high_low(const glm::dvec3& value, gpu::vec3& high, gpu::vec3& low);

}  // namespace oro
