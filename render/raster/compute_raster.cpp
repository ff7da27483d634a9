#include "render/raster/compute_raster.h"

#include <algorithm>
#include <cstddef>

namespace oro {
namespace {

constexpr VkBufferUsageFlags listed =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;

void wait_for_lists(VkCommandBuffer commands) {
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                       VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
}

}  // namespace

Result<ComputeRaster> ComputeRaster::create(const Gpu& gpu, VkExtent2D extent) {
    ComputeRaster raster(gpu);
    ORO_TRY(raster.clips_, create_buffer(gpu, gpu::clips_max * sizeof(std::uint32_t), listed,
                                         MemoryKind::device, "clip list"));
    ORO_TRY(raster.large_, create_buffer(gpu, (gpu::large_max + gpu::boxes_max) * sizeof(gpu::LargeTriangle),
                                         listed, MemoryKind::device, "large triangles"));
    ORO_TRY(raster.tasks_, create_buffer(gpu, gpu::tasks_max * sizeof(gpu::LargeTask), listed,
                                         MemoryKind::device, "large tasks"));
    ORO_CHECK(raster.resize(extent));
    return raster;
}

Result<void> ComputeRaster::resize(VkExtent2D extent) {
    ORO_TRY(visibility_,
            create_buffer(*gpu_, VkDeviceSize{8} * extent.width * extent.height,
                          listed | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                          MemoryKind::device, "visibility"));
    return {};
}

Result<void> ComputeRaster::reserve(std::size_t count, std::size_t lists) {
    static_assert(sizeof(gpu::RasterLists) <= gpu::raster_lists_bytes && gpu::raster_lists_bytes % 16 == 0);
    if (lists_.size < lists * gpu::raster_lists_bytes)
        ORO_CHECK(
            replace_buffer(*gpu_, lists_, lists * gpu::raster_lists_bytes,
                           listed | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                           MemoryKind::device, "raster lists"));
    if (count <= page_capacity_) return {};
    const std::size_t capacity = std::max(count, 2 * page_capacity_);
    ORO_CHECK(replace_buffer(*gpu_, meshlets_, capacity * gpu::meshlets_per_page * sizeof(std::uint32_t),
                             listed, MemoryKind::device, "meshlet list"));
    page_capacity_ = capacity;
    return {};
}

void ComputeRaster::address(gpu::FrameConstants& constants) const {
    constants.visibility = address_words(visibility_.address);
    constants.lists = address_words(lists_.address);
    constants.meshlet_list = address_words(meshlets_.address);
    constants.clip_list = address_words(clips_.address);
    constants.large_list = address_words(large_.address);
    constants.task_list = address_words(tasks_.address);
}

void ComputeRaster::record_clear(VkCommandBuffer commands, const Pipelines& pipelines,
                                 const FramePlan& plan) const {
    const gpu::uint pixels = plan.view.width_px() * plan.view.height_px();
    const gpu::uint groups = (pixels + gpu::clear_group_px - 1) / gpu::clear_group_px;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines.raster_clear.get());
    vkCmdDispatch(commands, std::min(groups, gpu::groups_per_row),
                  (groups + gpu::groups_per_row - 1) / gpu::groups_per_row, 1);
}

void ComputeRaster::record(VkCommandBuffer commands, const Pipelines& pipelines, bool of_clusters,
                           gpu::uint lists) const {
    const VkDeviceSize at = VkDeviceSize{lists} * gpu::raster_lists_bytes;
    const auto step = [&](const OwnedPipeline& pipeline, VkDeviceSize groups) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
        vkCmdDispatchIndirect(commands, lists_.handle.get(), at + groups);
    };
    wait_for_lists(commands);
    step(of_clusters ? pipelines.cluster_raster : pipelines.raster,
         offsetof(gpu::RasterLists, meshlet_groups));
    wait_for_lists(commands);
    // At the same time: few triangles are cut, and that takes long.
    step(of_clusters ? pipelines.cluster_clip : pipelines.raster_clip,
         offsetof(gpu::RasterLists, clip_groups));
    step(pipelines.raster_boxes, offsetof(gpu::RasterLists, box_groups));
    wait_for_lists(commands);
    step(pipelines.raster_large, offsetof(gpu::RasterLists, task_groups));
    wait_for_lists(commands);
}

}  // namespace oro
