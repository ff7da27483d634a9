#include "render/device/file_backed_memory.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>

#include "render/device/vulkan.h"

namespace oro {
namespace {

// For what the driver takes between two allocations of ours.
constexpr VkDeviceSize driver_slack_bytes = VkDeviceSize{4} << 20U;

// Nothing where files may be as long as they like.
rlim_t limit_of_files() {
    struct rlimit limit {};
    return getrlimit(RLIMIT_FSIZE, &limit) == 0 ? limit.rlim_cur : RLIM_INFINITY;
}

// Whether a byte can be read: the kernel reads it, and gives EFAULT where this program would get SIGBUS.
bool can_be_read(const std::byte* byte) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return true;  // not known
    errno = 0;
    const bool faulty = write(ends[1], byte, 1) < 0 && errno == EFAULT;
    close(ends[0]);
    close(ends[1]);
    return !faulty;
}

}  // namespace

Result<void> check_room_in_file(const Gpu& gpu, const VkMemoryAllocateInfo& info, const std::string& name) {
    if (gpu.report().kind != VK_PHYSICAL_DEVICE_TYPE_CPU) return {};
    const rlim_t limit = limit_of_files();
    if (limit == RLIM_INFINITY) return {};
    if (!gpu.memory_type(1U << info.memoryTypeIndex, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT)) return {};
    VkMemoryAllocateInfo more = info;
    more.allocationSize += driver_slack_bytes;
    VkDeviceMemory handle{};
    // Without room for the slack the allocation itself is told, if it fails.
    if (vkAllocateMemory(gpu.device(), &more, nullptr, &handle) != VK_SUCCESS) return {};
    const OwnedMemory memory(gpu.device(), handle);
    void* mapped = nullptr;
    if (vkMapMemory(gpu.device(), handle, 0, VK_WHOLE_SIZE, 0, &mapped) != VK_SUCCESS) return {};
    const bool there = can_be_read(static_cast<const std::byte*>(mapped) + more.allocationSize - 1);
    vkUnmapMemory(gpu.device(), handle);
    if (there) return {};
    return Error{ErrorKind::failed, gpu.report().name,
                 "has no room for " + std::to_string((info.allocationSize + 1023) >> 10U) + " KiB of " +
                     name + ": it keeps its memory in a file, and files may have " +
                     std::to_string(limit >> 10U) + " KiB here (ulimit -f)"};
}

}  // namespace oro
