// What a view takes by blocks of the grid and by clusters, before it is drawn.
#pragma once

#include <cstdint>
#include <optional>

#include "apps/view/view.h"
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

// Of a region that was baked with clusters, where the view can be drawn by them, and which is built in one go
// (most_posts_in_one_go); else nothing. Frustum and
// horizon are left out, what other ground hides is not. Blocks are chosen in straight light. Reads all posts.
// Errors: damage.
Result<std::optional<MeshForecasts>> mesh_forecasts(const View& view, const Region& region);

}  // namespace oro
