#include "render/scene/drape_store.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <utility>

#include "core/base/parallel.h"

namespace oro {
namespace {

constexpr std::size_t tile_bytes = gpu::drape_words * sizeof(std::uint32_t);
constexpr std::size_t tiles_per_chunk = 32;  // 8.5 MB
constexpr std::size_t tiles_in_staging = 32;
constexpr std::size_t no_slot = SIZE_MAX;
// Places of the table: twice as many as a frame can want.
constexpr std::size_t table_places = std::size_t{4} * gpu::drape_wanted_max;
constexpr std::size_t most_held = table_places / 2;

std::uint32_t name_of(int level) {
    return static_cast<std::uint32_t>(level - gpu::drape_finest + 1);
}

}  // namespace

Result<DrapeStore> DrapeStore::create(const Gpu& gpu, std::unique_ptr<const GroundImage> image,
                                      const DrapeLook& look, std::uint64_t bytes) {
    DrapeStore store(gpu);
    store.image_ = std::move(image);
    store.look_ = look;
    store.capacity_ = std::clamp<std::size_t>(bytes / tile_bytes, 1, gpu::drape_wanted_max);
    ORO_TRY(store.commands_, Commands::create(gpu, "image tiles"));
    constexpr VkBufferUsageFlags from = VK_BUFFER_USAGE_TRANSFER_SRC_BIT;
    ORO_TRY(store.staging_, create_buffer(gpu, tiles_in_staging * tile_bytes, from, MemoryKind::upload,
                                          "image tiles staging"));
    constexpr VkDeviceSize size = table_places * sizeof(gpu::DrapeTile);
    ORO_TRY(store.table_staging_,
            create_buffer(gpu, size, from, MemoryKind::upload, "table of image tiles, staging"));
    ORO_TRY(store.table_,
            create_buffer(gpu, size,
                          VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                              VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                          MemoryKind::device, "table of image tiles"));
    ORO_CHECK(store.send_table());
    return store;
}

void DrapeStore::describe(gpu::DrapeTable& table) const {
    table.tiles = address_words(table_.address);
    table.tile_mask = static_cast<std::uint32_t>(table_places - 1);
    static_assert(std::has_single_bit(table_places));
    table.finest = image_->finest_level();
    table.coarsest = image_->coarsest_level();
    table.opacity = look_.opacity;
    table.relief = look_.relief;
}

std::uint64_t DrapeStore::bytes() const {
    std::uint64_t bytes = 0;
    for (const Buffer& chunk : chunks_) bytes += chunk.size;
    return bytes;
}

Result<DrapeStore::Served> DrapeStore::serve(std::span<const ImageTile> wanted, bool all) {
    std::vector<ImageTile> missing;
    for (const ImageTile& tile : wanted) {
        const auto held = held_.find(tile);
        if (held == held_.end()) {
            missing.push_back(tile);
        } else {
            held->second.used = frame_;
        }
    }
    // Coarse ones first: they stand in for the others. Always the same order.
    std::ranges::sort(missing, [](const ImageTile& a, const ImageTile& b) {
        return a.level != b.level ? a.level > b.level : a < b;
    });
    forget_empty();
    Served served;
    const auto step = all ? tiles_in_staging : static_cast<std::size_t>(thread_count());
    std::size_t done = 0;
    for (; done < missing.size() && !served.is_full; done += step) {
        if (!all && done > 0) break;
        const std::size_t count = std::min(step, missing.size() - done);
        ORO_TRY(std::vector<Loaded> loaded, load(std::span(missing).subspan(done, count)));
        ORO_TRY(const bool found_room, send(loaded));
        served.is_full = !found_room;
        served.changed = true;
    }
    served.settled = !served.is_full && done >= missing.size();
    if (served.changed) ORO_CHECK(send_table());
    return served;
}

Result<std::vector<DrapeStore::Loaded>> DrapeStore::load(std::span<const ImageTile> tiles) const {
    std::vector<Loaded> loaded(tiles.size());
    std::vector<std::optional<Error>> failed(tiles.size());
    in_parallel(static_cast<int>(tiles.size()), thread_count(), [&](int i) {
        Loaded& one = loaded[static_cast<std::size_t>(i)];
        one.tile = tiles[static_cast<std::size_t>(i)];
        one.texels.resize(gpu::drape_words);
        const Result<bool> has_image = image_->load(one.tile, one.texels);
        if (has_image.ok()) {
            one.has_image = *has_image;
        } else {
            failed[static_cast<std::size_t>(i)] = has_image.error();
        }
        if (!one.has_image) one.texels.clear();
    });
    for (const std::optional<Error>& error : failed) {
        if (error) return *error;
    }
    return loaded;
}

// False where there is no room for all of them.
Result<bool> DrapeStore::send(std::vector<Loaded>& tiles) {
    std::vector<std::size_t> batch;
    bool found_room = true;
    for (Loaded& loaded : tiles) {
        std::size_t slot = no_slot;
        if (loaded.has_image) {
            ORO_TRY(found_room, find_slot(slot));
            if (!found_room) break;
            std::memcpy(staging_.mapped + batch.size() * tile_bytes, loaded.texels.data(), tile_bytes);
            batch.push_back(slot);
        }
        held_[loaded.tile] = {slot, frame_};
    }
    if (const Result<void> copied = copy(batch); !copied.ok()) {
        held_.clear();  // what did not arrive is not here
        slots_ = 0;
        return copied.error();
    }
    return found_room;
}

// Room for more; false where the device has none.
Result<bool> DrapeStore::add_chunk() {
    constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                         VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    const std::size_t count = std::min(tiles_per_chunk, capacity_ - slots_);
    bool full = false;
    auto chunk = create_buffer(*gpu_, count * tile_bytes, usage, MemoryKind::device,
                               "image tiles " + std::to_string(chunks_.size()), &full);
    if (chunk.ok()) {
        chunks_.push_back(std::move(chunk).value());
        return true;
    }
    if (!full || slots_ == 0) return chunk.error();
    capacity_ = slots_;
    return false;
}

// A slot that is free, or was not used for longest and not by this frame; false when there is none.
Result<bool> DrapeStore::find_slot(std::size_t& slot) {
    if (slots_ < capacity_) {
        bool there = slots_ / tiles_per_chunk < chunks_.size();
        if (!there) {
            ORO_TRY(there, add_chunk());
        }
        if (there) {
            slot = slots_++;
            return true;
        }
    }
    auto oldest = held_.end();
    for (auto one = held_.begin(); one != held_.end(); ++one) {
        if (one->second.slot == no_slot || one->second.used >= frame_) continue;
        if (oldest == held_.end() || one->second.used < oldest->second.used) oldest = one;
    }
    if (oldest == held_.end()) return false;
    slot = oldest->second.slot;
    held_.erase(oldest);
    return true;
}

// Tiles without an image take no memory, and a place in the table.
void DrapeStore::forget_empty() {
    if (held_.size() + gpu::drape_wanted_max <= most_held) return;
    std::erase_if(held_,
                  [&](const auto& one) { return one.second.slot == no_slot && one.second.used < frame_; });
}

Result<void> DrapeStore::copy(std::span<const std::size_t> slots) {
    if (slots.empty()) return {};
    return commands_.run(*gpu_, [&](VkCommandBuffer commands) {
        for (std::size_t i = 0; i < slots.size(); ++i) {
            const VkBufferCopy copy{i * tile_bytes, slots[i] % tiles_per_chunk * tile_bytes, tile_bytes};
            vkCmdCopyBuffer(commands, staging_.handle.get(), chunks_[slots[i] / tiles_per_chunk].handle.get(),
                            1, &copy);
        }
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    });
}

Result<void> DrapeStore::send_table() {
    std::vector<gpu::DrapeTile> places(table_places, gpu::DrapeTile{});
    for (const auto& [tile, held] : held_) {
        gpu::DrapeTile entry{name_of(tile.level),
                             static_cast<std::uint32_t>(tile.row),
                             static_cast<std::uint32_t>(tile.column),
                             {}};
        if (held.slot != no_slot)
            entry.texels = address_words(chunks_[held.slot / tiles_per_chunk].address +
                                         held.slot % tiles_per_chunk * tile_bytes);
        std::size_t place = gpu::drape_hash(entry.name, entry.row, entry.column, 0) & (table_places - 1);
        while (places[place].name != 0) place = (place + 1) & (table_places - 1);
        places[place] = entry;
    }
    std::memcpy(table_staging_.mapped, places.data(), table_staging_.size);
    return commands_.run(*gpu_, [&](VkCommandBuffer commands) {
        const VkBufferCopy copy{0, 0, table_.size};
        vkCmdCopyBuffer(commands, table_staging_.handle.get(), table_.handle.get(), 1, &copy);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    });
}

}  // namespace oro
