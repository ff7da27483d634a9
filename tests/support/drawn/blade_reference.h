// A blade of grass as a strip on a picture, in double: shaders/growth/draw_meadow.comp written a second time, for
// tests that ask each blade for each pixel.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/earth/camera.h"
#include "shaders/shared_meadow.h"

namespace oro::gpu {
namespace {
namespace grass_rule {
using glm::mix;
using std::cos;
using std::floor;
using std::sin;
using std::sqrt;
#define ORO_FUNCTION [[maybe_unused]]
#undef OROGRAPH_SHADERS_GROWTH_TREE_RULE
#undef OROGRAPH_SHADERS_GROWTH_MEADOW_REACH
#undef OROGRAPH_SHADERS_GROWTH_BLADE_RULE
// In the order in which they need each other.
// clang-format off
#include "shaders/growth/tree_rule.glsl"
#include "shaders/growth/meadow_reach.glsl"
#include "shaders/growth/blade_rule.glsl"
// clang-format on
#undef ORO_FUNCTION
}  // namespace grass_rule
}  // namespace
}  // namespace oro::gpu

namespace oro::test {

// A clump with blades, in view coordinates.
struct ReferenceClump {
    std::uint32_t row{}, column{};  // in the whole lattice
    std::uint32_t hash{};
    glm::dvec3 foot;
    glm::dmat3 axes;  // columns: east, north, up times the exaggeration
    double size{}, kept{};
    glm::dvec2 slope, wind;
    bool is_doubtful{};
};

// A piece of a blade between two cuts across it, in pixels.
struct BladePiece {
    std::array<glm::dvec2, 4> corners;
    glm::dvec2 low_px, way;            // where it begins; along it, over the square of its length
    double low_per_m{}, high_per_m{};  // one over the depths of both cuts
};
struct ReferenceBlade {
    std::uint32_t number{};
    bool is_doubtful{};  // on the edge of being drawn, or of other cuts
    std::vector<BladePiece> pieces;
};

// The picture that blades are drawn into.
class BladePicture {
  public:
    BladePicture(const Projection& projection, int width_px, int height_px, double per_tangent)
        : scale_(projection.scale),
          shift_(projection.shift),
          half_px_(0.5 * width_px, 0.5 * height_px),
          per_tangent_(per_tangent) {}

    // Nothing where the rule of pictures draws none of it.
    [[nodiscard]] std::optional<ReferenceBlade> blade(const ReferenceClump& clump,
                                                      std::uint32_t number) const {
        if (number >= clump.kept) return {};
        namespace rule = gpu::grass_rule;
        const rule::MeadowBlade curve = rule::blade_of_clump(
            clump.hash, number, static_cast<float>(clump.size), gpu::vec2(clump.slope), gpu::vec2(clump.wind),
            rule::blade_grown(static_cast<float>(clump.kept), static_cast<float>(number)));
        ReferenceBlade blade{number, clump.is_doubtful || std::abs(clump.kept - number) < 3.0e-3, {}};
        auto low = cut(clump, curve, 0.0);
        const auto tip = cut(clump, curve, 1.0);
        if (!low || !tip) return {};
        constexpr double piece_px = 11.0;
        const double whole = glm::length(tip->middle - low->middle) / piece_px;
        const int count = std::clamp(static_cast<int>(whole) + 1, 1, 9);
        blade.is_doubtful =
            blade.is_doubtful || (whole < 9.0 && std::abs(whole - std::round(whole)) < 2.0e-3 && whole > 0.5);
        for (int i = 1; i <= count; ++i) {
            const auto high = cut(clump, curve, static_cast<double>(i) / count);
            if (!high) break;
            const glm::dvec2 way = high->middle - low->middle;
            blade.pieces.push_back({{low->middle - low->across, low->middle + low->across,
                                     high->middle + high->across, high->middle - high->across},
                                    low->middle,
                                    way / std::max(glm::dot(way, way), 1.0e-6),
                                    low->per_m,
                                    high->per_m});
            low = high;
        }
        return blade;
    }

  private:
    struct Cut {
        glm::dvec2 middle, across;
        double per_m;
    };
    // What a step in space is on the picture, times the depth.
    [[nodiscard]] glm::dvec2 moves(const glm::dvec3& view, const glm::dvec3& to) const {
        return scale_ * half_px_ * (glm::dvec2(to) + glm::dvec2(view) * (to.z / -view.z));
    }
    [[nodiscard]] std::optional<Cut> cut(const ReferenceClump& clump,
                                         const gpu::grass_rule::MeadowBlade& curve, double t) const {
        const glm::dvec3 foot(curve.foot), middle(curve.middle), tip(curve.tip);
        const double rest = 1.0 - t;
        const glm::dvec3 view = clump.foot + clump.axes * (foot * (rest * rest) + middle * (2.0 * t * rest) +
                                                           tip * (t * t)),
                         along = clump.axes * ((middle - foot) * rest + (tip - middle) * t);
        const double depth_m = -view.z;
        if (depth_m < 0.15) return {};
        const glm::dvec2 way = moves(view, along),
                         side = moves(view, clump.axes * glm::dvec3(glm::dvec2(curve.side), 0.0));
        const double length_px = glm::length(way), taper = 1.0 - t * t;
        const glm::dvec2 normal =
            length_px > 1.0e-6 ? glm::dvec2(-way.y, way.x) / length_px : glm::dvec2(1.0, 0.0);
        const double half_px = 0.5 * static_cast<double>(gpu::grass_rule::blade_width_m) * taper *
                               std::max(std::abs(glm::dot(side, normal)), 0.45 * per_tangent_) / depth_m;
        return Cut{(scale_ * glm::dvec2(view) / depth_m + shift_ + 1.0) * half_px_,
                   std::max(half_px, 0.5) * normal, 1.0 / depth_m};
    }

    glm::dvec2 scale_, shift_, half_px_;
    double per_tangent_;
};

}  // namespace oro::test
