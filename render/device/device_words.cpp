#include "render/device/device_report.h"

namespace oro {

std::string kind_words(VkPhysicalDeviceType kind) {
    switch (kind) {
        case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
            return "discrete GPU";
        case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
            return "integrated GPU";
        case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
            return "virtual GPU";
        case VK_PHYSICAL_DEVICE_TYPE_CPU:
            return "software";
        default:
            return "other";
    }
}

std::string version_words(std::uint32_t vulkan_version) {
    return std::to_string(VK_API_VERSION_MAJOR(vulkan_version)) + "." +
           std::to_string(VK_API_VERSION_MINOR(vulkan_version)) + "." +
           std::to_string(VK_API_VERSION_PATCH(vulkan_version));
}

std::string lack_words(DeviceLack lack) {
    switch (lack) {
        case DeviceLack::vulkan_1_3:
            return "Vulkan 1.3";
        case DeviceLack::buffer_device_address:
            return "bufferDeviceAddress";
        case DeviceLack::scalar_block_layout:
            return "scalarBlockLayout";
        case DeviceLack::synchronization2:
            return "synchronization2";
        case DeviceLack::dynamic_rendering:
            return "dynamicRendering";
        case DeviceLack::maintenance4:
            return "maintenance4";
        case DeviceLack::way_of_drawing:
            return "VK_EXT_mesh_shader and 64-bit atomics (one of them is needed)";
        case DeviceLack::queue:
            return "a queue for graphics and compute with timestamps";
        case DeviceLack::swapchain:
            return VK_KHR_SWAPCHAIN_EXTENSION_NAME;
    }
    return "";
}

}  // namespace oro
