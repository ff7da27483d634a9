#include "core/effects/effects.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <numbers>

#include "core/base/parallel.h"
#include "core/effects/effect_sizes.h"
#include "core/frame/placement_promise.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/flat_triangle.h"

namespace oro {

EffectPrediction::EffectPrediction(const TrueGround& ground, const RegionPagesList& pages,
                                   const Camera& camera, const EarthParameters& world, int threads)
    : ground_(ground),
      pages_(pages),
      camera_(camera),
      world_(world),
      threads_(threads),
      sight_(sight_from(camera.eye, world.air)),
      view_from_ecef_(camera.view_from_ecef()),
      pixels_per_tangent_(0.5 * camera.height_px / camera.half_fov_tangent().y),
      samples_(view_samples(ground, sight_, camera_, threads)) {
    assert(pages.size() == ground.grids() && world.grids.size() == ground.grids());
    std::erase_if(samples_, &Sample::between_grids);
}

double EffectPrediction::nearest_m() const {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Sample& sample : samples_)
        if (sample.from_seen_px == 0.0) nearest_m = std::min(nearest_m, sample.distance_m);
    return nearest_m;
}

std::size_t EffectPrediction::sight_lines() const {
    return static_cast<std::size_t>(std::count_if(
        samples_.begin(), samples_.end(), [](const Sample& sample) { return sample.from_seen_px == 0.0; }));
}

double EffectPrediction::median_distance_m() const {
    std::vector<double> distances;
    for (const Sample& sample : samples_)
        if (sample.even) distances.push_back(sample.distance_m);
    return median_of(std::move(distances));
}

double EffectPrediction::apart_px(const glm::dvec3& drawn_m, const glm::dvec3& seen_m) const {
    const glm::dvec3 drawn = view_from_ecef_ * drawn_m, seen = view_from_ecef_ * seen_m;
    return glm::length(glm::dvec2(seen) / seen.z - glm::dvec2(drawn) / drawn.z) * pixels_per_tangent_;
}

EffectSize EffectPrediction::moved(const Drawn& drawn, double margin) const {
    Sizes sizes;
    for (const Sample& sample : samples_) {
        if (sample.from_seen_px > in_gaps_px) continue;
        const glm::dvec3 at = drawn(sample);
        if ((view_from_ecef_ * at).z >= -near_plane_m) continue;  // not in the picture
        sizes.add(glm::length(sight_.refraction.true_m(at) - sight_.refraction.true_m(sample.apparent_m)),
                  apart_px(at, sample.apparent_m), sample.even);
    }
    return sizes.size(margin);
}

namespace {

WorldModel plane(const EarthParameters& world) {
    return {Earth::flat, world.air, Precision::relative};
}

// The same picture with so many pixels more on each side.
Camera widened(const Camera& camera, int rim_px) {
    Camera wide = camera;
    wide.width_px += 2 * rim_px;
    wide.height_px += 2 * rim_px;
    const double tangent = camera.half_fov_tangent().y * wide.height_px / camera.height_px;
    wide.vertical_fov_deg = 360.0 / std::numbers::pi * std::atan(tangent);
    return wide;
}

}  // namespace

// How far a point in front of the eye lies outside the picture.
double EffectPrediction::outside_px(const glm::dvec3& apparent_m) const {
    const glm::dvec3 view = view_from_ecef_ * apparent_m;
    const glm::dvec2 from_middle_px = glm::abs(glm::dvec2(view) / -view.z) * pixels_per_tangent_;
    const glm::dvec2 half_px(0.5 * camera_.width_px, 0.5 * camera_.height_px);
    return std::max({from_middle_px.x - half_px.x, from_middle_px.y - half_px.y, 0.0});
}

const std::vector<EffectPrediction::Shown>& EffectPrediction::shown_by(EffectKind kind,
                                                                       const WorldModel& model,
                                                                       int rim_px) const {
    const auto [found, is_new] = shown_.try_emplace({kind, rim_px});
    std::vector<Shown>& all = found->second;
    if (!is_new) return all;
    const Camera wide = rim_px > 0 ? widened(camera_, rim_px) : camera_;
    for (const Sample& sample : view_samples(ground_, sight_of(model, camera_.eye), wide, threads_)) {
        if (sample.between_grids) continue;
        const glm::dvec3 offset_m = ecef_from_geodetic(sample.point).m - sight_.eye.m;
        const glm::dvec3 seen_m = sight_.refraction.apparent_m(offset_m);
        const double metres = glm::length(sight_.refraction.true_m(sample.apparent_m) - offset_m);
        // Truly behind the eye: as far as the metres reach at its distance.
        const double px = (view_from_ecef_ * seen_m).z >= 0.0 ? any_way_px(sample, metres)
                                                              : apart_px(sample.apparent_m, seen_m);
        const double outside = rim_px > 0 ? outside_px(sample.apparent_m) : 0.0;
        all.push_back({metres, px, sample.from_seen_px, outside, sample.even && outside == 0.0});
    }
    return all;
}

EffectSize EffectPrediction::moved_by(EffectKind kind, const WorldModel& model, double tau_px) const {
    EffectSize size =
        moved([&](const Sample& sample) { return model_offset_m(model, camera_.eye, sample.point); },
              between_samples);
    Sizes shown;
    // Ground beside the picture may come into it as what lies behind edges comes out.
    const int rim_px = tau_px > 0.0 ? static_cast<int>(behind_edges_px) : 0;
    for (const Shown& one : shown_by(kind, model, rim_px))
        if (one.from_seen_px <= in_gaps_px + tau_px && one.outside_px <= tau_px)
            shown.add(one.metres, one.px, one.even);
    const EffectSize of_shown = shown.size(between_samples);
    size.worst_m = std::max(size.worst_m, of_shown.worst_m);
    size.worst_px = std::max(size.worst_px, of_shown.worst_px);
    size.largest_px = std::max(size.largest_px, of_shown.largest_px);
    return size;
}

// A height on the picture, up or down from a sample. Towards the eye only half the way: beyond, pixels say
// nothing.
double EffectPrediction::vertical_px(const Sample& sample, double height_m) const {
    const glm::dvec3 here = view_from_ecef_ * sample.apparent_m;
    const glm::dvec3 up = view_from_ecef_ * ecef_from_enu(sample.point.lat_deg, sample.point.lon_deg)[2];
    double worst_px = 0.0;
    for (const double sign : {1.0, -1.0}) {
        const glm::dvec3 there = here + sign * height_m * up;
        const double tangent = there.z < 0.5 * here.z
                                   ? glm::length(glm::dvec2(there) / -there.z - glm::dvec2(here) / -here.z)
                                   : height_m / -here.z;
        worst_px = std::max(worst_px, tangent * pixels_per_tangent_);
    }
    return worst_px;
}

// So far in any direction: towards the picture's rim a metre is more pixels.
double EffectPrediction::any_way_px(const Sample& sample, double metres) const {
    const double z_m = std::max(near_plane_m, -(view_from_ecef_ * sample.apparent_m).z);
    return metres * sample.distance_m / (z_m * z_m) * pixels_per_tangent_;
}

EffectSize EffectPrediction::lifted(const Bound& height_m) const {
    Sizes sizes;
    for (const Sample& sample : samples_) {
        if (sample.from_seen_px > in_gaps_px) continue;
        const double height = height_m(sample);
        sizes.add(height, vertical_px(sample, height), sample.even);
    }
    return sizes.size(nearer);
}

EffectSize EffectPrediction::anywhere(const Bound& bound_m, const Bound& typical_m) const {
    Sizes bounds, typical;
    for (const Sample& sample : samples_) {
        if (sample.from_seen_px > in_gaps_px) continue;
        const double most_m = bound_m(sample), usual_m = typical_m(sample);
        bounds.add(most_m, any_way_px(sample, most_m), sample.even);
        typical.add(usual_m, any_way_px(sample, usual_m), sample.even);
    }
    EffectSize size = bounds.size(nearer);
    const EffectSize usual = typical.size(1.0);
    size.typical_m = usual.typical_m;
    size.typical_px = usual.typical_px;
    return size;
}

FlatTriangle EffectPrediction::flat_triangle(const Sample& sample, double posts) const {
    return oro::flat_triangle(grid(sample), sample.point.lat_deg, sample.point.h_m, sample.slope, posts);
}

double EffectPrediction::left_out_N_m(std::size_t grid, double lat_deg, double lon_deg) const {
    return pages_[grid].facts().undulation.N_m.empty()
               ? ground_.surface(grid).field().undulation.at_m(lat_deg, lon_deg)
               : 0.0;
}

EffectSize EffectPrediction::without_geoid() const {
    Geodetic eye = camera_.eye;
    eye.h_m -= ground_.N_m(eye.lat_deg, eye.lon_deg);
    const auto drawn = [&](const Sample& sample) {
        Geodetic point = sample.point;
        point.h_m -= surface(sample).field().undulation.at_m(point.lat_deg, point.lon_deg);
        return sight_.refraction.apparent_m(model_offset_m(Earth::ellipsoid, eye, point));
    };
    return moved(drawn, unlike_the_truth);
}

Result<std::optional<EffectSize>> EffectPrediction::size(EffectKind kind, double tau_px) const {
    const std::pair key(kind, kind == EffectKind::detail ? tau_px : 0.0);
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    ORO_TRY(const std::optional<EffectSize> made, new_size(kind, tau_px));
    known_.emplace(key, made);
    return made;
}

EffectSize EffectPrediction::in_flat_cells() const {
    Sizes sizes;
    for (const Sample& sample : samples_) {
        if (sample.from_seen_px > in_gaps_px) continue;
        const FlatTriangle off = flat_triangle(sample, 1.0);
        sizes.add(std::hypot(off.up_m, off.sideways_m),
                  vertical_px(sample, off.up_m) + any_way_px(sample, off.sideways_m), sample.even);
    }
    return sizes.size(nearer);
}

Result<std::optional<EffectSize>> EffectPrediction::new_size(EffectKind kind, double tau_px) const {
    using Size = std::optional<EffectSize>;
    switch (kind) {
        case EffectKind::geoid:
            return Size(without_geoid());
        case EffectKind::sphere:
            return Size(moved_by(kind, {Earth::sphere, world_.air, Precision::relative}, 0.0));
        case EffectKind::flat:
            return Size(moved_by(kind, plane(world_), 0.0));
        case EffectKind::refraction:
            return Size(moved_by(kind, {Earth::ellipsoid, Air{}, Precision::relative}, 0.0));
        case EffectKind::float32_posts:
            return Size(in_float32(Precision::rounded_posts));
        case EffectKind::float32_view:
            return Size(in_float32(Precision::naive));
        case EffectKind::steps_i16:
            return Size(in_sixteen_bits());
        case EffectKind::detail: {
            ORO_TRY(const EffectSize size, detail(tau_px));
            return Size(size);
        }
        case EffectKind::steps_f32:
        case EffectKind::placement:
        case EffectKind::depth:
        case EffectKind::pixel_grid:
        case EffectKind::flat_cells:
            return known_bound(kind);
        case EffectKind::interpolation:
            return Size(interpolation_estimate(1));
        case EffectKind::source:
            return stated_by_source();
    }
    return Size(std::nullopt);
}

Result<EffectSize> EffectPrediction::total(const DrawingModel& drawing) const {
    EffectSize sum;
    for (const EffectFacts& effect : effect_table()) {
        if (effect.group == EffectGroup::data || !effect.in_picture(drawing, world_)) continue;
        ORO_TRY(const std::optional<EffectSize> one, size(effect.kind, drawing.tau_px));
        if (!one) continue;
        // On a plane there is no end to how far ground is moved, and levels let more of it come out.
        const EffectSize largest =
            effect.kind == EffectKind::flat ? moved_by(effect.kind, plane(world_), drawing.tau_px) : *one;
        sum.worst_m += largest.worst_m;
        sum.typical_m += one->typical_m;
        sum.worst_px += largest.worst_px;
        sum.typical_px += one->typical_px;
    }
    // With levels it is a part of what they leave out.
    if (!is_in_picture(EffectKind::detail, drawing, world_)) {
        const EffectSize gaps = gaps_closed(0.0);
        sum.worst_m += gaps.worst_m;
        sum.worst_px += gaps.worst_px;
    }
    return sum;
}

}  // namespace oro
