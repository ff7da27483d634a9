// Tiles of images over the ground in GPU memory: as many as a budget allows, and the table in which shaders
// find them (shaders/shade/drape.glsl).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/cache/loader.h"
#include "core/drape/cover_tiles.h"
#include "core/drape/ground_image.h"
#include "render/device/buffer_cache.h"

namespace oro {

// How images lie over the ground.
struct DrapeLook {
    float opacity{1.0F};  // 0 .. 1: the share of their colour where they hide all
    float relief{0.35F};  // as gpu::DrapeTable
};

// The cache of tiles on the GPU. Those least recently used are evicted first.
class DrapeStore {
  public:
    // Tiles may take `bytes`, at least one tile; buffers are made when they are needed. image or cover may be
    // null, not both.
    static Result<DrapeStore> create(const Gpu& gpu, std::unique_ptr<const GroundImage> image,
                                     const DrapeLook& look, std::uint64_t bytes,
                                     std::unique_ptr<const CoverTiles> cover = nullptr);
    DrapeStore(DrapeStore&&) noexcept = default;
    DrapeStore& operator=(DrapeStore&&) = delete;  // a loader ends before the image that it reads
    ~DrapeStore() = default;

    // Where shaders find the tiles; `requests` and the seed are left as they are.
    void describe(gpu::DrapeTable& table) const;
    // From here on tiles are used by the next frame. What is sent lands after all frames before.
    void begin_frame() { cache_.items().begin_frame(); }

    // Reads the tiles that are not here and uploads them; `all`: every one, else as many as can be read at a
    // time. False where some find no capacity. They are there for all that is submitted afterwards; frames
    // submitted before see the tiles that were there. Errors: a file that cannot be read, the device.
    Result<bool> serve(std::span<const ImageTile> wanted, bool all);

    // Number of tiles that are here.
    [[nodiscard]] std::size_t size() const { return cache_.items().size() + empty_.size(); }
    [[nodiscard]] std::size_t capacity() const { return cache_.capacity(); }
    [[nodiscard]] std::uint64_t bytes() const { return cache_.bytes(); }  // of the buffers

  private:
    struct Loaded {
        ImageTile tile;
        std::vector<std::uint32_t> texels;  // none: no image lies in it
    };
    using Cache = BufferCache<ImageTile>;
    DrapeStore(const Gpu& gpu, std::unique_ptr<const GroundImage> image, const DrapeLook& look,
               std::uint64_t bytes, std::unique_ptr<const CoverTiles> cover);
    void put_grounds(std::vector<gpu::DrapeTile>& places) const;
    std::vector<ImageTile> missing_of(std::span<const ImageTile> wanted);
    Result<std::vector<Loaded>> load(std::span<const ImageTile> tiles);
    Result<bool> send(std::span<const Loaded> tiles);
    void forget_empty();
    Result<void> send_table();

    const Gpu* gpu_;
    std::unique_ptr<const GroundImage> image_;
    std::unique_ptr<const CoverTiles> cover_;
    DrapeLook look_;
    Buffer table_staging_, table_;
    Commands commands_;  // of the table
    Cache cache_;
    std::map<ImageTile, std::uint64_t> empty_;  // tiles without an image: the last frame that used each
    std::unique_ptr<Loader<ImageTile, Loaded>> loader_;  // last: it ends before the image
};

}  // namespace oro
