#include "render/growth/growth_frame.h"

#include <algorithm>
#include <cstring>

#include "spirv/draw_crowns_comp.h"
#include "spirv/draw_shade_map_comp.h"
#include "spirv/grow_sites_comp.h"
#include "spirv/keep_ids_comp.h"
#include "spirv/seed_visibility_comp.h"
#include "spirv/shade_growth_comp.h"
#include "spirv/smooth_crowns_comp.h"

namespace oro {
namespace {

constexpr VkDeviceSize tiles_at = (sizeof(gpu::GrowthTable) + 15) / 16 * 16;

std::size_t number_of(const GrowthKind& kind) {
    return (kind.casts ? 1U : 0U) + (kind.opens ? 2U : 0U) + (kind.draped ? 4U : 0U) +
           (kind.by_means ? 8U : 0U) + (kind.edges_follow ? 16U : 0U);
}

// By constant_id of grow_sites.comp and shade_growth.comp.
Result<OwnedPipeline> create_growth_pipeline(const Gpu& gpu, const Pipelines& pipelines,
                                             std::span<const std::uint32_t> words, const char* name,
                                             const GrowthKind& kind) {
    const auto flag = [](bool on) { return on ? VK_TRUE : VK_FALSE; };
    const std::array<VkBool32, 5> values{flag(kind.casts), flag(kind.opens), flag(kind.draped),
                                         flag(kind.by_means), flag(kind.edges_follow)};
    std::array<VkSpecializationMapEntry, values.size()> entries{};
    for (std::uint32_t i = 0; i < entries.size(); ++i)
        entries[i] = {i + 1, i * std::uint32_t{sizeof(VkBool32)}, sizeof(VkBool32)};
    const VkSpecializationInfo constants{entries.size(), entries.data(), sizeof(values), values.data()};
    return create_compute_pipeline(gpu, pipelines, words, name, &constants);
}

void dispatch_groups(VkCommandBuffer commands, std::uint32_t groups) {
    vkCmdDispatch(commands, std::min(groups, gpu::groups_per_row),
                  (groups + gpu::groups_per_row - 1) / gpu::groups_per_row, 1);
}

}  // namespace

Result<void> GrowthFrame::prepare(const Gpu& gpu, Pipelines& pipelines, const GrowthPlan& plan,
                                  gpu::uint first_page, const GrowthKind& kind, std::size_t slot) {
    slot_ = slot;
    tiles_ = static_cast<gpu::uint>(plan.tiles.size());
    if (tiles_ == 0) return {};
    constexpr VkBufferUsageFlags usage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    const VkDeviceSize table_bytes = tiles_at + tiles_ * sizeof(gpu::GrowthTile);
    if (tables_[slot].size < table_bytes) {
        ORO_TRY(tables_[slot], create_buffer(gpu, std::max(table_bytes, 2 * tables_[slot].size), usage,
                                             MemoryKind::upload, "tiles of trees"));
    }
    const VkDeviceSize site_bytes = VkDeviceSize{tiles_} * gpu::sites_per_tile * sizeof(gpu::uint);
    if (sites_.size < site_bytes)
        ORO_CHECK(replace_buffer(gpu, sites_, site_bytes, usage, MemoryKind::device, "sites of trees"));
    constexpr VkDeviceSize map_bytes =
        VkDeviceSize{gpu::shade_map_side} * gpu::shade_map_side * sizeof(gpu::uint);
    if (kind.casts && !shade_map_.handle) {
        ORO_TRY(shade_map_, create_buffer(gpu, map_bytes, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                          MemoryKind::device, "shadows of trees"));
    }
    if (kind.casts && !pipelines.draw_shade_map) {
        ORO_TRY(pipelines.draw_shade_map,
                create_compute_pipeline(gpu, pipelines, draw_shade_map_comp_spirv, "shadows of trees"));
    }
    map_ = kind.casts ? pipelines.draw_shade_map.get() : VK_NULL_HANDLE;
    gpu::GrowthTable table{};
    if (kind.casts) table.shade_map = address_words(shade_map_.address);
    table.tiles = address_words(tables_[slot].address + tiles_at);
    table.sites = address_words(sites_.address);
    table.tile_count = tiles_;
    table.first_page = first_page;
    table.reach_m = plan.reach_m;
    std::memcpy(tables_[slot].mapped, &table, sizeof(table));
    std::memcpy(tables_[slot].mapped + tiles_at, plan.tiles.data(), tiles_ * sizeof(gpu::GrowthTile));
    auto& kept = pipelines.growth[number_of(kind)];
    if (!kept[0]) {
        ORO_TRY(kept[0],
                create_growth_pipeline(gpu, pipelines, grow_sites_comp_spirv, "sites of trees", kind));
        ORO_TRY(kept[1],
                create_growth_pipeline(gpu, pipelines, shade_growth_comp_spirv, "shade trees", kind));
    }
    if (!pipelines.draw_crowns) {
        ORO_TRY(pipelines.draw_crowns,
                create_compute_pipeline(gpu, pipelines, draw_crowns_comp_spirv, "draw trees"));
    }
    if (kind.edges_follow && !pipelines.smooth_crowns) {
        ORO_TRY(pipelines.smooth_crowns,
                create_compute_pipeline(gpu, pipelines, smooth_crowns_comp_spirv, "outlines of trees"));
    }
    smooth_ = kind.edges_follow ? pipelines.smooth_crowns.get() : VK_NULL_HANDLE;
    grow_ = kept[0].get();
    shade_ = kept[1].get();
    draw_ = pipelines.draw_crowns.get();
    return {};
}

void GrowthFrame::push(VkCommandBuffer commands, const Pipelines& pipelines) const {
    const gpu::uvec2 table = address_words(tables_[slot_].address);
    static_assert(sizeof(table) <= sizeof(gpu::FrameRound));
    vkCmdPushConstants(commands, pipelines.layout.get(), pipelines.round_stages, 0, sizeof(table), &table);
}

void GrowthFrame::record_draw(VkCommandBuffer commands, const Pipelines& pipelines) const {
    push(commands, pipelines);
    const std::uint32_t groups = tiles_ * gpu::site_groups_per_tile;
    if (map_ != VK_NULL_HANDLE) vkCmdFillBuffer(commands, shade_map_.handle.get(), 0, VK_WHOLE_SIZE, 0);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, grow_);
    dispatch_groups(commands, groups);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, draw_);
    dispatch_groups(commands, groups);
    if (map_ == VK_NULL_HANDLE) return;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, map_);
    dispatch_groups(commands, groups);
}

void GrowthFrame::record_pixels(VkCommandBuffer commands, const Pipelines& pipelines, VkPipeline pipeline,
                                gpu::uint width_px, gpu::uint height_px) const {
    push(commands, pipelines);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdDispatch(commands, (width_px + 7) / 8, (height_px + 7) / 8, 1);
}

Result<void> add_visibility_copies(const Gpu& gpu, Pipelines& pipelines) {
    if (pipelines.keep_ids) return {};
    ORO_TRY(pipelines.seed_visibility,
            create_compute_pipeline(gpu, pipelines, seed_visibility_comp_spirv, "ids and depths kept"));
    ORO_TRY(pipelines.keep_ids, create_compute_pipeline(gpu, pipelines, keep_ids_comp_spirv, "ids of trees"));
    return {};
}

}  // namespace oro
