// The programs that draw grass.
#pragma once

#include "render/device/gpu.h"
#include "render/grass/grass_renderer.h"

namespace oro {

// Programs that are compute alone: of place_clumps.comp, cull_clumps.comp. Errors: the device.
Result<OwnedPipeline> create_clump_placer(const Gpu& gpu, VkPipelineLayout layout);
Result<OwnedPipeline> create_clump_cull(const Gpu& gpu, VkPipelineLayout layout);

// Draws the listed clumps by a way that the device can. Errors: the device.
Result<OwnedPipeline> create_grass_pipeline(const Gpu& gpu, VkPipelineLayout layout, GrassWay way);

}  // namespace oro
