#include "render/shading/texture_tile_feedback.h"

#include <cstring>

#include "render/pipelines/shading_pipelines.h"

namespace oro {
namespace {

constexpr VkDeviceSize requests_bytes = (VkDeviceSize{gpu::texture_tile_requests_max} + 1) *
                                        sizeof(gpu::TextureTileRequest);  // the last: whether any is missing

}  // namespace

Result<void> TextureTileFeedback::prepare(const Gpu& gpu, RasterPath path, Pipelines& pipelines,
                                          DrapeStore* store, std::size_t slot,
                                          gpu::FrameConstants& constants) {
    store_ = store;
    slot_ = slot;
    constants.drape = {};
    if (!store) return {};
    if (!requests_.handle) {
        ORO_TRY(
            requests_,
            create_buffer(gpu, requests_bytes,
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                              VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::device, "wanted image tiles"));
    }
    if (!read_back_[slot].handle) {
        ORO_TRY(read_back_[slot], create_buffer(gpu, requests_bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                                MemoryKind::readback, "wanted image tiles read back"));
    }
    ORO_CHECK(add_drape_pipelines(gpu, path, constants.clusters.on != 0, pipelines));
    store->describe(constants.drape);
    constants.drape.requests = address_words(requests_.address);
    return {};
}

void TextureTileFeedback::record(VkCommandBuffer commands, const Pipelines& pipelines,
                                 const gpu::FrameConstants& constants) const {
    vkCmdFillBuffer(commands, requests_.handle.get(), 0, VK_WHOLE_SIZE, 0);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT,
                   VK_ACCESS_2_TRANSFER_WRITE_BIT, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                   VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                      pipelines.texture_tile_feedback[constants.clusters.on != 0 ? 1 : 0].get());
    vkCmdDispatch(commands, (constants.width_px + 7) / 8, (constants.height_px + 7) / 8, 1);
    memory_barrier(
        commands,
        VK_PIPELINE_STAGE_2_COPY_BIT | VK_PIPELINE_STAGE_2_CLEAR_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
        VK_ACCESS_2_TRANSFER_WRITE_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT, VK_PIPELINE_STAGE_2_COPY_BIT,
        VK_ACCESS_2_TRANSFER_READ_BIT);
    const VkBufferCopy copy{0, 0, requests_bytes};
    vkCmdCopyBuffer(commands, requests_.handle.get(), read_back_[slot_].handle.get(), 1, &copy);
    memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                   VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
}

bool TextureTileFeedback::is_missing_any(std::size_t slot) const {
    gpu::TextureTileRequest last{};
    std::memcpy(&last, read_back_[slot].mapped + gpu::texture_tile_requests_max * sizeof(last), sizeof(last));
    return last.name != 0;
}

std::vector<ImageTile> TextureTileFeedback::wanted(std::size_t slot) const {
    std::vector<gpu::TextureTileRequest> places(gpu::texture_tile_requests_max);
    std::memcpy(places.data(), read_back_[slot].mapped, places.size() * sizeof(places[0]));
    std::vector<ImageTile> tiles;
    for (const gpu::TextureTileRequest& place : places) {
        if (place.hash != 0)
            tiles.push_back({static_cast<int>(place.name) - 1 + gpu::drape_finest,
                             static_cast<int>(place.row), static_cast<int>(place.column)});
    }
    return tiles;
}

}  // namespace oro
