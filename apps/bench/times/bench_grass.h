// Grass by four ways, timed as the dissertation on grass by mesh shaders has it: --grass.
#pragma once

#include <cstdint>
#include <vector>

#include "render/device/gpu.h"
#include "render/grass/grass_scene.h"

namespace oro {

struct GrassBenchOptions {
    std::uint32_t blades{grass_published_blades.back()};  // of the field
    std::uint32_t width_px{grass_width_px};
    std::uint32_t height_px{grass_height_px};
    int frames{30};
    double warm_up_s{0.1};  // before those that count, for each cell of a table
    bool by_boxes{false};   // clumps are left out by boxes around what they cover
    bool thins{false};
    bool wind{false};
    bool json{false};
};

// Prints tables of the eye's height down and the switch distance across, one for each way that the device
// can, and how many pixels show another blade than by the vertex way at full detail. Errors: the device.
Result<void> print_grass(const Gpu& gpu, const GrassBenchOptions& options);

}  // namespace oro
