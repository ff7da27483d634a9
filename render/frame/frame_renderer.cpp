#include "render/frame/frame_renderer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <utility>

#include "render/frame/frame_layout.h"

namespace oro {
namespace {

constexpr VkDeviceSize pages_offset = 8192;  // FrameConstants come first
static_assert(sizeof(gpu::FrameConstants) <= pages_offset);

// Where the parts of a frame's data lie, in bytes.
struct FrameLayout {
    VkDeviceSize rows;
    VkDeviceSize columns;
    VkDeviceSize size;
};
FrameLayout layout_of(const FramePlan& plan) {
    const auto aligned = [](VkDeviceSize size) { return (size + 15) / 16 * 16; };
    FrameLayout layout{};
    layout.rows = aligned(pages_offset + plan.pages.size() * sizeof(gpu::FramePage));
    layout.columns = aligned(layout.rows + plan.row_terms.size() * sizeof(gpu::RowTerms));
    layout.size = aligned(layout.columns + plan.column_terms.size() * sizeof(gpu::ColumnTerms));
    return layout;
}

constexpr std::uint32_t timestamp_count = 6;  // the last two with images over the ground alone

Result<OwnedQueryPool> create_timestamps(const Gpu& gpu) {
    VkQueryPoolCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
    info.queryType = VK_QUERY_TYPE_TIMESTAMP;
    info.queryCount = timestamp_count;
    VkQueryPool handle{};
    ORO_VK(vkCreateQueryPool(gpu.device(), &info, nullptr, &handle));
    gpu.name(VK_OBJECT_TYPE_QUERY_POOL, handle, "frame times");
    return OwnedQueryPool(gpu.device(), handle);
}

}  // namespace

Result<FrameRenderer> FrameRenderer::create(const Gpu& gpu, const FrameRendererOptions& options) {
    assert(options.extent.width > 0 && options.extent.width <= gpu.report().max_picture_side_px);
    assert(options.extent.height > 0 && options.extent.height <= gpu.report().max_picture_side_px);
    FrameRenderer renderer(gpu);
    renderer.options_ = options;
    ORO_TRY(renderer.pipelines_,
            shared_pipelines(gpu, options.path, {options.record_positions, options.keep_triangles}));
    ORO_TRY(renderer.commands_, Commands::create(gpu, "frame"));
    ORO_TRY(renderer.timestamps_, create_timestamps(gpu));
    constexpr VkBufferUsageFlags counted =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
        VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    ORO_TRY(renderer.counts_,
            create_buffer(gpu, sizeof(gpu::FrameCounts), counted, MemoryKind::device, "counts"));
    ORO_TRY(renderer.counts_read_,
            create_buffer(gpu, sizeof(gpu::FrameCounts), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                          MemoryKind::readback, "counts read back"));
    if (options.path == RasterPath::compute) {
        ORO_TRY(ComputeRaster compute, ComputeRaster::create(gpu, options.extent));
        renderer.compute_.emplace(std::move(compute));
    }
    ORO_CHECK(renderer.create_images());
    ORO_CHECK(renderer.create_set());
    return renderer;
}

Result<void> FrameRenderer::resize(VkExtent2D extent) {
    options_.extent = extent;
    if (compute_) ORO_CHECK(compute_->resize(extent));
    ORO_CHECK(create_images());
    return create_set();
}

Result<void> FrameRenderer::create_images() {
    const VkExtent2D extent = options_.extent;
    // The compute path keeps ids and depths in a buffer of its own.
    const VkExtent2D raster_extent = compute_ ? VkExtent2D{1, 1} : extent;
    const VkExtent2D sum_extent =
        options_.several_samples || options_.smooth_edges ? extent : VkExtent2D{1, 1};
    constexpr VkImageUsageFlags read_back = VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    ORO_TRY(ids_, create_image(*gpu_, id_format, raster_extent,
                               VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_STORAGE_BIT | read_back,
                               VK_IMAGE_ASPECT_COLOR_BIT, "triangle ids"));
    ORO_TRY(depth_, create_image(*gpu_, depth_format, raster_extent,
                                 VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | read_back,
                                 VK_IMAGE_ASPECT_DEPTH_BIT, "depth"));
    ORO_TRY(sum_, create_image(*gpu_, sum_format, sum_extent, VK_IMAGE_USAGE_STORAGE_BIT,
                               VK_IMAGE_ASPECT_COLOR_BIT, "sum of samples"));
    ORO_TRY(picture_, create_image(*gpu_, picture_format_vk, extent,
                                   VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | read_back,
                                   VK_IMAGE_ASPECT_COLOR_BIT, "picture"));
    return {};
}

Result<void> FrameRenderer::create_set() {
    const std::array sizes{VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, 3},
                           VkDescriptorPoolSize{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1}};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
    pool.pPoolSizes = sizes.data();
    VkDescriptorPool pool_handle{};
    ORO_VK(vkCreateDescriptorPool(gpu_->device(), &pool, nullptr, &pool_handle));
    pool_ = OwnedDescriptorPool(gpu_->device(), pool_handle);
    gpu_->name(VK_OBJECT_TYPE_DESCRIPTOR_POOL, pool_handle, "frame");
    const VkDescriptorSetLayout layout = pipelines_->set.get();
    VkDescriptorSetAllocateInfo set{};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    set.descriptorPool = pool_handle;
    set.descriptorSetCount = 1;
    set.pSetLayouts = &layout;
    ORO_VK(vkAllocateDescriptorSets(gpu_->device(), &set, &set_));
    gpu_->name(VK_OBJECT_TYPE_DESCRIPTOR_SET, set_, "frame");
    const std::array<VkImageView, 3> views{ids_.view.get(), sum_.view.get(), picture_.view.get()};
    std::array<VkDescriptorImageInfo, 3> images{};
    std::array<VkWriteDescriptorSet, 3> writes{};
    for (std::uint32_t i = 0; i < 3; ++i) {
        images[i] = {VK_NULL_HANDLE, views[i], VK_IMAGE_LAYOUT_GENERAL};
        writes[i].sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        writes[i].dstSet = set_;
        writes[i].dstBinding = i;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
        writes[i].pImageInfo = &images[i];
    }
    vkUpdateDescriptorSets(gpu_->device(), 3, writes.data(), 0, nullptr);
    if (frame_data_.handle) bind_constants();
    return {};
}

// The constants are at the beginning of the frame's data.
void FrameRenderer::bind_constants() const {
    const VkDescriptorBufferInfo buffer{frame_data_.handle.get(), 0, sizeof(gpu::FrameConstants)};
    VkWriteDescriptorSet write{};
    write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    write.dstSet = set_;
    write.dstBinding = 3;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER;
    write.pBufferInfo = &buffer;
    vkUpdateDescriptorSets(gpu_->device(), 1, &write, 0, nullptr);
}

// Room for the pages of a plan, on both sides, and for what is chosen of them.
Result<void> FrameRenderer::reserve(const FramePlan& plan) {
    const FrameLayout layout = layout_of(plan);
    if (staging_.size < layout.size) {
        const VkDeviceSize size = std::max(layout.size, 2 * staging_.size);
        ORO_TRY(Buffer staging, create_buffer(*gpu_, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                              MemoryKind::upload, "frame staging"));
        constexpr VkBufferUsageFlags usage =
            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
            VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
        ORO_TRY(frame_data_, create_buffer(*gpu_, size, usage, MemoryKind::device, "frame data"));
        staging_ = std::move(staging);  // both are that large, or neither is
        bind_constants();
    }
    const std::size_t count = std::max<std::size_t>(plan.pages.size(), 64);
    if (compute_) ORO_CHECK(compute_->reserve_pages(count));
    if (count > page_capacity_) {
        // A multiple of 4, so that each part starts at a multiple of 16 bytes.
        const std::size_t capacity = (std::max(count, 2 * page_capacity_) + 3) / 4 * 4;
        constexpr VkBufferUsageFlags usage =
            VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
            VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
        ORO_TRY(choice_, create_buffer(*gpu_, 4 * (live_pages_words + capacity * choice_words), usage,
                                       MemoryKind::device, "choice of levels"));
        page_capacity_ = capacity;
    }
    const VkDeviceSize pixels = VkDeviceSize{4} * options_.extent.width * options_.extent.height;
    if (needs_depths() && depths_.size < pixels) {
        ORO_TRY(depths_, create_buffer(*gpu_, pixels,
                                       VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                           VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                       MemoryKind::device, "depths"));
    }
    const VkDeviceSize triangles =
        VkDeviceSize{triangle_rows()} * options_.extent.width * sizeof(gpu::DrawnTriangle);
    if (options_.keep_triangles && triangles_.size < triangles) {
        ORO_TRY(triangles_,
                create_buffer(*gpu_, triangles,
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                  VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                              MemoryKind::device, "triangles"));
    }
    const VkDeviceSize positions = count * gpu::page_posts * gpu::page_posts * sizeof(gpu::vec3);
    if (options_.record_positions && recorded_.size < positions) {
        ORO_TRY(recorded_,
                create_buffer(*gpu_, positions,
                              VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                              MemoryKind::readback, "recorded positions"));
    }
    return {};
}

void FrameRenderer::address_choice(gpu::FrameConstants& constants) const {
    VkDeviceAddress at = choice_.address;
    constants.live_pages = address_words(at);
    at += 4 * live_pages_words;
    constants.live = address_words(at);
    at += 4 * live_words * page_capacity_;
    constants.accepted = address_words(at);
    at += VkDeviceSize{4} * gpu::accepted_words * page_capacity_;
    constants.edges = address_words(at);
}

Result<void> FrameRenderer::upload(FramePlan& plan, const gpu::FrameStyle& style, std::uint32_t sample_index,
                                   std::uint32_t sample_count, DrapeStore* drape) {
    ORO_CHECK(reserve(plan));
    const FrameLayout layout = layout_of(plan);
    gpu::FrameConstants& constants = plan.constants;
    constants.sample_index = sample_index;
    constants.sample_count = sample_count;
    constants.pages = address_words(frame_data_.address + pages_offset);
    constants.row_terms = address_words(frame_data_.address + layout.rows);
    constants.column_terms = address_words(frame_data_.address + layout.columns);
    constants.counts = address_words(counts_.address);
    if (needs_depths()) constants.depths = address_words(depths_.address);
    if (options_.keep_triangles) {
        constants.triangles = address_words(triangles_.address);
        constants.triangle_rows = triangle_rows();
    }
    if (options_.record_positions) constants.recorded = address_words(recorded_.address);
    constants.record_view = options_.record_view ? 1U : 0U;
    constants.style = style;
    ORO_CHECK(
        drape_.prepare(*gpu_, options_.path, *pipelines_, options_.shades ? drape : nullptr, constants));
    if (options_.shades) {
        ORO_CHECK(air_.prepare(*gpu_, *pipelines_, constants));
        ORO_CHECK(casters_.prepare(*gpu_, options_.path, *pipelines_, plan, constants));
        ORO_CHECK(choose_shading(constants));
    }
    address_choice(constants);
    if (compute_) compute_->address(constants);
    const auto copy = [&](VkDeviceSize at, const auto& values) {
        if (!values.empty())
            std::memcpy(staging_.mapped + at, values.data(), values.size() * sizeof(values[0]));
    };
    std::memcpy(staging_.mapped, &constants, sizeof(constants));
    copy(pages_offset, plan.pages);
    copy(layout.rows, plan.row_terms);
    copy(layout.columns, plan.column_terms);
    last_width_px_ = constants.width_px;
    return {};
}

void FrameRenderer::record_upload(VkCommandBuffer commands, const FramePlan& plan) const {
    const VkBufferCopy copy{0, 0, layout_of(plan).size};
    vkCmdCopyBuffer(commands, staging_.handle.get(), frame_data_.handle.get(), 1, &copy);
    vkCmdFillBuffer(commands, counts_.handle.get(), 0, VK_WHOLE_SIZE, 0);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT,
                   VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                       VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
}

// Levels: which nodes of which pages, for whichever way of drawing follows.
void FrameRenderer::record_choice(VkCommandBuffer commands, const FramePlan& plan) const {
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_->layout.get(), 0, 1, &set_,
                            0, nullptr);
    const auto count = static_cast<std::uint32_t>(plan.pages.size());
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_->accept.get());
    if (count > 0)
        vkCmdDispatch(commands, std::min(count, gpu::groups_per_row),
                      (count + gpu::groups_per_row - 1) / gpu::groups_per_row, 1);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_->live_pages.get());
    vkCmdDispatch(commands, 1, 1, 1);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                       VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
}

void FrameRenderer::record_raster(VkCommandBuffer commands, const FramePlan& plan) const {
    image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, unused, as_colour);
    image_barrier(commands, depth_.handle.get(), VK_IMAGE_ASPECT_DEPTH_BIT, unused, as_depth);
    VkRenderingAttachmentInfo colour{};
    colour.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    colour.imageView = ids_.view.get();
    colour.imageLayout = as_colour.layout;
    colour.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingAttachmentInfo depth = colour;
    depth.imageView = depth_.view.get();
    depth.imageLayout = as_depth.layout;
    depth.clearValue.depthStencil = {0.0F, 0};
    VkRenderingInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    rendering.renderArea.extent = {plan.constants.width_px, plan.constants.height_px};
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachments = &colour;
    rendering.pDepthAttachment = &depth;
    vkCmdBeginRendering(commands, &rendering);
    const VkViewport viewport{
        0.0F, 0.0F, static_cast<float>(plan.constants.width_px), static_cast<float>(plan.constants.height_px),
        0.0F, 1.0F};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &rendering.renderArea);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_->terrain.get());
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_->layout.get(), 0, 1, &set_,
                            0, nullptr);
    gpu_->draw_mesh_tasks_indirect()(commands, choice_.handle.get(), offsetof(gpu::LivePages, task_groups), 1,
                                     0);
    vkCmdEndRendering(commands);
    // The task shader has written the edges that the shading pass reads.
    memory_barrier(commands,
                   VK_PIPELINE_STAGE_2_TASK_SHADER_BIT_EXT | VK_PIPELINE_STAGE_2_MESH_SHADER_BIT_EXT,
                   VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
}

void FrameRenderer::record(VkCommandBuffer commands, const FramePlan& plan) {
    const auto stamp = [&](std::uint32_t number) {
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, timestamps_.get(), number);
    };
    vkCmdResetQueryPool(commands, timestamps_.get(), 0, timestamp_count);
    record_upload(commands, plan);
    stamp(0);
    record_choice(commands, plan);
    stamp(1);
    if (compute_) {
        compute_->record(commands, *pipelines_, plan, choice_.handle.get());
    } else {
        record_raster(commands, plan);
    }
    stamp(2);
    if (drape_.is_on()) {
        record_wants(commands, plan);
    } else if (options_.shades) {
        record_shade(commands, plan);
    } else if (options_.keep_triangles) {
        record_ids_alone(commands);
    }
    stamp(3);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
                   VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_HOST_READ_BIT);
    const VkBufferCopy copy{0, 0, sizeof(gpu::FrameCounts)};
    vkCmdCopyBuffer(commands, counts_.handle.get(), counts_read_.handle.get(), 1, &copy);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
}

Result<FrameReport> FrameRenderer::draw(FramePlan plan, const gpu::FrameStyle& style,
                                        std::uint32_t sample_index, std::uint32_t sample_count,
                                        DrapeStore* drape) {
    assert(plan.constants.width_px <= options_.extent.width &&
           plan.constants.height_px <= options_.extent.height);
    assert(sample_count == 1 || (options_.several_samples && !options_.smooth_edges));
    ORO_CHECK(upload(plan, style, sample_index, sample_count, drape));
    ORO_CHECK(commands_.run(*gpu_, [&](VkCommandBuffer commands) { record(commands, plan); }));
    FrameReport report;
    std::memcpy(&report.counts, counts_read_.mapped, sizeof(report.counts));
    report.pages = plan.pages.size();
    if (!compute_)
        report.task_groups = std::uint64_t{report.counts.pages_live} *
                             (gpu::meshlets_per_page / pipelines_->meshlets_per_task);
    if (report.counts.triangles_not_clipped > 0)
        return Error{ErrorKind::failed, "picture",
                     std::to_string(report.counts.triangles_not_clipped) +
                         " triangles more than the compute path can clip in a frame; --pipeline mesh can"};
    if (drape_.is_on()) {
        ORO_TRY(report.images_settled, shade_with_images(plan));
    }
    std::array<std::uint64_t, timestamp_count> ticks{};
    const std::uint32_t written = drape_.is_on() ? timestamp_count : 4;
    ORO_VK(vkGetQueryPoolResults(gpu_->device(), timestamps_.get(), 0, written, sizeof(ticks), ticks.data(),
                                 sizeof(std::uint64_t), VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
    const auto between_s = [&](std::size_t from) {
        return gpu_->seconds_between(ticks[from], ticks[from + 1]);
    };
    report.choose_s = between_s(0);
    report.raster_s = between_s(1);
    report.shade_s = between_s(drape_.is_on() ? 4 : 2);
    return report;
}

}  // namespace oro
