#include "core/measure/picture_errors.h"

#include <algorithm>
#include <cmath>

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

namespace {

// How far a triangle between posts, which is drawn flat, may be from the surface, which is as curved as the
// ellipsoid: up and sideways (docs/ARCHITECTURE.md, Truth). Of all latitudes of the grid the most.
double flat_cell_m(const PostGrid& grid) {
    const double tall = radians_from_deg(grid.lat.spacing_deg()).rad;
    const double wide = radians_from_deg(grid.lon.spacing_deg()).rad;
    const double north_deg = grid.north_deg(), south_deg = grid.south_deg();
    const double farthest_deg = std::min(90.0, std::max(std::abs(north_deg), std::abs(south_deg)));
    const double nearest_deg =
        south_deg <= 0.0 && north_deg >= 0.0 ? 0.0 : std::min(std::abs(north_deg), std::abs(south_deg));
    const double sine = sine_cosine_deg(farthest_deg).sine, cosine = sine_cosine_deg(nearest_deg).cosine;
    return wgs84_a_m * std::hypot((tall * tall + wide * wide * cosine * cosine) / 8.0,
                                  sine * (tall * wide / 4.0 + wide * wide * cosine / 8.0));
}

}  // namespace

double drawing_slack_px(const Camera& camera, double nearest_m, const PostGrid& grid) {
    constexpr double usual_px = 0.05;
    if (nearest_m <= 0.0) return usual_px;
    const double pixels_per_tangent = 0.5 * camera.height_px / camera.half_fov_tangent().y;
    return usual_px + (0.5 * height_step_m + flat_cell_m(grid)) / nearest_m * pixels_per_tangent;
}

}  // namespace oro
