// Groups and clusters on their way from their file: read, decoded and measured by threads in the background.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "core/cache/loader.h"
#include "core/cluster_frame/cluster_view.h"
#include "core/cluster_frame/region_clusters.h"

namespace oro {

// It goes on from group to group by itself, so a frame that takes long keeps it from nothing.
class ClusterStream {
  public:
    // `capacity`: so many groups and clusters may be under way or ready, at least 1; 2 KB a cluster, some 20
    // KB a group. `clusters` outlives the stream. Threads as in Loader.
    ClusterStream(const RegionClusters& clusters, const HeightQuantization& coding, int threads,
                  std::size_t capacity);

    // What an eye needs now and is not here, each most wanted first, groups before clusters; the last so many
    // of both, and what comes after those groups, when nothing else is requested. Groups that are held are
    // not loaded. It takes the place of what was requested before; what is ready stays. With a group come its
    // clusters that can be seen, and what made those that it uses, where the group is not selected.
    void request(const ClusterView& view, std::span<const std::uint32_t> groups,
                 std::span<const std::uint32_t> clusters, std::size_t last_groups = 0,
                 std::size_t last_clusters = 0);
    void cancel();

    struct Ready {
        std::vector<RegionClusters::LoadedGroup> groups;
        std::vector<RegionClusters::LoadedCluster> clusters;
    };
    // What is ready, in the order in which it became so; does not wait. Errors: damage (told once). What a
    // thread threw (std::bad_alloc) is thrown here.
    Result<Ready> take();

  private:
    struct Key {
        bool is_group;
        std::uint32_t number;
        auto operator<=>(const Key&) const = default;
    };
    using Item = std::variant<RegionClusters::LoadedGroup, RegionClusters::LoadedCluster>;
    using ItemLoader = Loader<Key, Item>;
    Result<Item> load(const ItemLoader::Request& request);
    // Requests groups that made what a loaded one uses, of those that can be seen.
    void request_below(const RegionClusters::LoadedGroup& loaded, int priority);

    const RegionClusters& clusters_;
    HeightQuantization coding_;
    std::mutex mutex_;  // of the two below; it is locked before what the loader locks
    std::optional<ClusterView> view_;
    bool is_cancelled_{false};
    ItemLoader loader_;  // last: its threads end before what they use
};

}  // namespace oro
