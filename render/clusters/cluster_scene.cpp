#include "render/clusters/cluster_scene.h"

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "core/base/parallel.h"
#include "core/cluster_frame/cluster_choice.h"
#include "core/cluster_frame/cluster_frame.h"
#include "core/cluster_frame/region_clusters.h"

namespace oro {
namespace {

// Of groups and clusters between two frames, where there is room: 2 MB of clusters at most, which are sent in
// a millisecond. Most of what a group takes is its triangles; some 20 KB.
constexpr std::size_t most_between_frames = 1024;
constexpr std::uint64_t bytes_on_the_way = 20'000;

// What is on its way has a quarter of a memory, what is held the rest.
std::size_t most_on_the_way(std::uint64_t bytes) {
    return static_cast<std::size_t>(
        std::clamp<std::uint64_t>(bytes / 4 / bytes_on_the_way, 1, most_between_frames));
}

// Those of what has come, of groups first, that are to be sent.
template <typename IsSent>
std::vector<ClusterStore::Loaded> loaded_of(const ClusterStream::Ready& ready, const IsSent& is_sent) {
    std::vector<ClusterStore::Loaded> loaded;
    const auto add = [&](const RegionClusters::LoadedCluster& cluster) {
        if (is_sent(cluster)) loaded.push_back({cluster.number, cluster.counts, cluster.block.get()});
    };
    for (const RegionClusters::LoadedGroup& group : ready.groups) std::ranges::for_each(group.seen, add);
    std::ranges::for_each(ready.clusters, add);
    return loaded;
}

}  // namespace

ClusterScene::ClusterScene(std::unique_ptr<RegionClusters> clusters, ClusterStore store,
                           std::size_t most_on_the_way)
    : clusters_(std::move(clusters)),
      store_(std::move(store)),
      most_on_the_way_(most_on_the_way),
      angles_(clusters_->grid()) {}
ClusterScene::ClusterScene(ClusterScene&&) noexcept = default;
ClusterScene::~ClusterScene() = default;

Result<ClusterScene> ClusterScene::create(const Gpu& gpu, std::unique_ptr<RegionClusters> clusters,
                                          std::uint64_t bytes, std::uint64_t main_bytes) {
    ClusterStore store(gpu,
                       std::max<std::uint64_t>(bytes, clusters->roots().size() * sizeof(gpu::ClusterBlock)));
    if (main_bytes != GroupCache::no_limit) clusters->hold_at_most(main_bytes - main_bytes / 4);
    return ClusterScene(std::move(clusters), std::move(store), most_on_the_way(main_bytes));
}

Result<void> ClusterScene::append_full_cut(GridPlan& plan, const Camera& camera, const Tile& tile,
                                           double tau_px, const WorldModel& model,
                                           const HorizonOccluder& occluder,
                                           const HeightQuantization& coding) {
    const ClusterView view(camera, tile, tau_px, model, occluder, coding, level_);
    clusters_->begin_frame();
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
    if (stream_) stream_->cancel();
    view_.reset();
    plan.clusters.missing = plan.clusters.without_room = without_room;
    most_without_room_ = std::max(most_without_room_, without_room);
    ORO_CHECK(draw(choice, offer_of(choice), camera, plan));
    clusters_->end_frame();
    return {};
}

Result<void> ClusterScene::append_resident_cut(GridPlan& plan, const Camera& camera, const Tile& tile,
                                               double tau_px, const WorldModel& model,
                                               const HorizonOccluder& occluder,
                                               const HeightQuantization& coding) {
    if (!stream_)
        stream_ = std::make_unique<ClusterStream>(*clusters_, coding, thread_count(), most_on_the_way_);
    clusters_->begin_frame();
    store_.begin_frame();
    // Everything else may be missing.
    ORO_CHECK(store_.hold(clusters_->roots(), [&](std::uint32_t cluster, gpu::ClusterBlock& block) {
        return clusters_->fill(cluster, coding, block);
    }));
    view_.emplace(camera, tile, tau_px, model, occluder, coding, level_);
    ORO_TRY(StreamedChoice choice, choose_here());
    request(choice);
    if (!is_drawn_by_blocks(choice)) ORO_CHECK(draw(choice.drawn, choice.offer, camera, plan));
    drawn_ = std::move(choice.drawn.clusters);
    plan.clusters.missing = choice.missing;
    plan.clusters.without_room = choice.without_room;
    is_whole_ = choice.missing == 0;
    has_room_ = choice.without_room == 0;
    clusters_->end_frame();
    most_without_room_ = std::max(most_without_room_, choice.without_room);
    return {};
}

// Of one whose group has given way nobody knows where it is: it waits for that, as if it were not here. The
// coarsest do not.
bool ClusterScene::is_here(std::uint32_t cluster) const {
    return store_.is_here(cluster) && (clusters_->known_reach(cluster) != nullptr ||
                                       std::ranges::binary_search(clusters_->roots(), cluster));
}

LackingCut ClusterScene::lacking_cut() const {
    return falls_back_to_blocks_ && !level_ ? LackingCut::is_left_out : LackingCut::is_drawn;
}

bool ClusterScene::is_drawn_by_blocks(const StreamedChoice& choice) const {
    return lacking_cut() == LackingCut::is_left_out && choice.missing > 0 && choice.without_room == 0;
}

// What is wanted and here is to stay.
Result<StreamedChoice> ClusterScene::choose_here() {
    ORO_TRY(StreamedChoice choice, select_resident_cut(
                                       *clusters_, *view_, store_.capacity() - clusters_->roots().size(),
                                       [&](std::uint32_t cluster) { return is_here(cluster); }, shown_,
                                       &choice_memory_, lacking_cut()));
    for (const std::uint32_t cluster : choice.clusters_wanted)
        if (store_.is_here(cluster)) store_.use(cluster);
    return choice;
}

void ClusterScene::request(const StreamedChoice& choice) {
    stream_->request(*view_, choice.groups_wanted, choice.clusters_to_come, choice.groups_hidden,
                     choice.to_come_hidden);
}

void ClusterScene::apply_feedback(const FrameFeedback& feedback) {
    shown_ = shown_clusters(feedback.clusters, feedback.words);
    for (const auto& [cluster, shows] : shown_) store_.mark_occluded(cluster, !shows);
    clusters_->mark_occluded(hidden_groups(feedback.clusters, shown_));
}

void ClusterScene::forget_frames() {
    apply_feedback({});
    if (stream_) stream_->cancel();
    view_.reset();
    drawn_.clear();
    is_whole_ = has_room_ = false;
    if (!has_capacity()) store_.clear();
}

bool ClusterScene::has_capacity() const {
    return store_.size() < store_.capacity() && groups().bytes() + bytes_on_the_way <= groups().most_bytes();
}

void ClusterScene::keep(ClusterStream::Ready& ready) {
    for (RegionClusters::LoadedGroup& group : ready.groups) clusters_->keep(group);
    for (const RegionClusters::LoadedCluster& cluster : ready.clusters)
        clusters_->keep(cluster.number, cluster.reach);
}

// A group's clusters come with it: which of them are wanted is known once it is.
Result<StreamedChoice> ClusterScene::send_wanted(const ClusterStream::Ready& ready) {
    store_.begin_frame();
    ORO_TRY(StreamedChoice choice, choose_here());
    std::ranges::fill(is_wanted_, char{0});
    for (const std::uint32_t cluster : choice.clusters_to_come) {
        if (cluster >= is_wanted_.size()) is_wanted_.resize(cluster + std::size_t{1});
        is_wanted_[cluster] = 1;
    }
    ORO_CHECK(store_.send(loaded_of(ready, [&](const RegionClusters::LoadedCluster& cluster) {
        return cluster.number < is_wanted_.size() && is_wanted_[cluster.number] != 0;
    })));
    return Result<StreamedChoice>(std::move(choice));
}

// What is wanted stays so when some of it has come: the same clusters, those that are here left out.
void ClusterScene::request_rest(StreamedChoice choice) {
    std::vector<std::uint32_t>& to_come = choice.clusters_to_come;
    const auto first_hidden = to_come.end() - static_cast<std::ptrdiff_t>(choice.to_come_hidden);
    const auto came = [&](std::uint32_t cluster) { return is_here(cluster); };
    choice.to_come_hidden -= static_cast<std::size_t>(std::count_if(first_hidden, to_come.end(), came));
    std::erase_if(to_come, came);
    request(choice);
}

// Where all has room nothing is chosen: the next plan says what is wanted, and until then the background goes
// on with what the last one has requested.
Result<void> ClusterScene::send_ahead(const ClusterStream::Ready& ready) {
    std::size_t count = ready.clusters.size();
    for (const RegionClusters::LoadedGroup& group : ready.groups) count += group.seen.size();
    if (store_.size() + count <= store_.capacity())
        return store_.send(loaded_of(ready, [](const RegionClusters::LoadedCluster&) { return true; }));
    ORO_TRY(StreamedChoice sent, send_wanted(ready));
    request_rest(std::move(sent));
    return {};
}

Result<bool> ClusterScene::advance(NextPlan next) {
    if (!view_) return false;
    ORO_TRY(ClusterStream::Ready ready, stream_->take());
    if (ready.groups.empty() && ready.clusters.empty()) return false;
    keep(ready);
    if (next == NextPlan::anyway) {
        ORO_CHECK(send_ahead(ready));
        return true;
    }
    ORO_CHECK(send_wanted(ready));
    ORO_TRY(const StreamedChoice choice, choose_here());
    request(choice);
    const bool is_other = !is_drawn_by_blocks(choice) && choice.drawn.clusters != drawn_;
    return is_other || (choice.missing == 0) != is_whole_ || (choice.without_room == 0) != has_room_;
}

Result<void> ClusterScene::draw(const ClusterChoice& choice, const ClusterOffer& offer, const Camera& camera,
                                GridPlan& plan) {
    std::vector<ResidentCluster> resident;
    resident.reserve(offer.clusters.size());
    std::deque<ClusterReach> others;  // of those that are kept with no group
    for (const OfferedCluster& offered : offer.clusters) {
        const ClusterStore::Held held = store_.use(offered.cluster);
        const ClusterReach* reach = clusters_->known_reach(offered.cluster);
        if (reach == nullptr) {
            ORO_TRY(const ClusterReach found, clusters_->reach(offered.cluster));
            reach = &others.emplace_back(found);
        }
        resident.push_back({held.address, held.counts, offered, reach});
    }
    draw_clusters(clusters_->grid(), resident, offer, camera, plan, &angles_);
    plan.clusters.groups_opened = choice.groups_opened;
    plan.clusters.beyond_frustum = choice.beyond_frustum;
    plan.clusters.beyond_horizon = choice.beyond_horizon;
    return {};
}

}  // namespace oro
