// Where the vertices of a cluster graph lie on the Earth, and what that adds to differences in height.
#pragma once

#include <span>
#include <vector>

#include "core/clusters/surface_vertex.h"
#include "core/earth/ellipsoid.h"
#include "core/terrain/post_grid.h"

namespace oro {

// The range of a group's places.
struct VertexRange {
    SurfaceVertex lowest{};  // row, column and height, each by itself
    SurfaceVertex highest{};
};

class GroundBounds {
  public:
    virtual ~GroundBounds() = default;
    [[nodiscard]] virtual Ecef ecef(const SurfaceVertex& vertex) const = 0;
    // Upper bound, metres, of how much farther apart two places of the same row and column are in space than
    // their heights differ, one on a flat triangle within `triangle` (the largest range of one of them), the
    // other on a flat triangle of the original within `group`. In it are the ellipsoid's sag and the rounding
    // of drawn places.
    [[nodiscard]] virtual double flat_m(const VertexRange& triangle, const VertexRange& group) const = 0;
};

// Of a grid's posts.
class GridBounds final : public GroundBounds {
  public:
    // highest_steps: of all posts. Keeps `grid`.
    GridBounds(const PostGrid& grid, std::int32_t highest_steps);
    [[nodiscard]] Ecef ecef(const SurfaceVertex& vertex) const override;
    [[nodiscard]] double flat_m(const VertexRange& triangle, const VertexRange& group) const override;

  private:
    struct Row {
        SineCosine lat;
        double N_m;  // prime-vertical radius
    };
    const PostGrid& grid_;
    double highest_m_;
    std::vector<Row> rows_;  // none of a net
    std::vector<SineCosine> columns_;
};

}  // namespace oro
