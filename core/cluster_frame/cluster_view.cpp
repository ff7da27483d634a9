#include "core/cluster_frame/cluster_view.h"

#include <algorithm>
#include <cassert>
#include <glm/geometric.hpp>

#include "core/earth/culling.h"

namespace oro {

ClusterView::ClusterView(const Camera& camera, const Tile& tile, double tau_px, const WorldModel& model,
                         const HorizonOccluder& occluder, const HeightQuantization& coding,
                         std::optional<std::uint32_t> level)
    : rule_(camera, tau_px, model.air, level),
      planes_(frustum_planes_view(projection_of_tile(camera, tile))) {
    assert(model.earth == Earth::ellipsoid);
    const ModelView view(camera, model, coding);
    horizon_ = view.horizon(occluder);
    // Drawn places are rounded.
    for (Plane& plane : planes_) plane.w += view.rounding_m() + 0.01;
}

ClusterView ClusterView::coarser(unsigned steps) const {
    ClusterView other = *this;
    other.rule_ = rule_.coarser(steps);
    return other;
}

bool ClusterView::is_beyond_frustum(const ClusterGroup& group) const {
    const GroupRule::SeenSphere seen = rule_.seen(group.centre, group.radius_m);
    return beyond_frustum(planes_, seen.centre_m, seen.radius_m);
}

ClusterView::Look ClusterView::look_at(const ClusterReach& reach) const {
    const GroupRule::SeenSphere seen = rule_.seen(reach.centre, reach.radius_m);
    if (beyond_frustum(planes_, seen.centre_m, seen.radius_m)) return {Seen::beyond_frustum, 0.0};
    if (beyond_horizon(horizon_.eye, {reach.horizon.direction, reach.horizon.angle_rad * horizon_.stretch}))
        return {Seen::beyond_horizon, 0.0};
    return {Seen::yes, std::max(0.0, glm::length(seen.centre_m) - seen.radius_m)};
}

}  // namespace oro
