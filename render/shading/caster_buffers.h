// What casts shadows into a frame, on the device: the pages and where they lie, and how high their nodes
// reach.
#pragma once

#include <vector>

#include "core/frame/frame_plan.h"
#include "render/device/resources.h"
#include "render/frame/pipelines.h"

namespace oro {

class CasterBuffers {
  public:
    // Room for a plan's casters, and their place into the frame's constants; the pipelines on first use.
    // Nothing happens for a style without shadows and openness, and for a plan without casters.
    Result<void> prepare(const Gpu& gpu, Pipelines& pipelines, const FramePlan& plan,
                         gpu::FrameConstants& constants);
    // Sends them, and finds out how high they reach and how much of the sky they leave. The frame's set is
    // bound.
    void record(VkCommandBuffer commands, const Pipelines& pipelines);
    // Whether the frame that was prepared has any of it, and what.
    [[nodiscard]] bool any() const { return casts_ || opens_; }
    [[nodiscard]] bool casts() const { return casts_; }
    [[nodiscard]] bool opens() const { return opens_; }

  private:
    Buffer staging_;  // gpu::Casters, then pages, then the table
    Buffer data_;     // the same on the device
    Buffer nodes_;
    Buffer openness_;
    VkDeviceSize size_{};
    bool casts_{}, opens_{};
    std::uint32_t pages_{};        // that cast
    std::uint32_t frame_pages_{};  // that are drawn
};

}  // namespace oro
