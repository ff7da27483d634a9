// Buffers and images with their memory; each has one owner and a name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>

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
// mapped_device: the device's own, that the host writes to, and where it has none such, upload.
enum class MemoryKind { device, upload, readback, mapped_device };
// Errors: the device is out of memory (the message says how much was asked for what; `full`, if given, is set
// to true then).
Result<Buffer> create_buffer(const Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage,
                             MemoryKind memory_kind, const std::string& name, bool* full = nullptr);

// A buffer in the place of a smaller one, or of none: once nothing on the device uses that any more. Errors:
// as create_buffer(); the old one stays then.
Result<void> replace_buffer(const Gpu& gpu, Buffer& buffer, VkDeviceSize size, VkBufferUsageFlags usage,
                            MemoryKind memory_kind, const std::string& name);

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

// How many frames may be under way on a device at a time. What the host writes for a frame, or reads of it,
// there is as often; what the device alone writes there is once: the queue draws one frame after the other.
inline constexpr std::size_t frames_in_flight = 2;

// What commands wait for before they begin, and what they signal at their end; null: nothing.
struct Semaphores {
    VkSemaphore waits{VK_NULL_HANDLE};
    VkSemaphore signals{VK_NULL_HANDLE};
};

// One command buffer and a fence: record, submit, wait.
class Commands {
  public:
    using Record = std::function<void(VkCommandBuffer)>;
    static Result<Commands> create(const Gpu& gpu, const std::string& name);
    Commands() = default;
    Commands(Commands&& other) noexcept { *this = std::move(other); }
    Commands& operator=(Commands&& other) noexcept;
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;
    // Waits for what is under way. Whoever owns what the commands use declares them after it.
    ~Commands();

    // Records with `record`, submits, and waits for the end. Errors: the device is lost or out of memory.
    Result<void> run(const Gpu& gpu, const Record& record);
    // The same without the wait for the end; what was submitted before is waited for first.
    Result<void> submit(const Gpu& gpu, const Record& record, const Semaphores& semaphores = {});
    // Waits for the end of what was submitted, if it was not waited for yet. Where that fails, nothing is
    // under way on the device any more all the same. Errors: the device is lost or out of memory.
    Result<void> wait();

  private:
    OwnedCommandPool pool_;
    OwnedFence fence_;
    VkCommandBuffer buffer_{VK_NULL_HANDLE};
    VkDevice under_way_{VK_NULL_HANDLE};  // the device where something is; null: nothing is
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
// All that was submitted before is done, and what it wrote can be read and written by all that follows.
void wait_for_earlier(VkCommandBuffer commands);

}  // namespace oro
