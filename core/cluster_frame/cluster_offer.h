// What the GPU makes its own cut of: clusters that are there, and the groups that it asks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/cluster_frame/cluster_view.h"
#include "core/cluster_frame/region_clusters.h"

namespace oro {

struct OfferedCluster {
    std::uint32_t cluster;
    std::uint32_t group;             // gpu::DrawnCluster::group
    std::uint32_t made_by, used_by;  // likewise: numbers in ClusterOffer::asked, or gpu::no_asked_group
};

// Clusters of a cut and of some that are coarser. Whatever the rule says of the groups that are asked, as
// long as all below one that stands stand: those clusters that it makes the cut of cover each place in view
// once. By the rule itself it is the cut; by one for a larger tau, or a higher level, as far as coarser
// clusters are there.
struct ClusterOffer {
    std::vector<OfferedCluster> clusters;  // of the cut, nearest first; then the coarser ones, likewise
    std::size_t in_cut{};
    std::vector<gpu::AskedGroup> asked;
    gpu::CutRule rule{};
};

// A cluster that may be offered.
struct OfferFound {
    double distance_m;
    std::uint32_t cluster, user;
};

// What offers of a region's clusters keep from one to the next: room alone.
struct OfferMemory {
    std::vector<char> must_be_deselected;  // of each group
    std::vector<std::uint32_t> numbers;    // of each group among those that are asked, or no_asked_group
    std::vector<std::uint32_t> touched;    // groups that have another entry than at the beginning
    std::vector<OfferFound> sorting;       // as sort_by_distance() has it
};

// Gathers one. Groups that do not give way are not asked: what they use is not offered.
class OfferedCut {
  public:
    // The clusters, the view and the memory outlive the cut.
    OfferedCut(const RegionClusters& clusters, const ClusterView& view, OfferMemory& memory);
    ~OfferedCut();
    OfferedCut(const OfferedCut&) = delete;
    OfferedCut& operator=(const OfferedCut&) = delete;

    // A cluster of the cut that is seen. user: the group that uses it, which gives way; no_group: none does.
    void add_of_cut(double distance_m, std::uint32_t cluster, std::uint32_t user) {
        of_cut_.push_back({distance_m, cluster, user});
    }
    // One that is seen whose maker gives way; is_here: on the GPU.
    void add_coarser(double distance_m, std::uint32_t cluster, std::uint32_t user, bool is_here);
    // opened: groups that give way, those that use what others made before these. All were read.
    [[nodiscard]] ClusterOffer take(std::span<const std::uint32_t> opened);

  private:
    // Its number among those that are asked.
    std::uint32_t ask(std::uint32_t group);
    void offer(std::vector<OfferFound>& found);
    void deselect(std::uint32_t group);

    const RegionClusters& clusters_;
    const ClusterView& view_;
    OfferMemory& memory_;
    std::vector<OfferFound> of_cut_, coarser_;
    ClusterOffer offer_;
};

struct ClusterChoice;
// Of clusters that were chosen, without any that is coarser: no group is asked.
ClusterOffer offer_of(const ClusterChoice& choice);

}  // namespace oro
