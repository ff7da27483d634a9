// Tiles of images over the ground in GPU memory: as many as a budget allows, and the table in which shaders
// find them (shaders/shade/drape.glsl).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

#include "core/drape/ground_image.h"
#include "render/device/resources.h"

namespace oro {

// How images lie over the ground.
struct DrapeLook {
    float opacity{1.0F};  // 0 .. 1: the share of their colour where they hide all
    float relief{0.35F};  // as gpu::DrapeTable
};

class DrapeStore {
  public:
    // Tiles may take `bytes`, at least one tile; buffers are made when they are needed.
    static Result<DrapeStore> create(const Gpu& gpu, std::unique_ptr<const GroundImage> image,
                                     const DrapeLook& look, std::uint64_t bytes);

    // Where shaders find the tiles; `wanted` and the seed are left as they are.
    void describe(gpu::DrapeTable& table) const;
    // From here on tiles count as used by another frame: those of earlier ones may make room.
    void begin_frame() { ++frame_; }

    // What came of a list of wanted tiles.
    struct Served {
        bool changed{};      // tiles were sent: the table is another
        bool settled{true};  // all of them are here
        bool is_full{};      // ... and those that are not find no room
    };
    // Reads the tiles that are not here and sends them; `all`: every one, else as many as can be read at a
    // time. Waits for the GPU. Errors: a file that cannot be read, the device.
    Result<Served> serve(std::span<const ImageTile> wanted, bool all);

    [[nodiscard]] std::size_t size() const { return held_.size(); }
    [[nodiscard]] std::size_t capacity() const { return capacity_; }
    [[nodiscard]] std::uint64_t bytes() const;  // of the buffers

  private:
    struct Held {
        std::size_t slot;  // no_slot: there is nothing in it
        std::uint64_t used;
    };
    struct Loaded {
        ImageTile tile;
        bool has_image{};
        std::vector<std::uint32_t> texels;
    };
    explicit DrapeStore(const Gpu& gpu) : gpu_(&gpu) {}
    Result<std::vector<Loaded>> load(std::span<const ImageTile> tiles) const;
    Result<bool> send(std::vector<Loaded>& tiles);
    Result<bool> find_slot(std::size_t& slot);
    Result<bool> add_chunk();
    void forget_empty();
    Result<void> copy(std::span<const std::size_t> slots);
    Result<void> send_table();

    const Gpu* gpu_;
    std::unique_ptr<const GroundImage> image_;
    DrapeLook look_;
    Commands commands_;
    Buffer staging_, table_staging_, table_;
    std::vector<Buffer> chunks_;
    std::size_t capacity_{};
    std::size_t slots_{};  // ever used
    std::map<ImageTile, Held> held_;
    std::uint64_t frame_{1};
};

}  // namespace oro
