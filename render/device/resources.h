// Buffers and images with their memory; each has one owner and a name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "render/device/gpu.h"
#include "shaders/shared.h"

namespace oro {

// A buffer with its own memory. Host-visible ones stay mapped and coherent.
struct Buffer {
    OwnedMemory memory;
    OwnedBuffer handle;
    VkDeviceSize size{};
    VkDeviceAddress address{};  // 0 unless made with SHADER_DEVICE_ADDRESS usage
    std::byte* mapped{nullptr};
};
// A device address as shaders take it, low word first.
inline gpu::uvec2 address_words(VkDeviceAddress address) {
    return {static_cast<std::uint32_t>(address), static_cast<std::uint32_t>(address >> 32U)};
}
enum class MemoryKind { device, upload, readback };
// Errors: the device is out of memory (the message says how much was asked for what; `full`, if given, is set
// to true then).
Result<Buffer> create_buffer(const Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage,
                             MemoryKind memory_kind, const std::string& name, bool* full = nullptr);

// A 2D image with its own memory and a view of all of it.
struct Image {
    OwnedMemory memory;
    OwnedImage handle;
    OwnedImageView view;
    VkFormat format{};
    VkExtent2D extent{};
};

// A view of all of an image that has one level and one layer. Errors: the device's.
Result<OwnedImageView> create_image_view(const Gpu& gpu, VkImage image, VkFormat format,
                                         VkImageAspectFlags aspect, const std::string& name);
Result<Image> create_image(const Gpu& gpu, VkFormat format, VkExtent2D extent, VkImageUsageFlags usage,
                           VkImageAspectFlags aspect, const std::string& name);

// Waits for a fence that was submitted, and takes it back. Where the wait fails, nothing is under way on the
// device any more all the same. Errors: the device is lost or out of memory.
Result<void> wait_for(const Gpu& gpu, VkFence fence);

// One command buffer and a fence: record, submit, wait.
class Commands {
  public:
    static Result<Commands> create(const Gpu& gpu, const std::string& name);
    // Records with `record`, submits, and waits for the end. Errors: the device is lost or out of memory.
    Result<void> run(const Gpu& gpu, const std::function<void(VkCommandBuffer)>& record);
    // For callers that submit by themselves (a window).
    Result<VkCommandBuffer> begin();
    [[nodiscard]] VkFence fence() const { return fence_.get(); }

  private:
    OwnedCommandPool pool_;
    OwnedFence fence_;
    VkCommandBuffer buffer_{VK_NULL_HANDLE};
};

// A barrier for memory alone; stages and accesses as in VkMemoryBarrier2.
void memory_barrier(VkCommandBuffer commands, VkPipelineStageFlags2 from, VkAccessFlags2 written,
                    VkPipelineStageFlags2 to, VkAccessFlags2 read);
// A barrier that moves an image to another layout.
struct ImageUse {
    VkImageLayout layout;
    VkPipelineStageFlags2 stage;
    VkAccessFlags2 access;
};
void image_barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, ImageUse from,
                   ImageUse to);

}  // namespace oro
