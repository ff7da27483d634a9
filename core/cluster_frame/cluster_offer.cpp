#include "core/cluster_frame/cluster_offer.h"

#include <algorithm>
#include <span>

#include "core/base/radix_order.h"
#include "core/cluster_frame/cluster_choice.h"

namespace oro {

OfferedCut::OfferedCut(const RegionClusters& clusters, const ClusterView& view, OfferMemory& memory)
    : clusters_(clusters), view_(view), memory_(memory) {
    memory_.must_be_deselected.resize(clusters.groups().size());
    memory_.numbers.resize(clusters.groups().size(), gpu::no_asked_group);
}

OfferedCut::~OfferedCut() {
    for (const std::uint32_t group : memory_.touched) {
        memory_.must_be_deselected[group] = 0;
        memory_.numbers[group] = gpu::no_asked_group;
    }
    memory_.touched.clear();
}

void OfferedCut::deselect(std::uint32_t group) {
    if (memory_.must_be_deselected[group] != 0) return;
    memory_.touched.push_back(group);
    memory_.must_be_deselected[group] = 1;
}

void OfferedCut::add_coarser(double distance_m, std::uint32_t cluster, std::uint32_t user, bool is_here) {
    if (is_here)
        coarser_.push_back({distance_m, cluster, user});
    else
        deselect(clusters_.maker(cluster));
}

std::uint32_t OfferedCut::ask(std::uint32_t group) {
    if (group == no_group || memory_.must_be_deselected[group] != 0) return gpu::no_asked_group;
    std::uint32_t& number = memory_.numbers[group];
    if (number == gpu::no_asked_group) {
        memory_.touched.push_back(group);
        number = static_cast<std::uint32_t>(offer_.asked.size());
        offer_.asked.push_back(view_.measured(clusters_.groups()[group]));
    }
    return number;
}

void OfferedCut::offer(std::vector<OfferFound>& found) {
    // Distances are at least 0, and no number stands twice.
    sort_by_distance(
        found, memory_.sorting, [](const OfferFound& one) { return one.distance_m; },
        [](const OfferFound& a, const OfferFound& b) {
            return a.distance_m != b.distance_m ? a.distance_m < b.distance_m : a.cluster < b.cluster;
        });
    for (const auto& [distance_m, cluster, user] : found) {
        const std::uint32_t maker = clusters_.maker(cluster);
        offer_.clusters.push_back(
            {cluster, maker == no_group ? user : maker, gpu::no_asked_group, ask(user)});
    }
}

ClusterOffer OfferedCut::take(std::span<const std::uint32_t> opened) {
    // Where a group cannot stand none above it can.
    for (auto group = opened.rbegin(); group != opened.rend(); ++group) {
        if (memory_.must_be_deselected[*group] == 0) continue;
        for (const Cluster& made : clusters_.read_part(*group)->made)
            if (made.used_by != no_group) deselect(made.used_by);
    }
    std::erase_if(coarser_, [&](const OfferFound& found) {
        return memory_.must_be_deselected[clusters_.maker(found.cluster)] != 0;
    });
    offer_.clusters.reserve(of_cut_.size() + coarser_.size());
    offer(of_cut_);
    offer_.in_cut = offer_.clusters.size();
    offer(coarser_);
    for (OfferedCluster& coarser : std::span(offer_.clusters).subspan(offer_.in_cut))
        coarser.made_by = ask(coarser.group);
    offer_.rule = view_.cut_rule();
    return std::move(offer_);
}

ClusterOffer offer_of(const ClusterChoice& choice) {
    ClusterOffer offer;
    for (std::size_t i = 0; i < choice.clusters.size(); ++i)
        offer.clusters.push_back(
            {choice.clusters[i], choice.groups[i], gpu::no_asked_group, gpu::no_asked_group});
    offer.in_cut = offer.clusters.size();
    return offer;
}

}  // namespace oro
