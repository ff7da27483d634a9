#include "core/frame/records_ahead.h"

#include "core/frame/plan_memory.h"

namespace oro {

Result<void> make_records_ahead(const RegionPages& pages, const FrameView& view, const ShadowRequest& light,
                                const std::stop_token& stop) {
    PlanMemory memory(pages);
    memory.wait_for_records(false);
    const Residency all_here = [](const PageIndex&) { return std::uint64_t{1}; };
    for (;;) {
        ORO_TRY(GridPlan plan, plan_grid(memory, all_here, view));
        if (light.any()) {
            ORO_TRY(const double top_m, region_top_m(pages));
            ORO_CHECK(plan_casters(memory, all_here, view, light, top_m, plan));
        }
        // What is missing has no record.
        if (plan.missing.empty()) return {};
        for (const PageIndex& page : plan.missing) {
            if (stop.stop_requested()) return {};
            ORO_CHECK(pages.record(page));
        }
    }
}

}  // namespace oro
