// Means of the data under invented ground, which lie on both sides of the rim between them.
#pragma once

#include <mutex>
#include <optional>

#include "core/lod/ground_means.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/page.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Means of all posts of the data, those below invented ground as well. Safe to ask from several threads.
class DataMeans {
  public:
    // heights: of all posts of the grid. The means are made when they are first asked for: 5 bytes a post.
    DataMeans(PostGrid grid, DrawnHeights heights, double exaggeration);

    // Puts the means of a page of the data into `means`.
    void page(const PageIndex& index, gpu::PageMeans& means) const;

  private:
    PostGrid grid_;
    DrawnHeights heights_;
    double exaggeration_;
    mutable std::once_flag made_;
    mutable std::optional<GroundMeans> means_;
};

}  // namespace oro
