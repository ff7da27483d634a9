// What one grid of a frame has on the device: its constants, pages and tables, what is chosen of them, and
// what shades its pixels. A frame has one for each grid that it draws.
#pragma once

#include <array>
#include <cstddef>

#include "core/frame/frame_plan.h"
#include "render/device/resources.h"
#include "render/frame/pipelines.h"
#include "render/shading/caster_buffers.h"
#include "render/shading/drape_wants.h"

namespace oro {

class GridFrame {
  public:
    // A set for the frame's images (ids, sum, picture) and the grid's constants.
    Result<void> create_set(const Gpu& gpu, const Pipelines& pipelines,
                            const std::array<VkImageView, 3>& images);
    // Room for the pages of a plan, on both sides, and for what is chosen of them.
    Result<void> reserve(const Gpu& gpu, const FramePlan& plan);
    // Where all that lies, into the plan's constants.
    void address(FramePlan& plan) const;
    // Puts a plan, whose constants are whole, where record_upload() sends it from.
    void fill(const FramePlan& plan);
    void record_upload(VkCommandBuffer commands) const;
    void bind(VkCommandBuffer commands, const Pipelines& pipelines, VkPipelineBindPoint point) const;

    [[nodiscard]] const Buffer& data() const { return data_; }      // begins with the constants
    [[nodiscard]] const Buffer& choice() const { return choice_; }  // see frame_layout.h
    [[nodiscard]] std::size_t page_capacity() const { return page_capacity_; }

    CasterBuffers casters;
    DrapeWants drape;
    VkPipeline shade{VK_NULL_HANDLE}, shade_parts{VK_NULL_HANDLE};  // of the frame

  private:
    void bind_constants(const Gpu& gpu) const;

    OwnedDescriptorPool pool_;
    VkDescriptorSet set_{VK_NULL_HANDLE};
    Buffer staging_;  // constants, then pages, then rows and columns
    Buffer data_;     // the same on the device
    Buffer choice_;
    std::size_t page_capacity_{};
    VkDeviceSize size_{};  // that a frame sends
};

}  // namespace oro
