// The grass of one grid in a frame: its tiles of clumps, and the programs that grow, draw and colour it.
#pragma once

#include <array>
#include <cstddef>

#include "core/growth/meadow_plan.h"
#include "render/growth/growth_frame.h"

namespace oro {

class MeadowFrame {
  public:
    // Takes the tiles of a plan, which may have none. trees: of the same grid and frame, prepared already;
    // where they have shadows, grass stands in them. Errors: the device.
    Result<void> prepare(const Gpu& gpu, Pipelines& pipelines, const MeadowPlan& plan, const GrowthKind& kind,
                         const GrowthFrame& trees, std::size_t slot);
    [[nodiscard]] bool is_on() const { return tiles_ > 0; }
    // Its clumps, and its blades into the visibility buffer, once trees are in it. The grid's set is bound.
    void record_draw(VkCommandBuffer commands, const Pipelines& pipelines) const;
    // Colours its pixels; and, of pictures of one sample whose edges follow, softens them.
    void record_shade(VkCommandBuffer commands, const Pipelines& pipelines, gpu::uint width_px,
                      gpu::uint height_px) const {
        record_pixels(commands, pipelines, shade_, width_px, height_px);
    }
    void record_smooth(VkCommandBuffer commands, const Pipelines& pipelines, gpu::uint width_px,
                       gpu::uint height_px) const {
        if (smooth_ != VK_NULL_HANDLE) record_pixels(commands, pipelines, smooth_, width_px, height_px);
    }

  private:
    Result<void> reserve(const Gpu& gpu);
    Result<void> choose_pipelines(const Gpu& gpu, Pipelines& pipelines, const GrowthKind& kind);
    void write_table(const MeadowPlan& plan, const GrowthFrame& trees);
    void push(VkCommandBuffer commands, const Pipelines& pipelines) const;
    void record_pixels(VkCommandBuffer commands, const Pipelines& pipelines, VkPipeline pipeline,
                       gpu::uint width_px, gpu::uint height_px) const;

    std::array<Buffer, frames_in_flight> tables_;  // MeadowTable, then its tiles
    Buffer clumps_;
    Buffer pieces_;
    std::size_t slot_{};
    gpu::uint tiles_{};
    VkPipeline grow_{VK_NULL_HANDLE}, shade_{VK_NULL_HANDLE}, smooth_{VK_NULL_HANDLE};
};

}  // namespace oro
