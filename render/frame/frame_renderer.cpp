#include "render/frame/frame_renderer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <utility>

#include "render/device/timestamps.h"
#include "render/frame/frame_layout.h"
#include "shaders/shared_heights.h"
#include "shaders/shared_mesh_pages.h"

namespace oro {
namespace {

constexpr std::uint32_t timestamp_count = 6;  // the last two with images over the ground alone

// Ids of triangles go on from one grid to the next, and then over the tiles of trees and grass of each: these
// are others to all grids.
Result<void> number_pages(FramePlan& plan, bool draws_growth) {
    std::size_t first = 0, others = plan.grids.size() - 1;
    for (GridPlan& grid : plan.grids) {
        if (!draws_growth) {
            grid.growth = {};
            grid.meadow = {};
        }
        if (!grid.growth.tiles.empty()) ++others;
        if (!grid.meadow.tiles.empty()) ++others;
        grid.constants.first_page = static_cast<gpu::uint>(first);
        first += grid.pages.size();
    }
    for (GridPlan& grid : plan.grids) grid.constants.other_grids = static_cast<gpu::uint>(others);
    if (first > gpu::pages_max)
        return Error{ErrorKind::failed, "picture",
                     "needs " + std::to_string(first) + " pages of all its grids; a frame numbers " +
                         std::to_string(gpu::pages_max) + " at most: a larger --tau takes fewer"};
    const auto number = [&](auto& growth) {
        growth.tiles.resize(std::min(growth.tiles.size(), gpu::pages_max - first));
        growth.first_page = static_cast<gpu::uint>(first);
        first += growth.tiles.size();
    };
    for (GridPlan& grid : plan.grids) number(grid.meadow);
    for (GridPlan& grid : plan.grids) number(grid.growth);
    return {};
}

PipelineWants wants_of(const FrameRendererOptions& options, bool packed_heights, bool meshes) {
    return {options.record_positions,
            options.keep_triangles,
            options.show != gpu::show_colours,
            options.leave_out_small && !options.record_positions,
            options.show == gpu::show_overdraw,
            options.shares_triangles,
            packed_heights,
            meshes,
            options.list_room,
            options.split};
}

bool has_meshes(const GridPlan& grid) {
    return grid.constants.contents == gpu::contents_meshes;
}

bool has_packed_heights(const GridPlan& grid) {
    return grid.constants.height_bits == gpu::height_bits_packed && !has_meshes(grid);
}

}  // namespace

Result<FrameRenderer> FrameRenderer::create(const Gpu& gpu, const FrameRendererOptions& options) {
    assert(options.extent.width > 0 && options.extent.width <= gpu.report().max_picture_side_px);
    assert(options.extent.height > 0 && options.extent.height <= gpu.report().max_picture_side_px);
    FrameRenderer renderer(gpu);
    renderer.options_ = options;
    const bool overdraw = options.show == gpu::show_overdraw;
    if (overdraw && options.path == RasterPath::mesh && !gpu.report().fragment_stores)
        return Error{
            ErrorKind::failed, gpu.report().name,
            "cannot count triangles by mesh shaders (fragmentStoresAndAtomics is missing); --pipeline "
            "compute can"};
    ORO_TRY(renderer.pipelines_, shared_pipelines(gpu, options.path, wants_of(options, false, false)));
    ORO_CHECK(renderer.create_slot(renderer.slots_.front()));
    constexpr VkBufferUsageFlags counted =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
        VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    ORO_TRY(renderer.counts_,
            create_buffer(gpu, sizeof(gpu::FrameCounts), counted, MemoryKind::device, "counts"));
    if (options.path == RasterPath::compute) {
        ORO_TRY(ComputeRaster compute, ComputeRaster::create(gpu, options.extent));
        renderer.compute_.emplace(std::move(compute));
    }
    renderer.grids_.emplace_back();
    renderer.occlusion_.emplace(options.record_positions ? OcclusionUse::off : options.occlusion,
                                options.nearest_pyramid);
    ORO_CHECK(renderer.create_images());
    ORO_CHECK(renderer.create_sets());
    return renderer;
}

// At its first frame.
Result<void> FrameRenderer::create_slot(Slot& slot) const {
    if (slot.counts_read.handle) return {};
    ORO_TRY(slot.commands, Commands::create(*gpu_, "frame"));
    ORO_TRY(slot.timestamps, create_timestamps(*gpu_, timestamp_count, "frame times"));
    if (options_.time_passes) {
        ORO_TRY(PassTimes passes, PassTimes::create(*gpu_));
        slot.passes = std::make_unique<PassTimes>(std::move(passes));
    }
    ORO_TRY(slot.counts_read, create_buffer(*gpu_, sizeof(gpu::FrameCounts), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                            MemoryKind::readback, "counts read back"));
    return {};
}

Result<void> FrameRenderer::resize(VkExtent2D extent) {
    assert(under_way_.empty());
    options_.extent = extent;
    if (compute_) ORO_CHECK(compute_->resize(extent));
    ORO_CHECK(create_images());
    return create_sets();
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
    ORO_TRY(depth_,
            create_image(*gpu_, depth_format, raster_extent,
                         VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT | read_back,
                         VK_IMAGE_ASPECT_DEPTH_BIT, "depth"));
    ORO_TRY(sum_, create_image(*gpu_, sum_format, sum_extent, VK_IMAGE_USAGE_STORAGE_BIT,
                               VK_IMAGE_ASPECT_COLOR_BIT, "sum of samples"));
    ORO_TRY(picture_, create_image(*gpu_, picture_format_vk, extent,
                                   VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT | read_back,
                                   VK_IMAGE_ASPECT_COLOR_BIT, "picture"));
    return occlusion_->resize(*gpu_, options_.path, extent);
}

Result<void> FrameRenderer::create_sets() {
    for (GridFrame& grid : grids_)
        ORO_CHECK(grid.create_set(
            *gpu_, *pipelines_, {ids_.view.get(), sum_.view.get(), picture_.view.get(), depth_.view.get()}));
    return {};
}

// Those for the way in which the frame's heights are kept, and for meshes where it has any.
Result<void> FrameRenderer::choose_pipelines(const FramePlan& plan) {
    const bool packed = std::ranges::any_of(plan.grids, has_packed_heights);
    const bool meshes = std::ranges::any_of(plan.grids, has_meshes);
    if (packed == pipelines_->packed_heights && meshes == pipelines_->meshes) return {};
    if (!under_way_.empty()) ORO_VK(vkQueueWaitIdle(gpu_->queue()));
    ORO_TRY(pipelines_, shared_pipelines(*gpu_, options_.path, wants_of(options_, packed, meshes)));
    return create_sets();
}

// Room for all that a frame's grids share.
Result<void> FrameRenderer::reserve(const FramePlan& plan) {
    // Meshlets of so many pages are listed, or clusters.
    std::size_t most_pages = 64;
    for (const GridPlan& grid : plan.grids)
        most_pages =
            std::max({most_pages, grid.page_room(), grid.clusters.drawn.size() / gpu::meshlets_per_page + 1});
    if (compute_) ORO_CHECK(compute_->reserve(most_pages, Occlusion::most_rounds * plan.grids.size()));
    while (grids_.size() < plan.grids.size()) {
        GridFrame& grid = grids_.emplace_back();
        ORO_CHECK(grid.create_set(
            *gpu_, *pipelines_, {ids_.view.get(), sum_.view.get(), picture_.view.get(), depth_.view.get()}));
    }
    const VkDeviceSize pixels = VkDeviceSize{4} * options_.extent.width * options_.extent.height;
    constexpr VkBufferUsageFlags read_back = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                             VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                             VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    if (needs_depths() && depths_.size < pixels)
        ORO_CHECK(replace_buffer(*gpu_, depths_, pixels, read_back, MemoryKind::device, "depths"));
    if (options_.show == gpu::show_overdraw && overdraw_.size < pixels)
        ORO_CHECK(replace_buffer(*gpu_, overdraw_, pixels,
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                     VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                 MemoryKind::device, "triangles over pixels"));
    ORO_CHECK(reserve_growth(plan));
    const VkDeviceSize triangles =
        VkDeviceSize{triangle_rows()} * options_.extent.width * sizeof(gpu::DrawnTriangle);
    if (options_.keep_triangles && triangles_.size < triangles)
        ORO_CHECK(replace_buffer(*gpu_, triangles_, triangles, read_back, MemoryKind::device, "triangles"));
    const VkDeviceSize positions = std::max<std::size_t>(plan.grids.front().pages.size(), 64) *
                                   gpu::page_posts * gpu::page_posts * sizeof(gpu::vec3);
    if (options_.record_positions && recorded_.size < positions)
        ORO_CHECK(
            replace_buffer(*gpu_, recorded_, positions,
                           VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                           MemoryKind::readback, "recorded positions"));
    return {};
}

// All that the programs of the frame's grid of that number read of it.
Result<void> FrameRenderer::upload(std::size_t number, GridPlan& plan, const FrameAsked& asked) {
    GridFrame& grid = grids_[number];
    gpu::FrameConstants& constants = plan.constants;
    occlusion_->address(constants);
    ORO_CHECK(grid.reserve(*gpu_, plan, slot_));
    constants.sample_index = asked.sample_index;
    constants.sample_count = asked.sample_count;
    constants.counts = address_words(counts_.address);
    if (needs_depths()) constants.depths = address_words(depths_.address);
    if (options_.keep_triangles) {
        constants.triangles = address_words(triangles_.address);
        constants.triangle_rows = triangle_rows();
    }
    if (options_.record_positions) constants.recorded = address_words(recorded_.address);
    constants.record_view = options_.record_view ? 1U : 0U;
    constants.style = asked.style;
    if (plan.growth.tiles.empty()) constants.style.materials.on &= ~gpu::materials_with_trees;
    if (plan.meadow.tiles.empty()) constants.style.materials.on &= ~gpu::materials_with_grass;
    constants.show = options_.show;
    constants.overdraw = address_words(overdraw_.address);
    if (plan.clusters.on)
        ORO_CHECK(add_cluster_pipelines(*gpu_, options_.path, options_.keep_triangles, *pipelines_));
    DrapeStore* const drape = number < asked.drapes.size() ? asked.drapes[number] : nullptr;
    ORO_CHECK(grid.drape.prepare(*gpu_, options_.path, *pipelines_, options_.shades ? drape : nullptr, slot_,
                                 constants));
    if (options_.shades) {
        ORO_CHECK(air_.prepare(*gpu_, *pipelines_, constants, asked.exact_air));
        const ShareOptions how{options_.path, !shades_as_gpu(*gpu_, options_.as_on_gpu)};
        ORO_CHECK(grid.casters.prepare(*gpu_, how, *pipelines_, plan, shared_shares_, slot_, constants));
        ORO_CHECK(choose_shading(grid, constants));
    }
    ORO_CHECK(choose_growth(grid, plan));
    if (plan.device.chooses && number > 0)
        plan.device.choice.frame_counts_before = address_words(grids_[number - 1].frame_counts());
    grid.address(plan);
    if (compute_) compute_->address(constants);
    if (!compute_ && visibility_.handle) constants.visibility = address_words(visibility_.address);
    grid.fill(plan);
    return {};
}

void FrameRenderer::record_upload(VkCommandBuffer commands, std::size_t grids) const {
    for (std::size_t i = 0; i < grids; ++i) grids_[i].record_upload(commands);
    vkCmdFillBuffer(commands, counts_.handle.get(), 0, VK_WHOLE_SIZE, 0);
    if (overdraw_.handle) vkCmdFillBuffer(commands, overdraw_.handle.get(), 0, VK_WHOLE_SIZE, 0);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT,
                   VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   VK_ACCESS_2_UNIFORM_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                       VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
}

Result<void> FrameRenderer::prepare_device_plans(const FramePlan& plan) {
    const auto any = [&](bool DevicePlan::*is_on) {
        return std::ranges::any_of(plan.grids, [&](const GridPlan& grid) { return grid.device.*is_on; });
    };
    if (any(&DevicePlan::chooses)) return prepare_choice();
    if (!plan_pass_ && any(&DevicePlan::on)) {
        ORO_TRY(PlanPass pass, PlanPass::create(*gpu_));
        plan_pass_.emplace(std::move(pass));
    }
    return {};
}

Result<void> FrameRenderer::prepare_choice() {
    if (!plan_pass_) {
        ORO_TRY(PlanPass pass, PlanPass::create(*gpu_));
        plan_pass_.emplace(std::move(pass));
    }
    if (!choice_pass_) {
        ORO_TRY(ChoicePass pass, ChoicePass::create(*gpu_));
        choice_pass_.emplace(std::move(pass));
    }
    return {};
}

void FrameRenderer::record_device_plans(VkCommandBuffer commands, const FramePlan& plan) const {
    bool any = false;
    for (std::size_t i = 0; i < plan.grids.size(); ++i) {
        const DevicePlan& device = plan.grids[i].device;
        if (!device.chooses) continue;
        choice_pass_->record(commands, device.choice, grids_[i].choice_terms());
        ChoicePass::record_end(commands);
    }
    for (std::size_t i = 0; i < plan.grids.size(); ++i) {
        if (!plan.grids[i].device.on) continue;
        plan_pass_->record(commands, plan.grids[i].device, grids_[i].plan_terms());
        any = true;
    }
    if (any) PlanPass::record_end(commands);
}

void FrameRenderer::record(VkCommandBuffer commands, const Slot& slot) {
    const FramePlan& plan = *slot.plan;
    const auto stamp = [&](std::uint32_t number) {
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slot.timestamps.get(), number);
    };
    vkCmdResetQueryPool(commands, slot.timestamps.get(), 0, timestamp_count);
    wait_for_earlier(commands);
    record_upload(commands, plan.grids.size());
    stamp(0);
    record_device_plans(commands, plan);
    record_clear(commands, plan);
    for (std::size_t i = 0; i < plan.grids.size(); ++i) record_choice(commands, grids_[i], plan.grids[i]);
    stamp(1);
    record_rounds(commands, plan);
    stamp(2);
    if (slot.has_images) {
        record_tile_feedback(commands, plan);
    } else if (options_.shades) {
        record_shade(commands, plan);
    } else if (options_.keep_triangles) {
        record_ids_alone(commands);
    }
    stamp(3);
    if (slot.has_images && !slot.in_parts) {
        stamp(4);
        record_shade(commands, plan);
        stamp(5);
    }
    memory_barrier(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
                   VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_HOST_READ_BIT);
    const VkBufferCopy copy{0, 0, sizeof(gpu::FrameCounts)};
    vkCmdCopyBuffer(commands, counts_.handle.get(), slot.counts_read.handle.get(), 1, &copy);
    for (std::size_t i = 0; i < plan.grids.size(); ++i) grids_[i].record_feedback(commands);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
}

Result<void> FrameRenderer::begin(FramePlan plan, const FrameAsked& asked) {
    assert(!plan.grids.empty());
    assert(plan.view.width_px() <= options_.extent.width && plan.view.height_px() <= options_.extent.height);
    assert(asked.sample_count == 1 ||
           (options_.several_samples && !options_.smooth_edges && options_.show == gpu::show_colours));
    assert(under_way_.size() < slots_.size());
    slot_ = 0;
    while (std::ranges::find(under_way_, slot_) != under_way_.end()) ++slot_;
    Slot& slot = slots_[slot_];
    ORO_CHECK(create_slot(slot));
    ORO_CHECK(number_pages(plan, draws_growth()));
    ORO_CHECK(choose_pipelines(plan));
    ORO_CHECK(reserve(plan));
    ORO_CHECK(prepare_device_plans(plan));
    occlusion_->begin(plan, remembers(plan));
    if (occlusion_->is_on() && !occlusion_->uses_last_frame())
        for (GridFrame& grid : grids_) grid.forget();
    ORO_CHECK(shared_shares_.reserve(*gpu_, plan, asked.style));
    ORO_CHECK(mesh_shadows_.prepare(*gpu_, options_.path, *pipelines_, plan, shared_shares_, slot_));
    last_width_px_ = plan.view.width_px();
    last_grids_.clear();
    for (std::size_t i = 0; i < plan.grids.size(); ++i) {
        ORO_CHECK(upload(i, plan.grids[i], asked));
        last_grids_.push_back(plan.grids[i].page_room() == 0 ? 0 : 1);
    }
    slot.has_images = has_images(plan);
    slot.in_parts = asked.in_parts;
    slot.plan = std::move(plan);
    ORO_CHECK(slot.commands.submit(*gpu_, [&](VkCommandBuffer commands) { record(commands, slot); }));
    under_way_.push_back(slot_);
    slot.trial = occlusion_->trial();
    remember(*slot.plan);
    return {};
}

Result<FrameReport> FrameRenderer::draw(FramePlan plan, const gpu::FrameStyle& style,
                                        std::uint32_t sample_index, std::uint32_t sample_count,
                                        std::vector<DrapeStore*> drapes) {
    assert(under_way_.empty());
    ORO_CHECK(begin(std::move(plan), {style, sample_index, sample_count, drapes, true, true}));
    return finish();
}

Result<void> FrameRenderer::submit(FramePlan plan, const gpu::FrameStyle& style,
                                   std::vector<DrapeStore*> drapes) {
    return begin(std::move(plan), {style, 0, 1, drapes, false, false});
}

Result<FrameReport> FrameRenderer::finish() {
    assert(!under_way_.empty());
    Slot& slot = slots_[under_way_.front()];
    under_way_.erase(under_way_.begin());
    ORO_CHECK(slot.commands.wait());
    ORO_TRY(FrameReport report, report_of(slot));
    if (slot.has_images) {
        ORO_TRY(report.images_settled, load_images(slot));
    }
    if (slot.has_images && slot.in_parts) ORO_CHECK(shade_with_images(slot));
    ORO_CHECK(add_times(slot, report));
    return report;
}

// All but how long it took.
Result<FrameReport> FrameRenderer::report_of(Slot& slot) {
    const FramePlan& plan = *slot.plan;
    const auto number = static_cast<std::size_t>(&slot - slots_.data());
    FrameReport report;
    std::memcpy(&report.counts, slot.counts_read.mapped, sizeof(report.counts));
    for (std::size_t i = 0; i < plan.grids.size(); ++i) {
        const GridPlan& grid = plan.grids[i];
        report.pages += grid.pages.size();
        if (slot.trial.is_on || grid.device.chooses) {
            report.feedback.resize(i);
            report.feedback.push_back(slot.trial.is_on ? grids_[i].feedback_of(grid, number)
                                                       : FrameFeedback());
        }
        if (grid.device.chooses) {
            report.feedback.back().choice = grids_[i].choice_of(grid, number);
            report.pages += report.feedback.back().choice->counts.open;
        }
        report.counts.meshlets_beyond_frustum += static_cast<gpu::uint>(grid.clusters.beyond_frustum);
        report.counts.meshlets_beyond_horizon += static_cast<gpu::uint>(grid.clusters.beyond_horizon);
    }
    if (report.counts.triangles_not_clipped > 0)
        return Error{ErrorKind::failed, "picture",
                     std::to_string(report.counts.triangles_not_clipped) +
                         " triangles more than the compute path can clip in a frame; --pipeline mesh can"};
    return report;
}

Result<void> FrameRenderer::add_times(const Slot& slot, FrameReport& report) {
    std::array<std::uint64_t, timestamp_count> ticks{};
    const std::uint32_t written = slot.has_images ? timestamp_count : 4;
    ORO_VK(vkGetQueryPoolResults(gpu_->device(), slot.timestamps.get(), 0, written, sizeof(ticks),
                                 ticks.data(), sizeof(std::uint64_t),
                                 VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
    const auto between_s = [&](std::size_t from) {
        return gpu_->seconds_between(ticks[from], ticks[from + 1]);
    };
    report.choose_s = between_s(0);
    report.raster_s = between_s(1);
    occlusion_->end(slot.trial, report.raster_s);
    report.shade_s = between_s(slot.has_images ? 4 : 2);
    if (slot.passes && options_.shades) {
        ORO_TRY(report.passes, slot.passes->read(*gpu_));
    }
    return {};
}

void FrameRenderer::end_pass(VkCommandBuffer commands, const char* name) const {
    oro::end_pass(slots_[slot_].passes.get(), commands, name);
}

}  // namespace oro
