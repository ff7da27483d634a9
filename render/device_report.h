// What a physical device has and lacks.
#pragma once

#include "render/gpu.h"

namespace oro {

DeviceReport describe_device(VkPhysicalDevice physical, const GpuOptions& options);

// A queue family for graphics and compute; nothing when the device has none.
std::optional<std::uint32_t> graphics_queue_family(VkPhysicalDevice physical);

}  // namespace oro
