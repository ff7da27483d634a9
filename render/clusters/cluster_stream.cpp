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
      capacity_(std::max<std::size_t>(1, capacity)) {}

ClusterStream::~ClusterStream() {
    for (std::jthread& thread : threads_) thread.request_stop();
    changed_.notify_all();
}

void ClusterStream::want(std::span<const std::uint32_t> groups, std::span<const std::uint32_t> clusters) {
    if (!(groups.empty() && clusters.empty()) && most_threads_ > 0)
        start_threads(threads_, std::exchange(most_threads_, 0),
                      [this](const std::stop_token& stop) { work(stop); });
    const std::scoped_lock lock(mutex_);
    std::set<Item> needed;
    for (const std::uint32_t group : groups) needed.insert({true, group});
    for (const std::uint32_t cluster : clusters) needed.insert({false, cluster});
    // A group that is read stays of use.
    std::erase_if(ready_.clusters, [&](const auto& loaded) {
        return !needed.contains({false, loaded.number});
    });
    std::set<Item> here = under_way_;
    for (const auto& loaded : ready_.groups) here.insert({true, loaded.number});
    for (const auto& loaded : ready_.clusters) here.insert({false, loaded.number});
    wanted_.clear();
    const auto add = [&](const Item& item) {
        if (!here.contains(item)) wanted_.push_back(item);
    };
    for (const std::uint32_t group : groups) add({true, group});
    for (const std::uint32_t cluster : clusters) add({false, cluster});
    changed_.notify_all();
}

Result<ClusterStream::Ready> ClusterStream::take() {
    std::unique_lock lock(mutex_);
    if (threads_.empty() && count_ready() == 0 && !wanted_.empty()) load_next(lock);
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    if (failed_) return *std::exchange(failed_, std::nullopt);
    Ready ready = std::exchange(ready_, {});
    changed_.notify_all();
    return ready;
}

void ClusterStream::work(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    for (;;) {
        const auto can_begin = [&] {
            return !wanted_.empty() && under_way_.size() + count_ready() < capacity_;
        };
        if (!changed_.wait(lock, stop, can_begin)) return;
        load_next(lock);
    }
}

void ClusterStream::load_next(std::unique_lock<std::mutex>& lock) {
    const Item item = wanted_.front();
    wanted_.pop_front();
    const auto fail = [&](const Error& error) {
        if (!failed_) failed_ = error;
        wanted_.clear();
    };
    try {
        under_way_.insert(item);
        lock.unlock();
        if (item.is_group) {
            Result<RegionClusters::LoadedGroup> loaded = clusters_.load_group(item.number);
            lock.lock();
            if (loaded.ok())
                ready_.groups.push_back(std::move(loaded).value());
            else
                fail(loaded.error());
        } else {
            Result<RegionClusters::LoadedCluster> loaded = clusters_.load_cluster(item.number, coding_);
            lock.lock();
            if (loaded.ok())
                ready_.clusters.push_back(std::move(loaded).value());
            else
                fail(loaded.error());
        }
    } catch (...) {  // no memory: the caller's business, not this thread's
        if (!lock.owns_lock()) lock.lock();
        thrown_ = std::current_exception();
        wanted_.clear();
    }
    under_way_.erase(item);
    changed_.notify_all();
}

}  // namespace oro
