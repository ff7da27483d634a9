#include "render/raster/occlusion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace oro {
namespace {

// Without a last frame: the nearest 16th of the clusters, or of the pages that have something to draw, then a
// quarter, then all.
constexpr gpu::uint first_share = gpu::round_shares / 16, second_share = gpu::round_shares / 4;

gpu::FrameRound round_of(gpu::uint first, gpu::uint last, bool is_last) {
    gpu::FrameRound round{};
    round.first_share = first;
    round.last_share = last;
    round.is_last = is_last ? 1U : 0U;
    return round;
}

VkDeviceSize pyramid_values(VkExtent2D extent) {
    VkDeviceSize values = 0;
    for (gpu::uint level = gpu::pyramid_finest; level <= gpu::pyramid_coarsest; ++level) {
        const gpu::uint side = 1U << level;
        values += VkDeviceSize{(extent.width + side - 1) / side} * ((extent.height + side - 1) / side);
    }
    return values;
}

}  // namespace

Result<void> Occlusion::resize(const Gpu& gpu, RasterPath path, VkExtent2D extent) {
    constexpr VkBufferUsageFlags usage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    if (use_ == OcclusionUse::off) return {};
    ORO_TRY(pyramid_, create_buffer(gpu, sizeof(float) * pyramid_values(extent), usage, MemoryKind::device,
                                    "depth pyramid"));
    if (path == RasterPath::compute) return {};
    ORO_TRY(ids_before_, create_buffer(gpu, VkDeviceSize{4} * extent.width * extent.height, usage,
                                       MemoryKind::device, "ids of the round before"));
    return {};
}

// Whether most of what a frame shows was in the last one, too. A wrong answer costs time, and nothing else.
bool Occlusion::shows_much_of(const FramePlan& plan) const {
    const gpu::FrameConstants& now = plan.grids.front().constants;  // of the view, which is that of all
    if (last_.page_count == 0 || now.width_px != last_.width_px || now.height_px != last_.height_px ||
        now.first_x_px != last_.first_x_px || now.first_y_px != last_.first_y_px)
        return false;
    const gpu::vec2 zoom = now.projection_scale / last_.projection_scale;
    if (std::min(zoom.x, zoom.y) < 0.8F || std::max(zoom.x, zoom.y) > 1.25F) return false;
    // By a quarter of the picture, at most; and a step of a hundred metres, more where the ground is far
    // below.
    const gpu::mat3 turn = now.view_from_ecef * glm::transpose(last_.view_from_ecef);
    const float largest = 0.5F / std::max(now.projection_scale.x, now.projection_scale.y);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (std::abs(turn[i][j] - (i == j ? 1.0F : 0.0F)) > largest) return false;
    const float moved_m = glm::length((now.eye_high - last_.eye_high) + (now.eye_low - last_.eye_low));
    return moved_m <= 100.0F + 0.05F * std::abs(now.eye_h_m);
}

void Occlusion::begin(const FramePlan& plan, bool remembers) {
    rounds_.assign(1, round_of(0, gpu::round_shares, true));
    may_tie_ = uses_last_frame_ = false;
    if (use_ == OcclusionUse::off) return;
    // What clusters take says nothing of nodes, and the other way round.
    const bool of_clusters =
        std::ranges::any_of(plan.grids, [](const GridPlan& grid) { return grid.clusters.on; });
    if (of_clusters != was_of_clusters_) last_ = {};
    was_of_clusters_ = of_clusters;
    const bool much = shows_much_of(plan);
    last_ = plan.grids.front().constants;
    last_.page_count = 0;
    for (const GridPlan& grid : plan.grids) last_.page_count += grid.constants.page_count;
    if (last_.page_count == 0) return;  // nothing hides anything
    // Other views begin with occlusion: where a view is seen once, that is what it costs least with by the
    // mesh path.
    if (!much) {
        toggle_.forget();
        ++views_;
    }
    // While pages are missing, what is seen decides which come first.
    if (use_ == OcclusionUse::if_it_pays && much && plan.is_settled() && toggle_.disable_next()) return;
    uses_last_frame_ = much && remembers;
    if (uses_last_frame_) {
        rounds_ = {round_of(0, 0, false), round_of(0, gpu::round_shares, true)};
    } else {
        rounds_ = {round_of(0, first_share, false), round_of(first_share, second_share, false),
                   round_of(0, gpu::round_shares, true)};
    }
    // Pages and clusters have numbers from the nearest on: rounds from near to far draw ids in their order.
    may_tie_ = uses_last_frame_ || plan.grids.size() > 1;
    for (gpu::FrameRound& round : rounds_) round.nearest = nearest_ ? 1U : 0U;
}

void Occlusion::address(gpu::FrameConstants& constants) const {
    constants.occlusion = is_on() ? 1U : 0U;
    constants.pyramid = address_words(pyramid_.address);
    constants.ids_before = address_words(ids_before_.address);
}

void Occlusion::record_pyramid(VkCommandBuffer commands, const Pipelines& pipelines,
                               const FramePlan& plan) const {
    constexpr std::uint32_t side_px = 1U << gpu::pyramid_coarsest;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines.pyramid.get());
    vkCmdDispatch(commands, (plan.view.width_px() + side_px - 1) / side_px,
                  (plan.view.height_px() + side_px - 1) / side_px, 1);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
}

Occlusion::Trial Occlusion::trial() {
    // What the first frame in rounds after one without knows of what is seen may be old: it is not counted.
    const Trial trial{is_on(), !is_on() || was_on_, views_};
    was_on_ = is_on();
    return trial;
}

void Occlusion::end(const Trial& trial, double raster_s) {
    if (trial.counts && trial.view == views_) toggle_.report_time(trial.is_on, raster_s);
}

}  // namespace oro
