#include "render/clusters/cluster_scene.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/cluster_frame/cluster_choice.h"
#include "core/cluster_frame/cluster_frame.h"
#include "core/cluster_frame/region_clusters.h"

namespace oro {
namespace {

// Of groups and clusters between two frames: 2 MB of clusters at most, which are sent in a millisecond.
constexpr std::size_t most_on_the_way = 1024;

}  // namespace

ClusterScene::ClusterScene(std::unique_ptr<RegionClusters> clusters, ClusterStore store)
    : clusters_(std::move(clusters)), store_(std::move(store)) {}
ClusterScene::ClusterScene(ClusterScene&&) noexcept = default;
ClusterScene::~ClusterScene() = default;

Result<ClusterScene> ClusterScene::create(const Gpu& gpu, std::unique_ptr<RegionClusters> clusters,
                                          std::uint64_t bytes) {
    ORO_TRY(ClusterStore store,
            ClusterStore::create(
                gpu, std::max<std::uint64_t>(bytes, clusters->roots().size() * sizeof(gpu::ClusterBlock))));
    return ClusterScene(std::move(clusters), std::move(store));
}

Result<void> ClusterScene::add_to(FramePlan& plan, const Camera& camera, const Tile& tile, double tau_px,
                                  const WorldModel& model, const HorizonOccluder& occluder,
                                  const HeightQuantization& coding) {
    const ClusterView view(camera, tile, tau_px, model, occluder, coding, level_);
    ORO_TRY(ClusterChoice choice, choose_clusters(*clusters_, view));
    std::size_t without_room = 0;
    if (choice.clusters.size() > store_.capacity()) {
        without_room = choice.clusters.size() - store_.capacity();
        // What they need was read for the finer one.
        const unsigned steps = coarser_steps_until([&](unsigned more) {
            const auto coarser = choose_clusters(*clusters_, view.coarser(more));
            return !coarser.ok() || coarser->clusters.size() <= store_.capacity();
        });
        ORO_TRY(choice, choose_clusters(*clusters_, view.coarser(steps)));
    }
    store_.begin_frame();
    ORO_CHECK(store_.hold(choice.clusters, [&](std::uint32_t cluster, gpu::ClusterBlock& block) {
        return clusters_->fill(cluster, coding, block);
    }));
    if (stream_) stream_->want_nothing();
    view_.reset();
    plan.clusters.missing = plan.clusters.without_room = without_room;
    most_without_room_ = std::max(most_without_room_, without_room);
    return draw(choice, offer_of(choice), camera, plan);
}

Result<void> ClusterScene::add_what_is_here(FramePlan& plan, const Camera& camera, const Tile& tile,
                                            double tau_px, const WorldModel& model,
                                            const HorizonOccluder& occluder,
                                            const HeightQuantization& coding) {
    if (!stream_)
        stream_ = std::make_unique<ClusterStream>(*clusters_, coding, thread_count(), most_on_the_way);
    store_.begin_frame();
    // Everything else may be missing.
    ORO_CHECK(store_.hold(clusters_->roots(), [&](std::uint32_t cluster, gpu::ClusterBlock& block) {
        return clusters_->fill(cluster, coding, block);
    }));
    view_.emplace(camera, tile, tau_px, model, occluder, coding, level_);
    ORO_TRY(StreamedChoice choice, choose_here());
    want(choice);
    ORO_CHECK(draw(choice.drawn, choice.offer, camera, plan));
    drawn_ = std::move(choice.drawn.clusters);
    plan.clusters.missing = choice.missing;
    plan.clusters.without_room = choice.without_room;
    is_whole_ = choice.missing == 0;
    has_room_ = choice.without_room == 0;
    most_without_room_ = std::max(most_without_room_, choice.without_room);
    return {};
}

// What is wanted and here is to stay.
Result<StreamedChoice> ClusterScene::choose_here() {
    ORO_TRY(StreamedChoice choice,
            choose_clusters_here(*clusters_, *view_, store_.capacity() - clusters_->roots().size(),
                                 [&](std::uint32_t cluster) { return store_.is_here(cluster); }));
    for (const std::uint32_t cluster : choice.clusters_wanted)
        if (store_.is_here(cluster)) store_.use(cluster);
    return choice;
}

void ClusterScene::want(const StreamedChoice& choice) {
    std::vector<std::uint32_t> to_come;
    std::ranges::copy_if(choice.clusters_wanted, std::back_inserter(to_come),
                         [&](std::uint32_t cluster) { return !store_.is_here(cluster); });
    stream_->want(*view_, choice.groups_wanted, to_come);
}

// A group's clusters come with it: which of them are wanted is known once it is.
Result<void> ClusterScene::send(ClusterStream::Ready ready) {
    for (RegionClusters::LoadedGroup& group : ready.groups) clusters_->keep(group);
    for (const RegionClusters::LoadedCluster& cluster : ready.clusters)
        clusters_->keep(cluster.number, cluster.reach);
    store_.begin_frame();
    ORO_TRY(const StreamedChoice choice, choose_here());
    std::vector<std::uint32_t> wanted = choice.clusters_wanted;
    std::ranges::sort(wanted);
    std::vector<ClusterStore::Loaded> loaded;
    const auto add = [&](const RegionClusters::LoadedCluster& cluster) {
        if (std::ranges::binary_search(wanted, cluster.number))
            loaded.push_back({cluster.number, cluster.counts, cluster.block.get()});
    };
    for (const RegionClusters::LoadedGroup& group : ready.groups) std::ranges::for_each(group.seen, add);
    std::ranges::for_each(ready.clusters, add);
    return store_.send(loaded);
}

Result<bool> ClusterScene::advance() {
    if (!view_) return false;
    ORO_TRY(ClusterStream::Ready ready, stream_->take());
    if (ready.groups.empty() && ready.clusters.empty()) return false;
    ORO_CHECK(send(std::move(ready)));
    ORO_TRY(const StreamedChoice choice, choose_here());
    want(choice);
    return choice.drawn.clusters != drawn_ || (choice.missing == 0) != is_whole_ ||
           (choice.without_room == 0) != has_room_;
}

Result<void> ClusterScene::draw(const ClusterChoice& choice, const ClusterOffer& offer, const Camera& camera,
                                FramePlan& plan) {
    std::vector<ResidentCluster> resident;
    resident.reserve(offer.clusters.size());
    for (const OfferedCluster& offered : offer.clusters) {
        const ClusterStore::Held held = store_.use(offered.cluster);
        ORO_TRY(const ClusterReach* const reach, clusters_->reach(offered.cluster));
        resident.push_back({held.address, held.counts, offered, reach->first_row, reach->last_row,
                            reach->first_column, reach->last_column, reach->centre, reach->half_axes_m});
    }
    draw_clusters(clusters_->grid(), resident, offer, camera, plan);
    plan.clusters.groups_opened = choice.groups_opened;
    plan.clusters.beyond_frustum = choice.beyond_frustum;
    plan.clusters.beyond_horizon = choice.beyond_horizon;
    return {};
}

}  // namespace oro
