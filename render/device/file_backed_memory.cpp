#include "render/device/software_driver.h"

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/base/system_room.h"
#include "render/device/vulkan.h"

namespace oro {
namespace {

// For what the driver takes between two allocations of ours.
constexpr VkDeviceSize driver_slack_bytes = VkDeviceSize{4} << 20U;

}  // namespace

Result<void> check_room_in_file(const Gpu& gpu, const VkMemoryAllocateInfo& info, const std::string& name) {
    if (gpu.report().kind != VK_PHYSICAL_DEVICE_TYPE_CPU) return {};
    const std::optional<std::uint64_t> limit = file_size_limit_bytes();
    if (!limit) return {};
    if (!gpu.memory_type(1U << info.memoryTypeIndex, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT)) return {};
    VkMemoryAllocateInfo more = info;
    more.allocationSize += driver_slack_bytes;
    VkDeviceMemory handle{};
    // Without room for the slack the allocation itself is told, if it fails.
    if (vkAllocateMemory(gpu.device(), &more, nullptr, &handle) != VK_SUCCESS) return {};
    const OwnedMemory memory(gpu.device(), handle);
    void* mapped = nullptr;
    if (vkMapMemory(gpu.device(), handle, 0, VK_WHOLE_SIZE, 0, &mapped) != VK_SUCCESS) return {};
    const bool there = is_memory_there(static_cast<const std::byte*>(mapped) + more.allocationSize - 1);
    vkUnmapMemory(gpu.device(), handle);
    if (there) return {};
    return Error{ErrorKind::failed, gpu.report().name,
                 "has no room for " + std::to_string((info.allocationSize + 1023) >> 10U) + " KiB of " +
                     name + ": it keeps its memory in a file, and files may have " +
                     std::to_string(*limit >> 10U) + " KiB here (ulimit -f)"};
}

}  // namespace oro
