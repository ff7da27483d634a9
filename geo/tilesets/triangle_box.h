// Between which latitudes, longitudes and heights flat triangles lie.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <limits>

#include "geo/tilesets/ground_mesh.h"

namespace oro {

// The radius of the smallest circle around a triangle, in metres: half the longest side, or that of the
// circle through its corners where all its angles are acute. Above it by rounding at most.
double enclosing_radius_m(const std::array<glm::dvec3, 3>& corners_m);

// The box that holds every point of flat triangles, not their corners alone: between corners a triangle lies
// below the surface that curves, and reaches nearer to a pole. Both are bounds, proven in triangle_box.cpp.
class TriangleBox {
  public:
    // middle_lon_deg: longitudes are counted in the whole turn around it.
    explicit TriangleBox(double middle_lon_deg) : middle_lon_deg_(middle_lon_deg) {}

    // ECEF in metres. Every corner of every triangle is added, each once at least.
    void add_corner(const glm::dvec3& at_m);
    void add_triangle(const std::array<glm::dvec3, 3>& corners_m);

    // The lowest height is that of the lowest corner less the sag of the widest triangle; the highest is that
    // of the highest corner. All sides have 1 cm beside that, for what rounds coordinates by less than a
    // millimetre. Triangles that may lie around a pole have a whole turn of longitudes, and those whose
    // circle is wider than 6,300 km the whole Earth. Needs a corner.
    [[nodiscard]] TileBox box() const;

  private:
    static constexpr double far = std::numeric_limits<double>::infinity();
    double middle_lon_deg_;
    TileBox corners_{far, far, -far, -far, far, -far};
    double nearest_axis_m_{far};  // of a corner to the axis of the Earth
    double widest_m_{};           // radius of the largest of the circles around triangles
};

// Of all triangles of a mesh, walls among them, where its whole steps are.
TileBox box_of(const GroundMesh& mesh);

}  // namespace oro
