// How far a drawn picture is from the truth: height and pixels at each drawn point, and where the skyline
// lies.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/earth/camera.h"
#include "core/truth/oracle.h"
#include "core/truth/true_surface.h"

namespace oro {

// Of absolute values. 0 everywhere when there are none.
struct ErrorSummary {
    double largest{};
    double p9999{};  // 99.99 % are not larger (nearest rank)
    double p99{};
    double mean{};
    std::uint64_t count{};
};
ErrorSummary summary_of(std::vector<double> values);
// The same of floats, those that are not_measured left out.
ErrorSummary summary_of(std::span<const float> values);

// A drawn picture's depths: reversed (near_plane_m / distance along the view axis), 0 for the background, row
// by row, each at the sample's place in its pixel.
struct DrawnDepths {
    std::span<const float> depths;
    glm::dvec2 sample_px{0.5, 0.5};
};

// What is wrong with one drawn point.
struct PointError {
    double height_m;  // how far it lies above the true surface, along the ellipsoid's normal
    double px;        // on the picture, from where the true surface at its latitude and longitude is
};
// Measures drawn points of a picture. All outlive it but the camera.
class PointMeter {
  public:
    // `sight` is the true one: where the eye really is, and the air really bends light.
    PointMeter(const TrueSurface& surface, const Sight& sight, const Camera& camera);
    // Where the point on the ray through a place of the picture is seen: offset from the eye, ECEF axes.
    [[nodiscard]] glm::dvec3 offset_m(const glm::dvec2& point_px, float depth) const;
    // Of a point that is drawn at that offset, before the eye; nothing where nothing true lies below it.
    [[nodiscard]] std::optional<PointError> at(const glm::dvec3& drawn_m) const;

  private:
    const TrueSurface& surface_;
    const Sight& sight_;
    glm::dmat3 view_from_ecef_;
    glm::dvec2 tangent_;
    glm::dvec2 size_px_;
    double pixels_per_tangent_;
};

// The interior: at each drawn point, taken relative to the true eye, how far it lies above the true surface
// (metres along the ellipsoid's normal), and how far apart the two points at that latitude and longitude are
// on the picture. Where the true one lies behind the picture's plane: at least as far as the metres would
// reach at the drawn one's distance, if they lay across.
struct InteriorError {
    std::vector<float> height_m;  // of each pixel, signed; not_measured where nothing is drawn or nothing
                                  // true lies below
    std::vector<float> px;
    ErrorSummary summary_m;
    ErrorSummary summary_px;
    std::uint64_t drawn{};        // pixels with ground
    std::uint64_t beyond_data{};  // of them those whose point lies over no data
};
inline constexpr float not_measured = -1.0e30F;
// `sight` is the true one: where the eye really is, and the air really bends light. Error: that of the
// depths, which are floats: 6e-8 of the distance, along the ray.
InteriorError interior_error(const TrueSurface& surface, const Sight& sight, const Camera& camera,
                             const DrawnDepths& drawn, int threads);

}  // namespace oro
