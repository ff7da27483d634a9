#include "render/shading/caster_buffers.h"

#include <algorithm>
#include <cstring>

#include "render/shading/shading.h"

namespace oro {
namespace {

constexpr VkBufferUsageFlags on_device = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                         VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                         VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
constexpr std::uint32_t groups_a_page = 4;  // of tops.comp

VkDeviceSize aligned(VkDeviceSize size) {
    return (size + 15) / 16 * 16;
}

}  // namespace

Result<void> CasterBuffers::prepare(const Gpu& gpu, Pipelines& pipelines, const FramePlan& frame,
                                    gpu::FrameConstants& constants) {
    const CasterPlan& plan = frame.casters;
    const gpu::FrameStyle& style = constants.style;
    const bool there = !plan.pages.empty();
    casts_ = there && style.shadows != 0 && plan.for_shadows;
    opens_ = there && style.sky_openness != 0 && plan.for_openness;
    constants.casters = {};
    if (!any()) return {};
    ORO_CHECK(add_cast_pipelines(gpu, pipelines));
    const VkDeviceSize pages_at = aligned(sizeof(gpu::Casters));
    const VkDeviceSize table_at = aligned(pages_at + plan.pages.size() * sizeof(gpu::CasterPage));
    size_ = aligned(table_at + plan.table.size() * sizeof(gpu::uint));
    if (staging_.size < size_) {
        const VkDeviceSize size = std::max(size_, 2 * staging_.size);
        ORO_TRY(Buffer staging, create_buffer(gpu, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload,
                                              "casters staging"));
        ORO_TRY(data_, create_buffer(gpu, size, on_device, MemoryKind::device, "casters"));
        staging_ = std::move(staging);
    }
    const VkDeviceSize nodes = plan.pages.size() * gpu::meshlets_per_page * sizeof(gpu::CasterNode);
    if (nodes_.size < nodes) {
        ORO_TRY(nodes_, create_buffer(gpu, std::max(nodes, 2 * nodes_.size), on_device, MemoryKind::device,
                                      "casters' nodes"));
    }
    const VkDeviceSize openness = frame.pages.size() * gpu::open_corners * gpu::open_corners * sizeof(float);
    if (opens_ && openness_.size < openness) {
        ORO_TRY(openness_, create_buffer(gpu, std::max(openness, 2 * openness_.size), on_device,
                                         MemoryKind::device, "openness"));
    }
    gpu::Casters casters = plan.frame;
    casters.openness = address_words(openness_.address);
    casters.pages = address_words(data_.address + pages_at);
    casters.table = address_words(data_.address + table_at);
    casters.nodes = address_words(nodes_.address);
    std::memcpy(staging_.mapped, &casters, sizeof(casters));
    std::memcpy(staging_.mapped + pages_at, plan.pages.data(), plan.pages.size() * sizeof(gpu::CasterPage));
    std::memcpy(staging_.mapped + table_at, plan.table.data(), plan.table.size() * sizeof(gpu::uint));
    constants.casters = address_words(data_.address);
    pages_ = static_cast<std::uint32_t>(plan.pages.size());
    frame_pages_ = static_cast<std::uint32_t>(frame.pages.size());
    return {};
}

void CasterBuffers::record(VkCommandBuffer commands, const Pipelines& pipelines) {
    if (!any()) return;
    const VkBufferCopy copy{0, 0, size_};
    vkCmdCopyBuffer(commands, staging_.handle.get(), data_.handle.get(), 1, &copy);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    const auto dispatch = [&](const OwnedPipeline& pipeline, std::uint32_t groups) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
        vkCmdDispatch(commands, std::min(groups, gpu::groups_per_row),
                      (groups + gpu::groups_per_row - 1) / gpu::groups_per_row, 1);
    };
    if (casts_) dispatch(pipelines.caster_tops, groups_a_page * pages_);
    if (opens_) dispatch(pipelines.openness, gpu::open_groups_a_page * frame_pages_);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
}

}  // namespace oro
