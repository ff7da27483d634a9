#include "render/device/timestamps.h"

namespace oro {

Result<OwnedQueryPool> create_timestamps(const Gpu& gpu, std::uint32_t count, const char* name) {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = count;
    VkQueryPool handle{};
    ORO_VK(vkCreateQueryPool(gpu.device(), &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_QUERY_POOL, handle, name);
    return OwnedQueryPool(gpu.device(), handle);
}

}  // namespace oro
