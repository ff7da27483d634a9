// A triangle cut by lines into faces, by GEOS.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <memory>
#include <span>
#include <vector>

#include "core/base/result.h"

namespace oro {

// In the plane, x to the right and y down.
using PlaneLine = std::array<glm::dvec2, 2>;
using PlaneTriangle = std::array<glm::dvec2, 3>;

// The triangles between points so that no point lies in the circle around one of them (Delaunay), by the
// points' numbers; of points at one place one counts. Anticlockwise where y goes up. Errors: what GEOS says.
Result<std::vector<std::array<std::size_t, 3>>> triangles_between(std::span<const glm::dvec2> points);

// A part of the triangle that no line crosses. Its rings are closed: the last point is the first. It lies on
// the right hand of each of them.
struct PlaneFace {
    glm::dvec2 inside;                           // a point of it, not on its rim
    std::vector<std::vector<glm::dvec2>> rings;  // around it, then around its holes
};

// Holds what GEOS needs; not for several threads at a time.
class FaceCutter {
  public:
    // Points nearer to each other than `snap` are one.
    explicit FaceCutter(double snap);
    ~FaceCutter();
    FaceCutter(const FaceCutter&) = delete;
    FaceCutter& operator=(const FaceCutter&) = delete;

    // All faces of a triangle. Lines may reach beyond it. Errors: what GEOS says of lines that are no
    // numbers.
    Result<std::vector<PlaneFace>> faces(const PlaneTriangle& triangle, std::span<const PlaneLine> lines);
    // Triangles that a face is made of, with all points of its rings as corners, and no others.
    Result<std::vector<PlaneTriangle>> triangles(const PlaneFace& face);

    struct Geos;

  private:
    std::unique_ptr<Geos> geos_;
    double snap_;
};

}  // namespace oro
