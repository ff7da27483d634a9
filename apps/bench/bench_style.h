// The colours and the light that benchmarks draw with: the same in each, so that their pictures can be compared.
#pragma once

#include "shaders/shared.h"

namespace oro {

inline gpu::FrameStyle bench_style() {
    gpu::FrameStyle style{};
    style.tint_count = 2;
    style.tints[0] = {0.0F, gpu::vec3(0.2F, 0.3F, 0.1F)};
    style.tints[1] = {1500.0F, gpu::vec3(0.8F)};
    style.sun_enu = gpu::vec3(-0.5F, 0.5F, 0.7071F);
    style.ambient = 0.2F;
    style.relief = 1.0F;
    style.haze_distance_m = 1e5F;
    style.sky_scale_height_m = 8000.0F;
    return style;
}

}  // namespace oro
