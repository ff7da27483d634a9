// What a cluster graph is built over and held against: a triangulated surface with one height at each place.
#pragma once

#include <limits>
#include <vector>

#include "core/surface/surface_vertex.h"

namespace oro {

// A source's full resolution. Heights and differences are vertical, in steps of height_step_m. Everything
// here may be asked from several threads.
//
// The difference between a mesh and the original is linear over the pieces that their edges cut each other
// into. So it is largest at corners of these pieces: where a mesh's edge meets an edge or a vertex of the
// original (edge_difference), and at vertices of the original within a triangle (inner_difference).
class OriginalSurface {
  public:
    static constexpr double no_limit = std::numeric_limits<double>::infinity();

    virtual ~OriginalSurface() = default;

    // Vertices are numbered 0 .. vertex_count() - 1; some of them may be in no triangle.
    [[nodiscard]] virtual std::size_t vertex_count() const = 0;
    [[nodiscard]] virtual SurfaceVertex vertex(VertexNumber number) const = 0;
    // Whether a vertex lies where more of the surface goes on beyond, which this object does not know: it is
    // a window of a larger one. Such vertices stay on all levels.
    [[nodiscard]] virtual bool is_open(VertexNumber) const { return false; }
    [[nodiscard]] virtual bool is_window() const { return false; }
    // Whether a vertex stays on all levels for another reason.
    [[nodiscard]] virtual bool must_stay(VertexNumber) const { return false; }
    // The original's triangles as clusters of at most 128 triangles and 128 vertices, in a fixed order; none
    // empty. What a cluster of a grid covers is a square of `leaf_side` posts (core/clusters/group_tiling.h).
    [[nodiscard]] virtual std::vector<std::vector<VertexTriangle>> leaves() const = 0;
    // Largest difference along the straight line between two vertices that lies within the surface (or on its
    // rim). Exact but for rounding (below 1e-6 steps); where it is above `limit`, any value above the limit
    // that is not above the difference.
    [[nodiscard]] virtual double edge_difference(const SurfaceVertex& from, const SurfaceVertex& to,
                                                 double limit) const = 0;
    // The largest difference over the original's vertices within a triangle, its edges left out or not.
    [[nodiscard]] virtual double inner_difference(const SurfaceVertex& a, const SurfaceVertex& b,
                                                  const SurfaceVertex& c, double limit) const = 0;
};

}  // namespace oro
