#include "core/measure/picture_errors.h"

#include <algorithm>
#include <cmath>

#include "core/terrain/drawn_heights.h"
#include "core/terrain/flat_triangle.h"

namespace oro {

TruePicture::TruePicture(const TrueGround& ground, const Sight& sight, const Camera& camera, int threads)
    : ground_(ground),
      sight_(sight),
      camera_(camera),
      oracle_(ground, sight),
      hits_(oracle_.cast_picture(camera, threads)),
      skyline_(true_skyline(ground, sight, camera, threads)) {}

double PictureErrors::largest_px() const {
    return std::max({ground.summary_displacement_px.largest, ground.summary_surface_px.largest,
                     seen.summary_px.largest - seen_resolution_px,
                     skyline.summary_px.largest - seen_resolution_px, 0.0});
}

bool PictureErrors::largest_px_at_least() const {
    return ground.summary_displacement_px.at_least > 0 || ground.summary_surface_px.at_least > 0 ||
           seen.summary_px.at_least > 0;
}

PictureErrors picture_errors(const TruePicture& truth, std::span<const DrawnPoint> points,
                             std::span<const DrawnDepths> samples, int threads,
                             std::span<const TrueMesh> drawn) {
    PictureErrors errors;
    errors.ground = ground_errors(truth.ground_, truth.sight_, truth.camera_, points, threads,
                                  MeshesMeasured{drawn, truth.hits_});
    errors.seen = seen_errors(truth.oracle_, {truth.ground_, truth.sight_, truth.camera_}, truth.hits_,
                              truth.camera_, points, threads);
    errors.skyline = skyline_error(truth.skyline_, truth.camera_, samples, &truth.oracle_);
    errors.slack_px = drawing_slack_px(truth.camera_, truth.ground_.surface(0).field().grid, 0.0, 0.0);
    for (const DrawnPoint& point : points) {
        if (point.background()) continue;
        if (errors.nearest_m == 0.0 || point.z_m < errors.nearest_m) errors.nearest_m = point.z_m;
        if (point.grid >= truth.ground_.grids()) continue;
        const TrueSurface& surface = truth.ground_.surface(point.grid);
        const auto slope = surface.slope_at(point.row, point.column);
        const double steepness = slope ? slope->steepness() : 0.0;
        errors.slack_px = std::max(
            errors.slack_px, drawing_slack_px(truth.camera_, surface.field().grid, point.z_m, steepness));
    }
    return errors;
}

double drawing_slack_px(const Camera& camera, const PostGrid& grid, double z_m, double steepness) {
    constexpr double usual_px = 0.05;
    if (z_m <= 0.0) return usual_px;
    constexpr double highest_m = 9000.0;
    const FlatTriangle flat = widest_flat_triangle(grid, highest_m, steepness, 1.0);
    const double off_m = 0.5 * height_step_m + std::hypot(flat.up_m, flat.sideways_m);
    // Towards the picture's corners a metre is more pixels.
    const glm::dvec2 tangent = camera.half_fov_tangent();
    const double pixels_per_tangent = 0.5 * camera.height_px / tangent.y;
    return usual_px + off_m / z_m * pixels_per_tangent * std::hypot(1.0, tangent.x, tangent.y);
}

}  // namespace oro
