#include "render/clusters/cluster_stream.h"

#include <utility>

namespace oro {
namespace {

constexpr int priority_now = 0, priority_last = 1;

}  // namespace

ClusterStream::ClusterStream(const RegionClusters& clusters, const HeightQuantization& coding, int threads,
                             std::size_t capacity)
    : clusters_(clusters),
      coding_(coding),
      loader_([this](const ItemLoader::Request& request) { return load(request); }, threads, capacity,
              [](const Item& item) {
                  const auto* const group = std::get_if<RegionClusters::LoadedGroup>(&item);
                  return 1 + (group == nullptr ? 0 : group->seen.size());
              }) {}

void ClusterStream::request(const ClusterView& view, std::span<const std::uint32_t> groups,
                            std::span<const std::uint32_t> clusters, std::size_t last_groups,
                            std::size_t last_clusters) {
    std::vector<ItemLoader::Request> requests;
    for (std::size_t i = 0; i < groups.size(); ++i)
        if (!clusters_.is_held(groups[i]))
            requests.push_back(
                {{true, groups[i]}, i + last_groups < groups.size() ? priority_now : priority_last});
    for (std::size_t i = 0; i < clusters.size(); ++i)
        requests.push_back(
            {{false, clusters[i]}, i + last_clusters < clusters.size() ? priority_now : priority_last});
    const std::scoped_lock lock(mutex_);
    view_ = view;
    is_cancelled_ = false;
    loader_.request(std::move(requests), false);
}

void ClusterStream::cancel() {
    const std::scoped_lock lock(mutex_);
    is_cancelled_ = true;
    loader_.request(std::vector<ItemLoader::Request>(), false);
}

Result<ClusterStream::Ready> ClusterStream::take() {
    ORO_TRY(std::vector<Item> items, loader_.take(false));
    Ready ready;
    for (Item& item : items) {
        if (auto* const group = std::get_if<RegionClusters::LoadedGroup>(&item))
            ready.groups.push_back(std::move(*group));
        else
            ready.clusters.push_back(std::get<RegionClusters::LoadedCluster>(std::move(item)));
    }
    return ready;
}

Result<ClusterStream::Item> ClusterStream::load(const ItemLoader::Request& request) {
    const std::uint32_t number = request.key.number;
    if (!request.key.is_group) {
        ORO_TRY(RegionClusters::LoadedCluster cluster, clusters_.load_cluster(number, coding_));
        return Item(std::move(cluster));
    }
    const auto view = [&] {
        const std::scoped_lock lock(mutex_);
        return *view_;
    }();
    const ClusterGroup& group = clusters_.groups()[number];
    const RegionClusters::SeenOfGroup seen{
        [&](const ClusterReach& reach) { return view.look_at(reach).seen == ClusterView::Seen::yes; },
        !view.stands(group), coding_};
    ORO_TRY(RegionClusters::LoadedGroup loaded, clusters_.load_group(number, &seen));
    const std::scoped_lock lock(mutex_);
    if (!is_cancelled_ && !view_->stands(group)) request_below(loaded, request.priority);
    return Item(std::move(loaded));
}

void ClusterStream::request_below(const RegionClusters::LoadedGroup& loaded, int priority) {
    std::vector<Key> below;
    for (const std::uint32_t member : loaded.part->members) {
        const std::uint32_t maker = clusters_.maker(member);
        if (maker != no_group && !clusters_.is_held(maker) &&
            !view_->is_beyond_frustum(clusters_.groups()[maker]))
            below.push_back({true, maker});
    }
    loader_.add(below, priority);
}

}  // namespace oro
