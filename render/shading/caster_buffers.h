// What casts shadows into a frame, on the device: the pages and where they lie, and how high their nodes
// reach.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/frame/frame_plan.h"
#include "render/device/resources.h"
#include "render/pipelines/pipelines.h"
#include "render/pipelines/shading_pipelines.h"
#include "shaders/shared_places.h"

namespace oro {

// In a frame of several grids whose terrain casts shadows: where the ground in each pixel is, and what it
// sees of the sun past all of them (gpu::FrameCasters).
class SharedShares {
  public:
    // Room for a frame of that plan and style; none where it has one grid, or no shadows. Errors: out of
    // memory.
    Result<void> reserve(const Gpu& gpu, const FramePlan& plan, const gpu::FrameStyle& style);
    [[nodiscard]] bool is_on() const { return is_on_; }
    [[nodiscard]] VkDeviceAddress places() const { return is_on_ ? places_.address : 0; }
    [[nodiscard]] VkDeviceAddress shares() const { return shares_.address; }
    // The shares of one grid after the other, with room for a list (shares.comp).
    [[nodiscard]] const Buffer& of_one_grid() const { return of_one_grid_; }
    // All of the sun in all pixels.
    void record_clear(VkCommandBuffer commands) const;

  private:
    Buffer places_, shares_, of_one_grid_;
    bool is_on_{};
};

class CasterBuffers {
  public:
    // Room for a plan's casters, and their place into the frame's constants; the pipelines on first use.
    // Nothing happens for a style without shadows and openness, and for a plan without casters unless others
    // of the frame may take the sun from its ground. slot: the frame's, of frames_in_flight.
    Result<void> prepare(const Gpu& gpu, const ShareOptions& how, Pipelines& pipelines, const GridPlan& plan,
                         const SharedShares& shared, std::size_t slot, gpu::FrameConstants& constants);
    // Sends them, and finds out how high they reach and how much of the sky they leave, unless all that is as
    // it was in the frame before. The frame's set is bound for all that is recorded, its ids can be read.
    void record_casters(VkCommandBuffer commands, const Pipelines& pipelines);
    // In a frame of several grids, where its pixels' ground is; after the casters of the same grid.
    void record_places(VkCommandBuffer commands, const Pipelines& pipelines) const;
    // What each pixel sees of the sun past these casters; after the places of all grids. In a frame of
    // several grids it is joined to what others leave: SharedShares has room for one grid at a time.
    void record_shares(VkCommandBuffer commands, const Pipelines& pipelines) const;
    // Whether the frame that was prepared has any of it, and what.
    [[nodiscard]] bool any() const { return casts_ || opens_ || is_joined_; }
    // Whether its ground may lie in shadow.
    [[nodiscard]] bool has_shadows() const { return casts_ || is_joined_; }
    [[nodiscard]] bool opens() const { return opens_; }

  private:
    Result<void> reserve(const Gpu& gpu, const GridPlan& plan, const gpu::FrameConstants& constants);
    void describe(const GridPlan& plan, const gpu::FrameCasters& casters,
                  const gpu::FrameConstants& constants);

    std::array<Buffer, frames_in_flight> staging_;  // gpu::FrameCasters, then pages, then the table
    std::size_t slot_{};                            // of the frame that is being recorded
    Buffer data_;                                   // the same on the device
    Buffer nodes_;
    Buffer openness_;
    Buffer sun_shares_;
    VkBuffer shares_{VK_NULL_HANDLE};       // sun_shares_, or SharedShares::of_one_grid()
    std::vector<std::byte> wanted_, made_;  // what nodes_ and openness_ follow from: of this frame, and made
    VkDeviceSize size_{};
    bool casts_{}, opens_{}, is_new_{};
    bool is_joined_{};  // the frame has several grids that cast shadows
    ShareOptions how_;
    bool on_net_{};       // the frame's posts lie on a net
    bool on_clusters_{};  // its pixels show clusters
    std::uint32_t width_px_{}, height_px_{};
    std::uint32_t pages_{};        // that cast
    std::uint32_t frame_pages_{};  // that are drawn
};

}  // namespace oro
