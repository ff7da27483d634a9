// The programs that draw patches of fixed size.
#pragma once

#include "render/device/gpu.h"
#include "render/patches/fixed_patches.h"

namespace oro {

// The program that gives each patch its level (choose_patches.comp). Errors: the device.
Result<OwnedPipeline> create_patch_choice(const Gpu& gpu, VkPipelineLayout layout);

// Draws patches by a way that the device can. Errors: the device.
Result<OwnedPipeline> create_patch_pipeline(const Gpu& gpu, VkPipelineLayout layout, PatchWay way);

}  // namespace oro
