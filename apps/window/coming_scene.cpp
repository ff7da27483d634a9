#include "apps/window/coming_scene.h"

#include <algorithm>

namespace oro {

bool lacks_clusters(const FramePlan& plan) {
    return std::ranges::any_of(plan.grids, [](const GridPlan& grid) { return grid.clusters.missing > 0; });
}

Result<bool> has_what_fits(Scene& scene, const FramePlan& plan, Clock::time_point since) {
    // Of clusters nothing says that they do not fit.
    constexpr double longest_s = 10.0;
    if (plan.is_settled()) return true;
    ORO_TRY(const bool better, scene.advance());
    if (lacks_clusters(plan)) return seconds_since(since) > longest_s;
    return !better && scene.lacks_memory();
}

}  // namespace oro
