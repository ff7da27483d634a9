#include "core/frame/model_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "core/lod/levels_gpu.h"

namespace oro {
namespace {

constexpr double everywhere_m = std::numeric_limits<double>::infinity();
// Of WGS84: the meridian's at the poles.
constexpr double largest_radius_m = wgs84_a_m * wgs84_a_m / wgs84_b_m;
// Pages that reach farther are not asked where another Earth puts them.
constexpr double largest_moved_m = 2.0e5;
// What bent light lifts less than 1e-5 m anywhere counts as straight.
constexpr double least_curvature = 1.0e-11;
// Beyond such an angle the horizon's distance is not sqrt(2 h R) to 2 %, and nothing is told about it.
constexpr double largest_bent_angle_rad = 0.35;

// How far float32 ECEF may put a post from its place: of four roundings at the eye's distance from the
// Earth's centre none is above 6e-8 of it.
double rounding_m(Precision precision, const Ecef& eye) {
    if (precision == Precision::relative) return 0.0;
    return 1.0e-6 * std::max(glm::length(eye.m), wgs84_a_m);
}

}  // namespace

ModelView::ModelView(const Camera& camera, const WorldModel& model, const HeightQuantization& coding)
    : model_(model),
      eye_(camera.eye),
      eye_ecef_(camera.eye_ecef()),
      view_from_ecef_(camera.view_from_ecef()),
      up_view_(view_from_ecef_ * ecef_from_enu(eye_.lat_deg, eye_.lon_deg)[2]),
      refraction_(eye_, model.air),
      rounding_m_(oro::rounding_m(model.precision, eye_ecef_) + coding.error_m()) {}

glm::dvec3 ModelView::straight_m(const PageSummary& page, const glm::dvec3& in_page_m) const {
    if (model_.earth == Earth::ellipsoid)
        return view_from_ecef_ * (page.origin_ecef.m + page.ecef_from_page * in_page_m - eye_ecef_.m);
    return view_from_ecef_ *
           (model_offset_m(model_.earth, eye_, page.origin) + page.ecef_from_page * in_page_m);
}

glm::dvec3 ModelView::origin_m(const PageSummary& page) const {
    if (model_.earth == Earth::ellipsoid) return view_from_ecef_ * (page.origin_ecef.m - eye_ecef_.m);
    return view_from_ecef_ * model_offset_m(model_.earth, eye_, page.origin);
}

double ModelView::across_m(const glm::dvec3& view_m) const {
    return glm::length(view_m - glm::dot(view_m, up_view_) * up_view_);
}

// The lift c a^2 / 2 of two points whose a differ by at most r differs by at most c r (a + r / 2).
ModelView::SeenAt ModelView::bent_at(const ViewSphere& straight) const {
    const double c = refraction_.curvature_per_m();
    if (c == 0.0) return {straight, 0.0, 1.0};
    const double a = across_m(straight.centre_m), r = straight.radius_m;
    return {{straight.centre_m + 0.5 * c * a * a * up_view_, r + std::abs(c) * r * (a + 0.5 * r)},
            a,
            1.0 + std::abs(c) * (a + r)};
}

ViewSphere ModelView::bent(const ViewSphere& straight) const {
    return bent_at(straight).sphere;
}

ViewSphere ModelView::seen(const PageSummary& page, const glm::dvec3& in_page_m, double radius_m) const {
    return bent({straight_m(page, in_page_m), radius_m});
}

ModelView::SeenAt ModelView::seen_at(const PageSummary& page, const glm::dvec3& in_page_m,
                                     double radius_m) const {
    return bent_at({straight_m(page, in_page_m), radius_m});
}

bool ModelView::may_stand(const PageRecord& page) const {
    return model_.earth != Earth::flat || page.summary.index.level == 0 || page.reach_m <= largest_moved_m;
}

ViewSphere ModelView::seen_page(const PostGrid& grid, const PageRecord& page) const {
    if (model_.earth == Earth::ellipsoid) return seen(page.summary, page.summary.centre_m, page.reach_m);
    const glm::dvec3 centre_m = straight_m(page.summary, page.summary.centre_m);
    if (page.reach_m > largest_moved_m) return {centre_m, everywhere_m};
    if (model_.earth == Earth::flat) return bent(on_plane(grid, page));
    // Radii of curvature differ by less than 1 % from the sphere's, and so do lengths.
    return bent({centre_m, 1.1 * page.reach_m + 0.01 * glm::length(centre_m)});
}

// A page is a box there. Heights of what lies below the page are within its error of its own, or at least no
// farther from the middle than anything in it.
ViewSphere ModelView::on_plane(const PostGrid& grid, const PageRecord& page) const {
    constexpr int quads = static_cast<int>(gpu::page_quads);
    const PageSummary& summary = page.summary;
    const LevelGrid level = level_grid(grid, summary.index.level);
    const auto post = [](const LevelAxis& axis, int number) {
        return axis.region_post(std::min(number, axis.quads));
    };
    const double north_deg = row_lat_deg(grid, post(level.row, summary.index.row * quads));
    const double south_deg = row_lat_deg(grid, post(level.row, (summary.index.row + 1) * quads));
    const double west_deg = grid.lon.at_deg(post(level.column, summary.index.column * quads));
    const double east_deg = grid.lon.at_deg(post(level.column, (summary.index.column + 1) * quads));
    const double to_west_deg = std::remainder(west_deg - eye_.lon_deg, 360.0);
    const double to_east_deg = std::remainder(east_deg - eye_.lon_deg, 360.0);
    // Torn apart opposite to the eye.
    if (std::abs(to_east_deg - to_west_deg - (east_deg - west_deg)) > 1.0e-6)
        return {straight_m(summary, summary.centre_m), everywhere_m};
    const bool known = summary.largest_error_m < gpu::unfit_error_m;
    const double more_m = known ? 1.0 + static_cast<double>(summary.largest_error_m)
                                : page.reach_m + glm::length(summary.centre_m);
    const glm::dvec3 corners[] = {
        model_offset_m(Earth::flat, eye_,
                       {north_deg, eye_.lon_deg + to_west_deg, summary.lowest_h_m - more_m}),
        model_offset_m(Earth::flat, eye_,
                       {south_deg, eye_.lon_deg + to_east_deg, summary.highest_h_m + more_m})};
    return {view_from_ecef_ * (0.5 * (corners[0] + corners[1])),
            0.5 * glm::length(corners[1] - corners[0]) + 0.01};
}

Plane ModelView::plane_for_nodes(const Plane& plane, double across_m, double radius_m) const {
    const double c = refraction_.curvature_per_m();
    if (c == 0.0) return plane;
    const double near_m = std::max(0.0, across_m - radius_m), far_m = across_m + radius_m;
    const double along = 0.5 * c * glm::dot(glm::dvec3(plane), up_view_);
    return {glm::dvec3(plane), plane.w + std::max(along * near_m * near_m, along * far_m * far_m)};
}

SeenHorizon ModelView::horizon(const HorizonOccluder& occluder) const {
    SeenHorizon seen{horizon_eye(occluder, eye_ecef_), 1.0};
    if (model_.earth != Earth::ellipsoid) seen.eye.angle_rad = std::numbers::pi;
    if (seen.eye.angle_rad >= std::numbers::pi) return seen;
    // Posts so much higher, above an occluder so much lower: sqrt(2 e / R) for the eye and sqrt(4 e / R) for
    // them.
    if (rounding_m_ > 0.0) seen.eye.angle_rad += 2.5 * std::sqrt(2.0 * rounding_m_ / wgs84_b_m);
    const double bend = refraction_.curvature_per_m() * largest_radius_m;
    // Light that bends upwards hides more: what was hidden still is.
    if (bend < least_curvature) return seen;
    // Over a surface whose curvature 1 / R looks like 1 / R - c a horizon is farther by that root; 2 % for
    // what the square root of the height leaves out.
    seen.stretch = 1.02 / std::sqrt(1.0 - bend);
    seen.eye.angle_rad *= seen.stretch;
    if (seen.eye.angle_rad > largest_bent_angle_rad) seen.eye.angle_rad = std::numbers::pi;
    return seen;
}

}  // namespace oro
