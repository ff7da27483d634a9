// The part of FrameRenderer that brings pages to ids and depths: in one round, or in several, each of which
// leaves out what the ground of those before it hides (occlusion.h).
#include <algorithm>
#include <cstddef>

#include "render/frame/frame_layout.h"
#include "render/frame/frame_renderer.h"

namespace oro {

void FrameRenderer::push(VkCommandBuffer commands, const gpu::FrameRound& round) const {
    vkCmdPushConstants(commands, pipelines_->layout.get(), pipelines_->round_stages, 0, sizeof(round),
                       &round);
}

// Of the compute path: its own buffer, while levels are chosen.
void FrameRenderer::record_clear(VkCommandBuffer commands, const FramePlan& plan) const {
    if (!compute_) return;
    grids_.front().bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
    gpu::FrameRound round{};
    round.lists = compute_->lists();
    push(commands, round);
    compute_->record_clear(commands, *pipelines_, plan);
}

// Levels: which nodes of which pages, for whichever way of drawing follows.
void FrameRenderer::record_choice(VkCommandBuffer commands, const GridFrame& grid,
                                  const GridPlan& plan) const {
    if (plan.clusters.on) return;  // the first round makes their cut
    grid.bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
    const auto count = static_cast<std::uint32_t>(plan.pages.size());
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_->lod_test.get());
    if (plan.device.chooses)
        vkCmdDispatchIndirect(commands, grid.data().handle.get(), grid.page_groups());
    else if (count > 0)
        vkCmdDispatch(commands, std::min(count, gpu::groups_per_row),
                      (count + gpu::groups_per_row - 1) / gpu::groups_per_row, 1);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    push(commands, {});
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_->live_pages.get());
    vkCmdDispatch(commands, 1, 1, 1);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                       VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
}

// The meshlets of a grid that the round draws, or its clusters, which have pipelines of their own; the frame
// has no other grid then. ties: what is as near as what is there.
void FrameRenderer::record_meshes(VkCommandBuffer commands, std::size_t grid, bool ties) const {
    grids_[grid].bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_GRAPHICS);
    const VkDeviceSize clusters = grids_[grid].cluster_groups();
    const OwnedPipeline& draws = clusters > 0
                                     ? (ties ? pipelines_->cluster_ties : pipelines_->cluster_terrain)
                                 : ties ? pipelines_->terrain_ties
                                        : pipelines_->terrain;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, draws.get());
    if (clusters > 0) {
        gpu_->draw_mesh_tasks_indirect()(commands, grids_[grid].data().handle.get(), clusters, 1, 0);
        return;
    }
    gpu_->draw_mesh_tasks_indirect()(commands, grids_[grid].choice().handle.get(),
                                     4 * round_pages_at + offsetof(gpu::LivePages, task_groups), 1, 0);
}

void FrameRenderer::record_raster(VkCommandBuffer commands, const FramePlan& plan, std::size_t number) const {
    const bool first = number == 0;
    image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, first ? unused : shader_read,
                  as_colour);
    image_barrier(commands, depth_.handle.get(), VK_IMAGE_ASPECT_DEPTH_BIT, first ? unused : depth_read,
                  as_depth);
    VkRenderingAttachmentInfo colour{};
    colour.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
    colour.imageView = ids_.view.get();
    colour.imageLayout = as_colour.layout;
    colour.loadOp = first ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
    colour.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    VkRenderingAttachmentInfo depth = colour;
    depth.imageView = depth_.view.get();
    depth.imageLayout = as_depth.layout;
    depth.clearValue.depthStencil = {0.0F, 0};
    VkRenderingInfo rendering{};
    rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
    rendering.renderArea.extent = {plan.view.width_px(), plan.view.height_px()};
    rendering.layerCount = 1;
    rendering.colorAttachmentCount = 1;
    rendering.pColorAttachments = &colour;
    rendering.pDepthAttachment = &depth;
    vkCmdBeginRendering(commands, &rendering);
    const VkViewport viewport{
        0.0F, 0.0F, static_cast<float>(plan.view.width_px()), static_cast<float>(plan.view.height_px()),
        0.0F, 1.0F};
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &rendering.renderArea);
    gpu::FrameRound round = occlusion_->rounds()[number];
    push(commands, round);
    for (std::size_t i = 0; i < plan.grids.size(); ++i) record_meshes(commands, i, false);
    if (!first && occlusion_->may_tie()) {
        // The same once more, from the highest id down: where it is as near as what is there, the lower id
        // wins.
        round.backwards = 1;
        push(commands, round);
        for (std::size_t i = plan.grids.size(); i-- > 0;) record_meshes(commands, i, true);
    }
    vkCmdEndRendering(commands);
    // Counts and recorded positions.
    memory_barrier(commands,
                   VK_PIPELINE_STAGE_2_TASK_SHADER_BIT_EXT | VK_PIPELINE_STAGE_2_MESH_SHADER_BIT_EXT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
}

// What the ground so far hides: of the compute path's visibility buffer, or of the mesh path's images.
void FrameRenderer::record_pyramid(VkCommandBuffer commands, const FramePlan& plan) const {
    if (!compute_) {
        image_barrier(commands, ids_.handle.get(), VK_IMAGE_ASPECT_COLOR_BIT, as_colour, shader_read);
        image_barrier(commands, depth_.handle.get(), VK_IMAGE_ASPECT_DEPTH_BIT, as_depth, depth_read);
    }
    grids_.front().bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
    occlusion_->record_pyramid(commands, *pipelines_, plan);
}

// What of a grid the round draws.
void FrameRenderer::record_round_choice(VkCommandBuffer commands, const GridFrame& grid,
                                        const ClusterPlan& clusters, bool first) const {
    if (clusters.on) {
        vkCmdBindPipeline(
            commands, VK_PIPELINE_BIND_POINT_COMPUTE,
            (first ? pipelines_->choose_clusters : pipelines_->choose_clusters_second_pass).get());
        const auto count = static_cast<std::uint32_t>(clusters.drawn.size());
        const std::uint32_t groups = (count + gpu::clusters_per_choice - 1) / gpu::clusters_per_choice;
        if (groups > 0) vkCmdDispatch(commands, groups, 1, 1);
        return;
    }
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                      (first ? pipelines_->cull : pipelines_->cull_second_pass).get());
    vkCmdDispatchIndirect(commands, grid.choice().handle.get(), offsetof(gpu::LivePages, cull_groups));
}

// A round of one grid after the other: what is drawn of it is chosen, and by the compute path drawn at once.
void FrameRenderer::record_round(VkCommandBuffer commands, const FramePlan& plan, std::size_t number) const {
    gpu::FrameRound round = occlusion_->rounds()[number];
    const std::size_t grids = plan.grids.size();
    for (std::size_t i = 0; i < grids; ++i) {
        const ClusterPlan& clusters = plan.grids[i].clusters;
        grids_[i].bind(commands, *pipelines_, VK_PIPELINE_BIND_POINT_COMPUTE);
        round.lists_round = 0;
        round.lists = static_cast<gpu::uint>(number * grids + i);
        push(commands, round);
        record_round_choice(commands, grids_[i], clusters, number == 0);
        if (compute_) compute_->record(commands, *pipelines_, clusters.on, round.lists);
        if (compute_ || clusters.on) continue;
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                       VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
        round.lists_round = 1;
        push(commands, round);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines_->live_pages.get());
        vkCmdDispatch(commands, 1, 1, 1);
    }
    if (compute_) return;
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                       VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
    record_raster(commands, plan, number);
}

void FrameRenderer::record_rounds(VkCommandBuffer commands, const FramePlan& plan) const {
    const std::size_t count = occlusion_->rounds().size();
    for (std::size_t number = 0; number < count; ++number) {
        if (number > 0) record_pyramid(commands, plan);
        record_round(commands, plan, number);
    }
}

// Whether it is known what the last frame saw of any grid.
bool FrameRenderer::remembers(const FramePlan& plan) const {
    for (std::size_t i = 0; i < plan.grids.size(); ++i)
        if (grids_[i].remembers(plan.grids[i])) return true;
    return false;
}

void FrameRenderer::remember(const FramePlan& plan) {
    if (!occlusion_->is_on()) return;
    for (std::size_t i = 0; i < plan.grids.size(); ++i) grids_[i].remember(plan.grids[i]);
    for (std::size_t i = plan.grids.size(); i < grids_.size(); ++i) grids_[i].forget();
}

}  // namespace oro
