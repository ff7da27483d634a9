#include "core/ground.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace oro {
namespace {

// A ray against the surface.
class Ray {
  public:
    Ray(const HeightField& field, const GroundLayer& layer, const Ecef& eye, const glm::dvec3& direction,
        double exaggeration)
        : field_(field), layer_(layer), eye_(eye), direction_(direction), exaggeration_(exaggeration) {}

    std::optional<GroundHit> first_hit(double reach_m) const;

  private:
    // A place on the ray. above_m is the height above the ground, nothing where there is no data.
    struct Sample {
        double t_m;
        Geodetic point;
        std::optional<double> above_m;
        bool below() const { return above_m && *above_m < 0.0; }
    };
    Sample sample(double t_m) const;
    double stride_m(const Sample& here) const;
    bool leaves(const Sample& here) const;
    Sample last_like(Sample from, Sample to) const;
    std::optional<Sample> crossing(const Sample& from, const Sample& to) const;

    const HeightField& field_;
    const GroundLayer& layer_;
    Ecef eye_;
    glm::dvec3 direction_;
    double exaggeration_;
};

constexpr double refined_m = 1.0e-4;  // along the ray

Ray::Sample Ray::sample(double t_m) const {
    Sample here{t_m, geodetic_from_ecef(Ecef{eye_.m + t_m * direction_}), std::nullopt};
    const std::optional<double> ground_m =
        ground_h_m(field_, here.point.lat_deg, here.point.lon_deg, exaggeration_);
    if (ground_m) here.above_m = here.point.h_m - *ground_m;
    return here;
}

// Height changes by at most a metre a metre, so nothing can be met within the distance to the layer that
// holds the surface.
double Ray::stride_m(const Sample& here) const {
    const double metres_per_deg = std::numbers::pi / 180.0 * wgs84_b_m;
    const double row_m = field_.grid.lat.spacing_deg() * metres_per_deg;
    const double column_m =
        field_.grid.lon.spacing_deg() * metres_per_deg * std::cos(radians_from_deg(here.point.lat_deg).rad);
    // Cells turn into slivers towards the poles; narrower than an eighth of their height is not followed.
    const double half_post_m = 0.5 * std::min(row_m, std::max(column_m, row_m / 8.0));
    return std::max({half_post_m, here.point.h_m - layer_.highest_h_m, layer_.lowest_h_m - here.point.h_m});
}

// Above everything and climbing: the height along a line is convex, so it never comes down again.
bool Ray::leaves(const Sample& here) const {
    if (here.point.h_m <= layer_.highest_h_m) return false;
    return glm::dot(ecef_from_enu(here.point.lat_deg, here.point.lon_deg)[2], direction_) >= 0.0;
}

// Between a place with data and one without: the farthest place, seen from the first, that is like it.
Ray::Sample Ray::last_like(Sample from, Sample to) const {
    while (std::abs(to.t_m - from.t_m) > refined_m) {
        const Sample middle = sample(0.5 * (from.t_m + to.t_m));
        (middle.above_m.has_value() == from.above_m.has_value() ? from : to) = middle;
    }
    return from;
}

// Where the ray crosses the ground between two places a stride apart; only what lies over data counts.
std::optional<Ray::Sample> Ray::crossing(const Sample& from, const Sample& to) const {
    if (!from.above_m && !to.above_m) return std::nullopt;
    if (!from.above_m) return crossing(last_like(to, from), to);
    if (!to.above_m) return crossing(from, last_like(from, to));
    if (from.below() == to.below()) return std::nullopt;
    Sample near = from;
    Sample far = to;
    while (far.t_m - near.t_m > refined_m) {
        const double middle_m = 0.5 * (near.t_m + far.t_m);
        if (middle_m <= near.t_m || middle_m >= far.t_m) break;  // doubles end here
        const Sample middle = sample(middle_m);
        if (!middle.above_m) {
            const std::optional<Sample> before = crossing(near, middle);
            return before ? before : crossing(middle, far);
        }
        (middle.below() == near.below() ? near : far) = middle;
    }
    return far;
}

std::optional<GroundHit> Ray::first_hit(double reach_m) const {
    Sample here = sample(0.0);
    while (here.t_m < reach_m && !leaves(here)) {
        const Sample next = sample(std::min(reach_m, here.t_m + stride_m(here)));
        if (next.t_m <= here.t_m) break;
        if (const std::optional<Sample> hit = crossing(here, next)) return GroundHit{hit->point, hit->t_m};
        here = next;
    }
    return std::nullopt;
}

}  // namespace

std::optional<double> ground_h_m(const HeightField& field, double lat_deg, double lon_deg,
                                 double exaggeration) {
    const std::optional<double> H_m = field.surface_H_m(lat_deg, lon_deg);
    if (!H_m) return std::nullopt;
    return *H_m * exaggeration + field.undulation.at_m(lat_deg, lon_deg);
}

GroundLayer ground_layer(const HeightField& field, double exaggeration) {
    const HeightRange range = height_range(field);
    GroundLayer layer{range.lowest_m * exaggeration, range.highest_m * exaggeration};
    if (!field.undulation.N_m.empty()) {
        const auto [lowest, highest] =
            std::minmax_element(field.undulation.N_m.begin(), field.undulation.N_m.end());
        layer.lowest_h_m += static_cast<double>(*lowest);
        layer.highest_h_m += static_cast<double>(*highest);
    }
    // A millimetre for the rounding of what lies between the posts.
    layer.lowest_h_m -= 1.0e-3;
    layer.highest_h_m += 1.0e-3;
    return layer;
}

std::optional<GroundHit> first_ground_hit(const HeightField& field, const GroundLayer& layer, const Ecef& eye,
                                          const glm::dvec3& direction, double reach_m, double exaggeration) {
    return Ray(field, layer, eye, direction, exaggeration).first_hit(reach_m);
}

std::optional<GroundHit> first_ground_hit(const HeightField& field, const Ecef& eye,
                                          const glm::dvec3& direction, double reach_m, double exaggeration) {
    return first_ground_hit(field, ground_layer(field, exaggeration), eye, direction, reach_m, exaggeration);
}

}  // namespace oro
