// What a frame offers the GPU: whatever rule it goes by, each place is covered once.
#include <cstdio>
#include <random>
#include <ranges>

#include "tests/core/cluster_frame/streamed_choices.h"

namespace oro {
namespace {

using test::Numbers;
using Seen = ClusterView::Seen;

class ClusterOffers : public test::StreamedChoices {
  protected:
    // As choose_clusters.comp does.
    static ClusterChoice cut_of_offer(const ClusterOffer& offer, const gpu::CutRule& rule) {
        const auto stands_in = [&](std::uint32_t asked) { return stands(offer.asked[asked], rule); };
        ClusterChoice cut;
        for (const OfferedCluster& cluster : offer.clusters) {
            if (cluster.made_by != gpu::no_asked_group && !stands_in(cluster.made_by)) continue;
            if (cluster.used_by != gpu::no_asked_group && stands_in(cluster.used_by)) continue;
            cut.clusters.push_back(cluster.cluster);
        }
        return cut;
    }
    // By loops over all of the graph: groups that give way, but may stand: all that they made, and that all
    // above them made, is here, as far as it can be seen.
    Numbers may_stand(RegionClusters& region, const ClusterView& view, const Numbers& all_deselected,
                      const Numbers& here) {
        Numbers may = all_deselected;
        for (bool changed = true; changed;) {
            changed = std::erase_if(may, [&](std::uint32_t number) {
                          return lacks(region, view, number, all_deselected, here) ||
                                 lower_must_be_deselected(number, all_deselected, may);
                      }) > 0;
        }
        return may;
    }
    bool lacks(RegionClusters& region, const ClusterView& view, std::uint32_t number,
               const Numbers& all_deselected, const Numbers& here) {
        const ClusterGroup& group = graph_.groups[number];
        for (std::uint32_t made = group.first_made; made < group.first_made + group.made; ++made) {
            const std::uint32_t user = graph_.clusters[made].used_by;
            if (user != no_group && !all_deselected.contains(user)) continue;
            if (!here.contains(made) && view.look_at(*region.reach(made)).seen == Seen::yes) return true;
        }
        return false;
    }
    bool lower_must_be_deselected(std::uint32_t number, const Numbers& all_deselected, const Numbers& may) {
        return std::ranges::any_of(graph_.members_of(graph_.groups[number]), [&](std::uint32_t member) {
            const std::uint32_t maker = graph_.clusters[member].made_by;
            return maker != no_group && all_deselected.contains(maker) && !may.contains(maker);
        });
    }
};

// The frame's own rule makes its cut; a coarser one a coarser cut, as far as there is one.
TEST_F(ClusterOffers, AreACutByAnyRuleThatAsksForLess) {
    constexpr unsigned seed = 335;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const test::Whole whole = test::whole_of(terrain_.surface);
    std::size_t coarser = 0, bound = 0, asked = 0;
    for (int i = 0; i < 14; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        const auto region = clusters();
        for (std::uint32_t group = 0; group < graph_.groups.size(); ++group) read(*region, group);
        const double here_share = i % 4 == 0 ? 1.0 : 1.0 - 0.3 * std::pow(unit(random), 4.0);
        Numbers here(region->roots().begin(), region->roots().end());
        for (std::uint32_t cluster = 0; cluster < graph_.clusters.size(); ++cluster)
            if (unit(random) <= here_share) here.insert(cluster);
        const Camera camera = test::random_camera(random, terrain_.field);
        const ClusterView eye = view(camera, 1.0);
        const Numbers all_deselected = brute_force(*region, eye, here);
        const StreamedChoice choice = choose(*region, eye, 1'000'000, here);
        EXPECT_EQ(cut_of_offer(choice.offer, choice.offer.rule).clusters, choice.drawn.clusters);
        asked += choice.offer.asked.size();
        // A picture that waits asks nothing: its cut is all that is there.
        const ClusterOffer waits = offer_of(choice.drawn);
        EXPECT_TRUE(waits.asked.empty());
        EXPECT_EQ(cut_of_offer(waits, choice.offer.rule).clusters, choice.drawn.clusters);
        const Numbers may = may_stand(*region, eye, all_deselected, here);
        for (const ClusterView& other :
             {view(camera, 1.5), view(camera, 8.0), view(camera, 1.0, 1 + i % 6)}) {
            Numbers deselected = all_deselected;
            std::erase_if(deselected, [&](std::uint32_t group) {
                return may.contains(group) && other.stands(graph_.groups[group]);
            });
            const ClusterChoice cut = cut_of_offer(choice.offer, other.cut_rule());
            expect_cut(*region, eye, whole, deselected, cut);
            coarser += deselected.size() < all_deselected.size() ? 1 : 0;
            bound += may.size() < all_deselected.size() ? 1 : 0;
        }
    }
    std::printf("seed %u: 14 eyes, %zu groups asked, %zu of 42 cuts coarser than the frame's, %zu bound\n",
                seed, asked, coarser, bound);
    EXPECT_GT(asked, 150U);
    EXPECT_GT(coarser, 14U);
    EXPECT_GT(bound, 5U);
}

}  // namespace
}  // namespace oro
