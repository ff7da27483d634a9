// Which tiles of images a frame's pixels are coloured from: asked of the GPU once the triangles are drawn,
// and answered by a DrapeStore before they are shaded.
#pragma once

#include <array>
#include <vector>

#include "render/device/resources.h"
#include "render/pipelines/pipelines.h"
#include "render/scene/drape_store.h"
#include "shaders/shared.h"

namespace oro {

class TextureTileFeedback {
  public:
    // Room and pipelines on first use, and where all is into a frame's constants. Nothing happens without a
    // store. slot: the frame's, of frames_in_flight.
    Result<void> prepare(const Gpu& gpu, RasterPath path, Pipelines& pipelines, DrapeStore* store,
                         std::size_t slot, gpu::FrameConstants& constants);
    [[nodiscard]] bool is_on() const { return store_ != nullptr; }
    [[nodiscard]] DrapeStore& store() const { return *store_; }

    // Fills the table of what is wanted, and brings it back. The frame's set is bound, its ids can be read.
    void record(VkCommandBuffer commands, const Pipelines& pipelines,
                const gpu::FrameConstants& constants) const;
    // What the frame of a slot, which is done, wanted: all of it, or where two tiles have one hash, or there
    // was no room for more, a part.
    [[nodiscard]] std::vector<ImageTile> wanted(std::size_t slot) const;
    // Whether one of all that were wanted was not on the GPU.
    [[nodiscard]] bool is_missing_any(std::size_t slot) const;

  private:
    DrapeStore* store_{nullptr};
    Buffer requests_;
    std::array<Buffer, frames_in_flight> read_back_;
    std::size_t slot_{};  // of the frame that is being recorded
};

}  // namespace oro
