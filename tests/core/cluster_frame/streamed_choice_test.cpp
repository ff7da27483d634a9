// What a frame draws while its clusters stream: whatever is here, each place once, as fine as may be.
#include "tests/core/cluster_frame/streamed_choices.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <random>

namespace oro {
namespace {

using test::Numbers;
using test::StreamedChoices;

// Random sets of clusters that are here and of groups that were read: each place is covered once, by what is
// here, and no group more could give way.
TEST_F(StreamedChoices, CoverEachPlaceOnceWhateverIsHere) {
    constexpr unsigned seed = 331;
    std::mt19937_64 random(seed);
    const test::Whole whole = test::whole_of(terrain_.surface);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::size_t drawn = 0, coarser = 0, whole_cuts = 0;
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        const auto region = clusters();
        const double read_share = i % 3 == 0 ? 1.0 : 1.0 - 0.2 * std::pow(unit(random), 4.0);
        for (std::uint32_t group = 0; group < graph_.groups.size(); ++group)
            if (unit(random) <= read_share) read(*region, group);
        const double here_share = i % 5 == 0 ? 1.0 : 1.0 - 0.3 * std::pow(unit(random), 4.0);
        Numbers here(region->roots().begin(), region->roots().end());
        for (std::uint32_t cluster = 0; cluster < graph_.clusters.size(); ++cluster) {
            const std::uint32_t maker = graph_.clusters[cluster].made_by;
            const bool is_read = maker == no_group || region->read_part(maker) != nullptr;
            if (is_read && unit(random) <= here_share) here.insert(cluster);
        }
        const Camera camera = test::random_camera(random, terrain_.field);
        const ClusterView eye = view(camera, i % 2 == 0 ? 1.0 : 4.0);
        const Numbers deselected = brute_force(*region, eye, here);
        const StreamedChoice choice = choose(*region, eye, 1'000'000, here);
        for (const std::uint32_t cluster : choice.drawn.clusters) EXPECT_TRUE(here.contains(cluster));
        expect_cut(*region, eye, whole, deselected, choice.drawn);
        EXPECT_EQ(choice.without_room, 0U);
        drawn += choice.drawn.clusters.size();
        (choice.missing > 0 ? coarser : whole_cuts) += 1;
        const auto waited = choose_clusters(*region, eye);
        EXPECT_TRUE(choice.missing > 0 || waited->clusters == choice.drawn.clusters);
        EXPECT_TRUE(choice.missing == 0 || read_share < 1.0 || here_share < 1.0);
    }
    std::printf("seed %u: 60 eyes, %zu clusters drawn, %zu coarser cuts, %zu whole\n", seed, drawn, coarser,
                whole_cuts);
    EXPECT_GT(drawn, 1000U);
    EXPECT_GT(coarser, 10U);
    EXPECT_GT(whole_cuts, 3U);
}

// Some of what is wanted comes between two frames, and what is not wanted may go: the whole cut is there in
// the end, and what is drawn before covers each place once. No more is ever wanted than there is room for.
TEST_F(StreamedChoices, ComeToTheWholeCut) {
    constexpr unsigned seed = 332;
    std::mt19937_64 random(seed);
    const test::Whole whole = test::whole_of(terrain_.surface);
    const auto region = clusters();
    Numbers here(region->roots().begin(), region->roots().end());
    int frames = 0;
    for (int i = 0; i < 12; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        const ClusterView eye = view(test::random_camera(random, terrain_.field), 1.0);
        const auto asked = clusters();
        const ClusterChoice waited = *choose_clusters(*asked, eye);
        const std::size_t room = waited.clusters.size() + (i % 2 == 0 ? 0 : random() % 500);
        for (int frame = 0;; ++frame, ++frames) {
            ASSERT_LT(frame, 400);
            const StreamedChoice choice = choose(*region, eye, room, here);
            EXPECT_EQ(choice.without_room, 0U);
            EXPECT_LE(choice.clusters_wanted.size(), room + region->roots().size());
            if (frame % 8 == 0)
                expect_cut(*region, eye, whole, brute_force(*region, eye, here), choice.drawn);
            if (choice.missing == 0) {
                EXPECT_EQ(choice.drawn.clusters, waited.clusters);
                EXPECT_EQ(choice.drawn.groups, waited.groups);
                break;
            }
            const Numbers wanted(choice.clusters_wanted.begin(), choice.clusters_wanted.end());
            std::erase_if(here, [&](std::uint32_t cluster) {
                return !wanted.contains(cluster) && graph_.clusters[cluster].used_by != no_group &&
                       here.size() > room;
            });
            for (std::size_t at = 0; at < std::min<std::size_t>(3, choice.groups_wanted.size()); ++at)
                read(*region, choice.groups_wanted[at]);
            std::size_t sent = 0;
            for (const std::uint32_t cluster : choice.clusters_wanted)
                if (sent < 12 && here.insert(cluster).second) ++sent;
        }
    }
    std::printf("seed %u: 12 eyes, %d frames until all was there\n", seed, frames);
}

// With too little room it is a coarser cut, which is told, and it comes to an end.
TEST_F(StreamedChoices, AreCoarserWhereThereIsNoRoom) {
    constexpr unsigned seed = 333;
    std::mt19937_64 random(seed);
    const auto region = clusters();
    for (std::uint32_t group = 0; group < graph_.groups.size(); ++group) read(*region, group);
    std::size_t short_of_room = 0;
    for (int i = 0; i < 40; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        const Camera camera = test::random_camera(random, terrain_.field);
        const ClusterView eye =
            i % 4 == 0 ? view(camera, 1.0, static_cast<std::uint32_t>(i % 3)) : view(camera, i % 2);
        const std::size_t room = i % 5 == 0 ? 0 : random() % 60;
        Numbers here(region->roots().begin(), region->roots().end());
        const StreamedChoice first = choose(*region, eye, room, here);
        here.insert(first.clusters_wanted.begin(), first.clusters_wanted.end());
        EXPECT_LE(here.size(), room + region->roots().size());
        const StreamedChoice choice = choose(*region, eye, room, here);
        const std::size_t whole = choose_clusters(*region, eye)->clusters.size();
        if (choice.without_room == 0) {
            EXPECT_EQ(choice.missing, 0U);
            continue;
        }
        ++short_of_room;
        EXPECT_GT(choice.missing, 0U);
        EXPECT_GT(whole, room);
        // There is no better one to come.
        EXPECT_EQ(first.clusters_wanted, choice.clusters_wanted);
        EXPECT_LE(choice.drawn.clusters.size(), room + region->roots().size());
        EXPECT_GT(choice.drawn.clusters.size() + choice.drawn.beyond_frustum + choice.drawn.beyond_horizon,
                  0U);
    }
    EXPECT_GT(short_of_room, 10U);
}

// What would come in the place of clusters that were hidden comes last, and nothing else changes.
// Clusters on the way down from the roots, through all groups that were read and that an eye opens.
Numbers met_by(const RegionClusters& region, const ClusterGraph& graph, const ClusterView& eye) {
    Numbers met, opened;
    std::vector<std::uint32_t> to_meet(region.roots().begin(), region.roots().end());
    while (!to_meet.empty()) {
        met.insert(to_meet.back());
        const std::uint32_t maker = graph.clusters[to_meet.back()].made_by;
        to_meet.pop_back();
        if (maker == no_group || region.read_part(maker) == nullptr || opened.contains(maker)) continue;
        const ClusterGroup& group = graph.groups[maker];
        if (eye.stands(group) || eye.is_beyond_frustum(group)) continue;
        opened.insert(maker);
        for (const std::uint32_t member : graph.members_of(group)) to_meet.push_back(member);
    }
    return met;
}

TEST_F(StreamedChoices, WhatIsHiddenComesLast) {
    constexpr unsigned seed = 335;
    std::mt19937_64 random(seed);
    std::size_t shown_first = 0, hidden_last = 0;
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        const auto region = clusters();
        for (std::uint32_t group = 0; group < graph_.groups.size(); ++group)
            if (random() % 16 != 0) read(*region, group);
        Numbers here(region->roots().begin(), region->roots().end());
        const ClusterView eye = view(test::random_camera(random, terrain_.field), 0.25);
        // Somewhat finer than the roots, so that some stand-ins show and some do not.
        const StreamedChoice coarse = choose(*region, eye.coarser(6), 1'000'000, here);
        here.insert(coarse.clusters_wanted.begin(), coarse.clusters_wanted.end());
        const StreamedChoice unknown = choose(*region, eye, 1'000'000, here);
        ShownClusters shown;
        for (const std::uint32_t cluster : unknown.drawn.clusters) shown[cluster] = random() % 2 == 0;
        const StreamedChoice choice = choose(*region, eye, 1'000'000, here, shown);
        EXPECT_EQ(choice.drawn.clusters, unknown.drawn.clusters);
        EXPECT_EQ(choice.missing, unknown.missing);
        EXPECT_TRUE(std::ranges::is_permutation(choice.clusters_wanted, unknown.clusters_wanted));
        EXPECT_TRUE(std::ranges::is_permutation(choice.groups_wanted, unknown.groups_wanted));
        EXPECT_EQ(unknown.clusters_hidden, 0U);
        const Numbers met = met_by(*region, graph_, eye);
        // By the way up from each of them, to what is drawn.
        std::map<std::uint32_t, std::pair<bool, bool>> known;  // of groups: any shows, any is hidden
        std::function<bool(std::uint32_t)> is_hidden;
        const auto is_group_hidden = [&](std::uint32_t group) {
            const auto [at, is_new] = known.try_emplace(group);
            const std::uint32_t first = graph_.groups[group].first_made;
            for (std::uint32_t made = first; is_new && made < first + graph_.groups[group].made; ++made) {
                const ClusterReach* const reach = region->known_reach(made);
                if (!met.contains(made) || (!shown.contains(made) && reach != nullptr &&
                                            eye.look_at(*reach).seen != ClusterView::Seen::yes))
                    continue;
                (is_hidden(made) ? at->second.second : at->second.first) = true;
            }
            return !at->second.first && at->second.second;
        };
        is_hidden = [&](std::uint32_t cluster) {
            if (const auto seen = shown.find(cluster); seen != shown.end()) return !seen->second;
            const std::uint32_t user = graph_.clusters[cluster].used_by;
            return user != no_group && is_group_hidden(user);
        };
        for (std::size_t at = 0; at < choice.clusters_wanted.size(); ++at) {
            const bool first = at + choice.clusters_hidden < choice.clusters_wanted.size();
            EXPECT_TRUE(first || is_hidden(choice.clusters_wanted[at]));
            (first ? shown_first : hidden_last) += here.contains(choice.clusters_wanted[at]) ? 0U : 1U;
        }
        for (std::size_t at = 0; at < choice.groups_wanted.size(); ++at)
            EXPECT_TRUE(at + choice.groups_hidden < choice.groups_wanted.size() ||
                        is_group_hidden(choice.groups_wanted[at]));
    }
    std::printf("seed %u: %zu clusters to come that show, %zu that do not\n", seed, shown_first, hidden_last);
    EXPECT_GT(shown_first, 50U);
    EXPECT_GT(hidden_last, 50U);
}

class StreamedChoicesWithHoles : public StreamedChoices {
  protected:
    StreamedChoicesWithHoles() : StreamedChoices(test::holed_field(120, 130, 5)) {}
};

// Ground with holes has many coarsest clusters.
TEST_F(StreamedChoicesWithHoles, CoverEachPlaceOnceWhateverIsHere) {
    constexpr unsigned seed = 334;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const test::Whole whole = test::whole_of(terrain_.surface);
    const auto region = clusters();
    EXPECT_GT(region->roots().size(), 1U);
    for (std::uint32_t group = 0; group < graph_.groups.size(); ++group) read(*region, group);
    for (int i = 0; i < 30; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        Numbers here(region->roots().begin(), region->roots().end());
        const double share = 1.0 - 0.3 * std::pow(unit(random), 2.0);
        for (std::uint32_t cluster = 0; cluster < graph_.clusters.size(); ++cluster)
            if (unit(random) <= share) here.insert(cluster);
        const ClusterView eye = view(test::random_camera(random, terrain_.field), 1.0);
        const StreamedChoice choice = choose(*region, eye, 1'000'000, here);
        for (const std::uint32_t cluster : choice.drawn.clusters) EXPECT_TRUE(here.contains(cluster));
        expect_cut(*region, eye, whole, brute_force(*region, eye, here), choice.drawn);
    }
}

}  // namespace
}  // namespace oro
