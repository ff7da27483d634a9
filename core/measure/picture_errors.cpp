#include "core/measure/picture_errors.h"

#include <algorithm>

#include "core/terrain/drawn_heights.h"

namespace oro {

TruePicture::TruePicture(const TrueSurface& surface, const Sight& sight, const Camera& camera, int threads)
    : surface_(surface),
      sight_(sight),
      camera_(camera),
      oracle_(surface, sight),
      hits_(oracle_.cast_picture(camera, threads)),
      skyline_(true_skyline(surface, sight, camera, threads)) {}

double PictureErrors::largest_px() const {
    return std::max({ground.summary_displacement_px.largest, ground.summary_surface_px.largest,
                     seen.summary_px.largest - seen_resolution_px,
                     skyline.summary_px.largest - seen_resolution_px, 0.0});
}

PictureErrors picture_errors(const TruePicture& truth, std::span<const DrawnPoint> points,
                             std::span<const DrawnDepths> samples, int threads) {
    PictureErrors errors;
    errors.ground = ground_errors(truth.surface_, truth.sight_, truth.camera_, points, threads);
    errors.seen = seen_errors(truth.oracle_, {truth.surface_, truth.sight_, truth.camera_}, truth.hits_,
                              truth.camera_, points, threads);
    errors.skyline = skyline_error(truth.skyline_, truth.camera_, samples, &truth.oracle_);
    for (const DrawnPoint& point : points) {
        if (!point.background() && (errors.nearest_m == 0.0 || point.z_m < errors.nearest_m))
            errors.nearest_m = point.z_m;
    }
    return errors;
}

double drawing_slack_px(const Camera& camera, double nearest_m) {
    constexpr double usual_px = 0.05;
    if (nearest_m <= 0.0) return usual_px;
    const double pixels_per_tangent = 0.5 * camera.height_px / camera.half_fov_tangent().y;
    return usual_px + 0.5 * height_step_m / nearest_m * pixels_per_tangent;
}

}  // namespace oro
