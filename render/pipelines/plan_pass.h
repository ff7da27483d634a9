// Makes on the device what plans leave to it (DevicePlan): tables of rows and columns, and places of pages.
#pragma once

#include "core/frame/frame_plan.h"
#include "render/device/resources.h"

namespace oro {

class PlanPass {
  public:
    // Whether a device has the doubles that it takes.
    [[nodiscard]] static bool can_run(const Gpu& gpu);
    // Errors: the device.
    static Result<PlanPass> create(const Gpu& gpu);

    // Makes those of one grid; what it reads is there (GridFrame::record_upload()). terms_address: of the
    // plan's gpu::PlanTerms. record_end() comes after the last one, and before what reads them.
    void record(VkCommandBuffer commands, const DevicePlan& plan, VkDeviceAddress terms_address) const;
    static void record_end(VkCommandBuffer commands);

  private:
    OwnedPipelineLayout layout_;
    OwnedPipeline pipeline_;
};

}  // namespace oro
