// The compute rasteriser: meshlets to depth and id by compute alone, into one 64-bit word a pixel.
#pragma once

#include "core/frame/frame_plan.h"
#include "render/device/resources.h"
#include "render/frame/pipelines.h"

namespace oro {

// The buffers of the compute path. Its steps: cull lists meshlets, raster draws them (one workgroup each) and
// hands on what is large or must be clipped, raster_clip cuts the latter, raster_large draws squares of the
// former.
class ComputeRaster {
  public:
    static Result<ComputeRaster> create(const Gpu& gpu, VkExtent2D extent);
    Result<void> resize(VkExtent2D extent);
    // Room for the meshlets of so many pages.
    Result<void> reserve_pages(std::size_t count);

    // Puts its addresses into the frame's constants.
    void address(gpu::FrameConstants& constants) const;
    // Records all steps for a grid of the frame, with its constants already bound; `choice` holds its
    // LivePages. The first grid clears the visibility buffer, the others draw into what is there. Leaves the
    // buffer ready for compute reads.
    void record(VkCommandBuffer commands, const Pipelines& pipelines, const FramePlan& plan, VkBuffer choice,
                bool first) const;

    // Depth << 32 | id for each pixel of the last frame, row by row, `width` to a row.
    [[nodiscard]] const Buffer& visibility() const { return visibility_; }

  private:
    explicit ComputeRaster(const Gpu& gpu) : gpu_(&gpu) {}
    void record_clear(VkCommandBuffer commands, const FramePlan& plan, bool first) const;

    const Gpu* gpu_;
    Buffer visibility_, lists_, meshlets_, clips_, large_, tasks_;
    std::size_t page_capacity_{};
};

}  // namespace oro
