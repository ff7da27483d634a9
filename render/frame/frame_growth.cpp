// The part of FrameRenderer that draws trees and grass, once the ground is drawn and what casts shadows is
// known, and before pixels are coloured. Frames without them have none of it.
#include <algorithm>

#include "render/frame/frame_layout.h"
#include "render/frame/frame_renderer.h"

namespace oro {

// Who reads triangles, depths or positions asks for the ground, unless they say otherwise.
bool FrameRenderer::draws_growth() const {
    return options_.shades && options_.show == gpu::show_colours && !options_.keep_triangles &&
           (!options_.keep_depths || options_.depths_of_growth) && !options_.record_positions;
}

bool FrameRenderer::has_growth(const FramePlan& plan) const {
    return std::ranges::any_of(plan.grids, [](const GridPlan& grid) {
        return !grid.growth.tiles.empty() || !grid.meadow.tiles.empty();
    });
}

Result<void> FrameRenderer::reserve_growth(const FramePlan& plan) {
    if (!has_growth(plan)) return {};
    const VkDeviceSize canopy = VkDeviceSize{8} * options_.extent.width * options_.extent.height;
    if (canopy_.size < canopy) {
        ORO_CHECK(replace_buffer(*gpu_, canopy_, canopy,
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                     VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                 MemoryKind::device, "forests beyond their trees"));
    }
    if (compute_) return {};
    ORO_CHECK(add_visibility_copies(*gpu_, *pipelines_));
    const VkDeviceSize bytes = VkDeviceSize{8} * options_.extent.width * options_.extent.height;
    if (visibility_.size >= bytes) return {};
    return replace_buffer(*gpu_, visibility_, bytes,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::device, "visibility");
}

Result<void> FrameRenderer::begin_tiled_picture(VkExtent2D size_px) {
    // 384 MiB: all of a picture of 33 million pixels.
    constexpr std::uint64_t most = std::uint64_t{1} << 25U;
    const auto kept = [&](std::uint64_t step) {
        return ((size_px.width + step - 1) / step) * ((size_px.height + step - 1) / step);
    };
    std::uint64_t step = 1;
    while (kept(step) > most) ++step;
    const VkDeviceSize bytes = kept(step) * sizeof(gpu::KeptOfPicture);
    if (kept_picture_.size < bytes)
        ORO_CHECK(replace_buffer(*gpu_, kept_picture_, bytes,
                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                     VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                 MemoryKind::device, "a picture of several tiles"));
    tiled_ = {};
    tiled_.pixels = address_words(kept_picture_.address);
    tiled_.width_px = size_px.width;
    tiled_.height_px = size_px.height;
    tiled_.step_px = static_cast<gpu::uint>(step);
    return commands().run(*gpu_, [&](VkCommandBuffer commands) {
        wait_for_earlier(commands);
        vkCmdFillBuffer(commands, kept_picture_.handle.get(), 0, VK_WHOLE_SIZE, 0);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                       VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    });
}

void FrameRenderer::keep_for_tiles(const VkRect2D& own) {
    tiled_.own_x_px = static_cast<gpu::uint>(own.offset.x);
    tiled_.own_y_px = static_cast<gpu::uint>(own.offset.y);
    tiled_.own_width_px = own.extent.width;
    tiled_.own_height_px = own.extent.height;
}

Result<void> FrameRenderer::choose_growth(GridFrame& grid, const GridPlan& plan) {
    const gpu::FrameConstants& constants = plan.constants;
    const GrowthKind kind{grid.casters.has_shadows(),
                          grid.casters.opens(),
                          grid.drape.is_on(),
                          constants.has_means != 0,
                          options_.smooth_edges,
                          canopy_.address,
                          tiled_};
    const VkExtent2D culled = options_.occlusion == OcclusionUse::off ? VkExtent2D{} : options_.extent;
    ORO_CHECK(grid.growth.prepare(*gpu_, *pipelines_, plan.growth, kind, culled, slot_));
    return grid.meadow.prepare(*gpu_, *pipelines_, plan.meadow, kind, grid.growth, slot_);
}

void FrameRenderer::record_growth(VkCommandBuffer commands, const FramePlan& plan) const {
    if (!has_growth(plan)) return;
    const auto wait = [&] {
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                       VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    };
    // An earlier frame, or sample, may still read it.
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, 0, VK_PIPELINE_STAGE_2_CLEAR_BIT,
                   VK_ACCESS_2_TRANSFER_WRITE_BIT);
    vkCmdFillBuffer(commands, canopy_.handle.get(), 0, VK_WHOLE_SIZE, 0);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_CLEAR_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    const auto copy = [&](const OwnedPipeline& pipeline) {
        wait();
        grids_.front().bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline.get());
        vkCmdDispatch(commands, (plan.view.width_px() + 7) / 8, (plan.view.height_px() + 7) / 8, 1);
    };
    if (!compute_) {
        image_barrier(commands, depth_.handle.get(), VK_IMAGE_ASPECT_DEPTH_BIT, as_depth, depth_read);
        copy(pipelines_->seed_visibility);
    }
    wait();
    for (std::size_t i = 0; i < plan.grids.size(); ++i) {
        if (!grids_[i].growth.is_on()) continue;
        grids_[i].bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
        grids_[i].growth.record_draw(commands, *pipelines_, plan.view.width_px(), plan.view.height_px(),
                                     slots_[slot_].passes.get());
    }
    for (std::size_t i = 0; i < plan.grids.size(); ++i) {
        if (!grids_[i].meadow.is_on()) continue;
        wait();
        grids_[i].bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
        grids_[i].meadow.record_draw(commands, *pipelines_);
        end_pass(commands, "grass");
    }
    if (!compute_) {
        image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, shader_read, shader_write);
        copy(pipelines_->keep_ids);
        image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, shader_write, shader_read);
    }
    wait();
}

void FrameRenderer::record_growth_pixels(VkCommandBuffer commands, const FramePlan& plan,
                                         GrowthPass pass) const {
    const auto record = [&](const GridFrame& grid, const auto& growth, auto pixels) {
        if (!growth.is_on()) return;
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                       VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
        grid.bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
        (growth.*pixels)(commands, *pipelines_, plan.view.width_px(), plan.view.height_px());
    };
    if (pass == GrowthPass::raise || pass == GrowthPass::mirror || pass == GrowthPass::keep) {
        const auto grid = std::ranges::find_if(
            grids_.begin(), grids_.begin() + static_cast<std::ptrdiff_t>(plan.grids.size()),
            [](const GridFrame& one) { return one.growth.is_on(); });
        if (grid - grids_.begin() < static_cast<std::ptrdiff_t>(plan.grids.size()))
            record(*grid, grid->growth,
                   pass == GrowthPass::raise    ? &GrowthFrame::record_raise
                   : pass == GrowthPass::mirror ? &GrowthFrame::record_mirror
                                                : &GrowthFrame::record_keep);
        return;
    }
    const bool shades = pass == GrowthPass::shade;
    for (std::size_t i = 0; i < plan.grids.size(); ++i) {
        const GridFrame& grid = grids_[i];
        record(grid, grid.growth, shades ? &GrowthFrame::record_shade : &GrowthFrame::record_smooth);
        record(grid, grid.meadow, shades ? &MeadowFrame::record_shade : &MeadowFrame::record_smooth);
    }
}

}  // namespace oro
