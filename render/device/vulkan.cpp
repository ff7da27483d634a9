#include "render/device/vulkan.h"

namespace oro {

std::string vulkan_result_name(VkResult result) {
    switch (result) {
#define ORO_NAME(name) \
    case name:         \
        return #name
        ORO_NAME(VK_SUCCESS);
        ORO_NAME(VK_NOT_READY);
        ORO_NAME(VK_TIMEOUT);
        ORO_NAME(VK_INCOMPLETE);
        ORO_NAME(VK_ERROR_OUT_OF_HOST_MEMORY);
        ORO_NAME(VK_ERROR_OUT_OF_DEVICE_MEMORY);
        ORO_NAME(VK_ERROR_INITIALIZATION_FAILED);
        ORO_NAME(VK_ERROR_DEVICE_LOST);
        ORO_NAME(VK_ERROR_MEMORY_MAP_FAILED);
        ORO_NAME(VK_ERROR_LAYER_NOT_PRESENT);
        ORO_NAME(VK_ERROR_EXTENSION_NOT_PRESENT);
        ORO_NAME(VK_ERROR_FEATURE_NOT_PRESENT);
        ORO_NAME(VK_ERROR_INCOMPATIBLE_DRIVER);
        ORO_NAME(VK_ERROR_TOO_MANY_OBJECTS);
        ORO_NAME(VK_ERROR_FORMAT_NOT_SUPPORTED);
        ORO_NAME(VK_ERROR_SURFACE_LOST_KHR);
        ORO_NAME(VK_ERROR_NATIVE_WINDOW_IN_USE_KHR);
        ORO_NAME(VK_SUBOPTIMAL_KHR);
        ORO_NAME(VK_ERROR_OUT_OF_DATE_KHR);
#undef ORO_NAME
        default:
            return "VkResult " + std::to_string(static_cast<int>(result));
    }
}

std::string vulkan_reason(VkResult result) {
    const std::string name = vulkan_result_name(result);
    switch (result) {
        case VK_ERROR_OUT_OF_DEVICE_MEMORY:
            return name +
                   ": the GPU has no memory left for this; a smaller --size or --gpu-memory needs less";
        case VK_ERROR_OUT_OF_HOST_MEMORY:
            return name + ": this machine has no memory left for the GPU's driver";
        case VK_ERROR_DEVICE_LOST:
            return name + ": the GPU was reset or its driver has failed; the same command may do it now";
        default:
            return name;
    }
}

Result<void> vulkan_checked(VkResult result, const char* call) {
    if (result == VK_SUCCESS) return {};
    const std::string text(call);
    return Error{ErrorKind::failed, "Vulkan",
                 text.substr(0, text.find('(')) + " gave " + vulkan_reason(result)};
}

}  // namespace oro
