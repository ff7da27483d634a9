// Small ground under all Vulkan code here: results checked in every build, handles owned by one owner.
#pragma once

#include <vulkan/vulkan.h>

#include <string>
#include <utility>

#include "core/base/result.h"

namespace oro {

// The name of a VkResult as the specification writes it, or its number.
std::string vulkan_result_name(VkResult result);

// The name of a result with what it means to whoever runs the program, where that helps.
std::string vulkan_reason(VkResult result);

// Whether a result tells that there is no memory left, on the device or for its driver.
inline bool is_out_of_memory(VkResult result) {
    return result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY;
}

// An Error that names the call and its result, or nothing for VK_SUCCESS.
Result<void> vulkan_checked(VkResult result, const char* call);

#define ORO_VK(call) ORO_CHECK(::oro::vulkan_checked((call), #call))

// Owns one handle made from a VkDevice; Destroy is its vkDestroy or vkFree function.
template <class Handle, auto Destroy>
class DeviceOwned {
  public:
    DeviceOwned() = default;
    DeviceOwned(VkDevice device, Handle handle) : device_(device), handle_(handle) {}
    DeviceOwned(DeviceOwned&& other) noexcept { *this = std::move(other); }
    DeviceOwned& operator=(DeviceOwned&& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(handle_, other.handle_);
        return *this;
    }
    DeviceOwned(const DeviceOwned&) = delete;
    DeviceOwned& operator=(const DeviceOwned&) = delete;
    ~DeviceOwned() {
        if (handle_) Destroy(device_, handle_, nullptr);
    }

    [[nodiscard]] Handle get() const { return handle_; }
    explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

  private:
    VkDevice device_{VK_NULL_HANDLE};
    Handle handle_{VK_NULL_HANDLE};
};

using OwnedMemory = DeviceOwned<VkDeviceMemory, vkFreeMemory>;
using OwnedBuffer = DeviceOwned<VkBuffer, vkDestroyBuffer>;
using OwnedImage = DeviceOwned<VkImage, vkDestroyImage>;
using OwnedImageView = DeviceOwned<VkImageView, vkDestroyImageView>;
using OwnedShader = DeviceOwned<VkShaderModule, vkDestroyShaderModule>;
using OwnedPipeline = DeviceOwned<VkPipeline, vkDestroyPipeline>;
using OwnedPipelineLayout = DeviceOwned<VkPipelineLayout, vkDestroyPipelineLayout>;
using OwnedSetLayout = DeviceOwned<VkDescriptorSetLayout, vkDestroyDescriptorSetLayout>;
using OwnedDescriptorPool = DeviceOwned<VkDescriptorPool, vkDestroyDescriptorPool>;
using OwnedCommandPool = DeviceOwned<VkCommandPool, vkDestroyCommandPool>;
using OwnedFence = DeviceOwned<VkFence, vkDestroyFence>;
using OwnedSemaphore = DeviceOwned<VkSemaphore, vkDestroySemaphore>;
using OwnedQueryPool = DeviceOwned<VkQueryPool, vkDestroyQueryPool>;

}  // namespace oro
