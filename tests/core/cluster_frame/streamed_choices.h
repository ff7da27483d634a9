// Eyes over a graph in memory of which some is here, for tests of what a frame makes of that.
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "core/cluster_frame/streamed_choice.h"
#include "tests/core/clusters/cut_cover.h"
#include "tests/support/drawn/cracks.h"

namespace oro::test {

using Numbers = std::set<std::uint32_t>;

class StreamedChoices : public ::testing::Test {
  protected:
    explicit StreamedChoices(HeightField field = rough_field(47.0, 8.0, 261, 303))
        : terrain_(std::move(field)) {}

    ClusterTerrain terrain_;
    HorizonOccluder occluder_ = region_shape(terrain_.field, 1.0).occluder;
    const ClusterGraph& graph_ = terrain_.graph;

    std::unique_ptr<RegionClusters> clusters() {
        auto made = clusters_of_graph(graph_, terrain_.field, occluder_);
        EXPECT_TRUE(made.ok()) << made.error().line();
        return std::move(made).value();
    }
    [[nodiscard]] ClusterView view(const Camera& camera, double tau_px,
                                   std::optional<std::uint32_t> level = {}) const {
        return {camera, test_picture(camera), tau_px, {}, occluder_, {}, level};
    }
    static Tile test_picture(const Camera& camera) {
        return {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}};
    }
    static StreamedChoice choose(RegionClusters& region, const ClusterView& view, std::size_t room,
                                 const Numbers& here, const ShownClusters& shown = {}) {
        auto choice = select_resident_cut(
            region, view, room, [&](std::uint32_t c) { return here.contains(c); }, shown);
        EXPECT_TRUE(choice.ok()) << choice.error().line();
        return std::move(choice).value();
    }
    static void read(RegionClusters& region, std::uint32_t group) {
        auto loaded = region.load_group(group);
        ASSERT_TRUE(loaded.ok());
        region.keep(*loaded);
    }

    // By loops over all of the graph: the largest set of groups that may give way.
    [[nodiscard]] Numbers brute_force(RegionClusters& region, const ClusterView& view,
                                      const Numbers& here) const {
        Numbers open;
        for (std::uint32_t i = 0; i < graph_.groups.size(); ++i)
            if (!view.stands(graph_.groups[i]) && !view.is_beyond_frustum(graph_.groups[i]) &&
                region.read_part(i) != nullptr)
                open.insert(i);
        const auto may_open = [&](std::uint32_t group) {
            for (std::uint32_t i = 0; i < graph_.groups[group].made; ++i) {
                const std::uint32_t user = graph_.clusters[graph_.groups[group].first_made + i].used_by;
                if (user != no_group && !open.contains(user)) return false;
            }
            return std::ranges::all_of(graph_.members_of(graph_.groups[group]), [&](std::uint32_t member) {
                const std::uint32_t maker = graph_.clusters[member].made_by;
                if (maker != no_group &&
                    (open.contains(maker) || view.is_beyond_frustum(graph_.groups[maker])))
                    return true;
                const ClusterReach* const reach = region.known_reach(member);
                return here.contains(member) ||
                       (reach != nullptr && view.look_at(*reach).seen != ClusterView::Seen::yes);
            });
        };
        for (bool changed = true; changed;) {
            const auto gone = std::erase_if(open, [&](std::uint32_t group) { return !may_open(group); });
            changed = gone > 0;
        }
        return open;
    }

    // The clusters that are drawn are those of a cut that covers each place once, but for what cannot be
    // seen.
    void expect_cut(RegionClusters& region, const ClusterView& view, const Whole& whole,
                    const Numbers& deselected, const ClusterChoice& drawn) {
        std::vector<char> stands(graph_.groups.size(), 1);
        for (const std::uint32_t group : deselected) stands[group] = 0;
        const auto cut = cut_of(graph_, stands);
        expect_cover(terrain_, whole, cut);
        const Numbers chosen(drawn.clusters.begin(), drawn.clusters.end());
        EXPECT_EQ(chosen.size(), drawn.clusters.size()) << "one is drawn twice";
        Numbers can_be_seen;
        for (const std::uint32_t cluster : cut) {
            const std::uint32_t maker = graph_.clusters[cluster].made_by;
            if (maker != no_group && view.is_beyond_frustum(graph_.groups[maker])) continue;
            if (view.look_at(*region.reach(cluster)).seen == ClusterView::Seen::yes)
                can_be_seen.insert(cluster);
        }
        EXPECT_EQ(chosen, can_be_seen);
    }
};

}  // namespace oro::test
