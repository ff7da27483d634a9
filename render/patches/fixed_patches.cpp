#include "render/patches/fixed_patches.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <glm/matrix.hpp>

#include "core/earth/ellipsoid.h"
#include "render/device/timestamps.h"
#include "render/patches/patch_pipelines.h"
#include "render/pipelines/pipeline_parts.h"
#include "render/pipelines/pipelines.h"

namespace oro {
namespace {

static_assert(sizeof(gpu::PatchFrame) <= 128, "every device pushes so much");

constexpr std::uint32_t patch_stamps = 4;
constexpr VkBufferUsageFlags patch_storage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
    VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
constexpr ImageUse patches_before{VK_IMAGE_LAYOUT_UNDEFINED, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0};
constexpr ImageUse patches_drawn{VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                 VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                                 VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
constexpr ImageUse patches_depth{
    VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};

VkPhysicalDeviceMeshShaderPropertiesEXT mesh_limits(const Gpu& gpu) {
    VkPhysicalDeviceMeshShaderPropertiesEXT mesh{};
    mesh.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MESH_SHADER_PROPERTIES_EXT;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &mesh;
    vkGetPhysicalDeviceProperties2(gpu.physical(), &properties);
    return mesh;
}

// How far the nearest and the farthest patch of a square are from an eye, metres: of 17 x 17 places of it.
struct Reach {
    double nearest_m{};
    double farthest_m{};
};
Reach reach_of(const MadeTerrain& terrain, const glm::dvec3& eye, double H_m) {
    Reach reach{1e30, 0.0};
    const auto per_deg = static_cast<double>(terrain.posts_per_deg);
    for (int row = 0; row <= 16; ++row)
        for (int column = 0; column <= 16; ++column) {
            const double lat =
                static_cast<double>(terrain.south) + row / 16.0 * static_cast<double>(terrain.rows() - 1);
            const double lon = static_cast<double>(terrain.west) +
                               column / 16.0 * static_cast<double>(terrain.columns() - 1);
            const double from_eye_m =
                glm::length(ecef_from_geodetic({lat / per_deg, lon / per_deg, H_m}).m - eye);
            reach.nearest_m = std::min(reach.nearest_m, from_eye_m);
            reach.farthest_m = std::max(reach.farthest_m, from_eye_m);
        }
    return reach;
}

}  // namespace

std::string name_of(PatchWay way) {
    if (way == PatchWay::mesh) return "mesh";
    return way == PatchWay::compute ? "compute" : "mesh, an invocation a vertex";
}

Result<FixedPatches> FixedPatches::create(const Gpu& gpu, const MadeTerrain& terrain, std::uint32_t width_px,
                                          std::uint32_t height_px) {
    assert(terrain.rows() == terrain.columns() && terrain.rows() % 8 == 1 && width_px < 65536 &&
           height_px < 65536);
    FixedPatches made(gpu, terrain);
    made.patches_ = static_cast<std::uint32_t>(terrain.rows()) / gpu::patch_quads;
    made.extent_ = {width_px, height_px};
    ORO_TRY(made.posts_, MadePosts::create(gpu, terrain));
    ORO_CHECK(made.create_buffers());
    ORO_CHECK(made.create_layout());
    ORO_TRY(made.choose_, create_patch_choice(gpu, made.layout_.get()));
    ORO_TRY(made.timestamps_, create_timestamps(gpu, patch_stamps, "timestamps of patches"));
    ORO_TRY(made.commands_, Commands::create(gpu, "patches"));
    return made;
}

Result<void> FixedPatches::create_buffers() {
    const VkDeviceSize posts =
        static_cast<VkDeviceSize>(terrain_.rows()) * static_cast<VkDeviceSize>(terrain_.columns());
    const VkDeviceSize pixels = VkDeviceSize{extent_.width} * extent_.height;
    ORO_TRY(heights_, create_buffer(*gpu_, posts * sizeof(std::int32_t), patch_storage, MemoryKind::device,
                                    "heights of patches"));
    ORO_TRY(levels_, create_buffer(*gpu_, VkDeviceSize{patches_} * patches_ * sizeof(std::uint32_t),
                                   patch_storage, MemoryKind::device, "levels of patches"));
    ORO_TRY(visibility_, create_buffer(*gpu_, pixels * sizeof(std::uint64_t), patch_storage,
                                       MemoryKind::device, "visible triangles of patches"));
    const std::array<std::uint32_t, 3> groups{patches_, patches_, 1};
    ORO_TRY(mesh_groups_,
            create_buffer(*gpu_, sizeof groups,
                          VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::upload, "workgroups of patches"));
    std::memcpy(mesh_groups_.mapped, groups.data(), sizeof groups);
    ORO_TRY(ids_, create_image(*gpu_, id_format, extent_,
                               VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                               VK_IMAGE_ASPECT_COLOR_BIT, "ids of patches"));
    ORO_TRY(depth_, create_image(*gpu_, depth_format, extent_, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT,
                                 VK_IMAGE_ASPECT_DEPTH_BIT, "depths of patches"));
    return {};
}

Result<void> FixedPatches::create_layout() {
    stages_ = VK_SHADER_STAGE_COMPUTE_BIT;
    if (gpu_->report().mesh_shader) stages_ |= VK_SHADER_STAGE_MESH_BIT_EXT;
    ORO_TRY(layout_, create_push_layout(*gpu_, stages_, sizeof(gpu::PatchFrame), "patches"));
    return {};
}

Result<void> FixedPatches::check(PatchWay way) const {
    const DeviceReport& device = gpu_->report();
    const std::string where = "patches by " + name_of(way);
    if (way == PatchWay::compute) {
        if (device.compute_raster) return {};
        return Error{ErrorKind::no_device, where, device.name + " has no 64-bit atomics in buffers"};
    }
    if (!device.mesh_shader)
        return Error{ErrorKind::no_device, where, device.name + " has no VK_EXT_mesh_shader"};
    const VkPhysicalDeviceMeshShaderPropertiesEXT limits = mesh_limits(*gpu_);
    if (limits.maxMeshWorkGroupTotalCount >= patches_ * patches_ &&
        limits.maxMeshWorkGroupCount[0] >= patches_ && limits.maxMeshWorkGroupCount[1] >= patches_)
        return {};
    return Error{ErrorKind::no_device, where,
                 device.name + " starts " + std::to_string(limits.maxMeshWorkGroupTotalCount) +
                     " mesh workgroups at most, and there are " + std::to_string(patches_ * patches_) +
                     " patches"};
}

gpu::PatchFrame FixedPatches::frame_for(const PatchRequest& request) const {
    const glm::dmat3 ecef_from_view = glm::transpose(request.camera.view_from_ecef());
    const glm::dvec3 eye = request.camera.eye_ecef().m;
    const glm::dvec2 tangent = request.camera.half_fov_tangent();
    gpu::PatchFrame frame{};
    frame.right = ecef_from_view[0];
    frame.up = ecef_from_view[1];
    frame.forward = -ecef_from_view[2];
    frame.scale = glm::vec2(1.0 / tangent.x, 1.0 / tangent.y);
    for (int i = 0; i < 3; ++i) frame.eye[i] = static_cast<std::int32_t>(std::lround(eye[i] * 64.0));
    frame.heights = address_words(heights_.address);
    frame.rows = address_words(posts_->rows_address());
    frame.columns = address_words(posts_->columns_address());
    frame.levels = address_words(levels_.address);
    frame.visibility = address_words(visibility_.address);
    frame.patches = patches_;
    frame.size_px = extent_.width | extent_.height << 16U;
    const double middle_m = 0.5 * made_step_m * terrain_.high;
    const Reach reach = reach_of(terrain_, eye, middle_m);
    frame.middle_m = static_cast<float>(middle_m);
    frame.nearest_m = static_cast<float>(reach.nearest_m);
    frame.band_m = static_cast<float>((reach.farthest_m - reach.nearest_m) / 4.0);
    frame.level = request.level.value_or(gpu::patch_by_distance);
    frame.borders = static_cast<std::uint32_t>(request.borders);
    return frame;
}

void FixedPatches::record_compute(VkCommandBuffer commands) const {
    vkCmdFillBuffer(commands, visibility_.handle.get(), 0, VK_WHOLE_SIZE, 0);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                      ways_[static_cast<std::size_t>(PatchWay::compute)].get());
    vkCmdDispatch(commands, patches_, patches_, 1);
}

void FixedPatches::record_drawn(VkCommandBuffer commands, PatchWay way) const {
    image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, patches_before, patches_drawn);
    image_barrier(commands, depth_.handle.get(), VK_IMAGE_ASPECT_DEPTH_BIT, patches_before, patches_depth);
    VkRenderingAttachmentInfo colour{};
    colour.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    colour.imageView = ids_.view.get();
    colour.imageLayout = patches_drawn.layout;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingAttachmentInfo depth = colour;
    depth.imageView = depth_.view.get();
    depth.imageLayout = patches_depth.layout;
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
    gpu_->draw_mesh_tasks_indirect()(commands, mesh_groups_.handle.get(), 0, 1, 0);
    vkCmdEndRendering(commands);
}

void FixedPatches::record(VkCommandBuffer commands, PatchWay way, const gpu::PatchFrame& frame,
                          bool makes_heights) {
    const auto stamp = [&](std::uint32_t number) {
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps_.get(), number);
    };
    const auto wait_for_compute = [&] {
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    };
    vkCmdResetQueryPool(commands, timestamps_.get(), 0, patch_stamps);
    wait_for_earlier(commands);
    stamp(0);
    if (makes_heights) {
        posts_->record_rectangle(commands, {0, terrain_.rows(), 0, terrain_.columns()}, heights_.address);
        wait_for_compute();
    }
    stamp(1);
    vkCmdPushConstants(commands, layout_.get(), stages_, 0, sizeof frame, &frame);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, choose_.get());
    vkCmdDispatch(commands, (patches_ * patches_ + gpu::patches_per_choice - 1) / gpu::patches_per_choice, 1,
                  1);
    wait_for_compute();
    stamp(2);
    if (way == PatchWay::compute)
        record_compute(commands);
    else
        record_drawn(commands, way);
    stamp(3);
    wait_for_earlier(commands);
}

Result<PatchFrameReport> FixedPatches::draw(PatchWay way, const PatchRequest& request) {
    assert(static_cast<std::uint32_t>(request.camera.width_px) == extent_.width &&
           static_cast<std::uint32_t>(request.camera.height_px) == extent_.height);
    OwnedPipeline& pipeline = ways_[static_cast<std::size_t>(way)];
    if (!pipeline) {
        ORO_CHECK(check(way));
        ORO_TRY(pipeline, create_patch_pipeline(*gpu_, layout_.get(), way));
    }
    ORO_CHECK(commands_.run(*gpu_, [&](VkCommandBuffer commands) {
        record(commands, way, frame_for(request), request.makes_heights);
    }));
    last_way_ = way;
    std::array<std::uint64_t, patch_stamps> ticks{};
    ORO_VK(vkGetQueryPoolResults(gpu_->device(), timestamps_.get(), 0, patch_stamps, sizeof ticks,
                                 ticks.data(), sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT));
    return PatchFrameReport{request.makes_heights ? gpu_->seconds_between(ticks[0], ticks[1]) : 0.0,
                            gpu_->seconds_between(ticks[1], ticks[2]),
                            gpu_->seconds_between(ticks[2], ticks[3])};
}

Result<Buffer> FixedPatches::read_back(const Buffer& from, VkDeviceSize bytes) {
    ORO_TRY(Buffer read, create_buffer(*gpu_, bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback,
                                       "patches read back"));
    ORO_CHECK(commands_.run(*gpu_, [&](VkCommandBuffer commands) {
        wait_for_earlier(commands);
        const VkBufferCopy copy{0, 0, bytes};
        vkCmdCopyBuffer(commands, from.handle.get(), read.handle.get(), 1, &copy);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    }));
    return read;
}

Result<std::vector<std::uint32_t>> FixedPatches::ids() {
    const std::size_t pixels = std::size_t{extent_.width} * extent_.height;
    std::vector<std::uint32_t> ids(pixels);
    if (last_way_ == PatchWay::compute) {
        ORO_TRY(const Buffer read, read_back(visibility_, pixels * sizeof(std::uint64_t)));
        for (std::size_t i = 0; i < pixels; ++i) {
            std::uint64_t word{};
            std::memcpy(&word, read.mapped + i * sizeof word, sizeof word);
            ids[i] = word == 0 ? 0 : ~static_cast<std::uint32_t>(word);
        }
        return ids;
    }
    ORO_TRY(const Buffer read,
            create_buffer(*gpu_, pixels * sizeof(std::uint32_t), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                          MemoryKind::readback, "ids of patches read back"));
    ORO_CHECK(commands_.run(*gpu_, [&](VkCommandBuffer commands) {
        const ImageUse as_source{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                 VK_ACCESS_2_TRANSFER_READ_BIT};
        image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, patches_drawn, as_source);
        VkBufferImageCopy copy{};
        copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
        copy.imageExtent = {extent_.width, extent_.height, 1};
        vkCmdCopyImageToBuffer(commands, ids_.handle.get(), as_source.layout, read.handle.get(), 1, &copy);
        image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, as_source, patches_drawn);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    }));
    std::memcpy(ids.data(), read.mapped, pixels * sizeof(std::uint32_t));
    return ids;
}

Result<std::array<std::uint32_t, 4>> FixedPatches::patches_of_levels() {
    const std::size_t count = std::size_t{patches_} * patches_;
    ORO_TRY(const Buffer read, read_back(levels_, count * sizeof(std::uint32_t)));
    std::array<std::uint32_t, 4> of_levels{};
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t level{};
        std::memcpy(&level, read.mapped + i * sizeof level, sizeof level);
        ++of_levels[std::min(level, gpu::patch_finest)];
    }
    return of_levels;
}

Result<std::vector<std::int32_t>> FixedPatches::heights() {
    std::vector<std::int32_t> steps(static_cast<std::size_t>(terrain_.rows()) *
                                    static_cast<std::size_t>(terrain_.columns()));
    ORO_TRY(const Buffer read, read_back(heights_, steps.size() * sizeof(std::int32_t)));
    std::memcpy(steps.data(), read.mapped, steps.size() * sizeof(std::int32_t));
    return steps;
}

}  // namespace oro
