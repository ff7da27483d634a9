// What one grid of a frame has on the device: its constants, pages and tables, what is chosen of them, and
// what shades its pixels. A frame has one for each grid that it draws.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "core/frame/frame_plan.h"
#include "core/frame/visibility_feedback.h"
#include "core/terrain/page_table.h"
#include "render/device/resources.h"
#include "render/growth/growth_frame.h"
#include "render/growth/meadow_frame.h"
#include "render/pipelines/pipelines.h"
#include "render/shading/caster_buffers.h"
#include "render/shading/texture_tile_feedback.h"

namespace oro {

class GridFrame {
  public:
    // A set for the frame's images (ids, sum, picture; depth) and the grid's constants.
    Result<void> create_set(const Gpu& gpu, const Pipelines& pipelines,
                            const std::array<VkImageView, 4>& images);
    // Room for the pages of a plan, on both sides, and for what is chosen of them. slot: of frames_in_flight;
    // the frame that had it before is done. All that follows is of this frame.
    Result<void> reserve(const Gpu& gpu, const GridPlan& plan, std::size_t slot);
    // Where all that lies, into the plan's constants.
    void address(GridPlan& plan) const;
    // Puts a plan, whose constants are whole, where record_upload() sends it from.
    void fill(const GridPlan& plan);
    void record_upload(VkCommandBuffer commands) const;
    // What the frame's nodes or clusters have shown goes to where feedback_of() reads it, once the frame is
    // done.
    void record_feedback(VkCommandBuffer commands) const;
    // What the frame of a slot, which is done, has shown, of its plan. Nothing of a frame that was drawn at
    // once.
    [[nodiscard]] FrameFeedback feedback_of(const GridPlan& plan, std::size_t slot) const;
    // What the device has chosen of that plan, which leaves that to it.
    [[nodiscard]] MadeChoice choice_of(const GridPlan& plan, std::size_t slot) const;
    void bind(VkCommandBuffer commands, const Pipelines& pipelines, VkPipelineBindPoint point) const;

    // The frame was drawn in rounds: the next such one knows which of its nodes or clusters were seen. Or
    // nobody knows.
    void remember(const GridPlan& plan);
    void forget() {
        pages_before_ = 0;
        clusters_before_ = 0;
    }
    [[nodiscard]] bool remembers(const GridPlan& plan) const {
        return plan.clusters.on ? clusters_before_ > 0
                                : pages_before_ > 0 && before_chosen_ == plan.device.chooses;
    }

    // Where data() holds the gpu::ChoiceTerms of a plan whose pages the device chooses, and the workgroups of
    // an indirect dispatch of one a page.
    [[nodiscard]] VkDeviceAddress choice_terms() const { return choice_terms_; }
    [[nodiscard]] VkDeviceSize page_groups() const { return page_groups_; }
    // The address of FrameConstants.page_count, after which first_page comes.
    [[nodiscard]] VkDeviceAddress frame_counts() const;
    // Where data() holds the gpu::PlanTerms of a plan that leaves some of it to the device, and its pages,
    // rows and columns.
    [[nodiscard]] VkDeviceAddress plan_terms() const { return plan_terms_; }
    struct DataPart {
        VkDeviceSize first, size;  // bytes
    };
    [[nodiscard]] const std::array<DataPart, 3>& planned_parts() const { return planned_parts_; }

    [[nodiscard]] const Buffer& data() const { return data_; }      // begins with the constants
    [[nodiscard]] const Buffer& choice() const { return choice_; }  // see frame_layout.h
    [[nodiscard]] std::size_t page_capacity() const { return page_capacity_; }
    // Where data() holds the workgroups of an indirect draw of the frame's clusters; 0: it has none.
    [[nodiscard]] VkDeviceSize cluster_groups() const { return cluster_groups_; }
    [[nodiscard]] const Buffer& cluster_states() const { return cluster_states_; }

    CasterBuffers casters;
    TextureTileFeedback drape;
    GrowthFrame growth;
    MeadowFrame meadow;
    VkPipeline shade{VK_NULL_HANDLE}, shade_parts{VK_NULL_HANDLE};  // of the frame

  private:
    void bind_constants(const Gpu& gpu) const;
    Result<void> reserve_seen(const Gpu& gpu, std::size_t pages);
    Result<void> reserve_clusters(const Gpu& gpu, const GridPlan& plan);
    Result<void> reserve_feedback(const Gpu& gpu, const GridPlan& plan);
    [[nodiscard]] VkDeviceSize requested_feedback() const;
    void remember_pages(std::span<const PageIndex> pages);
    Result<void> reserve_choice(const Gpu& gpu, const GridPlan& plan);
    void address_choice(GridPlan& plan) const;
    void fill_choice(const GridPlan& plan);
    [[nodiscard]] std::vector<gpu::uint> numbers_before(const GridPlan& plan) const;

    OwnedDescriptorPool pool_;
    VkDescriptorSet set_{VK_NULL_HANDLE};
    std::size_t slot_{};  // of the frame that is being recorded
    // Constants, then pages, then rows and columns, then FrameConstants::page_before, then clusters and their
    // boxes.
    std::array<Buffer, frames_in_flight> staging_;
    Buffer data_;  // the same on the device
    Buffer choice_;
    std::array<Buffer, 2> seen_;  // of this frame in rounds and of the last such one, by turns
    std::size_t turn_{};
    std::vector<PageTable> before_;    // numbers of the last such frame's pages, of each level
    std::size_t pages_before_{};       // 0: nothing is known of it
    std::uint32_t clusters_turn_{};    // frames of clusters in rounds so far
    std::uint32_t clusters_before_{};  // the last frame's number among them; 0: nothing is known of it
    Buffer cluster_states_;            // FrameConstants::cluster_states
    // FrameConstants::feedback, on the device and for the host, and of how many bytes the frame's is; 0:
    // nobody wants to know.
    Buffer feedback_;
    std::array<Buffer, frames_in_flight> feedback_read_;
    std::array<VkDeviceSize, frames_in_flight> feedback_size_{};
    std::size_t page_capacity_{};
    // Of pages that the device chooses: their numbers in this frame in rounds and in the last such one, by
    // turns as seen_; whether the device has chosen the last one's; what it tells the host.
    std::array<Buffer, 2> numbers_;
    bool before_chosen_{};
    std::array<Buffer, frames_in_flight> choice_read_;
    VkDeviceAddress choice_terms_{};
    VkDeviceSize page_groups_{}, counts_at_{}, wanted_at_{}, choice_read_bytes_{};
    VkDeviceSize sent_from_{}, sent_to_{};  // then the constants are sent, and this
    bool clears_seen_{};
    VkDeviceSize size_{};  // that a frame sends
    VkDeviceSize cluster_groups_{};
    VkDeviceAddress plan_terms_{};
    std::array<DataPart, 3> planned_parts_{};
};

}  // namespace oro
