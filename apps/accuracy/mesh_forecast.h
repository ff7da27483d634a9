// What a view takes by blocks of the grid and by clusters, before it is drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "apps/drawing/clusters_of_region.h"
#include "apps/view/view.h"
#include "core/frame/region_pages.h"
#include "geo/region/region.h"

namespace oro {

// What is in view of one kind of mesh.
struct MeshForecast {
    std::uint64_t triangles{};
    double worst_m{};   // the largest certified error of what is drawn: of anything in it, full resolution
    double worst_px{};  // likewise on the picture; at most tau
};
struct MeshForecasts {
    MeshForecast blocks;
    MeshForecast clusters;
};

// Forecasts for a region that was baked with clusters, where the view can be drawn by them; else nothing.
// pages: the region's own. Frustum and horizon are left out, what other ground hides is not. Blocks are
// chosen in straight light. Reads all posts (clusters_of_region), and of pages and clusters those in view.
// Errors: damage.
Result<std::optional<MeshForecasts>> mesh_forecasts(const View& view, const Region& region,
                                                    const RegionPages& pages,
                                                    std::size_t most_read_at_once = most_posts_read_at_once);

}  // namespace oro
