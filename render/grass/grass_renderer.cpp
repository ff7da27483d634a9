#include "render/grass/grass_renderer.h"

#include <cassert>
#include <cstddef>
#include <cstring>

#include "render/device/timestamps.h"
#include "render/grass/grass_pipelines.h"
#include "render/pipelines/pipeline_parts.h"
#include "render/pipelines/pipelines.h"

namespace oro {
namespace {

static_assert(sizeof(gpu::GrassFrame) <= 128, "every device pushes so much");
static_assert(sizeof(gpu::GrassClump) == 16);
static_assert(grass_blades_max / gpu::blades_per_clump / gpu::clumps_per_raster <= 65535,
              "every device dispatches so many workgroups");

constexpr std::uint32_t stamp_count = 3;
constexpr VkBufferUsageFlags grass_storage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
constexpr ImageUse before_frame{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0};
constexpr ImageUse drawn_ids{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                             VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                             VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
constexpr ImageUse drawn_depth{
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};

// Lists without a clump, and what each way's indirect draw or dispatch takes beside.
constexpr gpu::GrassLists empty_lists{
    {{gpu::blade_vertices_most, 0, 0, 0}, {gpu::blade_vertices_least, 0, 0, 0}},
    {1, 1, 1},
    {0, 1, 1},
    {0, 1, 1},
    0,
    0};

// Most workgroups of mesh shaders that one call may start, and one that a task workgroup starts along x.
struct MeshGroupLimits {
    std::uint32_t total{};
    std::uint32_t along_x{};
    std::uint32_t along_y{};
};
MeshGroupLimits mesh_group_limits(const Gpu& gpu) {
    VkPhysicalDeviceMeshShaderPropertiesEXT mesh{};
    mesh.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_PROPERTIES_EXT;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &mesh;
    vkGetPhysicalDeviceProperties2(gpu.physical(), &properties);
    return {mesh.maxMeshWorkGroupTotalCount, mesh.maxMeshWorkGroupCount[0], mesh.maxMeshWorkGroupCount[1]};
}

}  // namespace

std::string name_of(GrassWay way) {
    switch (way) {
        case GrassWay::vertex:
            return "vertex";
        case GrassWay::clumps:
            return "mesh, a clump a group";
        case GrassWay::packed:
            return "mesh, packed";
        case GrassWay::compute:
            break;
    }
    return "compute";
}

Result<GrassRenderer> GrassRenderer::create(const Gpu& gpu, const gpu::GrassField& field,
                                            std::uint32_t width_px, std::uint32_t height_px) {
    assert(field.clumps <= grass_blades_max / gpu::blades_per_clump && width_px < 65536 && height_px < 65536);
    GrassRenderer renderer(gpu);
    renderer.field_ = field;
    renderer.extent_ = {width_px, height_px};
    ORO_CHECK(renderer.create_buffers());
    ORO_CHECK(renderer.create_layout());
    ORO_TRY(renderer.place_, create_clump_placer(gpu, renderer.layout_.get()));
    ORO_TRY(renderer.cull_, create_clump_cull(gpu, renderer.layout_.get()));
    ORO_TRY(renderer.timestamps_, create_timestamps(gpu, stamp_count, "grass timestamps"));
    ORO_TRY(renderer.commands_, Commands::create(gpu, "grass"));
    const gpu::GrassFrame frame = renderer.frame_for({});
    ORO_CHECK(renderer.commands_.run(gpu, [&](VkCommandBuffer commands) {
        renderer.push(commands, frame);
        renderer.dispatch(commands, renderer.place_,
                          (field.clumps + gpu::clumps_per_cull - 1) / gpu::clumps_per_cull);
        wait_for_earlier(commands);
    }));
    return renderer;
}

Result<void> GrassRenderer::create_buffers() {
    const VkDeviceSize clumps = field_.clumps, pixels = VkDeviceSize{extent_.width} * extent_.height;
    ORO_TRY(clumps_, create_buffer(*gpu_, clumps * sizeof(gpu::GrassClump), grass_storage, MemoryKind::device,
                                   "clumps"));
    ORO_TRY(lists_, create_buffer(*gpu_, sizeof(gpu::GrassLists) + 2 * clumps * sizeof(std::uint32_t),
                                  grass_storage | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                                      VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                  MemoryKind::device, "lists of clumps"));
    ORO_TRY(lists_read_, create_buffer(*gpu_, sizeof(gpu::GrassLists), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                       MemoryKind::readback, "counts of clumps"));
    ORO_TRY(visibility_,
            create_buffer(*gpu_, pixels * sizeof(std::uint64_t),
                          grass_storage | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                          MemoryKind::device, "visible blades"));
    ORO_TRY(ids_, create_image(*gpu_, id_format, extent_,
                               VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                               VK_IMAGE_ASPECT_COLOR_BIT, "blade ids"));
    ORO_TRY(depth_, create_image(*gpu_, depth_format, extent_, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                 VK_IMAGE_ASPECT_DEPTH_BIT, "blade depths"));
    return {};
}

Result<void> GrassRenderer::create_layout() {
    stages_ = VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_VERTEX_BIT;
    if (gpu_->report().mesh_shader) stages_ |= VK_SHADER_STAGE_TASK_BIT_EXT | VK_SHADER_STAGE_MESH_BIT_EXT;
    ORO_TRY(layout_, create_push_layout(*gpu_, stages_, sizeof(gpu::GrassFrame), "grass"));
    return {};
}

Result<void> GrassRenderer::check(GrassWay way) const {
    const DeviceReport& device = gpu_->report();
    const std::string where = "grass by " + name_of(way);
    if (way == GrassWay::vertex) return {};
    if (way == GrassWay::compute) {
        if (device.compute_raster) return {};
        return Error{ErrorKind::no_device, where, device.name + " has no 64-bit atomics in buffers"};
    }
    if (!device.mesh_shader)
        return Error{ErrorKind::no_device, where, device.name + " has no VK_EXT_mesh_shader"};
    const MeshGroupLimits limits = mesh_group_limits(*gpu_);
    const std::uint32_t rows = (field_.clumps + gpu::groups_per_row - 1) / gpu::groups_per_row;
    if (limits.total < field_.clumps || limits.along_x < gpu::groups_per_row || limits.along_y < rows)
        return Error{ErrorKind::no_device, where,
                     device.name + " starts " + std::to_string(limits.total) +
                         " mesh workgroups at most, and the field has " + std::to_string(field_.clumps) +
                         " clumps"};
    return {};
}

Result<void> GrassRenderer::add_pipelines(GrassWay way) {
    OwnedPipeline& pipeline = ways_[static_cast<std::size_t>(way)];
    if (pipeline) return {};
    ORO_CHECK(check(way));
    ORO_TRY(pipeline, create_grass_pipeline(*gpu_, layout_.get(), way));
    return {};
}

gpu::GrassFrame GrassRenderer::frame_for(const GrassRequest& request) const {
    gpu::GrassFrame frame{};
    frame.view = request.view;
    frame.clumps = address_words(clumps_.address);
    frame.lists = address_words(lists_.address);
    frame.visibility = address_words(visibility_.address);
    frame.field = field_;
    frame.size_px = extent_.width | extent_.height << 16U;
    frame.switch_m = request.switch_m;
    frame.wind_time_s = request.wind_time_s.value_or(-1.0F);
    frame.margin_m = request.by_boxes ? 0.0F : grass_published_margin_m;
    frame.flags = (request.by_boxes ? gpu::grass_by_boxes : 0U) | (request.thins ? gpu::grass_thins : 0U);
    return frame;
}

void GrassRenderer::push(VkCommandBuffer commands, const gpu::GrassFrame& frame) const {
    vkCmdPushConstants(commands, layout_.get(), stages_, 0, sizeof(frame), &frame);
}

void GrassRenderer::dispatch(VkCommandBuffer commands, const OwnedPipeline& pipeline,
                             std::uint32_t groups) const {
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
    vkCmdDispatch(commands, groups, 1, 1);
}

void GrassRenderer::record_cull(VkCommandBuffer commands, const gpu::GrassFrame& frame) const {
    vkCmdUpdateBuffer(commands, lists_.handle.get(), 0, sizeof(empty_lists), &empty_lists);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    push(commands, frame);
    dispatch(commands, cull_, (field_.clumps + gpu::clumps_per_cull - 1) / gpu::clumps_per_cull);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                       VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
}

void GrassRenderer::record_compute(VkCommandBuffer commands) const {
    vkCmdFillBuffer(commands, visibility_.handle.get(), 0, VK_WHOLE_SIZE, 0);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                      ways_[static_cast<std::size_t>(GrassWay::compute)].get());
    vkCmdDispatchIndirect(commands, lists_.handle.get(), offsetof(gpu::GrassLists, raster_groups));
}

void GrassRenderer::record_drawn(VkCommandBuffer commands, GrassWay way, gpu::GrassFrame& frame) const {
    image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, before_frame, drawn_ids);
    image_barrier(commands, depth_.handle.get(), VK_IMAGE_ASPECT_DEPTH_BIT, before_frame, drawn_depth);
    VkRenderingAttachmentInfo colour{};
    colour.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    colour.imageView = ids_.view.get();
    colour.imageLayout = drawn_ids.layout;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingAttachmentInfo depth = colour;
    depth.imageView = depth_.view.get();
    depth.imageLayout = drawn_depth.layout;
    VkRenderingInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    rendering.renderArea.extent = extent_;
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachments = &colour;
    rendering.pDepthAttachment = &depth;
    vkCmdBeginRendering(commands, &rendering);
    const VkViewport viewport{
        0.0F, 0.0F, static_cast<float>(extent_.width), static_cast<float>(extent_.height), 0.0F, 1.0F};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &rendering.renderArea);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, ways_[static_cast<std::size_t>(way)].get());
    if (way == GrassWay::vertex) {
        for (frame.list = 0; frame.list < 2; ++frame.list) {
            push(commands, frame);
            vkCmdDrawIndirect(commands, lists_.handle.get(),
                              offsetof(gpu::GrassLists, draws) + frame.list * sizeof(gpu::GrassDraw), 1, 0);
        }
    } else {
        gpu_->draw_mesh_tasks_indirect()(commands, lists_.handle.get(),
                                         way == GrassWay::clumps ? offsetof(gpu::GrassLists, one_group)
                                                                 : offsetof(gpu::GrassLists, task_groups),
                                         1, 0);
    }
    vkCmdEndRendering(commands);
}

void GrassRenderer::record(VkCommandBuffer commands, GrassWay way, gpu::GrassFrame frame) const {
    const auto stamp = [&](std::uint32_t number) {
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps_.get(), number);
    };
    vkCmdResetQueryPool(commands, timestamps_.get(), 0, stamp_count);
    wait_for_earlier(commands);
    stamp(0);
    record_cull(commands, frame);
    stamp(1);
    if (way == GrassWay::compute)
        record_compute(commands);
    else
        record_drawn(commands, way, frame);
    stamp(2);
    wait_for_earlier(commands);
    const VkBufferCopy copy{0, 0, sizeof(gpu::GrassLists)};
    vkCmdCopyBuffer(commands, lists_.handle.get(), lists_read_.handle.get(), 1, &copy);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
}

Result<GrassFrameReport> GrassRenderer::draw(GrassWay way, const GrassRequest& request) {
    ORO_CHECK(add_pipelines(way));
    ORO_CHECK(
        commands_.run(*gpu_, [&](VkCommandBuffer commands) { record(commands, way, frame_for(request)); }));
    last_way_ = way;
    std::array<std::uint64_t, stamp_count> ticks{};
    ORO_VK(vkGetQueryPoolResults(gpu_->device(), timestamps_.get(), 0, stamp_count, sizeof(ticks),
                                 ticks.data(), sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT));
    gpu::GrassLists lists{};
    std::memcpy(&lists, lists_read_.mapped, sizeof(lists));
    return GrassFrameReport{gpu_->seconds_between(ticks[0], ticks[1]),
                            gpu_->seconds_between(ticks[1], ticks[2]), lists.draws[0].instances,
                            lists.draws[1].instances, lists.mesh_groups};
}

Result<std::vector<std::uint32_t>> GrassRenderer::blades() {
    const std::size_t pixels = std::size_t{extent_.width} * extent_.height;
    const bool compute = last_way_ == GrassWay::compute;
    ORO_TRY(const Buffer read,
            create_buffer(*gpu_, pixels * (compute ? sizeof(std::uint64_t) : sizeof(std::uint32_t)),
                          VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback, "blades read back"));
    ORO_CHECK(commands_.run(*gpu_, [&](VkCommandBuffer commands) {
        if (compute) {
            const VkBufferCopy copy{0, 0, read.size};
            vkCmdCopyBuffer(commands, visibility_.handle.get(), read.handle.get(), 1, &copy);
        } else {
            const ImageUse as_source{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                     VK_ACCESS_2_TRANSFER_READ_BIT};
            image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, drawn_ids, as_source);
            VkBufferImageCopy copy{};
            copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
            copy.imageExtent = {extent_.width, extent_.height, 1};
            vkCmdCopyImageToBuffer(commands, ids_.handle.get(), as_source.layout, read.handle.get(), 1,
                                   &copy);
            image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, as_source, drawn_ids);
        }
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    }));
    std::vector<std::uint32_t> blades(pixels);
    if (!compute) {
        std::memcpy(blades.data(), read.mapped, pixels * sizeof(std::uint32_t));
        return blades;
    }
    for (std::size_t i = 0; i < pixels; ++i) {
        std::uint64_t word{};
        std::memcpy(&word, read.mapped + i * sizeof(word), sizeof(word));
        blades[i] = word == 0 ? 0 : ~static_cast<std::uint32_t>(word);
    }
    return blades;
}

}  // namespace oro
