#include "core/frame/picture_culling.h"

#include <glm/geometric.hpp>

#include "core/frame/frame_plan.h"

namespace oro {
namespace {

constexpr double rounded_off_m = 1.0;
// Of tau: more than what floats of a GPU make of the same sum.
constexpr float share_of_tau = 0.99F;

// A pixel more on all sides.
Tile with_rim(const Tile& tile) {
    Tile wider = tile;
    wider.x_px -= 1;
    wider.y_px -= 1;
    wider.width_px += 2;
    wider.height_px += 2;
    return wider;
}

}  // namespace

PictureCulling::PictureCulling(const FrameView& view, const HorizonOccluder& occluder)
    : model_(view.camera, view.model, {}),
      level_(level_view(view.camera, view.tau_px)),
      planes_(frustum_planes_view(projection_of_tile(view.camera, with_rim(view.tile)))),
      horizon_(model_.horizon(occluder)) {
    for (Plane& plane : planes_) plane.w += model_.rounding_m() + rounded_off_m;
}

bool PictureCulling::may_show(const PageBound& bound) const {
    if (!model_.culls_nodes()) return true;
    const ViewSphere seen = model_.seen_at(bound.centre.m, bound.radius_m).sphere;
    return !beyond_frustum(planes_, seen.centre_m, seen.radius_m) &&
           !beyond_horizon(horizon_.eye,
                           {bound.horizon.direction, bound.horizon.angle_rad * horizon_.stretch});
}

bool PictureCulling::keeps_tau(const PageBound& bound, double error_m) const {
    if (!model_.culls_nodes()) return false;
    const ModelView::SeenAt seen = model_.seen_at(bound.centre.m, bound.radius_m);
    return gpu::projected_error_px(gpu::vec3(seen.sphere.centre_m), static_cast<float>(seen.sphere.radius_m),
                                   static_cast<float>(error_m * seen.stretch), level_.pixels_per_tangent,
                                   level_.corner_tangent) <= share_of_tau * level_.tau_px;
}

// gpu::projected_error_px() is no less than what is seen of the error at the sphere's farthest place.
bool PictureCulling::fails_tau(const PageBound& bound, double error_m) const {
    if (!model_.culls_nodes()) return false;
    const ViewSphere seen = model_.seen_at(bound.centre.m, bound.radius_m).sphere;
    const double farthest_m = glm::length(seen.centre_m) + seen.radius_m;
    return static_cast<double>(share_of_tau * level_.pixels_per_tangent) * error_m >
           static_cast<double>(level_.tau_px) * farthest_m;
}

}  // namespace oro
