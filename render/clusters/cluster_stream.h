// Groups and clusters on their way from their file: read, decoded and measured by threads in the background.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "core/cluster_frame/region_clusters.h"

namespace oro {

class ClusterStream {
  public:
    // `capacity`: groups and clusters that may be under way or ready at a time, at least 1; 2 KB a cluster,
    // some 20 KB a group. `clusters` outlives the stream. Threads begin with what is wanted first. Where
    // fewer are to be had, or none, it does with those: without any, take() loads one thing a time.
    ClusterStream(const RegionClusters& clusters, const HeightQuantization& coding, int threads,
                  std::size_t capacity);
    ~ClusterStream();
    ClusterStream(const ClusterStream&) = delete;
    ClusterStream& operator=(const ClusterStream&) = delete;

    // What is needed now, each most wanted first, groups before clusters; makers of clusters were read. What
    // was wanted before and is not any more is dropped.
    void want(std::span<const std::uint32_t> groups, std::span<const std::uint32_t> clusters);

    struct Ready {
        std::vector<RegionClusters::LoadedGroup> groups;
        std::vector<RegionClusters::LoadedCluster> clusters;
    };
    // What is ready, in the order in which it became so; does not wait. Errors: damage (told once). What a
    // thread threw (std::bad_alloc) is thrown here.
    Result<Ready> take();

  private:
    struct Item {
        bool is_group;
        std::uint32_t number;
        auto operator<=>(const Item&) const = default;
    };
    void work(const std::stop_token& stop);
    // Loads what is most wanted; there is something. Lets go of the lock meanwhile.
    void load_next(std::unique_lock<std::mutex>& lock);
    [[nodiscard]] std::size_t count_ready() const { return ready_.groups.size() + ready_.clusters.size(); }

    const RegionClusters& clusters_;
    HeightQuantization coding_;
    int most_threads_;  // to be begun; 0: they are
    std::size_t capacity_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::deque<Item> wanted_;
    std::set<Item> under_way_;
    Ready ready_;
    std::optional<Error> failed_;
    std::exception_ptr thrown_;
    std::vector<std::jthread> threads_;  // last: they end before what they use
};

}  // namespace oro
