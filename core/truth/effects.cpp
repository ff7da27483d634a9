#include "core/truth/effects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/base/median.h"
#include "core/base/parallel.h"
#include "core/frame/placement_promise.h"
#include "core/lod/sampled_detail.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

constexpr int samples_across = 160;
// What lies between the samples: bounds that come from samples of rough ground are widened by this.
constexpr double between_samples = 2.5;
// Half a unit in the last place of a float, relative.
constexpr double float_rounding = 1.0 / 16777216.0;

EffectSize larger(const EffectSize& a, const EffectSize& b) {
    return {std::max(a.worst_m, b.worst_m), std::max(a.typical_m, b.typical_m),
            std::max(a.worst_px, b.worst_px), std::max(a.typical_px, b.typical_px)};
}

// Collects one effect's sizes at the samples.
class Sizes {
  public:
    void add(double height_m, double px) {
        height_m_.push_back(height_m);
        px_.push_back(px);
    }
    // The bound is the largest times `margin`. Uses the values up.
    EffectSize size(double margin) {
        if (px_.empty()) return {};
        const double worst_m = *std::max_element(height_m_.begin(), height_m_.end());
        const double worst_px = *std::max_element(px_.begin(), px_.end());
        return {margin * worst_m, median_of(std::move(height_m_)), margin * worst_px,
                median_of(std::move(px_))};
    }

  private:
    std::vector<double> height_m_;
    std::vector<double> px_;
};

}  // namespace

EffectPrediction::EffectPrediction(const TrueSurface& surface, const RegionPages& pages, const Camera& camera,
                                   const TrueWorld& world, int threads)
    : surface_(surface),
      pages_(pages),
      camera_(camera),
      world_(world),
      threads_(threads),
      sight_(sight_from(camera.eye, world.refraction_k)),
      view_from_ecef_(camera.view_from_ecef()),
      pixels_per_tangent_(0.5 * camera.height_px / camera.half_fov_tangent().y),
      samples_(cast(sight_.refraction, threads)) {}

// Sight lines through the middles of pixels all over the picture, those of its rim included.
std::vector<EffectPrediction::Sample> EffectPrediction::cast(const Refraction& refraction,
                                                             int threads) const {
    const Oracle oracle(surface_, {sight_.eye, refraction});
    const double reach_m = sight_reach_m(camera_.eye.h_m);
    const int across = std::clamp(camera_.width_px, 1, samples_across);
    const int down = std::clamp(samples_across * camera_.height_px / std::max(1, camera_.width_px), 1,
                                std::min(camera_.height_px, 4 * samples_across));
    const auto pixel = [](int i, int count, int size) {
        return 0.5 +
               (count > 1 ? std::round(static_cast<double>(i) * (size - 1) / (count - 1)) : 0.5 * (size - 1));
    };
    std::vector<std::vector<Sample>> rows(static_cast<std::size_t>(down));
    const PostGrid& grid = surface_.field().grid;
    in_parallel(down, threads, [&](int i) {
        for (int j = 0; j < across; ++j) {
            const glm::dvec3 direction = camera_.ecef_direction_at(
                {pixel(j, across, camera_.width_px), pixel(i, down, camera_.height_px)});
            const auto hit = oracle.first_hit(direction, reach_m);
            if (!hit) continue;
            const auto h_m = [&](int row, int column) {
                return surface_.post_h_m(row, column).value_or(hit->point.h_m);
            };
            const double corner_m = h_m(hit->south_west ? hit->row + 1 : hit->row,
                                        hit->south_west ? hit->column : hit->column + 1);
            const double north_west_m = h_m(hit->row, hit->column),
                         south_east_m = h_m(hit->row + 1, hit->column + 1);
            const double row_m =
                meridian_radius_m(hit->point.lat_deg) * radians_from_deg(grid.lat.spacing_deg()).rad;
            const double column_m = std::max(1.0e-3, prime_vertical_radius_m(hit->point.lat_deg) *
                                                         sine_cosine_deg(hit->point.lat_deg).cosine *
                                                         radians_from_deg(grid.lon.spacing_deg()).rad);
            const double down_m = hit->south_west ? corner_m - north_west_m : south_east_m - corner_m;
            const double right_m = hit->south_west ? south_east_m - corner_m : corner_m - north_west_m;
            rows[static_cast<std::size_t>(i)].push_back(
                {hit->point, hit->distance_m * direction, hit->distance_m,
                 std::hypot(down_m / row_m, right_m / column_m), hit->row, hit->column, hit->south_west});
        }
    });
    std::vector<Sample> samples;
    for (const std::vector<Sample>& row : rows) samples.insert(samples.end(), row.begin(), row.end());
    return samples;
}

double EffectPrediction::nearest_m() const {
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const Sample& sample : samples_) nearest_m = std::min(nearest_m, sample.distance_m);
    return nearest_m;
}

double EffectPrediction::median_distance_m() const {
    std::vector<double> distances;
    for (const Sample& sample : samples_) distances.push_back(sample.distance_m);
    return median_of(std::move(distances));
}

// Points that are drawn elsewhere: how far over the surface they then are.
EffectSize EffectPrediction::displaced(const std::vector<Sample>& samples, const Displacement& drawn) const {
    const PointMeter meter(surface_, sight_, camera_);
    Sizes sizes;
    for (const Sample& sample : samples) {
        const std::optional<glm::dvec3> at = drawn(sample);
        if (!at || (view_from_ecef_ * *at).z >= -near_plane_m) continue;
        if (const auto error = meter.at(*at)) sizes.add(std::abs(error->height_m), error->px);
    }
    return sizes.size(between_samples);
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

// Heights that are off by no more than a bound. Ground between the samples may be somewhat nearer.
EffectSize EffectPrediction::bounded(const Bound& height_m) const {
    constexpr double nearer = 1.3;
    Sizes sizes;
    for (const Sample& sample : samples_) {
        const double height = height_m(sample);
        sizes.add(height, vertical_px(sample, height));
    }
    return sizes.size(nearer);
}

EffectSize EffectPrediction::on_flat_earth() const {
    // Without curvature more can be seen: as if light followed the ground.
    const double radius_m =
        std::sqrt(prime_vertical_radius_m(camera_.eye.lat_deg) * meridian_radius_m(camera_.eye.lat_deg));
    const Refraction along_ground =
        Refraction::with_curvature(camera_.eye, sight_.refraction.curvature_per_m() + 1.0 / radius_m);
    const WorldModel flat{Earth::flat, world_.refraction_k, Precision::relative};
    EffectSize size = displaced(cast(along_ground, threads_), [&](const Sample& sample) {
        return model_offset_m(flat, camera_.eye, sample.point);
    });
    // Through gaps between hills comes ground from far away, where the error is largest: samples miss more
    // than elsewhere.
    constexpr double through_gaps = 1.6;
    size.worst_m *= through_gaps;
    size.worst_px *= through_gaps;
    return size;
}

double EffectPrediction::left_out_N_m(double lat_deg, double lon_deg) const {
    return pages_.facts().undulation.N_m.empty() ? surface_.field().undulation.at_m(lat_deg, lon_deg) : 0.0;
}

EffectSize EffectPrediction::without_geoid() const {
    const UndulationField& undulation = surface_.field().undulation;
    Geodetic eye = camera_.eye;
    eye.h_m -= undulation.at_m(eye.lat_deg, eye.lon_deg);
    return displaced(samples_, [&](const Sample& sample) {
        Geodetic point = sample.point;
        point.h_m -= undulation.at_m(point.lat_deg, point.lon_deg);
        return sight_.refraction.apparent_m(model_offset_m(Earth::ellipsoid, eye, point));
    });
}

// From the posts around what is seen: how far each second one lies from the middle of its neighbours is how
// far the ground may lie from the middle of posts twice as dense; half of that typically.
EffectSize EffectPrediction::interpolation(int apart) const {
    Sizes sizes;
    for (const Sample& sample : samples_) {
        double bend_m = 0.0;
        for (const auto& [down, right] : {std::pair(apart, 0), std::pair(0, apart)}) {
            const PostGrid& grid = surface_.field().grid;
            if (sample.row < down || sample.column < right || sample.row + down >= grid.rows() ||
                sample.column + right >= grid.columns())
                continue;
            const auto before = surface_.post_h_m(sample.row - down, sample.column - right);
            const auto here = surface_.post_h_m(sample.row, sample.column);
            const auto after = surface_.post_h_m(sample.row + down, sample.column + right);
            if (!before || !here || !after) continue;
            bend_m = std::max(bend_m, std::abs(*here - 0.5 * (*before + *after)));
        }
        sizes.add(bend_m, vertical_px(sample, bend_m));
    }
    EffectSize size = sizes.size(1.0);
    size.typical_m *= 0.5;
    size.typical_px *= 0.5;
    return size;
}

Result<EffectSize> EffectPrediction::detail(double tau_px) const {
    Camera drawn = camera_;
    drawn.eye.h_m -= left_out_N_m(drawn.eye.lat_deg, drawn.eye.lon_deg);
    SampledDetail detail(pages_, drawn, tau_px);
    Sizes sizes;
    for (const Sample& sample : samples_) {
        ORO_TRY(const SampledDetail::Bound bound, detail.at(sample.row, sample.column));
        sizes.add(bound.error_m, bound.error_px);
    }
    constexpr double between_nodes = 1.5;
    EffectSize size = sizes.size(between_nodes);
    size.worst_px = std::min(size.worst_px, tau_px);
    return size;
}

Result<std::optional<EffectSize>> EffectPrediction::size(EffectKind kind, double tau_px) const {
    const std::pair key(kind, kind == EffectKind::detail ? tau_px : 0.0);
    if (const auto found = known_.find(key); found != known_.end()) return found->second;
    ORO_TRY(const std::optional<EffectSize> made, new_size(kind, tau_px));
    known_.emplace(key, made);
    return made;
}

EffectSize EffectPrediction::as_sphere() const {
    const WorldModel sphere{Earth::sphere, world_.refraction_k, Precision::relative};
    return displaced(samples_,
                     [&](const Sample& sample) { return model_offset_m(sphere, camera_.eye, sample.point); });
}

EffectSize EffectPrediction::in_straight_light() const {
    return displaced(samples_,
                     [&](const Sample& sample) { return sight_.refraction.true_m(sample.apparent_m); });
}

EffectSize EffectPrediction::in_flat_cells() const {
    const PostGrid& grid = surface_.field().grid;
    return bounded([&](const Sample& sample) {
        const double tall = radians_from_deg(grid.lat.spacing_deg()).rad;
        const double wide =
            radians_from_deg(grid.lon.spacing_deg()).rad * sine_cosine_deg(sample.point.lat_deg).cosine;
        return (tall * tall + wide * wide) / 8.0 * (wgs84_a_m + std::max(0.0, sample.point.h_m));
    });
}

std::optional<EffectSize> EffectPrediction::stated_by_source() const {
    if (!world_.source_le90_m) return std::nullopt;
    // Of a normal distribution: half of all errors are within 0.41 of what holds 90 %.
    constexpr double half_of_all = 0.41;
    const double le90_m = *world_.source_le90_m;
    EffectSize size = bounded([&](const Sample&) { return le90_m; });
    size.typical_m = half_of_all * le90_m;
    size.typical_px *= half_of_all;
    size.worst_m = le90_m;
    return size;
}

// What drawing rounds off, by no more than is known beforehand; nothing for other effects.
std::optional<EffectSize> EffectPrediction::known_bound(EffectKind kind) const {
    const auto of_distance = [&](double share) {
        return bounded([share](const Sample& sample) {
            return share * sample.distance_m * std::hypot(1.0, sample.slope);
        });
    };
    switch (kind) {
        case EffectKind::steps_f32:
            return bounded([](const Sample&) { return 0.5 * height_step_m; });
        case EffectKind::placement:
            return of_distance(placement_far_share);
        // A depth is rounded twice, and the triangle's plane that it comes from.
        case EffectKind::depth:
            return of_distance(4.0 * float_rounding);
        // Two corners of a triangle may move apart by a step along each axis.
        case EffectKind::pixel_grid:
            return of_distance(std::sqrt(2.0) / 256.0 / pixels_per_tangent_);
        case EffectKind::flat_cells:
            return in_flat_cells();
        default:
            return std::nullopt;
    }
}

Result<std::optional<EffectSize>> EffectPrediction::new_size(EffectKind kind, double tau_px) const {
    using Size = std::optional<EffectSize>;
    switch (kind) {
        case EffectKind::geoid:
            return Size(without_geoid());
        case EffectKind::sphere:
            return Size(as_sphere());
        case EffectKind::flat:
            return Size(on_flat_earth());
        case EffectKind::refraction:
            return Size(in_straight_light());
        case EffectKind::float32_posts:
            return Size(in_float32(Precision::rounded_posts, false));
        case EffectKind::float32_view:
            return Size(larger(in_float32(Precision::naive, false), in_float32(Precision::naive, true)));
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
            return Size(interpolation(1));
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
        sum.worst_m += one->worst_m;
        sum.typical_m += one->typical_m;
        sum.worst_px += one->worst_px;
        sum.typical_px += one->typical_px;
    }
    return sum;
}

}  // namespace oro
