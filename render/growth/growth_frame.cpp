#include "render/growth/growth_frame.h"

#include <algorithm>
#include <cstring>

#include "spirv/draw_crowns_comp.h"
#include "spirv/draw_large_crowns_comp.h"
#include "spirv/draw_shade_map_comp.h"
#include "spirv/farthest_depths_comp.h"
#include "spirv/grow_sites_comp.h"
#include "spirv/keep_for_tiles_comp.h"
#include "spirv/keep_ids_comp.h"
#include "spirv/list_sites_comp.h"
#include "spirv/mirror_in_water_comp.h"
#include "spirv/raise_canopy_comp.h"
#include "spirv/seed_visibility_comp.h"
#include "spirv/shade_growth_comp.h"
#include "spirv/smooth_crowns_comp.h"
#include "spirv/sort_pieces_comp.h"

namespace oro {
namespace {

// growth/picture_kept.glsl has the picture right behind the table.
constexpr VkDeviceSize picture_at = sizeof(gpu::GrowthTable);
constexpr VkDeviceSize tiles_at = (picture_at + sizeof(gpu::TiledPicture) + 15) / 16 * 16;

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

std::uint32_t blocks_of(std::uint32_t pixels) {
    return (pixels + gpu::depth_block_px - 1) / gpu::depth_block_px;
}

void dispatch_groups(VkCommandBuffer commands, std::uint32_t groups) {
    vkCmdDispatch(commands, std::min(groups, gpu::groups_per_row),
                  (groups + gpu::groups_per_row - 1) / gpu::groups_per_row, 1);
}

}  // namespace

Result<void> GrowthFrame::prepare(const Gpu& gpu, Pipelines& pipelines, const GrowthPlan& plan,
                                  const GrowthKind& kind, VkExtent2D culled, std::size_t slot) {
    slot_ = slot;
    tiles_ = static_cast<gpu::uint>(plan.tiles.size());
    if (tiles_ == 0) return {};
    ORO_CHECK(reserve(gpu, kind, culled));
    ORO_CHECK(choose_pipelines(gpu, pipelines, kind));
    write_table(plan, kind);
    return {};
}

Result<void> GrowthFrame::reserve(const Gpu& gpu, const GrowthKind& kind, VkExtent2D culled) {
    constexpr VkBufferUsageFlags usage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    const VkDeviceSize table_bytes = tiles_at + tiles_ * sizeof(gpu::GrowthTile);
    if (tables_[slot_].size < table_bytes) {
        ORO_TRY(tables_[slot_], create_buffer(gpu, std::max(table_bytes, 2 * tables_[slot_].size), usage,
                                              MemoryKind::upload, "tiles of trees"));
    }
    const VkDeviceSize site_bytes = VkDeviceSize{tiles_} * gpu::sites_per_tile * sizeof(gpu::uint);
    if (sites_.size < 2 * site_bytes)
        ORO_CHECK(replace_buffer(gpu, sites_, 2 * site_bytes, usage, MemoryKind::device, "sites of trees"));
    constexpr VkDeviceSize map_bytes =
        VkDeviceSize{gpu::shade_map_side} * gpu::shade_map_side * sizeof(gpu::uint);
    if (kind.casts && !shade_map_.handle) {
        ORO_TRY(shade_map_, create_buffer(gpu, map_bytes, usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                          MemoryKind::device, "shadows of trees"));
    }
    if (!lists_.handle) {
        ORO_TRY(lists_,
                create_buffer(gpu, sizeof(gpu::CrownLists),
                              usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                              MemoryKind::device, "lists of crowns"));
    }
    const VkDeviceSize depth_bytes =
        sizeof(float) * VkDeviceSize{blocks_of(culled.width)} * blocks_of(culled.height);
    culls_ = depth_bytes > 0;
    if (farthest_.size < depth_bytes)
        ORO_CHECK(replace_buffer(gpu, farthest_, depth_bytes, usage, MemoryKind::device, "farthest depths"));
    return {};
}

Result<void> GrowthFrame::choose_pipelines(const Gpu& gpu, Pipelines& pipelines, const GrowthKind& kind) {
    const auto need = [&](OwnedPipeline& pipeline, std::span<const std::uint32_t> words,
                          const char* name) -> Result<void> {
        if (pipeline) return {};
        ORO_TRY(pipeline, create_compute_pipeline(gpu, pipelines, words, name));
        return {};
    };
    ORO_CHECK(need(pipelines.list_sites, list_sites_comp_spirv, "sites in view"));
    ORO_CHECK(need(pipelines.draw_crowns, draw_crowns_comp_spirv, "draw trees"));
    ORO_CHECK(need(pipelines.sort_pieces, sort_pieces_comp_spirv, "order of large trees"));
    ORO_CHECK(need(pipelines.draw_large_crowns, draw_large_crowns_comp_spirv, "draw large trees"));
    if (culls_) ORO_CHECK(need(pipelines.farthest_depths, farthest_depths_comp_spirv, "farthest depths"));
    if (kind.casts) ORO_CHECK(need(pipelines.draw_shade_map, draw_shade_map_comp_spirv, "shadows of trees"));
    if (kind.edges_follow)
        ORO_CHECK(need(pipelines.smooth_crowns, smooth_crowns_comp_spirv, "outlines of trees"));
    auto& kept = pipelines.growth[number_of(kind)];
    if (!kept[0]) {
        ORO_TRY(kept[0],
                create_growth_pipeline(gpu, pipelines, grow_sites_comp_spirv, "sites of trees", kind));
        ORO_TRY(kept[1],
                create_growth_pipeline(gpu, pipelines, shade_growth_comp_spirv, "shade trees", kind));
    }
    ORO_CHECK(choose_changes(gpu, pipelines, kind));
    map_ = kind.casts ? pipelines.draw_shade_map.get() : VK_NULL_HANDLE;
    smooth_ = kind.edges_follow ? pipelines.smooth_crowns.get() : VK_NULL_HANDLE;
    grow_ = kept[0].get();
    shade_ = kept[1].get();
    return {};
}

// What changes pixels once they are coloured.
Result<void> GrowthFrame::choose_changes(const Gpu& gpu, Pipelines& pipelines, const GrowthKind& kind) {
    OwnedPipeline& raise = pipelines.raise_canopy[kind.edges_follow ? 1 : 0];
    OwnedPipeline& mirror = pipelines.mirror_in_water[kind.edges_follow ? 1 : 0];
    if (!raise) {
        ORO_TRY(raise, create_growth_pipeline(gpu, pipelines, raise_canopy_comp_spirv, "far forests", kind));
    }
    if (!mirror) {
        ORO_TRY(mirror, create_growth_pipeline(gpu, pipelines, mirror_in_water_comp_spirv, "mirrors", kind));
    }
    const bool is_tile = kind.picture.step_px > 0;
    if (is_tile && !pipelines.keep_for_tiles) {
        ORO_TRY(pipelines.keep_for_tiles,
                create_compute_pipeline(gpu, pipelines, keep_for_tiles_comp_spirv, "pixels for other tiles"));
    }
    raise_ = raise.get();
    mirror_ = mirror.get();
    keep_ = is_tile ? pipelines.keep_for_tiles.get() : VK_NULL_HANDLE;
    return {};
}

void GrowthFrame::write_table(const GrowthPlan& plan, const GrowthKind& kind) {
    gpu::GrowthTable table{};
    if (kind.casts) table.shade_map = address_words(shade_map_.address);
    if (culls_) table.farthest = address_words(farthest_.address);
    table.canopy = address_words(kind.canopy);
    table.lists = address_words(lists_.address);
    table.tiles = address_words(tables_[slot_].address + tiles_at);
    table.sites = address_words(sites_.address);
    table.asked =
        address_words(sites_.address + VkDeviceSize{tiles_} * gpu::sites_per_tile * sizeof(gpu::uint));
    table.tile_count = tiles_;
    table.first_page = plan.first_page;
    table.reach_m = plan.reach_m;
    std::memcpy(tables_[slot_].mapped, &table, sizeof(table));
    std::memcpy(tables_[slot_].mapped + picture_at, &kind.picture, sizeof(kind.picture));
    std::memcpy(tables_[slot_].mapped + tiles_at, plan.tiles.data(), tiles_ * sizeof(gpu::GrowthTile));
}

void GrowthFrame::push(VkCommandBuffer commands, const Pipelines& pipelines) const {
    const gpu::uvec2 table = address_words(tables_[slot_].address);
    static_assert(sizeof(table) <= sizeof(gpu::FrameRound));
    vkCmdPushConstants(commands, pipelines.layout.get(), pipelines.round_stages, 0, sizeof(table), &table);
}

void GrowthFrame::record_draw(VkCommandBuffer commands, const Pipelines& pipelines, gpu::uint width_px,
                              gpu::uint height_px, PassTimes* times) const {
    push(commands, pipelines);
    const auto wait = [&](VkPipelineStageFlags2 stages, VkAccessFlags2 access) {
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | stages,
                       VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | access,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                       VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                           VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
    };
    // An earlier frame may still read them.
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                   0, VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
                   VK_ACCESS_2_TRANSFER_WRITE_BIT);
    // Groups of pieces, of shadows, of sites, of pieces that are brought into order; then counts.
    constexpr std::array<gpu::uint, offsetof(gpu::CrownLists, crowns) / sizeof(gpu::uint)> nothing{
        0, 1, 1, 0, 1, 1, 0, 1, 1, 0, 1, 1};
    static_assert(offsetof(gpu::CrownLists, asked_count) == 12 * sizeof(gpu::uint));
    vkCmdUpdateBuffer(commands, lists_.handle.get(), 0, sizeof(nothing), nothing.data());
    if (map_ != VK_NULL_HANDLE) vkCmdFillBuffer(commands, shade_map_.handle.get(), 0, VK_WHOLE_SIZE, 0);
    if (culls_) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines.farthest_depths.get());
        vkCmdDispatch(commands, blocks_of(width_px), blocks_of(height_px), 1);
    }
    // Whatever an earlier pass has found: groups lie at `groups` in the lists.
    const auto draw = [&](VkPipeline pipeline, VkDeviceSize groups) {
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
        vkCmdDispatchIndirect(commands, lists_.handle.get(), groups);
    };
    wait(VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines.list_sites.get());
    dispatch_groups(commands, tiles_ * gpu::site_groups_per_tile);
    end_pass(times, commands, "sites in view");
    wait(0, 0);
    draw(grow_, offsetof(gpu::CrownLists, site_groups));
    end_pass(times, commands, "what stands there");
    wait(0, 0);
    draw(pipelines.draw_crowns.get(), offsetof(gpu::CrownLists, site_groups));
    end_pass(times, commands, "small crowns");
    wait(0, 0);
    draw(pipelines.sort_pieces.get(), offsetof(gpu::CrownLists, sort_groups));
    wait(0, 0);
    draw(pipelines.draw_large_crowns.get(), offsetof(gpu::CrownLists, piece_groups));
    end_pass(times, commands, "large crowns");
    if (map_ == VK_NULL_HANDLE) return;
    draw(map_, offsetof(gpu::CrownLists, shade_groups));
    end_pass(times, commands, "shadows of trees");
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
