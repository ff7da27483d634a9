// How far the ground of a picture is from where it truly is: each pixel's ground point, and the surface
// there.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/earth/camera.h"
#include "core/measure/drawn_point.h"
#include "core/truth/oracle.h"
#include "core/truth/picture_error.h"
#include "core/truth/true_ground.h"

namespace oro {

// A distance in the world, and the same on the picture.
struct Distance {
    double m{};
    double px{};
    bool px_at_least{};  // one of the two places is on no picture: pixels are a least that it is off by
};

// Measures drawn points of a picture. All outlive it.
class GroundMeter {
  public:
    // `sight` is the true one: where the eye really is, and the air really bends light.
    GroundMeter(const TrueGround& ground, const Sight& sight, const Camera& camera);

    // Direction through a place of the picture in view coordinates, z = -1.
    [[nodiscard]] glm::dvec3 ray_view(const glm::dvec2& point_px) const;
    // Where a point is seen that lies so far along the view axis: offset from the eye, ECEF axes, metres.
    [[nodiscard]] glm::dvec3 offset_m(const glm::dvec2& point_px, double z_m) const;
    // Where the ground point of a pixel is truly seen; nothing over no data. What is drawn between grids
    // belongs to none: it should be at its own place, at a height between those that the grids have there.
    [[nodiscard]] std::optional<glm::dvec3> seen_m(const glm::dvec2& point_px, const DrawnPoint& point) const;
    [[nodiscard]] bool is_between(const DrawnPoint& point) const { return point.grid >= ground_.grids(); }
    // Where an offset from the eye is on the picture; nothing behind the picture's plane.
    [[nodiscard]] std::optional<glm::dvec2> place_px(const glm::dvec3& seen_m) const;
    // How far apart two offsets from the eye are on the picture. Of one behind the picture's plane: as far as
    // the metres between them would reach at the other's distance, if they lay across. At most the picture's
    // diagonal: beyond, towards the picture's plane, pixels grow without end and say nothing.
    [[nodiscard]] double apart_px(const glm::dvec3& drawn_m, const glm::dvec3& seen_m) const;
    // The distance without an end, of two points that are before the picture's plane; of others at least
    // apart_px().
    struct Apart {
        double px{};
        bool at_least{};
    };
    [[nodiscard]] Apart apart(const glm::dvec3& drawn_m, const glm::dvec3& seen_m) const;
    // The picture's diagonal.
    [[nodiscard]] double diagonal_px() const;

    // The displacement of a pixel that shows `point`, from where its ground point (the row and column of its
    // triangle) truly is: sideways, up and along the line of sight. Nothing where that lies over no data.
    // Error: rounding of doubles, and that of the drawn point: 6e-8 of its distance.
    [[nodiscard]] std::optional<Distance> displacement(const glm::dvec2& point_px,
                                                       const DrawnPoint& point) const;
    // From the true surface: no farther than this, to 0.2 % where the ground is even around it, and no
    // farther than the point's displacement. m is the distance to the surface, not the difference of heights,
    // which would exaggerate on walls.
    [[nodiscard]] Distance from_surface(const glm::dvec2& point_px, const DrawnPoint& point,
                                        const Distance& displacement) const;
    // The same of any place, of one that is `so_far` from something else: the nearer of both. seen_m: where
    // it is seen, from the eye. otherwise: the grid to ask where none is the ground there.
    [[nodiscard]] Distance from_ground(const glm::dvec3& place_m, const glm::dvec3& seen_m,
                                       std::size_t otherwise, const Distance& so_far) const;

  private:
    TrueGround ground_;
    [[nodiscard]] std::optional<glm::dvec3> seen_between_m(const glm::dvec2& point_px,
                                                           const DrawnPoint& point) const;
    const Sight& sight_;
    glm::dmat3 view_from_ecef_;
    glm::dvec2 tangent_;
    glm::dvec2 size_px_;
    double pixels_per_tangent_;
};

// Of meshes, both ways, over the pixels that show one and those that truly show one
// (core/measure/mesh_error.h).
struct MeshErrors {
    ErrorSummary drawn_m, drawn_px;    // what is drawn, from the meshes
    ErrorSummary missed_m, missed_px;  // what is truly seen of them, from what is drawn
};

// The errors of all pixels, each at its centre, row by row; not_measured where nothing is drawn, or over no
// data. A pixel that shows a mesh is displaced, and off the surface, by how far that is from the meshes; one
// that truly shows a mesh is displaced by no less than what is seen there is from what is drawn.
struct GroundErrors {
    std::vector<float> displacement_m, displacement_px;
    std::vector<float> surface_m, surface_px;
    std::vector<std::uint8_t> displacement_at_least, surface_at_least;  // 1: the pixels are, Distance
    ErrorSummary summary_displacement_m, summary_displacement_px;
    ErrorSummary summary_surface_m, summary_surface_px;
    std::uint64_t drawn{};               // pixels with ground
    std::uint64_t beyond_data{};         // of them those whose ground point has no true height
    std::uint64_t between{};             // of them those that are drawn between grids, or on meshes
    std::optional<MeshErrors> meshes{};  // where there are meshes
};
enum class GroundMeasures { both, displacement };  // without the surface its values are not_measured
GroundErrors ground_errors(const TrueGround& ground, const Sight& sight, const Camera& camera,
                           std::span<const DrawnPoint> points, int threads,
                           GroundMeasures measures = GroundMeasures::both);

// What is measured of meshes beside that.
struct MeshesMeasured {
    // What is drawn in the place of the ground's meshes; empty: they themselves, of which nothing is missed.
    std::span<const TrueMesh> drawn;
    std::span<const std::optional<SightHit>> seen;  // what each pixel truly sees at its centre
};
GroundErrors ground_errors(const TrueGround& ground, const Sight& sight, const Camera& camera,
                           std::span<const DrawnPoint> points, int threads, const MeshesMeasured& meshes);

}  // namespace oro
