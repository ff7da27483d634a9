// Which tiles of images a frame's pixels are coloured from: asked of the GPU once the triangles are drawn,
// and answered by a DrapeStore before they are shaded.
#pragma once

#include <vector>

#include "render/pipelines/pipelines.h"
#include "render/scene/drape_store.h"
#include "shaders/shared.h"

namespace oro {

class TextureTileFeedback {
  public:
    // Room and pipelines on first use, and where all is into a frame's constants. Nothing happens without a
    // store.
    Result<void> prepare(const Gpu& gpu, RasterPath path, Pipelines& pipelines, DrapeStore* store,
                         gpu::FrameConstants& constants);
    [[nodiscard]] bool is_on() const { return store_ != nullptr; }
    [[nodiscard]] DrapeStore& store() const { return *store_; }

    // Fills the table of what is wanted, and brings it back. The frame's set is bound, its ids can be read.
    void record(VkCommandBuffer commands, const Pipelines& pipelines,
                const gpu::FrameConstants& constants) const;
    // What was wanted: all of it, or where two tiles have one hash, or there was no room for more, a part.
    [[nodiscard]] std::vector<ImageTile> wanted() const;
    // Whether one of all that were wanted was not on the GPU.
    [[nodiscard]] bool is_missing_any() const;

  private:
    DrapeStore* store_{nullptr};
    Buffer requests_, read_back_;
};

}  // namespace oro
