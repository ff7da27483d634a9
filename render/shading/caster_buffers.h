// What casts shadows into a frame, on the device: the pages and where they lie, and how high their nodes
// reach.
#pragma once

#include <cstddef>
#include <vector>

#include "core/frame/frame_plan.h"
#include "render/device/resources.h"
#include "render/frame/pipelines.h"

namespace oro {

class CasterBuffers {
  public:
    // Room for a plan's casters, and their place into the frame's constants; the pipelines on first use.
    // Nothing happens for a style without shadows and openness, and for a plan without casters.
    Result<void> prepare(const Gpu& gpu, RasterPath path, Pipelines& pipelines, const FramePlan& plan,
                         gpu::FrameConstants& constants);
    // Sends them, and finds out how high they reach and how much of the sky they leave, unless all that is as
    // it was in the frame before; and what each pixel sees of the sun. The frame's set is bound, its
    // ids can be read.
    void record(VkCommandBuffer commands, const Pipelines& pipelines);
    // Whether the frame that was prepared has any of it, and what.
    [[nodiscard]] bool any() const { return casts_ || opens_; }
    [[nodiscard]] bool casts() const { return casts_; }
    [[nodiscard]] bool opens() const { return opens_; }

  private:
    Result<void> reserve(const Gpu& gpu, const FramePlan& plan, const gpu::FrameConstants& constants);
    void describe(const FramePlan& plan, const gpu::Casters& casters);

    Buffer staging_;  // gpu::Casters, then pages, then the table
    Buffer data_;     // the same on the device
    Buffer nodes_;
    Buffer openness_;
    Buffer sun_shares_;
    std::vector<std::byte> wanted_, made_;  // what nodes_ and openness_ follow from: of this frame, and made
    VkDeviceSize size_{};
    bool casts_{}, opens_{}, is_new_{};
    bool lists_together_{};  // shading.h, lists_pixels_together
    bool on_net_{};          // the frame's posts lie on a net
    std::uint32_t width_px_{}, height_px_{};
    std::uint32_t pages_{};        // that cast
    std::uint32_t frame_pages_{};  // that are drawn
};

}  // namespace oro
