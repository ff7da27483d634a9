#include "render/scene/drape_store.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstring>
#include <utility>

#include "core/base/parallel.h"

namespace oro {
namespace {

constexpr std::size_t tile_bytes = gpu::drape_words * sizeof(std::uint32_t);
constexpr std::size_t tiles_per_buffer = 32;  // 8.5 MB
constexpr std::size_t tiles_in_staging = 32;
// Places of the table: twice as many as a frame can want.
constexpr std::size_t table_places = std::size_t{4} * gpu::texture_tile_requests_max;
constexpr std::size_t most_held = table_places / 2;
// Behind them: what there is, and the grounds of land cover.
constexpr std::size_t table_entries = table_places + 1 + unknown_ground;
// Tiles of land cover are those of a level that is so much higher.
constexpr int cover_level_offset = 64;

bool is_of_cover(const ImageTile& tile) {
    return tile.level >= cover_level_offset / 2;
}

std::uint32_t name_of(int level) {
    return static_cast<std::uint32_t>(level - gpu::drape_finest + 1);
}

CacheLayout tile_cache_layout() {
    return {.name = "image tiles",
            .item_bytes = tile_bytes,
            .first_buffer = tiles_per_buffer,
            .largest_buffer = tiles_per_buffer,
            .smallest_buffer = tiles_per_buffer,
            .staging_bytes = tiles_in_staging * tile_bytes};
}

// Coarse ones first: they stand in for the others. Always the same order.
bool comes_before(const ImageTile& a, const ImageTile& b) {
    return a.level != b.level ? a.level > b.level : a < b;
}

}  // namespace

DrapeStore::DrapeStore(const Gpu& gpu, std::unique_ptr<const GroundImage> image, const DrapeLook& look,
                       std::uint64_t bytes, std::unique_ptr<const CoverTiles> cover)
    : gpu_(&gpu),
      image_(std::move(image)),
      cover_(std::move(cover)),
      look_(look),
      cache_(gpu, tile_cache_layout(),
             std::make_shared<MemoryBudget>(
                 std::clamp<std::uint64_t>(bytes / tile_bytes, 1, gpu::texture_tile_requests_max) *
                 tile_bytes)) {
    const auto read = [image = image_.get(), cover = cover_.get()](
                          const Loader<ImageTile, Loaded>::Request& request) -> Result<Loaded> {
        Loaded loaded{request.key, std::vector<std::uint32_t>(gpu::drape_words)};
        ImageTile tile = request.key;
        const GroundImage* const from = is_of_cover(tile) ? cover : image;
        if (from == cover) tile.level -= cover_level_offset;
        ORO_TRY(const bool has_image, from->load(tile, loaded.texels));
        if (!has_image) loaded.texels = {};
        return loaded;
    };
    loader_ = std::make_unique<Loader<ImageTile, Loaded>>(read, thread_count(), tiles_in_staging);
}

Result<DrapeStore> DrapeStore::create(const Gpu& gpu, std::unique_ptr<const GroundImage> image,
                                      const DrapeLook& look, std::uint64_t bytes,
                                      std::unique_ptr<const CoverTiles> cover) {
    assert(image || cover);
    DrapeStore store(gpu, std::move(image), look, bytes, std::move(cover));
    ORO_TRY(store.commands_, Commands::create(gpu, "image tiles"));
    constexpr VkDeviceSize size = table_entries * sizeof(gpu::DrapeTile);
    ORO_TRY(store.table_staging_, create_buffer(gpu, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                                MemoryKind::upload, "table of image tiles, staging"));
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
    const GroundImage& finest = image_ ? *image_ : *cover_;
    table.finest = finest.finest_level();
    table.coarsest = finest.coarsest_level();
    table.opacity = look_.opacity;
    table.relief = look_.relief;
}

// Those that are here are used by the frame.
std::vector<ImageTile> DrapeStore::missing_of(std::span<const ImageTile> wanted) {
    std::vector<ImageTile> missing;
    for (const ImageTile& tile : wanted) {
        if (const auto handle = cache_.items().find(tile); handle != Cache::Items::none)
            cache_.items().use(handle);
        else if (const auto empty = empty_.find(tile); empty != empty_.end())
            empty->second = cache_.items().frame();
        else
            missing.push_back(tile);
    }
    std::ranges::sort(missing, comes_before);
    return missing;
}

Result<bool> DrapeStore::serve(std::span<const ImageTile> wanted, bool all) {
    const std::vector<ImageTile> missing = missing_of(wanted);
    if (missing.empty()) return true;
    forget_empty();
    const auto step = all ? tiles_in_staging : static_cast<std::size_t>(thread_count());
    const std::size_t end = all ? missing.size() : std::min(step, missing.size());
    bool has_capacity = true;
    for (std::size_t done = 0; done < end && has_capacity; done += step) {
        ORO_TRY(const std::vector<Loaded> loaded,
                load(std::span(missing).subspan(done, std::min(step, end - done))));
        ORO_TRY(has_capacity, send(loaded));
    }
    ORO_CHECK(send_table());
    return has_capacity;
}

// All of them, in their order.
Result<std::vector<DrapeStore::Loaded>> DrapeStore::load(std::span<const ImageTile> tiles) {
    loader_->request(tiles);
    std::vector<Loaded> loaded;
    while (loaded.size() < tiles.size()) {
        ORO_TRY(std::vector<Loaded> some, loader_->take(true));
        // After an error, some may still come that were requested before.
        for (Loaded& one : some)
            if (std::ranges::find(tiles, one.tile) != tiles.end()) loaded.push_back(std::move(one));
    }
    std::ranges::sort(loaded, comes_before, &Loaded::tile);
    return loaded;
}

// False where some find no capacity.
Result<bool> DrapeStore::send(std::span<const Loaded> tiles) {
    bool found_slot = true;
    Result<void> done;
    for (const Loaded& loaded : tiles) {
        if (loaded.texels.empty()) {
            empty_[loaded.tile] = cache_.items().frame();
            continue;
        }
        const auto added = cache_.add(loaded.tile, tile_bytes);
        if (!added.ok()) done = added.error();
        found_slot = added.ok() && added->bytes != nullptr;
        if (!found_slot) break;
        std::memcpy(added->bytes, loaded.texels.data(), tile_bytes);
    }
    if (done.ok()) done = cache_.upload();
    if (done.ok()) return found_slot;
    cache_.items().clear();  // the table still names what may be gone
    return done.error();
}

// Tiles without an image take no memory, and a place in the table.
void DrapeStore::forget_empty() {
    if (size() + gpu::texture_tile_requests_max <= most_held) return;
    std::erase_if(empty_, [&](const auto& one) { return one.second < cache_.items().frame(); });
}

// As shaders/shade/materials.glsl reads them: degrees in the low 7 bits, then heights over -12,000 m in steps
// of 50 m, 9 bits each.
std::uint32_t limits_of(const GroundColour& ground) {
    const auto whole = [](float value, float most) {
        return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0F, most)));
    };
    const auto steps = [&](float H_m) { return whole((H_m + 12000.0F) / 50.0F, 511.0F); };
    return whole(ground.steepest_deg, 90.0F) | steps(ground.lowest_H_m) << 7U |
           steps(ground.highest_H_m) << 16U;
}

// As shaders/shade/cover_tiles.glsl reads them.
void DrapeStore::put_grounds(std::vector<gpu::DrapeTile>& places) const {
    gpu::DrapeTile& head = places[table_places];
    head.name = (image_ ? 1U : 0U) | (cover_ ? 2U : 0U);
    if (!cover_) return;
    head.row = static_cast<std::uint32_t>(cover_->finest_level());
    head.column = static_cast<std::uint32_t>(cover_->coarsest_level());
    for (std::size_t i = 0; i < cover_->grounds().size(); ++i) {
        const GroundColour& ground = cover_->grounds()[i];
        const auto bits = [](float value) { return std::bit_cast<std::uint32_t>(value); };
        places[table_places + 1 + i] = {bits(ground.colour.x), bits(ground.colour.y), bits(ground.colour.z),
                                        gpu::uvec2(ground.materials, limits_of(ground))};
    }
}

Result<void> DrapeStore::send_table() {
    std::vector<gpu::DrapeTile> places(table_entries, gpu::DrapeTile{});
    const auto enter = [&](const ImageTile& tile, VkDeviceAddress texels) {
        const gpu::DrapeTile entry{name_of(tile.level), static_cast<std::uint32_t>(tile.row),
                                   static_cast<std::uint32_t>(tile.column), address_words(texels)};
        std::size_t place = gpu::drape_hash(entry.name, entry.row, entry.column, 0) & (table_places - 1);
        while (places[place].name != 0) place = (place + 1) & (table_places - 1);
        places[place] = entry;
    };
    put_grounds(places);
    for (const auto& [tile, used] : empty_) enter(tile, 0);
    cache_.items().for_each([&](const auto& slot) { enter(slot.key, cache_.address(slot)); });
    ORO_CHECK(commands_.wait());
    std::memcpy(table_staging_.mapped, places.data(), table_staging_.size);
    return commands_.submit(*gpu_, [&](VkCommandBuffer commands) {
        wait_for_earlier(commands);
        const VkBufferCopy copy{0, 0, table_.size};
        vkCmdCopyBuffer(commands, table_staging_.handle.get(), table_.handle.get(), 1, &copy);
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    });
}

}  // namespace oro
