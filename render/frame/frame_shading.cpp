// The part of FrameRenderer that turns triangle ids into colours. Which tiles of images over the ground these
// need is known when the triangles are drawn, so a frame with images is submitted in two parts, unless others
// are under way.
#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/lod/ground_means.h"
#include "render/frame/frame_layout.h"
#include "render/frame/frame_renderer.h"
#include "render/pipelines/shading_pipelines.h"

namespace oro {
namespace {

constexpr std::uint32_t tile_px = 8;
std::uint32_t tiles_of(std::uint32_t pixels) {
    return (pixels + tile_px - 1) / tile_px;
}

}  // namespace

// The programs of a frame, and what they hand to each other. In air, near ground has a program without the
// code for footprints of several parts, for water and for what is no ground: that takes registers from all.
// Not where a processor draws: it makes each program anew in each process, which takes it 0.2 s.
Result<void> FrameRenderer::choose_shading(GridFrame& grid, gpu::FrameConstants& constants) {
    const gpu::FrameStyle& style = constants.style;
    ShadingKind kind = shading_of(style);
    kind.casts = grid.casters.has_shadows();
    kind.opens = grid.casters.opens();
    kind.draped = grid.drape.is_on();
    kind.by_means = constants.has_means != 0 && asks_for_means(style);
    kind.edges_follow = options_.smooth_edges;
    kind.on_net = constants.has_net != 0;
    kind.on_clusters = constants.clusters.on != 0;
    kind.parts_follow = kind.by_means && kind.in_air && style.footprint == gpu::footprint_mean &&
                        shades_as_gpu(*gpu_, options_.as_on_gpu);
    ORO_TRY(grid.shade, shading_for(*gpu_, options_.path, kind, *pipelines_));
    if (kind.edges_follow) {
        ORO_TRY(edges_, edges_for(*gpu_, options_.path, kind, *pipelines_));
    }
    grid.shade_parts = VK_NULL_HANDLE;
    if (!kind.parts_follow) return {};
    std::swap(kind.parts_follow, kind.parts_alone);
    ORO_TRY(grid.shade_parts, shading_for(*gpu_, options_.path, kind, *pipelines_));
    const VkDeviceSize bytes =
        sizeof(gpu::uint) * VkDeviceSize{tiles_of(options_.extent.width)} * tiles_of(options_.extent.height);
    if (tiles_in_parts_.size < bytes) {
        ORO_CHECK(replace_buffer(*gpu_, tiles_in_parts_, bytes,
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                     VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                 MemoryKind::device, "tiles in parts"));
    }
    constants.tiles_in_parts = address_words(tiles_in_parts_.address);
    return {};
}

// What each pixel sees of the sun: past the terrain of all grids, where there are several.
void FrameRenderer::record_casters(VkCommandBuffer commands, const FramePlan& plan) {
    const auto each = [&](const auto& record_grid) {
        for (std::size_t i = 0; i < plan.grids.size(); ++i) {
            if (!grids_[i].casters.any()) continue;
            grids_[i].bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
            record_grid(grids_[i].casters);
        }
    };
    if (shared_shares_.is_on()) shared_shares_.record_clear(commands);
    each([&](CasterBuffers& casters) { casters.record_casters(commands, *pipelines_); });
    each([&](CasterBuffers& casters) { casters.record_places(commands, *pipelines_); });
    each([&](CasterBuffers& casters) { casters.record_shares(commands, *pipelines_); });
    if (!mesh_shadows_.is_on()) return;
    for (std::size_t i = 0; i < plan.grids.size(); ++i) {
        if (!grids_[i].casters.has_shadows()) continue;
        grids_[i].bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
        mesh_shadows_.record(commands, *pipelines_);
        return;
    }
}

void FrameRenderer::record_shade(VkCommandBuffer commands, const FramePlan& plan) {
    const bool in_parts =
        std::any_of(grids_.begin(), grids_.begin() + static_cast<std::ptrdiff_t>(plan.grids.size()),
                    [](const GridFrame& grid) { return grid.shade_parts != VK_NULL_HANDLE; });
    if (slots_[slot_].passes) slots_[slot_].passes->begin(commands);
    if (in_parts) vkCmdFillBuffer(commands, tiles_in_parts_.handle.get(), 0, VK_WHOLE_SIZE, 0);
    grids_.front().bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
    air_.record(commands, *pipelines_);
    end_pass(commands, "air");
    image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT,
                  has_images(plan) ? shader_read
                  : compute_       ? unused
                                   : as_colour,
                  shader_read);
    record_casters(commands, plan);
    end_pass(commands, "shadows and sky");
    record_growth(commands, plan);
    const bool first = plan.grids.front().constants.sample_index == 0;
    image_barrier(commands, sum_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, first ? unused : shader_write,
                  shader_write);
    image_barrier(commands, picture_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, unused, shader_write);
    if (in_parts)
        memory_barrier(commands, VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                       VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    bool before = false;
    const auto pass = [&](const GridFrame& grid, VkPipeline pipeline) {
        if (pipeline == VK_NULL_HANDLE) return;
        if (before)
            memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                           VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                           VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
        grid.bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
        if (grid.growth.is_on()) grid.growth.push(commands, *pipelines_);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        dispatch_pixels(commands, plan);
        before = true;
    };
    for (std::size_t i = 0; i < plan.grids.size(); ++i) {
        pass(grids_[i], grids_[i].shade);
        end_pass(commands, "ground of one place");
        pass(grids_[i], grids_[i].shade_parts);
        end_pass(commands, "ground of several places");
    }
    record_growth_pixels(commands, plan, GrowthPass::raise);
    end_pass(commands, "far forests");
    record_growth_pixels(commands, plan, GrowthPass::shade);
    end_pass(commands, "colours of trees and grass");
    record_growth_pixels(commands, plan, GrowthPass::mirror);
    if (tiled_.step_px > 0) record_growth_pixels(commands, plan, GrowthPass::keep);
    end_pass(commands, "mirrors");
    for (std::size_t i = 0; options_.smooth_edges && i < plan.grids.size(); ++i) pass(grids_[i], edges_);
    end_pass(commands, "edges of the ground");
    record_growth_pixels(commands, plan, GrowthPass::smooth);
    end_pass(commands, "outlines of trees and grass");
    if (options_.show != gpu::show_colours) record_show(commands, plan);
}

// A program of shade.comp or edges.comp over the frame's pixels, or those of its part and the tiles beside
// it, whose colours and depths edges depend on.
void FrameRenderer::dispatch_pixels(VkCommandBuffer commands, const FramePlan& plan) const {
    const std::uint32_t columns = tiles_of(plan.view.width_px()), rows = tiles_of(plan.view.height_px());
    if (!part_) {
        vkCmdDispatch(commands, columns, rows, 1);
        return;
    }
    // Far forests reach up into pixels above them.
    const std::uint32_t beside = has_growth(plan) ? gpu::canopy_search_px / tile_px : 1U;
    const auto first = [&](std::int32_t px) {
        return std::max(static_cast<std::uint32_t>(px) / tile_px, beside) - beside;
    };
    const auto last = [&](std::int32_t px, std::uint32_t count_px, std::uint32_t most) {
        return std::min(tiles_of(static_cast<std::uint32_t>(px) + count_px) + beside, most);
    };
    const std::uint32_t left = first(part_->offset.x), top = first(part_->offset.y),
                        right = last(part_->offset.x, part_->extent.width, columns),
                        bottom = last(part_->offset.y, part_->extent.height, rows);
    vkCmdDispatchBase(commands, left, top, 0, right - left, bottom - top, 1);
}

// What draws each pixel, over its colours.
void FrameRenderer::record_show(VkCommandBuffer commands, const FramePlan& plan) const {
    for (std::size_t i = 0; i < plan.grids.size(); ++i) {
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                       VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
        grids_[i].bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_->show.get());
        vkCmdDispatch(commands, tiles_of(plan.view.width_px()), tiles_of(plan.view.height_px()), 1);
    }
}

// For those who read them instead of the shading pass.
void FrameRenderer::record_ids_alone(VkCommandBuffer commands) const {
    image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, compute_ ? unused : as_colour,
                  shader_read);
}

void FrameRenderer::record_tile_feedback(VkCommandBuffer commands, const FramePlan& plan) const {
    record_ids_alone(commands);
    for (std::size_t i = 0; i < plan.grids.size(); ++i) {
        if (!grids_[i].drape.is_on()) continue;
        grids_[i].bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
        grids_[i].drape.record(commands, *pipelines_, plan.grids[i].constants);
    }
}

// The same question again. Another seed: two tiles of one hash have others now.
Result<void> FrameRenderer::ask_again(const GridFrame& grid, const GridPlan& plan, std::uint32_t seed) {
    return commands().run(*gpu_, [&](VkCommandBuffer commands) {
        constexpr VkDeviceSize at =
            offsetof(gpu::FrameConstants, drape) + offsetof(gpu::DrapeTable, request_seed);
        vkCmdUpdateBuffer(commands, grid.data().handle.get(), at, sizeof(seed), &seed);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
                       VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                       VK_ACCESS_2_UNIFORM_READ_BIT);
        grid.bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
        grid.drape.record(commands, *pipelines_, plan.constants);
    });
}

// Whether images lie over one of its grids.
bool FrameRenderer::has_images(const FramePlan& plan) const {
    return std::any_of(grids_.begin(), grids_.begin() + static_cast<std::ptrdiff_t>(plan.grids.size()),
                       [](const GridFrame& grid) { return grid.drape.is_on(); });
}

// Brings the tiles that a grid is coloured from: all of them, unless there is no room or nobody waits.
Result<bool> FrameRenderer::load_requested_tiles(const GridFrame& grid, const GridPlan& plan,
                                                 const Slot& slot) {
    constexpr std::uint32_t most_tries = 64;
    const bool waits = slot.in_parts && options_.waits_for_images;
    const auto number = static_cast<std::size_t>(&slot - slots_.data());
    DrapeStore& store = grid.drape.store();
    store.begin_frame();
    for (std::uint32_t turn = 1;; ++turn) {
        const bool missing = grid.drape.is_missing_any(number);
        ORO_TRY(const bool has_capacity, store.serve(grid.drape.wanted(number), waits));
        if (!missing) return true;
        if (!has_capacity || !waits || turn == most_tries) return false;
        ORO_CHECK(ask_again(grid, plan, turn));
    }
}

// True where the images are as fine as the frame asks for.
Result<bool> FrameRenderer::load_images(const Slot& slot) {
    bool settled = true;
    for (std::size_t i = 0; i < slot.plan->grids.size(); ++i) {
        if (!grids_[i].drape.is_on()) continue;
        ORO_TRY(const bool here, load_requested_tiles(grids_[i], slot.plan->grids[i], slot));
        settled = settled && here;
    }
    return settled;
}

// The second part of a frame, with the images that are there now.
Result<void> FrameRenderer::shade_with_images(Slot& slot) {
    return slot.commands.run(*gpu_, [&](VkCommandBuffer commands) {
        grids_.front().bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slot.timestamps.get(), 4);
        record_shade(commands, *slot.plan);
        vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slot.timestamps.get(), 5);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
                       VK_ACCESS_2_TRANSFER_READ_BIT | VK_ACCESS_2_HOST_READ_BIT);
    });
}

}  // namespace oro
