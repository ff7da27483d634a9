// Puts the clusters that a frame draws into its plan.
#pragma once

#include <cstdint>
#include <span>

#include "core/cluster_frame/cluster_offer.h"
#include "core/cluster_frame/region_clusters.h"
#include "core/earth/camera.h"
#include "core/frame/frame_plan.h"
#include "core/frame/frame_tables.h"

namespace oro {

// A cluster that is offered and is on the GPU.
struct ResidentCluster {
    std::uint64_t address;
    std::uint32_t counts;  // DrawnCluster::counts
    OfferedCluster offered;
    const ClusterReach* reach;
};

// plan: of plan_grid() for the same eye and model, on the ellipsoid. Each cluster begins to be shaded from
// the finest page of the plan that covers all of it; one that none covers cannot be seen, and is left out.
// Adds the terms of all rows and columns of the region that a cluster reaches over.
// clusters: those of the offer, in its order. kept: of the same grid, from frame to frame.
void draw_clusters(const PostGrid& grid, std::span<const ResidentCluster> clusters, const ClusterOffer& offer,
                   const Camera& camera, GridPlan& plan, KeptAngles* kept = nullptr);

}  // namespace oro
