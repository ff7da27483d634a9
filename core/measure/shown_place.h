// Where exactly the ground is that a pixel shows: in double, where float32 only says which triangle it is.
#pragma once

#include <atomic>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "core/earth/camera.h"
#include "core/earth/world_model.h"
#include "core/measure/drawn_point.h"
#include "core/truth/oracle.h"
#include "core/truth/true_ground.h"

namespace oro {

struct ShownPlace {
    Geodetic point;  // h above the ellipsoid, exaggerated as it is drawn
    double row{};    // of its grid, fractional
    double column{};
    double distance_m{};  // from the eye to where it is seen: along the ray
    std::size_t grid{};   // of the ground's; on a step between grids that which is the ground there
};

// Where what a pixel shows lies, to what float32 leaves: by its own triangle, or between grids by how far
// away it was drawn.
PostPlace place_of(const DrawnPoint& point, const TrueGround& ground, const Sight& sight,
                   const Camera& camera, glm::dvec2 point_px);

// Meets the rays of a picture's pixels with the triangles that they show. Safe to ask from several threads.
class ShownPlaces {
  public:
    // What `ground` is made of outlives it; its grids are the frame's. full_resolution: the picture leaves no
    // detail out (tau 0). A ray that passes beside its triangle, by what drawing rounds off (1/256 px), is
    // then asked of the oracle: what it truly meets, and so is one that meets a step between grids. Of other
    // pictures it meets the triangle's plane, or where that is too far off, the triangle's rim; a step where
    // float32 has it.
    ShownPlaces(const TrueGround& ground, const Camera& camera, const WorldModel& model,
                bool full_resolution);

    // Nothing for the background. Error: rounding of doubles, below 1e-6 m along the ray where it meets the
    // ground at more than a degree.
    [[nodiscard]] std::optional<ShownPlace> at(const ShownTriangle& shown, glm::dvec2 point_px) const;

    // How many rays passed beside their triangles so far.
    [[nodiscard]] std::uint64_t missed() const { return missed_; }

  private:
    struct Plane;
    [[nodiscard]] Plane plane_of(const ShownTriangle& shown) const;
    [[nodiscard]] Geodetic point_at(const glm::dvec3& direction, double distance_m) const;
    [[nodiscard]] ShownPlace place_at(const glm::dvec3& direction, double distance_m, std::size_t grid,
                                      double near_column) const;
    [[nodiscard]] ShownPlace between_grids(const glm::dvec3& direction, double distance_m) const;
    [[nodiscard]] std::optional<ShownPlace> met(const Plane& plane, const glm::dvec3& direction,
                                                double about_m) const;
    [[nodiscard]] std::optional<ShownPlace> met_truly(const glm::dvec3& direction) const;
    [[nodiscard]] ShownPlace on_rim(const DrawnPoint& drawn) const;

    TrueGround ground_;
    Camera camera_;
    Sight sight_;
    glm::dmat3 ecef_from_view_;
    glm::dvec2 tangent_;
    std::optional<Oracle> oracle_;
    mutable std::atomic<std::uint64_t> missed_{0};
};

}  // namespace oro
