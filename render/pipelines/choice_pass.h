// Chooses the pages of a frame on the device (shaders/plan): the same as plan_grid(), in the same order.
#pragma once

#include <array>

#include "render/device/resources.h"
#include "shaders/plan/shared_choice.h"

namespace oro {

class ChoicePass {
  public:
    // Errors: the device, which has doubles (PlanPass::can_run()).
    static Result<ChoicePass> create(const Gpu& gpu);

    // Chooses those of one grid. terms: what lies at terms_address; its counts are 0. What it reads is there.
    // What it writes comes after record_end().
    void record(VkCommandBuffer commands, const gpu::ChoiceTerms& terms, VkDeviceAddress terms_address) const;
    static void record_end(VkCommandBuffer commands);

  private:
    static constexpr std::size_t step_count = 5;
    OwnedPipelineLayout layout_;
    std::array<OwnedPipeline, step_count> steps_;
};

}  // namespace oro
