// The words for what a device is and lacks.
#pragma once

#include <cstdint>
#include <string>

#include "render/device/gpu.h"

namespace oro {

std::string kind_words(VkPhysicalDeviceType kind);        // "discrete GPU", "software", ...
std::string version_words(std::uint32_t vulkan_version);  // "1.3.274"
std::string lack_words(DeviceLack lack);                  // "Vulkan 1.3", "bufferDeviceAddress", ...

}  // namespace oro
