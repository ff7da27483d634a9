// Posts placed as shaders/place/place.glsl places them, in float, from a frame's tables.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/earth/camera.h"
#include "core/terrain/drawn_heights.h"
#include "shaders/shared.h"

namespace oro::test {

// A post's place relative to the eye, in the eye's meridian frame.
inline gpu::vec3 place_from_eye(const gpu::RowTerms& t, const gpu::ColumnTerms& u,
                                std::int32_t reference_steps, std::int32_t steps) {
    const float dh = static_cast<float>(steps - reference_steps) * gpu::height_step_m;
    const float r = t.P + dh * t.Q;
    return {(t.R + dh * t.C) - r * u.V, r * u.W, t.Z + dh * t.S};
}

// From the eye's meridian frame: x outward in the equatorial plane at the eye's longitude, y east, z north.
inline glm::dmat3 ecef_from_eye(const Geodetic& eye) {
    const SineCosine lon = sine_cosine_deg(eye.lon_deg);
    return {lon.cosine, lon.sine, 0.0, -lon.sine, lon.cosine, 0.0, 0.0, 0.0, 1.0};
}

}  // namespace oro::test
