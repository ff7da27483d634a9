// Where the vertices of a cluster graph lie on the Earth, and what that adds to differences in height.
#pragma once

#include <span>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/surface/surface_vertex.h"
#include "core/terrain/post_grid.h"

namespace oro {

// How far a triangle, or a group of them, reaches in the plane and in height.
struct GroundExtent {
    std::int32_t first_row{};
    std::int32_t last_row{};
    std::int32_t columns{};  // from the first to the last
    double rise_m{};         // from the lowest to the highest

    [[nodiscard]] double rows() const { return static_cast<double>(last_row) - first_row; }
};

class GroundBounds {
  public:
    virtual ~GroundBounds() = default;
    [[nodiscard]] virtual Ecef ecef(const SurfaceVertex& vertex) const = 0;
    // Upper bound, metres, of how much farther apart two places of the same row and column are in space than
    // their heights differ, one on a flat triangle that reaches no farther than `triangle`, the other on
    // a flat triangle of the original; both in `group`. In it are the ellipsoid's sag and the rounding
    // of drawn places.
    [[nodiscard]] virtual double flat_m(const GroundExtent& triangle, const GroundExtent& group) const = 0;
};

// The bounds of a grid's posts.
class GridBounds final : public GroundBounds {
  public:
    // highest_steps: of all posts. Keeps `grid`.
    GridBounds(const PostGrid& grid, std::int32_t highest_steps);
    [[nodiscard]] Ecef ecef(const SurfaceVertex& vertex) const override;
    [[nodiscard]] double flat_m(const GroundExtent& triangle, const GroundExtent& group) const override;

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
