// The ground of one grid with its cluster graph: what a tileset is cut from.
#pragma once

#include <memory>

#include "core/base/result.h"
#include "core/cluster_file/cluster_file.h"
#include "core/clusters/cluster_graph.h"
#include "core/surface/grid_surface.h"
#include "core/surface/ground_bounds.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Some 130 bytes a post. May be asked from several threads.
class ClusteredGround {
  public:
    // Reads the graph of `baked`, or builds it where that is null: 13 s of a thread for 1.44 million posts.
    // `field` outlives it. The graph is the same for any number of threads. Errors: a file that cannot be
    // read, or is not of this field.
    static Result<std::unique_ptr<ClusteredGround>> of(const HeightField& field, const ClusterFile* baked,
                                                       int threads);

    [[nodiscard]] const PostGrid& grid() const { return field_.grid; }
    [[nodiscard]] const OriginalSurface& surface() const { return surface_; }
    [[nodiscard]] const ClusterGraph& graph() const { return graph_; }
    [[nodiscard]] Ecef ecef(const SurfaceVertex& vertex) const { return bounds_.ecef(vertex); }
    // h of all posts; 0 where there is none.
    [[nodiscard]] double lowest_h_m() const { return lowest_h_m_; }
    [[nodiscard]] double highest_h_m() const { return highest_h_m_; }

  private:
    ClusteredGround(const HeightField& field, int threads);

    const HeightField& field_;
    DrawnHeights heights_;
    GridSurface surface_;
    GridBounds bounds_;
    ClusterGraph graph_;
    double lowest_h_m_{}, highest_h_m_{};
};

}  // namespace oro
