#include "core/cluster_frame/cluster_offer.h"

#include <algorithm>
#include <ranges>

#include "core/cluster_frame/cluster_choice.h"

namespace oro {

void OfferedCut::add_coarser(double distance_m, std::uint32_t cluster, std::uint32_t user, bool is_here) {
    if (is_here) {
        coarser_.emplace_back(distance_m, cluster, user);
        return;
    }
    must_be_deselected_[clusters_.maker(cluster)] = true;
}

std::uint32_t OfferedCut::ask(std::uint32_t group) {
    if (group == no_group || must_be_deselected_[group]) return gpu::no_asked_group;
    if (numbers_[group] == gpu::no_asked_group) {
        numbers_[group] = static_cast<std::uint32_t>(offer_.asked.size());
        offer_.asked.push_back(view_.measured(clusters_.groups()[group]));
    }
    return numbers_[group];
}

void OfferedCut::offer(std::vector<Found>& found) {
    std::ranges::sort(found);
    for (const auto& [distance_m, cluster, user] : found) {
        const std::uint32_t maker = clusters_.maker(cluster);
        offer_.clusters.push_back(
            {cluster, maker == no_group ? user : maker, gpu::no_asked_group, ask(user)});
    }
}

ClusterOffer OfferedCut::take(std::span<const std::uint32_t> opened) {
    // Where a group cannot stand none above it can.
    for (const std::uint32_t group : opened | std::views::reverse) {
        if (!must_be_deselected_[group]) continue;
        for (const Cluster& made : clusters_.read_part(group)->made)
            if (made.used_by != no_group) must_be_deselected_[made.used_by] = true;
    }
    std::erase_if(coarser_, [&](const Found& found) {
        return must_be_deselected_[clusters_.maker(std::get<1>(found))];
    });
    offer(of_cut_);
    offer_.in_cut = offer_.clusters.size();
    offer(coarser_);
    for (OfferedCluster& coarser : offer_.clusters | std::views::drop(offer_.in_cut))
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
