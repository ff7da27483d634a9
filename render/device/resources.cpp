#include "render/device/resources.h"

#include <optional>
#include <utility>

#include "render/device/software_driver.h"

namespace oro {
namespace {

Result<OwnedMemory> allocate(const Gpu& gpu, const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted,
                             bool addressed, const std::string& name, bool* full = nullptr) {
    // Cached host memory reads faster; coherent is enough when there is none. Device-local is a wish, not a
    // need.
    std::optional<std::uint32_t> type = gpu.memory_type(needs.memoryTypeBits, wanted);
    if (!type)
        type = gpu.memory_type(needs.memoryTypeBits, wanted & ~static_cast<VkMemoryPropertyFlags>(
                                                                  VK_MEMORY_PROPERTY_HOST_CACHED_BIT |
                                                                  VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT));
    if (!type) return Error{ErrorKind::failed, gpu.report().name, "has no memory type for " + name};
    VkMemoryAllocateFlagsInfo flags{};
    flags.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO;
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    VkMemoryAllocateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
    info.pNext = addressed ? &flags : nullptr;
    info.allocationSize = needs.size;
    info.memoryTypeIndex = *type;
    ORO_CHECK(check_room_in_file(gpu, info, name));
    VkDeviceMemory memory{};
    const VkResult made = vkAllocateMemory(gpu.device(), &info, nullptr, &memory);
    if (full) *full = made == VK_ERROR_OUT_OF_DEVICE_MEMORY;
    if (made != VK_SUCCESS)
        return Error{ErrorKind::failed, gpu.report().name,
                     "has no room for " + std::to_string((needs.size + 1023) >> 10U) + " KiB of " + name +
                         ": vkAllocateMemory gave " + vulkan_reason(made)};
    gpu.name(VK_OBJECT_TYPE_DEVICE_MEMORY, memory, name);
    return OwnedMemory(gpu.device(), memory);
}

VkMemoryPropertyFlags properties_of(MemoryKind memory_kind) {
    constexpr VkMemoryPropertyFlags host =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    switch (memory_kind) {
        case MemoryKind::upload:
            return host;
        case MemoryKind::mapped_device:
            return host | VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
        case MemoryKind::readback:
            return host | VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
        case MemoryKind::device:
            break;
    }
    return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
}

}  // namespace

Result<Buffer> create_buffer(const Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage,
                             MemoryKind memory_kind, const std::string& name, bool* full) {
    VkBufferCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
    info.size = size;
    info.usage = usage;
    VkBuffer handle{};
    ORO_VK(vkCreateBuffer(gpu.device(), &info, nullptr, &handle));
    Buffer buffer;
    buffer.handle = OwnedBuffer(gpu.device(), handle);
    buffer.size = size;
    gpu.name(VK_OBJECT_TYPE_BUFFER, handle, name);
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(gpu.device(), handle, &needs);
    const bool addressed = (usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0;
    if (memory_kind == MemoryKind::mapped_device &&
        !gpu.memory_type(needs.memoryTypeBits, properties_of(memory_kind)))
        memory_kind = MemoryKind::upload;
    ORO_TRY(buffer.memory, allocate(gpu, needs, properties_of(memory_kind), addressed, name, full));
    ORO_VK(vkBindBufferMemory(gpu.device(), handle, buffer.memory.get(), 0));
    if (memory_kind != MemoryKind::device) {
        void* mapped = nullptr;
        ORO_VK(vkMapMemory(gpu.device(), buffer.memory.get(), 0, VK_WHOLE_SIZE, 0, &mapped));
        buffer.mapped = static_cast<std::byte*>(mapped);
    }
    if (addressed) {
        VkBufferDeviceAddressInfo address{};
        address.sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO;
        address.buffer = handle;
        buffer.address = vkGetBufferDeviceAddress(gpu.device(), &address);
    }
    return buffer;
}

Result<void> replace_buffer(const Gpu& gpu, Buffer& buffer, VkDeviceSize size, VkBufferUsageFlags usage,
                            MemoryKind memory_kind, const std::string& name) {
    ORO_TRY(Buffer other, create_buffer(gpu, size, usage, memory_kind, name));
    if (buffer.handle) ORO_VK(vkQueueWaitIdle(gpu.queue()));
    buffer = std::move(other);
    return {};
}

Result<OwnedImageView> create_image_view(const Gpu& gpu, VkImage image, VkFormat format,
                                         VkImageAspectFlags aspect, const std::string& name) {
    VkImageViewCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
    info.image = image;
    info.viewType = VK_IMAGE_VIEW_TYPE_2D;
    info.format = format;
    info.subresourceRange = {aspect, 0, 1, 0, 1};
    VkImageView handle{};
    ORO_VK(vkCreateImageView(gpu.device(), &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_IMAGE_VIEW, handle, name);
    return OwnedImageView(gpu.device(), handle);
}

Result<Image> create_image(const Gpu& gpu, VkFormat format, VkExtent2D extent, VkImageUsageFlags usage,
                           VkImageAspectFlags aspect, const std::string& name) {
    VkImageCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
    info.imageType = VK_IMAGE_TYPE_2D;
    info.format = format;
    info.extent = {extent.width, extent.height, 1};
    info.mipLevels = info.arrayLayers = 1;
    info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.tiling = VK_IMAGE_TILING_OPTIMAL;
    info.usage = usage;
    VkImage handle{};
    ORO_VK(vkCreateImage(gpu.device(), &info, nullptr, &handle));
    Image image;
    image.handle = OwnedImage(gpu.device(), handle);
    image.format = format;
    image.extent = extent;
    gpu.name(VK_OBJECT_TYPE_IMAGE, handle, name);
    VkMemoryRequirements needs{};
    vkGetImageMemoryRequirements(gpu.device(), handle, &needs);
    ORO_TRY(image.memory, allocate(gpu, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, false, name));
    ORO_VK(vkBindImageMemory(gpu.device(), handle, image.memory.get(), 0));
    ORO_TRY(image.view, create_image_view(gpu, handle, format, aspect, name));
    return image;
}

Result<Commands> Commands::create(const Gpu& gpu, const std::string& name) {
    Commands commands;
    VkCommandPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = gpu.queue_family();
    VkCommandPool pool_handle{};
    ORO_VK(vkCreateCommandPool(gpu.device(), &pool, nullptr, &pool_handle));
    commands.pool_ = OwnedCommandPool(gpu.device(), pool_handle);
    gpu.name(VK_OBJECT_TYPE_COMMAND_POOL, pool_handle, name);
    VkCommandBufferAllocateInfo buffer{};
    buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    buffer.commandPool = pool_handle;
    buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    buffer.commandBufferCount = 1;
    ORO_VK(vkAllocateCommandBuffers(gpu.device(), &buffer, &commands.buffer_));
    gpu.name(VK_OBJECT_TYPE_COMMAND_BUFFER, commands.buffer_, name);
    VkFenceCreateInfo fence{};
    fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VkFence fence_handle{};
    ORO_VK(vkCreateFence(gpu.device(), &fence, nullptr, &fence_handle));
    commands.fence_ = OwnedFence(gpu.device(), fence_handle);
    gpu.name(VK_OBJECT_TYPE_FENCE, fence_handle, name);
    return commands;
}

Commands& Commands::operator=(Commands&& other) noexcept {
    pool_ = std::move(other.pool_);
    fence_ = std::move(other.fence_);
    std::swap(buffer_, other.buffer_);
    std::swap(under_way_, other.under_way_);
    return *this;
}

Commands::~Commands() {
    if (under_way_ != VK_NULL_HANDLE && vkGetFenceStatus(under_way_, fence_.get()) == VK_NOT_READY)
        vkDeviceWaitIdle(under_way_);
}

Result<void> Commands::submit(const Gpu& gpu, const Record& record, const Semaphores& semaphores) {
    ORO_CHECK(wait());
    VkCommandBufferBeginInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    ORO_VK(vkBeginCommandBuffer(buffer_, &info));
    record(buffer_);
    ORO_VK(vkEndCommandBuffer(buffer_));
    VkSemaphoreSubmitInfo wait{};
    wait.sType = VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO;
    wait.semaphore = semaphores.waits;
    wait.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    VkSemaphoreSubmitInfo signal = wait;
    signal.semaphore = semaphores.signals;
    VkCommandBufferSubmitInfo submitted{};
    submitted.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO;
    submitted.commandBuffer = buffer_;
    VkSubmitInfo2 submit{};
    submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2;
    submit.waitSemaphoreInfoCount = semaphores.waits != VK_NULL_HANDLE ? 1 : 0;
    submit.pWaitSemaphoreInfos = &wait;
    submit.commandBufferInfoCount = 1;
    submit.pCommandBufferInfos = &submitted;
    submit.signalSemaphoreInfoCount = semaphores.signals != VK_NULL_HANDLE ? 1 : 0;
    submit.pSignalSemaphoreInfos = &signal;
    ORO_VK(vkQueueSubmit2(gpu.queue(), 1, &submit, fence_.get()));
    under_way_ = gpu.device();
    return {};
}

Result<void> Commands::run(const Gpu& gpu, const Record& record) {
    ORO_CHECK(submit(gpu, record));
    return wait();
}

Result<void> Commands::wait() {
    if (under_way_ == VK_NULL_HANDLE) return {};
    const VkDevice device = std::exchange(under_way_, VK_NULL_HANDLE);
    const VkFence fence = fence_.get();
    const VkResult waited = vkWaitForFences(device, 1, &fence, VK_TRUE, UINT64_MAX);
    // A wait can fail while the work goes on, and whoever hears of it destroys what the work uses.
    if (waited != VK_SUCCESS) vkDeviceWaitIdle(device);
    ORO_CHECK(vulkan_checked(waited, "vkWaitForFences("));
    ORO_VK(vkResetFences(device, 1, &fence));
    return {};
}

void memory_barrier(VkCommandBuffer commands, VkPipelineStageFlags2 from, VkAccessFlags2 written,
                    VkPipelineStageFlags2 to, VkAccessFlags2 read) {
    VkMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    barrier.srcStageMask = from;
    barrier.srcAccessMask = written;
    barrier.dstStageMask = to;
    barrier.dstAccessMask = read;
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

void wait_for_earlier(VkCommandBuffer commands) {
    memory_barrier(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT);
}

void image_barrier(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect, ImageUse from,
                   ImageUse to) {
    VkImageMemoryBarrier2 barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = from.stage;
    barrier.srcAccessMask = from.access;
    barrier.dstStageMask = to.stage;
    barrier.dstAccessMask = to.access;
    barrier.oldLayout = from.layout;
    barrier.newLayout = to.layout;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image;
    barrier.subresourceRange = {aspect, 0, 1, 0, 1};
    VkDependencyInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace oro
