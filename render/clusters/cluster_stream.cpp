#include "render/clusters/cluster_stream.h"

#include <algorithm>
#include <iterator>

#include "core/base/parallel.h"

namespace oro {

ClusterStream::ClusterStream(const RegionClusters& clusters, const HeightQuantization& coding, int threads,
                             std::size_t capacity)
    : clusters_(clusters),
      coding_(coding),
      most_threads_(std::max(1, threads)),
      capacity_(std::max<std::size_t>(1, capacity)),
      ways_(clusters.groups().size(), Way::none) {}

ClusterStream::~ClusterStream() {
    for (std::jthread& thread : threads_) thread.request_stop();
    changed_.notify_all();
}

void ClusterStream::want(const ClusterView& view, std::span<const std::uint32_t> groups,
                         std::span<const std::uint32_t> clusters, std::size_t last_groups,
                         std::size_t last_clusters) {
    if (!(groups.empty() && clusters.empty()) && most_threads_ > 0)
        start_threads(threads_, std::exchange(most_threads_, 0),
                      [this](const std::stop_token& stop) { work(stop); });
    const std::scoped_lock lock(mutex_);
    view_ = view;
    for (const std::uint32_t group : taken_) ways_[group] = Way::given;
    taken_.clear();
    std::set<std::uint32_t> here;
    for (const Item& item : under_way_)
        if (!item.is_group) here.insert(item.number);
    for (const auto& loaded : ready_.clusters) here.insert(loaded.number);
    wanted_.clear();
    const auto add = [&](std::span<const std::uint32_t> these, bool are_groups, bool are_last) {
        for (const std::uint32_t number : these)
            if (are_groups ? may_begin(number) : !here.contains(number))
                wanted_.push_back({are_groups, number, are_last});
    };
    add(groups.first(groups.size() - last_groups), true, false);
    add(clusters.first(clusters.size() - last_clusters), false, false);
    add(groups.last(last_groups), true, true);
    add(clusters.last(last_clusters), false, true);
    changed_.notify_all();
}

void ClusterStream::want_nothing() {
    const std::scoped_lock lock(mutex_);
    wanted_.clear();
    view_.reset();
}

Result<ClusterStream::Ready> ClusterStream::take() {
    std::unique_lock lock(mutex_);
    if (threads_.empty() && ready_count_ == 0 && !wanted_.empty()) load_next(lock);
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    if (failed_) return *std::exchange(failed_, std::nullopt);
    Ready ready = std::exchange(ready_, {});
    ready_count_ = 0;
    for (const RegionClusters::LoadedGroup& group : ready.groups) taken_.push_back(group.number);
    changed_.notify_all();
    return ready;
}

void ClusterStream::work(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    for (;;) {
        const auto can_begin = [&] { return !wanted_.empty() && ready_count_ < capacity_; };
        if (!changed_.wait(lock, stop, can_begin)) return;
        load_next(lock);
    }
}

void ClusterStream::load_next(std::unique_lock<std::mutex>& lock) {
    const Item item = wanted_.front();
    wanted_.pop_front();
    if (item.is_group && !may_begin(item.number)) return;  // two groups may lead to it
    try {
        under_way_.insert(item);
        if (item.is_group) {
            ways_[item.number] = Way::begun;
            load_group(item, lock);
        } else {
            load_cluster(item.number, lock);
        }
    } catch (...) {  // no memory: the caller's business, not this thread's
        if (!lock.owns_lock()) lock.lock();
        thrown_ = std::current_exception();
        wanted_.clear();
    }
    under_way_.erase(item);
    changed_.notify_all();
}

void ClusterStream::load_group(const Item& item, std::unique_lock<std::mutex>& lock) {
    const std::uint32_t group = item.number;
    const ClusterView view = *view_;
    lock.unlock();
    const RegionClusters::SeenOfGroup seen{
        [&](const ClusterReach& reach) { return view.look_at(reach).seen == ClusterView::Seen::yes; },
        !view.stands(clusters_.groups()[group]), coding_};
    Result<RegionClusters::LoadedGroup> loaded = clusters_.load_group(group, &seen);
    lock.lock();
    if (!loaded.ok()) return fail(loaded.error());
    if (view_ && !view_->stands(clusters_.groups()[group])) want_below(*loaded, item.is_last);
    ready_count_ += 1 + loaded->seen.size();
    ready_.groups.push_back(std::move(loaded).value());
}

bool ClusterStream::may_begin(std::uint32_t group) const {
    return ways_[group] == Way::none || (ways_[group] == Way::given && !clusters_.is_held(group));
}

void ClusterStream::want_below(const RegionClusters::LoadedGroup& loaded, bool is_last) {
    const auto end =
        is_last ? wanted_.end()
                : std::ranges::partition_point(wanted_, [](const Item& item) { return !item.is_last; });
    std::vector<Item> below;
    for (const std::uint32_t member : loaded.part->members) {
        const std::uint32_t maker = clusters_.maker(member);
        if (maker != no_group && may_begin(maker) && !view_->is_beyond_frustum(clusters_.groups()[maker]))
            below.push_back({true, maker, is_last});
    }
    wanted_.insert(end, below.begin(), below.end());
}

void ClusterStream::load_cluster(std::uint32_t cluster, std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    Result<RegionClusters::LoadedCluster> loaded = clusters_.load_cluster(cluster, coding_);
    lock.lock();
    if (!loaded.ok()) return fail(loaded.error());
    ++ready_count_;
    ready_.clusters.push_back(std::move(loaded).value());
}

void ClusterStream::fail(const Error& error) {
    if (!failed_) failed_ = error;
    wanted_.clear();
}

}  // namespace oro
