// Where exactly the ground is that a pixel shows: in double, where float32 only says which triangle it is.
#pragma once

#include <atomic>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "core/earth/camera.h"
#include "core/earth/world_model.h"
#include "core/truth/oracle.h"
#include "core/truth/true_surface.h"
#include "shaders/shared.h"

namespace oro {

struct ShownPlace {
    Geodetic point;  // h above the ellipsoid, exaggerated as it is drawn
    double row{};    // of the region's grid, fractional
    double column{};
    double distance_m{};  // from the eye to where it is seen: along the ray
};

// Meets the rays of a picture's pixels with the triangles that they show. Safe to ask from several threads.
class ShownPlaces {
  public:
    // `surface` outlives it. full_resolution: the picture leaves no detail out (tau 0). A ray that passes
    // beside its triangle, by what drawing rounds off (1/256 px), is then asked of the oracle: what it truly
    // meets. Of other pictures it meets the triangle's plane, or where that is too far off, the triangle's
    // rim.
    ShownPlaces(const TrueSurface& surface, const Camera& camera, const WorldModel& model,
                bool full_resolution);

    // Nothing for the background. Error: rounding of doubles, below 1e-6 m along the ray where it meets the
    // ground at more than a degree.
    [[nodiscard]] std::optional<ShownPlace> at(const gpu::DrawnTriangle& triangle, glm::dvec2 point_px) const;

    // How many rays passed beside their triangles so far.
    [[nodiscard]] std::uint64_t passed_beside() const { return passed_beside_; }

  private:
    struct Plane;
    [[nodiscard]] Plane plane_of(const gpu::DrawnTriangle& triangle) const;
    [[nodiscard]] ShownPlace place_at(const glm::dvec3& direction, double distance_m,
                                      double near_column) const;
    [[nodiscard]] std::optional<ShownPlace> met(const Plane& plane, const glm::dvec3& direction,
                                                double about_m) const;
    [[nodiscard]] std::optional<ShownPlace> met_truly(const glm::dvec3& direction) const;
    [[nodiscard]] ShownPlace on_rim(double row, double column, double h_m) const;

    const TrueSurface& surface_;
    Camera camera_;
    Sight sight_;
    glm::dmat3 ecef_from_view_;
    glm::dvec2 tangent_;
    std::optional<Oracle> oracle_;
    mutable std::atomic<std::uint64_t> passed_beside_{0};
};

}  // namespace oro
