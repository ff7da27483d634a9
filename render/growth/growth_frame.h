// The trees of one grid in a frame: its tiles of sites, what stands on them, and the programs that draw and
// colour it.
#pragma once

#include <array>
#include <cstddef>

#include "core/growth/growth_plan.h"
#include "render/device/pass_times.h"
#include "render/device/resources.h"
#include "render/pipelines/pipelines.h"
#include "shaders/growth/shared_picture.h"

namespace oro {

// What of a frame decides which programs it takes.
struct GrowthKind {
    bool casts{};                 // terrain casts shadows
    bool opens{};                 // the sky's light is that of the part of the sky that is seen
    bool draped{};                // land cover lies over the ground
    bool by_means{};              // pages have means
    bool edges_follow{};          // the picture is left to `edges`
    VkDeviceAddress canopy{};     // GrowthTable::canopy
    gpu::TiledPicture picture{};  // all zero: the frame is a picture of its own
};

class GrowthFrame {
  public:
    // Takes the tiles of a plan, which may have none. culled: the picture that trees behind its ground are
    // left out of; 0 x 0: none is. slot: of frames_in_flight. Errors: the device.
    Result<void> prepare(const Gpu& gpu, Pipelines& pipelines, const GrowthPlan& plan, const GrowthKind& kind,
                         VkExtent2D culled, std::size_t slot);
    [[nodiscard]] bool is_on() const { return tiles_ > 0; }
    // What stands on its sites, and its trees into the visibility buffer. The grid's set is bound, and the
    // nodes of its casters are there. times: null where nobody asks for them.
    void record_draw(VkCommandBuffer commands, const Pipelines& pipelines, gpu::uint width_px,
                     gpu::uint height_px, PassTimes* times) const;
    // GrowthTable::shade_map; null without shadows of trees.
    [[nodiscard]] const Buffer* shade_map() const {
        return is_on() && map_ != VK_NULL_HANDLE ? &shade_map_ : nullptr;
    }
    // GrowthTable::farthest, once trees are drawn; null where what is hidden is drawn, too.
    [[nodiscard]] const Buffer* farthest_depths() const { return is_on() && culls_ ? &farthest_ : nullptr; }
    // For the programs that colour the grid's ground, which look up the shadows of its trees.
    void push(VkCommandBuffer commands, const Pipelines& pipelines) const;
    // Colours its pixels; and, of pictures of one sample whose edges follow, softens its outlines once all
    // pixels of the frame are coloured.
    void record_shade(VkCommandBuffer commands, const Pipelines& pipelines, gpu::uint width_px,
                      gpu::uint height_px) const {
        record_pixels(commands, pipelines, shade_, width_px, height_px);
    }
    // Raises forests that are farther than their trees by their canopy, in a picture whose ground is
    // coloured; mirrors in water what stands beyond it, once trees are coloured, too. Once for all grids of a
    // frame, by one of them.
    void record_mirror(VkCommandBuffer commands, const Pipelines& pipelines, gpu::uint width_px,
                       gpu::uint height_px) const {
        record_pixels(commands, pipelines, mirror_, width_px, height_px);
    }
    void record_raise(VkCommandBuffer commands, const Pipelines& pipelines, gpu::uint width_px,
                      gpu::uint height_px) const {
        record_pixels(commands, pipelines, raise_, width_px, height_px);
    }
    // Of a tile of a picture: keeps what it shows for the tiles after it.
    void record_keep(VkCommandBuffer commands, const Pipelines& pipelines, gpu::uint width_px,
                     gpu::uint height_px) const {
        if (keep_ != VK_NULL_HANDLE) record_pixels(commands, pipelines, keep_, width_px, height_px);
    }
    void record_smooth(VkCommandBuffer commands, const Pipelines& pipelines, gpu::uint width_px,
                       gpu::uint height_px) const {
        if (smooth_ != VK_NULL_HANDLE) record_pixels(commands, pipelines, smooth_, width_px, height_px);
    }

  private:
    Result<void> reserve(const Gpu& gpu, const GrowthKind& kind, VkExtent2D culled);
    Result<void> choose_pipelines(const Gpu& gpu, Pipelines& pipelines, const GrowthKind& kind);
    Result<void> choose_changes(const Gpu& gpu, Pipelines& pipelines, const GrowthKind& kind);
    void write_table(const GrowthPlan& plan, const GrowthKind& kind);
    void record_pixels(VkCommandBuffer commands, const Pipelines& pipelines, VkPipeline pipeline,
                       gpu::uint width_px, gpu::uint height_px) const;

    std::array<Buffer, frames_in_flight> tables_;  // GrowthTable, TiledPicture, then its tiles
    Buffer sites_;
    Buffer shade_map_;  // GrowthTable::shade_map, where terrain casts shadows
    Buffer lists_;      // CrownLists
    Buffer farthest_;   // GrowthTable::farthest
    bool culls_{};
    std::size_t slot_{};
    gpu::uint tiles_{};
    VkPipeline grow_{VK_NULL_HANDLE}, map_{VK_NULL_HANDLE}, shade_{VK_NULL_HANDLE}, smooth_{VK_NULL_HANDLE},
        raise_{VK_NULL_HANDLE}, mirror_{VK_NULL_HANDLE}, keep_{VK_NULL_HANDLE};
};

// Mesh path: its images into a visibility buffer, and the ids back, around what draws trees. The images are
// in shader_read and depth_read, and ids may be written. Errors: the device.
Result<void> add_visibility_copies(const Gpu& gpu, Pipelines& pipelines);

}  // namespace oro
