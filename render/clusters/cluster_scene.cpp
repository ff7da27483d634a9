#include "render/clusters/cluster_scene.h"

#include <utility>
#include <vector>

#include "core/cluster_frame/cluster_choice.h"
#include "core/cluster_frame/cluster_frame.h"
#include "core/cluster_frame/region_clusters.h"

namespace oro {

ClusterScene::ClusterScene(std::unique_ptr<RegionClusters> clusters, ClusterStore store)
    : clusters_(std::move(clusters)), store_(std::move(store)) {}
ClusterScene::ClusterScene(ClusterScene&&) noexcept = default;
ClusterScene& ClusterScene::operator=(ClusterScene&&) noexcept = default;
ClusterScene::~ClusterScene() = default;

Result<ClusterScene> ClusterScene::create(const Gpu& gpu, std::unique_ptr<RegionClusters> clusters,
                                          std::uint64_t bytes) {
    ORO_TRY(ClusterStore store, ClusterStore::create(gpu, bytes));
    return ClusterScene(std::move(clusters), std::move(store));
}

Result<void> ClusterScene::add_to(FramePlan& plan, const Camera& camera, const Tile& tile, double tau_px,
                                  const WorldModel& model, const HorizonOccluder& occluder,
                                  const HeightQuantization& coding) {
    ORO_TRY(const ClusterChoice choice,
            choose_clusters(*clusters_, camera, tile, tau_px, model, occluder, coding, level_));
    ORO_TRY(const std::vector<ClusterStore::Held> held,
            store_.hold(choice.clusters, [&](std::uint32_t cluster, gpu::ClusterBlock& block) {
                return clusters_->fill(cluster, coding, block);
            }));
    std::vector<ResidentCluster> resident;
    resident.reserve(held.size());
    for (std::size_t i = 0; i < held.size(); ++i) {
        ORO_TRY(const ClusterReach* const reach, clusters_->reach(choice.clusters[i]));
        resident.push_back({held[i].address, held[i].counts, choice.clusters[i], choice.groups[i],
                            reach->first_row, reach->last_row, reach->first_column, reach->last_column});
    }
    draw_clusters(clusters_->grid(), resident, camera, plan);
    plan.clusters.groups_opened = choice.groups_opened;
    plan.clusters.beyond_frustum = choice.beyond_frustum;
    plan.clusters.beyond_horizon = choice.beyond_horizon;
    return {};
}

}  // namespace oro
