#include "tests/core/growth/forest_reference.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

#include "core/growth/tree_sites.h"
#include "shaders/shared_growth.h"

namespace oro::gpu {
namespace {
namespace forest_rule {
#define ORO_FUNCTION [[maybe_unused]]
#undef OROGRAPH_SHADERS_GROWTH_TREE_RULE
#undef OROGRAPH_SHADERS_GROWTH_REACH
#include "shaders/growth/reach.glsl"
#include "shaders/growth/tree_rule.glsl"
#undef ORO_FUNCTION
}  // namespace forest_rule
}  // namespace
}  // namespace oro::gpu

namespace oro::test {
namespace {

constexpr double relief = 1.2, most_sun = 1.5;  // as the style `natural`, and shaders/shared_growth.h
constexpr double needle_lighter = 3.3, broad_lighter = 1.25;  // as shade_growth.comp
constexpr double floor_light = 0.65;                          // of ground below trees, as materials.glsl
constexpr auto grows_in = static_cast<double>(gpu::forest_rule::trees_grow_in);
constexpr std::uint32_t middle_site = 30'000'000;

struct Stem {
    glm::dvec3 foot;
    glm::dmat3 axes;  // columns: east, north, along the stem
    double low_m{}, high_m{}, radius_m{}, colour{};
};

struct Met {
    double way{std::numeric_limits<double>::infinity()};
    glm::dvec3 at{}, normal{};  // of the tree's frame
};

Met meets_cone(const Stem& stem, const glm::dvec3& p, const glm::dvec3& d) {
    const double radius_m = 0.9 * stem.radius_m, k = radius_m / (stem.high_m - stem.low_m), kk = k * k,
                 down = stem.high_m - p.z;
    Met met;
    const double a = d.x * d.x + d.y * d.y - kk * d.z * d.z, b = p.x * d.x + p.y * d.y + kk * down * d.z,
                 c = p.x * p.x + p.y * p.y - kk * down * down;
    const double square = b * b - a * c;
    if (square > 0.0 && std::abs(a) > 1e-12) {
        for (const double root : {-std::sqrt(square), std::sqrt(square)}) {
            const double way = (-b + root) / a, z = p.z + way * d.z;
            if (z < stem.low_m || z > stem.high_m || way >= met.way) continue;
            met.way = way;
        }
    }
    if (d.z > 0.0) {
        const double way = (stem.low_m - p.z) / d.z;
        const glm::dvec3 at = p + way * d;
        if (at.x * at.x + at.y * at.y <= radius_m * radius_m) met.way = std::min(met.way, way);
    }
    if (!std::isfinite(met.way)) return met;
    met.at = p + met.way * d;
    const double out_m = std::max(std::hypot(met.at.x, met.at.y), 1e-6);
    met.normal = glm::normalize(glm::dvec3(met.at.x / out_m, met.at.y / out_m, k));
    return met;
}

Met meets_ellipsoid(const Stem& stem, const glm::dvec3& p, const glm::dvec3& d) {
    const glm::dvec3 scale = 1.0 / glm::dvec3(stem.radius_m, stem.radius_m, 0.5 * (stem.high_m - stem.low_m)),
                     from = (p - glm::dvec3(0.0, 0.0, 0.5 * (stem.low_m + stem.high_m))) * scale,
                     along = d * scale;
    const double a = glm::dot(along, along), b = glm::dot(from, along), c = glm::dot(from, from) - 1.0,
                 square = b * b - a * c;
    Met met;
    if (square <= 0.0) return met;
    met.way = (-b - std::sqrt(square)) / a;
    met.at = p + met.way * d;
    met.normal = glm::normalize((from + met.way * along) * scale);
    return met;
}

class ForestRaster {
  public:
    explicit ForestRaster(const ForestView& view)
        : view_(view),
          side_(view.side_px * view.samples_a_side),
          eye_(view.distance_m * view.to_eye),
          east_(glm::normalize(glm::cross(-view.to_eye, glm::dvec3(0.0, 0.0, 1.0)))),
          up_(glm::cross(east_, -view.to_eye)),
          met_(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_)),
          of_stem_(met_.size(), -1) {}

    ForestPicture draw() {
        stand();
        for (std::size_t i = 0; i < stems_.size(); ++i) draw_stem(static_cast<int>(i));
        return seen();
    }

  private:
    // In samples from the window's corner; z: metres before the eye.
    [[nodiscard]] glm::dvec3 sample_of(const glm::dvec3& place) const {
        const glm::dvec3 from_eye = place - eye_;
        const double depth_m = glm::dot(from_eye, -view_.to_eye),
                     scale = view_.pixels_per_tangent * view_.samples_a_side / depth_m;
        return {0.5 * side_ + scale * glm::dot(from_eye, east_),
                0.5 * side_ - scale * glm::dot(from_eye, up_), depth_m};
    }
    [[nodiscard]] glm::dvec3 ray_of(int x, int y) const {
        const double scale = 1.0 / (view_.pixels_per_tangent * view_.samples_a_side);
        return -view_.to_eye + (x + 0.5 - 0.5 * side_) * scale * east_ -
               (y + 0.5 - 0.5 * side_) * scale * up_;
    }
    // Of the plane below a place.
    [[nodiscard]] double ground_m(double east_m, double north_m) const {
        return -(view_.ground.x * east_m + view_.ground.y * north_m) / view_.ground.z;
    }

    // The trees that the window may show: around the ground in it, and so far before it as the tallest hide.
    void stand() {
        const double half_m = 0.5 * view_.side_px * view_.distance_m / view_.pixels_per_tangent;
        const double facing = std::max(glm::dot(view_.to_eye, view_.ground), 0.03);
        const double reach_m = std::min(1.5 * half_m / facing + 45.0 / facing, 0.7 * view_.distance_m) + 40.0,
                     spacing_m = site_spacing_m();
        const auto sites = static_cast<int>(reach_m / spacing_m);
        for (int row = -sites; row <= sites; ++row)
            for (int column = -sites; column <= sites; ++column) try_site(row, column);
    }
    void try_site(int row, int column) {
        namespace rule = gpu::forest_rule;
        const std::uint32_t hash = rule::site_hash(middle_site + static_cast<std::uint32_t>(row),
                                                   middle_site + static_cast<std::uint32_t>(column));
        // As grow_sites.comp: where trees are left out the next of them are small already.
        const double rank = static_cast<double>(rule::site_rank(hash)),
                     over = view_.kept * (static_cast<double>(rule::stocked_sites) + grows_in) - rank;
        const double grown = std::clamp(over / grows_in, 0.0, 1.0),
                     size = grown * grown * (3.0 - 2.0 * grown);
        if (rank >= static_cast<double>(rule::stocked_sites) || size < 20.0 / 255.0) return;
        const double spacing_m = site_spacing_m();
        const auto place = rule::site_place(hash);
        const glm::dvec2 at =
            spacing_m * (glm::dvec2(column, row) +
                         glm::dvec2(static_cast<double>(place.x), static_cast<double>(place.y)));
        const auto tree = rule::tree_of_site(hash, view_.is_needle ? gpu::site_needle : gpu::site_broad,
                                             static_cast<float>(size));
        Stem stem;
        stem.foot = {at.x, at.y, ground_m(at.x, at.y)};
        const glm::dvec3 middle = sample_of(stem.foot + glm::dvec3(0.0, 0.0, 12.0));
        const double slack = 34.0 * view_.pixels_per_tangent * view_.samples_a_side / std::max(middle.z, 1.0);
        if (middle.z < 40.0 || middle.x < -slack || middle.x > side_ + slack || middle.y < -slack ||
            middle.y > side_ + slack)
            return;
        const glm::dvec3 along = glm::normalize(glm::dvec3(static_cast<double>(tree.lean.x),
                                                           static_cast<double>(tree.lean.y), 1.0)),
                         east = glm::normalize(glm::dvec3(1.0, 0.0, 0.0) - along.x * along);
        stem.axes = glm::dmat3(east, glm::cross(along, east), along);
        stem.low_m = static_cast<double>(tree.crown_m);
        stem.high_m = static_cast<double>(tree.height_m);
        stem.radius_m = static_cast<double>(tree.radius_m);
        stem.colour = static_cast<double>(tree.colour);
        stems_.push_back(stem);
    }

    void draw_stem(int number) {
        const Stem& stem = stems_[static_cast<std::size_t>(number)];
        const glm::dvec3 foot = sample_of(stem.foot), top = sample_of(stem.foot + stem.high_m * stem.axes[2]);
        const double reach = 1.05 * stem.radius_m * view_.pixels_per_tangent * view_.samples_a_side /
                                 (std::min(foot.z, top.z) - stem.radius_m) +
                             1.0;
        const auto first = [&](double one, double other) {
            return std::max(0, static_cast<int>(std::min(one, other) - reach));
        };
        const auto last = [&](double one, double other) {
            return std::min(side_ - 1, static_cast<int>(std::max(one, other) + reach));
        };
        const glm::dvec3 p = (eye_ - stem.foot) * stem.axes;
        for (int y = first(foot.y, top.y); y <= last(foot.y, top.y); ++y) {
            for (int x = first(foot.x, top.x); x <= last(foot.x, top.x); ++x) {
                const glm::dvec3 d = ray_of(x, y) * stem.axes;
                const Met met = view_.is_needle ? meets_cone(stem, p, d) : meets_ellipsoid(stem, p, d);
                const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                                static_cast<std::size_t>(x);
                if (met.way <= 0.0 || met.way >= met_[at].way) continue;
                met_[at] = met;
                of_stem_[at] = number;
            }
        }
    }

    // Of the sun's light on level ground and of the sky's; as light_of_crown() in green, among other trees.
    void light_of(const Stem& stem, const Met& met, const glm::dvec3& to_eye, double& lit,
                  double& open) const {
        const double albedo = (view_.is_needle ? needle_lighter : broad_lighter) * (1.0 + 0.3 * stem.colour);
        const glm::dvec3 normal = glm::normalize(met.normal + glm::dvec3(0.0, 0.0, 0.45)),
                         sun = view_.sun * stem.axes;
        const double up = std::clamp((met.at.z - stem.low_m) / (stem.high_m - stem.low_m), 0.0, 1.0);
        const double edge = std::clamp((up - 0.05) / 0.7, 0.0, 1.0),
                     reached = 0.18 + 0.82 * edge * edge * (3.0 - 2.0 * edge);
        const double outside = view_.is_needle ? 1.0 - 0.75 * (0.05 / 0.55) : 1.0;
        const double facing = std::max(0.75 * glm::dot(normal, sun) + 0.25, 0.0),
                     through = view_.is_needle ? 0.12 : 0.3;
        const double rim = std::pow(1.0 - std::clamp(glm::dot(met.normal, to_eye), 0.0, 1.0), 2),
                     before = std::max(-glm::dot(to_eye, sun), 0.0);
        const glm::dvec3 slope =
            glm::normalize(glm::dvec3(relief * view_.ground.x, relief * view_.ground.y, view_.ground.z));
        const double site_sun =
            std::clamp(glm::dot(slope, view_.sun) / std::max(view_.sun.z, 0.15), 0.08, most_sun);
        lit = albedo * site_sun * reached * outside * (facing + through * rim * before * before);
        open = 0.6 * albedo * outside * (0.25 + 0.75 * up) * (0.55 + 0.45 * normal.z);
    }

    [[nodiscard]] ForestPicture seen() const {
        const auto pixels = static_cast<std::size_t>(view_.side_px) * static_cast<std::size_t>(view_.side_px);
        ForestPicture picture{view_.side_px, std::vector<double>(pixels), std::vector<double>(pixels),
                              std::vector<double>(pixels)};
        const double weight = 1.0 / (view_.samples_a_side * view_.samples_a_side);
        const glm::dvec3 slope =
            glm::normalize(glm::dvec3(relief * view_.ground.x, relief * view_.ground.y, view_.ground.z));
        for (int y = 0; y < side_; ++y) {
            for (int x = 0; x < side_; ++x) {
                const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                                static_cast<std::size_t>(x);
                const auto pixel = static_cast<std::size_t>(y / view_.samples_a_side * view_.side_px +
                                                            x / view_.samples_a_side);
                double lit = floor_light * std::max(glm::dot(slope, view_.sun), 0.0),
                       open = floor_light * (0.5 + 0.5 * slope.z);
                if (of_stem_[at] >= 0) {
                    const Stem& stem = stems_[static_cast<std::size_t>(of_stem_[at])];
                    light_of(stem, met_[at], glm::normalize(-ray_of(x, y) * stem.axes), lit, open);
                    picture.trees[pixel] += weight;
                }
                picture.lit[pixel] += weight * lit;
                picture.open[pixel] += weight * open;
            }
        }
        return picture;
    }

    ForestView view_;
    int side_;
    glm::dvec3 eye_, east_, up_;
    std::vector<Met> met_;
    std::vector<int> of_stem_;
    std::vector<Stem> stems_;
};

}  // namespace

ForestPicture draw_forest(const ForestView& view) {
    return ForestRaster(view).draw();
}

}  // namespace oro::test
