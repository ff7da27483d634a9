// What a physical device has and lacks, and the words for that.
#pragma once

#include <cstdint>
#include <string>

#include "render/device/gpu.h"

namespace oro {

// Errors: the driver has no memory left to tell.
Result<DeviceReport> describe_device(VkPhysicalDevice physical, const GpuOptions& options);

// A queue family for graphics and compute; nothing when the device has none.
std::optional<std::uint32_t> graphics_queue_family(VkPhysicalDevice physical);

// The bits of a family's timestamps that mean something.
std::uint64_t timestamp_mask(VkPhysicalDevice physical, std::uint32_t queue_family);

std::string kind_words(VkPhysicalDeviceType kind);        // "discrete GPU", "software", ...
std::string version_words(std::uint32_t vulkan_version);  // "1.3.274"
std::string lack_words(DeviceLack lack);                  // "Vulkan 1.3", "bufferDeviceAddress", ...

}  // namespace oro
