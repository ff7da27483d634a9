// Ground of one grey in the sun and in haze.
#pragma once

#include "shaders/shared.h"

namespace oro::test {

// Lit from the south, 53 degrees high.
inline gpu::FrameStyle plain_style() {
    gpu::FrameStyle style{};
    style.tint_count = 1;
    style.tints[0].colour = gpu::vec3(0.5F);
    style.sun_enu = gpu::vec3(0.0F, 0.6F, 0.8F);
    style.relief = 1.0F;
    style.haze_distance_m = 1e5F;
    style.sky_scale_height_m = 8000.0F;
    return style;
}

}  // namespace oro::test
