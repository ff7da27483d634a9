#include "core/measure/ground_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numeric>
#include <utility>

#include "core/base/parallel.h"
#include "core/measure/mesh_error.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/post_spacing.h"

namespace oro {
namespace {

double lat_on_axis_deg(const PostGrid& grid, double row) {
    const double whole = std::floor(row);
    return std::clamp(
        grid.lat.at_deg(static_cast<std::int64_t>(whole)) - (row - whole) * grid.lat.spacing_deg(), -90.0,
        90.0);
}

double lon_on_axis_deg(const PostGrid& grid, double column) {
    const double whole = std::floor(column);
    return grid.lon.at_deg(static_cast<std::int64_t>(whole)) + (column - whole) * grid.lon.spacing_deg();
}

// As PostGrid::place_at, with less rounding in large grids.
PostPlace place_at(const PostGrid& grid, double row, double column) {
    if (grid.net) return grid.net->place_at(row, column);
    return {lat_on_axis_deg(grid, row), lon_on_axis_deg(grid, column)};
}

}  // namespace

GroundMeter::GroundMeter(const TrueGround& ground, const Sight& sight, const Camera& camera)
    : ground_(ground),
      sight_(sight),
      view_from_ecef_(camera.view_from_ecef()),
      tangent_(camera.half_fov_tangent()),
      size_px_(camera.width_px, camera.height_px),
      pixels_per_tangent_(0.5 * camera.height_px / tangent_.y) {}

glm::dvec3 GroundMeter::ray_view(const glm::dvec2& point_px) const {
    return {(2.0 * point_px / size_px_ - 1.0) * tangent_ * glm::dvec2(1.0, -1.0), -1.0};
}

glm::dvec3 GroundMeter::offset_m(const glm::dvec2& point_px, double z_m) const {
    return z_m * (ray_view(point_px) * view_from_ecef_);
}

namespace {

// Heights that a grid has at a place or beside it, where the place is rounded off its rim: all of them.
void add_heights(const TrueSurface& surface, const Geodetic& place, std::vector<double>& heights_m) {
    constexpr double offset_posts = 0.02;
    const PostNumber post = surface.field().grid.post_at(place.lat_deg, place.lon_deg);
    for (const double down : {0.0, offset_posts, -offset_posts}) {
        for (const double right : {0.0, offset_posts, -offset_posts})
            if (const auto h_m = surface.h_at_m(post.row + down, post.column + right))
                heights_m.push_back(*h_m);
    }
}

}  // namespace

std::optional<glm::dvec3> GroundMeter::seen_between_m(const glm::dvec2& point_px,
                                                      const DrawnPoint& point) const {
    Geodetic drawn =
        geodetic_from_ecef({sight_.eye.m + sight_.refraction.true_m(offset_m(point_px, point.z_m))});
    std::vector<double> heights_m;
    for (std::size_t grid = 0; grid < ground_.grids(); ++grid)
        add_heights(ground_.surface(grid), drawn, heights_m);
    if (heights_m.empty()) return std::nullopt;
    const auto [lowest, highest] = std::minmax_element(heights_m.begin(), heights_m.end());
    drawn.h_m = std::clamp(drawn.h_m, *lowest, *highest);
    return sight_.refraction.apparent_m(ecef_from_geodetic(drawn).m - sight_.eye.m);
}

std::optional<glm::dvec3> GroundMeter::seen_m(const glm::dvec2& point_px, const DrawnPoint& point) const {
    if (is_between(point)) return seen_between_m(point_px, point);
    const TrueSurface& surface = ground_.surface(point.grid);
    const std::optional<double> h_m = surface.h_at_m(point.row, point.column);
    if (!h_m) return std::nullopt;
    const PostPlace at = place_at(surface.field().grid, point.row, point.column);
    const Ecef place = ecef_from_geodetic({at.lat_deg, at.lon_deg, *h_m});
    return sight_.refraction.apparent_m(place.m - sight_.eye.m);
}

std::optional<glm::dvec2> GroundMeter::place_px(const glm::dvec3& seen_m) const {
    const glm::dvec3 seen = view_from_ecef_ * seen_m;
    if (seen.z >= 0.0) return std::nullopt;
    const glm::dvec2 share = glm::dvec2(seen.x, -seen.y) / -seen.z / tangent_;
    return 0.5 * (share + 1.0) * size_px_;
}

double GroundMeter::diagonal_px() const {
    return glm::length(size_px_);
}

double GroundMeter::apart_px(const glm::dvec3& drawn_m, const glm::dvec3& seen_m) const {
    return std::min(apart(drawn_m, seen_m).px, diagonal_px());
}

GroundMeter::Apart GroundMeter::apart(const glm::dvec3& drawn_m, const glm::dvec3& seen_m) const {
    const glm::dvec3 drawn = view_from_ecef_ * drawn_m, seen = view_from_ecef_ * seen_m;
    if (seen.z < 0.0) {
        const double tangent = glm::length(glm::dvec2(seen) / seen.z - glm::dvec2(drawn) / drawn.z);
        return {tangent * pixels_per_tangent_, false};
    }
    const double tangent = glm::length(seen - drawn) / -drawn.z;
    return {std::min(tangent * pixels_per_tangent_, diagonal_px()), true};
}

// Goes from the foot straight below the point to the foot of the perpendicular on the triangle there, and so
// on: each is a point of the surface, so the nearest of them is near enough.
Distance GroundMeter::from_ground(const glm::dvec3& place_m, const glm::dvec3& seen_m, std::size_t otherwise,
                                  const Distance& so_far) const {
    const Geodetic place = geodetic_from_ecef({place_m});
    const TrueSurface& surface = ground_.surface(ground_.grid_at(place.lat_deg, place.lon_deg, otherwise));
    const PostGrid& grid = surface.field().grid;
    auto [row, column] = grid.post_at(place.lat_deg, place.lon_deg);
    Distance nearest = so_far;
    constexpr int steps = 4;
    constexpr double close_enough_m = 1.0e-4;
    constexpr double even = 0.05;  // the foot is as good as found: nearer by 0.2 % at most
    for (int step = 0; step < steps; ++step) {
        const std::optional<double> h_m = surface.h_at_m(row, column);
        if (!h_m) break;
        const PostPlace at = place_at(grid, row, column);
        const Geodetic foot{at.lat_deg, at.lon_deg, *h_m};
        const glm::dvec3 foot_ecef = ecef_from_geodetic(foot).m;
        nearest.m = std::min(nearest.m, glm::length(place_m - foot_ecef));
        const Apart away = apart(seen_m, sight_.refraction.apparent_m(foot_ecef - sight_.eye.m));
        if (!away.at_least && (nearest.px_at_least || away.px < nearest.px)) {
            nearest.px = away.px;
            nearest.px_at_least = false;
        }
        const auto slope = surface.slope_at(row, column);
        if (!slope || nearest.m < close_enough_m) break;
        const glm::dvec3 up =
            glm::transpose(ecef_from_enu(foot.lat_deg, foot.lon_deg)) * (place_m - foot_ecef);
        const glm::dvec3 normal = glm::normalize(glm::dvec3(-slope->east, -slope->north, 1.0));
        const glm::dvec3 along = up - glm::dot(up, normal) * normal;
        if (glm::length(along) < even * glm::length(up)) break;
        const PostNumber on = posts_along(grid, {row, column}, foot.lat_deg, along.x, along.y);
        row += on.row;
        column += on.column;
    }
    return nearest;
}

Distance GroundMeter::from_surface(const glm::dvec2& point_px, const DrawnPoint& point,
                                   const Distance& displacement) const {
    const glm::dvec3 drawn_m = offset_m(point_px, point.z_m);
    // Over no ground of any: over where the point's own grid ends.
    return from_ground(sight_.eye.m + sight_.refraction.true_m(drawn_m), drawn_m, point.grid, displacement);
}

std::optional<Distance> GroundMeter::displacement(const glm::dvec2& point_px, const DrawnPoint& point) const {
    assert(!point.background());
    const std::optional<glm::dvec3> seen = seen_m(point_px, point);
    if (!seen) return std::nullopt;
    const glm::dvec3 drawn = offset_m(point_px, point.z_m);
    const Apart on_picture = apart(drawn, *seen);
    return Distance{glm::length(sight_.refraction.true_m(drawn) - sight_.refraction.true_m(*seen)),
                    on_picture.px, on_picture.at_least};
}

namespace {

// What is measured of a pixel that shows ground.
struct PixelErrors {
    std::optional<Distance> displacement, surface;
    std::optional<Distance> mesh_drawn, mesh_missed;
    bool is_between{};
};

// Measures the pixels of a picture, one by one.
class PixelMeter {
  public:
    PixelMeter(const TrueGround& ground, const Sight& sight, const Camera& camera, GroundMeasures measures,
               const MeshesMeasured& meshes)
        : meter_(ground, sight, camera),
          measures_(measures),
          seen_(meshes.drawn.empty() ? meshes.seen.first(0) : meshes.seen) {
        if (!ground.meshes().empty()) of_meshes_.emplace(ground, sight, meter_, meshes.drawn);
    }
    PixelMeter(const PixelMeter&) = delete;
    PixelMeter& operator=(const PixelMeter&) = delete;

    [[nodiscard]] bool has_meshes() const { return of_meshes_.has_value(); }

    [[nodiscard]] PixelErrors at(std::size_t pixel, const glm::dvec2& centre_px,
                                 const DrawnPoint& point) const {
        PixelErrors errors;
        errors.is_between = meter_.is_between(point);
        if (errors.is_between && of_meshes_) {
            errors.mesh_drawn = of_meshes_->from_true(centre_px, point);
            errors.displacement = errors.surface = errors.mesh_drawn;
        } else {
            errors.displacement = meter_.displacement(centre_px, point);
            if (errors.displacement && measures_ == GroundMeasures::both && !errors.is_between)
                errors.surface = meter_.from_surface(centre_px, point, *errors.displacement);
        }
        if (of_meshes_ && pixel < seen_.size() && seen_[pixel] && seen_[pixel]->mesh > 0) {
            errors.mesh_missed = of_meshes_->from_drawn(seen_[pixel]->point);
            if (errors.displacement && errors.displacement->px < errors.mesh_missed->px)
                errors.displacement = errors.mesh_missed;
        }
        return errors;
    }

  private:
    GroundMeter meter_;
    GroundMeasures measures_;
    std::span<const std::optional<SightHit>> seen_;
    std::optional<MeshMeter> of_meshes_;
};

// A measure of all pixels, in metres and in pixels.
struct Measured {
    explicit Measured(std::size_t pixels)
        : m(pixels, not_measured), px(pixels, not_measured), at_least(pixels, 0) {}
    void put(std::size_t pixel, const std::optional<Distance>& distance) {
        if (!distance) return;
        m[pixel] = static_cast<float>(distance->m);
        px[pixel] = static_cast<float>(distance->px);
        at_least[pixel] = distance->px_at_least ? 1 : 0;
    }
    std::vector<float> m, px;
    std::vector<std::uint8_t> at_least;
};

GroundErrors measured_errors(const PixelMeter& meter, const Camera& camera,
                             std::span<const DrawnPoint> points, int threads) {
    const std::size_t width = static_cast<std::size_t>(camera.width_px);
    const std::size_t height = static_cast<std::size_t>(camera.height_px), pixels = width * height;
    assert(points.size() == pixels);
    Measured displacement(pixels), surface(pixels), drawn(meter.has_meshes() ? pixels : 0),
        missed(meter.has_meshes() ? pixels : 0);
    std::vector<std::uint64_t> drawn_in_row(height), beyond_in_row(height), between_in_row(height);
    in_parallel(camera.height_px, threads, [&](int row) {
        const std::size_t r = static_cast<std::size_t>(row);
        for (std::size_t column = 0; column < width; ++column) {
            const std::size_t pixel = r * width + column;
            if (points[pixel].background()) continue;
            const PixelErrors errors =
                meter.at(pixel, {static_cast<double>(column) + 0.5, row + 0.5}, points[pixel]);
            ++drawn_in_row[r];
            between_in_row[r] += errors.is_between ? 1 : 0;
            beyond_in_row[r] += errors.displacement ? 0 : 1;
            displacement.put(pixel, errors.displacement);
            surface.put(pixel, errors.surface);
            drawn.put(pixel, errors.mesh_drawn);
            missed.put(pixel, errors.mesh_missed);
        }
    });
    const auto sum = [](const std::vector<std::uint64_t>& counts) {
        return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    };
    GroundErrors errors;
    errors.drawn = sum(drawn_in_row), errors.beyond_data = sum(beyond_in_row),
    errors.between = sum(between_in_row);
    errors.summary_displacement_m = summary_of(displacement.m);
    errors.summary_displacement_px = summary_of(displacement.px, displacement.at_least);
    errors.summary_surface_m = summary_of(surface.m);
    errors.summary_surface_px = summary_of(surface.px, surface.at_least);
    if (meter.has_meshes())
        errors.meshes = MeshErrors{summary_of(drawn.m), summary_of(drawn.px, drawn.at_least),
                                   summary_of(missed.m), summary_of(missed.px, missed.at_least)};
    errors.displacement_m = std::move(displacement.m), errors.displacement_px = std::move(displacement.px);
    errors.surface_m = std::move(surface.m), errors.surface_px = std::move(surface.px);
    errors.displacement_at_least = std::move(displacement.at_least);
    errors.surface_at_least = std::move(surface.at_least);
    return errors;
}

}  // namespace

GroundErrors ground_errors(const TrueGround& ground, const Sight& sight, const Camera& camera,
                           std::span<const DrawnPoint> points, int threads, GroundMeasures measures) {
    return measured_errors(PixelMeter(ground, sight, camera, measures, {}), camera, points, threads);
}

GroundErrors ground_errors(const TrueGround& ground, const Sight& sight, const Camera& camera,
                           std::span<const DrawnPoint> points, int threads, const MeshesMeasured& meshes) {
    return measured_errors(PixelMeter(ground, sight, camera, GroundMeasures::both, meshes), camera, points,
                           threads);
}

}  // namespace oro
