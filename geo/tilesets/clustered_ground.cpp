#include "geo/tilesets/clustered_ground.h"

#include <algorithm>

#include "core/clusters/graph_builder.h"

namespace oro {

ClusteredGround::ClusteredGround(const HeightField& field, int threads)
    : field_(field),
      heights_(drawn_heights(field, 1.0, threads)),
      surface_(heights_, {.wraps_longitude = field.grid.wraps_longitude()}),
      bounds_(field.grid, heights_.highest_steps) {
    std::int32_t lowest = highest_height_steps;
    for (const std::int32_t steps : heights_.steps)
        if (steps != void_height_steps) lowest = std::min(lowest, steps);
    if (heights_.highest_steps == void_height_steps) return;
    lowest_h_m_ = lowest * height_step_m;
    highest_h_m_ = heights_.highest_steps * height_step_m;
}

Result<std::unique_ptr<ClusteredGround>> ClusteredGround::of(const HeightField& field,
                                                             const ClusterFile* baked, int threads) {
    std::unique_ptr<ClusteredGround> ground(new ClusteredGround(field, threads));
    if (baked != nullptr) {
        ORO_TRY(ground->graph_, baked->graph(ground->surface_, ground->bounds_, threads));
    } else {
        ground->graph_ = build_cluster_graph(ground->surface_, ground->bounds_, {.threads = threads});
    }
    return ground;
}

}  // namespace oro
