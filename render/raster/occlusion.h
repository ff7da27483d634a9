// What ground hides other ground: whether a frame is drawn in rounds, in which, and the pyramid of the
// farthest depths between them.
#pragma once

#include <cstdint>
#include <vector>

#include "core/frame/frame_plan.h"
#include "render/device/resources.h"
#include "render/pipelines/pipelines.h"
#include "render/raster/adaptive_toggle.h"

namespace oro {

// Whether meshlets that other ground hides are left out. The picture is the same, bit for bit.
enum class OcclusionUse {
    off,
    on,
    if_it_pays  // as it took less time when both were tried (adaptive_toggle.h)
};

class Occlusion {
  public:
    // nearest: makes the wrong pyramid (tests only).
    Occlusion(OcclusionUse use, bool nearest) : use_(use), nearest_(nearest) {}
    // For pictures up to that size.
    Result<void> resize(const Gpu& gpu, RasterPath path, VkExtent2D extent);

    // The rounds of a frame, in their order; one where it is drawn without occlusion.
    // remembers: it is known what the last frame saw.
    void begin(const FramePlan& plan, bool remembers);
    [[nodiscard]] const std::vector<gpu::FrameRound>& rounds() const { return rounds_; }
    [[nodiscard]] bool is_on() const { return rounds_.size() > 1; }
    // Whether the first round draws what the last frame saw.
    [[nodiscard]] bool uses_last_frame() const { return uses_last_frame_; }
    // Whether a round may draw what is as near as what an earlier one drew, and has a lower id.
    [[nodiscard]] bool may_tie() const { return may_tie_; }
    void address(gpu::FrameConstants& constants) const;
    // From what the rounds so far have drawn; the frame's first set is bound, and its depths are there to be
    // read. Leaves the pyramid ready for compute reads.
    void record_pyramid(VkCommandBuffer commands, const Pipelines& pipelines, const FramePlan& plan) const;
    // What end() is to be told of the frame that begin() was called for last: once for each frame that is
    // drawn.
    struct Trial {
        bool is_on{};
        bool counts{};
        std::uint64_t view{};  // of the toggle
    };
    Trial trial();
    // How long the rounds of a frame took. Others may have begun meanwhile.
    void end(const Trial& trial, double raster_s);
    static constexpr std::size_t most_rounds = 3;

  private:
    [[nodiscard]] bool shows_much_of(const FramePlan& plan) const;

    OcclusionUse use_;
    bool nearest_;
    bool may_tie_{}, uses_last_frame_{};
    bool was_of_clusters_{};  // the last frame was
    std::vector<gpu::FrameRound> rounds_;
    gpu::FrameConstants
        last_{};             // of the last frame that was drawn in rounds; its page_count 0: there is none
    AdaptiveToggle toggle_;  // of if_it_pays
    std::uint64_t views_{};  // that it has forgotten
    bool was_on_{};
    Buffer pyramid_, ids_before_;
};

}  // namespace oro
