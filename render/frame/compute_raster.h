// The compute rasteriser: meshlets to depth and id by compute alone, into one 64-bit word a pixel.
#pragma once

#include "core/frame/frame_plan.h"
#include "render/device/resources.h"
#include "render/frame/pipelines.h"

namespace oro {

// The buffers of the compute path. Its steps: cull, and in later rounds uncover, lists meshlets, raster draws
// them (one workgroup each) and hands on what is large or must be clipped, raster_clip cuts the latter,
// raster_large draws squares of the former.
class ComputeRaster {
  public:
    static Result<ComputeRaster> create(const Gpu& gpu, VkExtent2D extent);
    Result<void> resize(VkExtent2D extent);
    // Room for the meshlets of so many pages.
    Result<void> reserve_pages(std::size_t count);

    // Puts its addresses into the frame's constants.
    void address(gpu::FrameConstants& constants) const;
    // Empties the lists, before a grid's meshlets of a round are listed. Before the first of a frame it
    // clears the visibility buffer; all others draw into what is there.
    void record_clear(VkCommandBuffer commands, const FramePlan& plan, bool first) const;
    // Draws what was listed. Leaves the buffer ready for compute reads.
    void record(VkCommandBuffer commands, const Pipelines& pipelines) const;

    // Depth << 32 | ~id for each pixel of the last frame, row by row, `width` to a row.
    [[nodiscard]] const Buffer& visibility() const { return visibility_; }

  private:
    explicit ComputeRaster(const Gpu& gpu) : gpu_(&gpu) {}

    const Gpu* gpu_;
    Buffer visibility_, lists_, meshlets_, clips_, large_, tasks_;
    std::size_t page_capacity_{};
};

}  // namespace oro
