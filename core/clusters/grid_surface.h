// The one place where a vertex of a cluster graph is a post: a grid of heights as its original surface.
#pragma once

#include "core/clusters/original_surface.h"
#include "core/terrain/drawn_heights.h"

namespace oro {

// Vertex number row * columns + column. A cell is two triangles, split from its north-west to its south-east
// post; a triangle with a void post is not there, so that cells with void posts are holes. Leaves are the
// nodes of level 0: 8 x 8 quads. Reads `heights` where it is.
class GridSurface final : public OriginalSurface {
  public:
    explicit GridSurface(const DrawnHeights& heights) : heights_(heights) {}

    [[nodiscard]] std::size_t vertex_count() const override { return heights_.steps.size(); }
    [[nodiscard]] SurfaceVertex vertex(VertexNumber number) const override;
    [[nodiscard]] std::vector<std::vector<VertexTriangle>> leaves() const override;
    [[nodiscard]] double edge_difference(const SurfaceVertex& from, const SurfaceVertex& to,
                                         double limit) const override;
    [[nodiscard]] double inner_difference(const SurfaceVertex& a, const SurfaceVertex& b,
                                          const SurfaceVertex& c, double limit) const override;

  private:
    // A step from line to line of the grid that an edge crosses, and the way along such a line from a post to
    // the next.
    struct Lines {
        int count;             // crossings, both ends left out: 1 .. count - 1
        std::ptrdiff_t along;  // posts, in memory
    };
    [[nodiscard]] VertexTriangle triangle_of(int row, int column, int side) const;
    [[nodiscard]] bool triangle_there(const VertexTriangle& triangle) const;
    [[nodiscard]] double crossing_difference(const SurfaceVertex& from, const SurfaceVertex& to,
                                             const Lines& lines, double limit) const;

    const DrawnHeights& heights_;
};

}  // namespace oro
