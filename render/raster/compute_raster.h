// The compute rasteriser: meshlets to depth and id by compute alone, into one 64-bit word a pixel.
#pragma once

#include "core/frame/frame_plan.h"
#include "render/device/resources.h"
#include "render/pipelines/pipelines.h"

namespace oro {

// The buffers of the compute path. Its steps: cull, and in later rounds uncover, lists meshlets, raster draws
// them (one workgroup each) and hands on what is large or must be clipped, raster_clip cuts the latter while
// raster_boxes draws what is of middling size, raster_large draws squares of the rest.
class ComputeRaster {
  public:
    static Result<ComputeRaster> create(const Gpu& gpu, VkExtent2D extent);
    Result<void> resize(VkExtent2D extent);
    // Room for the meshlets of so many pages, and for so many lists.
    Result<void> reserve(std::size_t pages, std::size_t lists);

    // Puts its addresses into the frame's constants.
    void address(gpu::FrameConstants& constants) const;
    // How many lists there is room for.
    [[nodiscard]] gpu::uint lists() const {
        return static_cast<gpu::uint>(lists_.size / gpu::raster_lists_bytes);
    }
    // Clears the visibility buffer, and empties all lists. The frame's first set is bound, and lists() pushed
    // as FrameRound::lists. What touches none of both may run beside it.
    void record_clear(VkCommandBuffer commands, const Pipelines& pipelines, const FramePlan& plan) const;
    // Draws what was listed in one of them, or the clusters of a plan that has some; FrameRound::lists is its
    // number, and pushed. Leaves the buffer ready for compute reads.
    void record(VkCommandBuffer commands, const Pipelines& pipelines, bool of_clusters,
                gpu::uint lists) const;

    // Depth << 32 | ~id for each pixel of the last frame, row by row, `width` to a row.
    [[nodiscard]] const Buffer& visibility() const { return visibility_; }

  private:
    explicit ComputeRaster(const Gpu& gpu) : gpu_(&gpu) {}

    const Gpu* gpu_;
    Buffer visibility_, lists_, meshlets_, clips_, large_, tasks_;
    std::size_t page_capacity_{};
};

}  // namespace oro
