// Puts the clusters that a frame draws into its plan.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <span>

#include "core/cluster_frame/cluster_offer.h"
#include "core/earth/camera.h"
#include "core/earth/ellipsoid.h"
#include "core/frame/frame_plan.h"

namespace oro {

// A cluster that is offered and is on the GPU.
struct ResidentCluster {
    std::uint64_t address;
    std::uint32_t counts;  // DrawnCluster::counts
    OfferedCluster offered;
    std::int32_t first_row, last_row, first_column, last_column;  // posts that it reaches over
    Ecef centre;                                                  // ClusterReach
    glm::mat3 half_axes_m;
};

// plan: of plan_grid() for the same eye and model, on the ellipsoid. Each cluster begins to be shaded from
// the finest page of the plan that covers all of it; one that none covers cannot be seen, and is left out.
// Adds the terms of all rows and columns of the region that a cluster reaches over.
// clusters: those of the offer, in its order.
void draw_clusters(const PostGrid& grid, std::span<const ResidentCluster> clusters, const ClusterOffer& offer,
                   const Camera& camera, GridPlan& plan);

}  // namespace oro
