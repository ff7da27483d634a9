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

#include "core/cluster_frame/cluster_view.h"
#include "core/cluster_frame/region_clusters.h"

namespace oro {

// It goes on from group to group by itself, so a frame that takes long keeps it from nothing.
class ClusterStream {
  public:
    // `capacity`: with so many groups and clusters ready no more are begun, at least 1; 2 KB a cluster, some
    // 20 KB a group. `clusters` outlives the stream. Threads begin with what is wanted first. Where
    // fewer are to be had, or none, it does with those: without any, take() loads one thing a time.
    ClusterStream(const RegionClusters& clusters, const HeightQuantization& coding, int threads,
                  std::size_t capacity);
    ~ClusterStream();
    ClusterStream(const ClusterStream&) = delete;
    ClusterStream& operator=(const ClusterStream&) = delete;

    // What an eye needs now and is not here, each most wanted first, groups before clusters; the last so many
    // of both, and what comes after those groups, when nothing else is wanted. What was taken before is kept
    // by now, or has given way. What was wanted before and is not any more is dropped. With a group come its
    // clusters that can be seen, and what made those that it uses, where it gives way.
    void want(const ClusterView& view, std::span<const std::uint32_t> groups,
              std::span<const std::uint32_t> clusters, std::size_t last_groups = 0,
              std::size_t last_clusters = 0);
    void want_nothing();

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
        bool is_last;
        auto operator<=>(const Item&) const = default;
    };
    void work(const std::stop_token& stop);
    // Loads what is most wanted; there is something. Lets go of the lock meanwhile.
    void load_next(std::unique_lock<std::mutex>& lock);
    void load_group(const Item& item, std::unique_lock<std::mutex>& lock);
    void load_cluster(std::uint32_t cluster, std::unique_lock<std::mutex>& lock);
    void fail(const Error& error);
    // It is neither on its way nor here.
    [[nodiscard]] bool may_begin(std::uint32_t group) const;
    // Groups that made what a loaded one uses, of those that can be seen. is_last: as the loaded one.
    void want_below(const RegionClusters::LoadedGroup& loaded, bool is_last);

    const RegionClusters& clusters_;
    HeightQuantization coding_;
    int most_threads_;  // to be begun; 0: they are
    std::size_t capacity_;
    std::optional<ClusterView> view_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::deque<Item> wanted_;  // those that are last come last
    std::set<Item> under_way_;
    // Of each group. begun: it is under way, ready, or could not be loaded. given: it was taken; it is here
    // as long as it is held.
    enum class Way : char { none, begun, given };
    std::vector<Way> ways_;
    std::vector<std::uint32_t> taken_;  // groups, since something was wanted
    Ready ready_;
    std::size_t ready_count_{};  // groups and clusters, those of groups, too
    std::optional<Error> failed_;
    std::exception_ptr thrown_;
    std::vector<std::jthread> threads_;  // last: they end before what they use
};

}  // namespace oro
