#include "render/growth/meadow_frame.h"

#include <algorithm>
#include <cstring>

#include "shaders/shared_meadow.h"
#include "spirv/draw_meadow_comp.h"
#include "spirv/grow_meadow_comp.h"
#include "spirv/shade_meadow_comp.h"
#include "spirv/smooth_meadow_comp.h"

namespace oro {
namespace {

constexpr VkDeviceSize meadow_tiles_at = (sizeof(gpu::MeadowTable) + 15) / 16 * 16;

// As many as an indirect dispatch may have groups for, whatever stands.
gpu::uint most_pieces(gpu::uint tiles) {
    constexpr gpu::uint per_tile = gpu::clumps_per_tile * gpu::blades_per_clump / gpu::blades_per_piece;
    return std::min(tiles * per_tile, gpu::pieces_per_group * 65535U);
}

// By constant_id.
Result<OwnedPipeline> create_meadow_pipeline(const Gpu& gpu, const Pipelines& pipelines,
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

}  // namespace

Result<void> MeadowFrame::prepare(const Gpu& gpu, Pipelines& pipelines, const MeadowPlan& plan,
                                  const GrowthKind& kind, const GrowthFrame& trees, std::size_t slot) {
    slot_ = slot;
    tiles_ = static_cast<gpu::uint>(plan.tiles.size());
    if (tiles_ == 0) return {};
    ORO_CHECK(reserve(gpu));
    ORO_CHECK(choose_pipelines(gpu, pipelines, kind));
    write_table(plan, trees);
    return {};
}

Result<void> MeadowFrame::reserve(const Gpu& gpu) {
    constexpr VkBufferUsageFlags usage =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    const VkDeviceSize table_bytes = meadow_tiles_at + tiles_ * sizeof(gpu::GrowthTile);
    if (tables_[slot_].size < table_bytes) {
        ORO_TRY(tables_[slot_], create_buffer(gpu, std::max(table_bytes, 2 * tables_[slot_].size), usage,
                                              MemoryKind::upload, "tiles of grass"));
    }
    const VkDeviceSize clump_bytes = VkDeviceSize{tiles_} * gpu::clumps_per_tile * sizeof(gpu::MeadowClump);
    if (clumps_.size < clump_bytes)
        ORO_CHECK(replace_buffer(gpu, clumps_, clump_bytes, usage, MemoryKind::device, "clumps of grass"));
    const VkDeviceSize piece_bytes =
        sizeof(gpu::MeadowPieces) + VkDeviceSize{most_pieces(tiles_)} * sizeof(gpu::uint);
    if (pieces_.size < piece_bytes)
        ORO_CHECK(
            replace_buffer(gpu, pieces_, piece_bytes,
                           usage | VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT,
                           MemoryKind::device, "pieces of clumps"));
    return {};
}

Result<void> MeadowFrame::choose_pipelines(const Gpu& gpu, Pipelines& pipelines, const GrowthKind& kind) {
    if (!pipelines.draw_meadow) {
        ORO_TRY(pipelines.draw_meadow,
                create_compute_pipeline(gpu, pipelines, draw_meadow_comp_spirv, "draw grass"));
    }
    if (kind.edges_follow && !pipelines.smooth_meadow) {
        ORO_TRY(pipelines.smooth_meadow,
                create_compute_pipeline(gpu, pipelines, smooth_meadow_comp_spirv, "soften grass"));
    }
    OwnedPipeline& shade = pipelines.shade_meadow[kind.edges_follow ? 1 : 0];
    if (!shade) {
        ORO_TRY(shade, create_meadow_pipeline(gpu, pipelines, shade_meadow_comp_spirv, "shade grass", kind));
    }
    const std::size_t number =
        (kind.casts ? 1U : 0U) + (kind.opens ? 2U : 0U) + (kind.draped ? 4U : 0U) + (kind.by_means ? 8U : 0U);
    OwnedPipeline& grow = pipelines.grow_meadow[number];
    if (!grow) {
        ORO_TRY(grow,
                create_meadow_pipeline(gpu, pipelines, grow_meadow_comp_spirv, "clumps of grass", kind));
    }
    grow_ = grow.get();
    shade_ = shade.get();
    smooth_ = kind.edges_follow ? pipelines.smooth_meadow.get() : VK_NULL_HANDLE;
    return {};
}

void MeadowFrame::write_table(const MeadowPlan& plan, const GrowthFrame& trees) {
    gpu::MeadowTable table{};
    if (const Buffer* const map = trees.shade_map()) table.growth.shade_map = address_words(map->address);
    if (const Buffer* const farthest = trees.farthest_depths())
        table.growth.farthest = address_words(farthest->address);
    table.growth.tiles = address_words(tables_[slot_].address + meadow_tiles_at);
    table.growth.sites = address_words(clumps_.address);
    table.growth.tile_count = tiles_;
    table.growth.first_page = plan.first_page;
    table.growth.reach_m = gpu::meadow_reach_m;
    table.pieces = address_words(pieces_.address);
    table.piece_max = most_pieces(tiles_);
    std::memcpy(tables_[slot_].mapped, &table, sizeof(table));
    std::memcpy(tables_[slot_].mapped + meadow_tiles_at, plan.tiles.data(), tiles_ * sizeof(gpu::GrowthTile));
}

void MeadowFrame::push(VkCommandBuffer commands, const Pipelines& pipelines) const {
    const gpu::uvec2 table = address_words(tables_[slot_].address);
    vkCmdPushConstants(commands, pipelines.layout.get(), pipelines.round_stages, 0, sizeof(table), &table);
}

void MeadowFrame::record_draw(VkCommandBuffer commands, const Pipelines& pipelines) const {
    push(commands, pipelines);
    // An earlier frame may still read them.
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                   0, VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COPY_BIT,
                   VK_ACCESS_2_TRANSFER_WRITE_BIT);
    constexpr gpu::MeadowPieces no_pieces{{0, 1, 1}, 0};
    vkCmdUpdateBuffer(commands, pieces_.handle.get(), 0, sizeof(no_pieces), &no_pieces);
    const auto wait = [&] {
        memory_barrier(commands,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT |
                           VK_PIPELINE_STAGE_2_COPY_BIT,
                       VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                       VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                           VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
    };
    wait();
    const std::uint32_t groups = tiles_ * gpu::clump_groups_per_tile;
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, grow_);
    vkCmdDispatch(commands, std::min(groups, gpu::groups_per_row),
                  (groups + gpu::groups_per_row - 1) / gpu::groups_per_row, 1);
    wait();
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipelines.draw_meadow.get());
    vkCmdDispatchIndirect(commands, pieces_.handle.get(), 0);
}

void MeadowFrame::record_pixels(VkCommandBuffer commands, const Pipelines& pipelines, VkPipeline pipeline,
                                gpu::uint width_px, gpu::uint height_px) const {
    push(commands, pipelines);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
    vkCmdDispatch(commands, (width_px + 7) / 8, (height_px + 7) / 8, 1);
}

}  // namespace oro
