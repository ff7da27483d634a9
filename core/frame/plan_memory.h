// What the plans of one grid keep from frame to frame, so that it is not made anew for each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/frame/cast_cells.h"
#include "core/frame/frame_plan.h"
#include "core/frame/frame_tables.h"
#include "core/frame/page_table.h"
#include "core/frame/region_pages.h"

namespace oro {

// Records and angles of rows are the same for every frame. For one thread at a time.
class PlanMemory {
  public:
    // The pages outlive it.
    explicit PlanMemory(const RegionPages& pages) : pages_(&pages), angles_(pages.facts().grid) {}

    // What records() pointed to may be gone from here on.
    void begin_frame();
    // A page's record, good until the next frame begins. Errors: as RegionPages::record().
    Result<const PageRecord*> record(const PageIndex& page);
    [[nodiscard]] KeptAngles& angles() { return angles_; }
    [[nodiscard]] CastCells& cast_cells() {
        return cast_cells_ ? *cast_cells_ : cast_cells_.emplace(*pages_);
    }
    [[nodiscard]] const RegionPages& pages() const { return *pages_; }

  private:
    struct Level {
        PageTable numbers;
        std::vector<std::unique_ptr<PageRecord>> records;
    };
    const RegionPages* pages_;
    KeptAngles angles_;
    std::optional<CastCells> cast_cells_;
    std::vector<Level> levels_;
    std::size_t size_{};
};

// The plans of core/frame/frame_plan.h and core/frame/casters.h, to the bit, in less time: of the pages of a
// memory that is kept from frame to frame. Casters are those of the memory's last plan.
Result<GridPlan> plan_grid(PlanMemory& memory, const Residency& residency, const FrameView& view,
                           const HeightQuantization& coding = {},
                           double shading_spacing_px = gpu::shading_spacing_px,
                           const IsHidden& is_hidden = {});
Result<std::vector<ShadowReceiver>> shadow_receivers(PlanMemory& memory, const FrameView& view,
                                                     const GridPlan& plan);
Result<void> plan_casters(PlanMemory& memory, const std::function<std::uint64_t(const PageIndex&)>& residency,
                          const FrameView& view, const ShadowRequest& request, double top_m, GridPlan& plan,
                          std::span<const ShadowReceiver> others = {});

}  // namespace oro
