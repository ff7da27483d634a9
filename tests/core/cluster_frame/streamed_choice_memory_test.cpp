// Choices among clusters that keep their room from frame to frame are those that are made from nothing.
#include <cstdio>
#include <cstring>
#include <random>

#include "tests/core/cluster_frame/streamed_choices.h"

namespace oro {
namespace {

using test::Numbers;

class StreamedChoicesWithMemory : public test::StreamedChoices {
  protected:
    static void expect_same(const StreamedChoice& kept, const StreamedChoice& fresh) {
        EXPECT_EQ(kept.drawn.clusters, fresh.drawn.clusters);
        EXPECT_EQ(kept.drawn.groups, fresh.drawn.groups);
        EXPECT_EQ(kept.drawn.groups_opened, fresh.drawn.groups_opened);
        EXPECT_EQ(kept.drawn.beyond_frustum, fresh.drawn.beyond_frustum);
        EXPECT_EQ(kept.drawn.beyond_horizon, fresh.drawn.beyond_horizon);
        EXPECT_EQ(kept.groups_wanted, fresh.groups_wanted);
        EXPECT_EQ(kept.clusters_wanted, fresh.clusters_wanted);
        EXPECT_EQ(kept.groups_hidden, fresh.groups_hidden);
        EXPECT_EQ(kept.clusters_hidden, fresh.clusters_hidden);
        EXPECT_EQ(kept.clusters_to_come, fresh.clusters_to_come);
        EXPECT_EQ(kept.to_come_hidden, fresh.to_come_hidden);
        EXPECT_EQ(kept.missing, fresh.missing);
        EXPECT_EQ(kept.without_room, fresh.without_room);
        EXPECT_EQ(kept.offer.in_cut, fresh.offer.in_cut);
        ASSERT_EQ(kept.offer.clusters.size(), fresh.offer.clusters.size());
        for (std::size_t i = 0; i < kept.offer.clusters.size(); ++i)
            EXPECT_EQ(std::memcmp(&kept.offer.clusters[i], &fresh.offer.clusters[i], sizeof(OfferedCluster)),
                      0);
        ASSERT_EQ(kept.offer.asked.size(), fresh.offer.asked.size());
        for (std::size_t i = 0; i < kept.offer.asked.size(); ++i)
            EXPECT_EQ(std::memcmp(&kept.offer.asked[i], &fresh.offer.asked[i], sizeof(gpu::AskedGroup)), 0);
    }
    // Nothing is drawn of a cut that lacks something and would have room; the same is wanted.
    void expect_left_out(RegionClusters& region, const ClusterView& eye, std::size_t room,
                         const IsClusterHere& is_here, const ShownClusters& shown,
                         const StreamedChoice& whole) {
        const auto choice =
            select_resident_cut(region, eye, room, is_here, shown, nullptr, LackingCut::is_left_out);
        ASSERT_TRUE(choice.ok());
        if (whole.missing == 0 || whole.without_room > 0) return expect_same(*choice, whole);
        left_out_ += whole.drawn.clusters.empty() ? 0U : 1U;
        EXPECT_TRUE(choice->drawn.clusters.empty());
        EXPECT_TRUE(choice->offer.clusters.empty());
        EXPECT_EQ(choice->groups_wanted, whole.groups_wanted);
        EXPECT_EQ(choice->clusters_wanted, whole.clusters_wanted);
        EXPECT_EQ(choice->clusters_to_come, whole.clusters_to_come);
        EXPECT_EQ(choice->to_come_hidden, whole.to_come_hidden);
        EXPECT_EQ(choice->missing, whole.missing);
    }
    std::size_t left_out_{};
};

TEST_F(StreamedChoicesWithMemory, AreThoseFromNothing) {
    constexpr unsigned seed = 5106;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    StreamedChoiceMemory memory;
    std::size_t drawn = 0, to_come = 0, coarser = 0, without_room = 0;
    for (int round = 0; round < 8; ++round) {
        // A choice finds out where clusters reach: each has a region of its own.
        const auto region = clusters(), other = clusters();
        const double read_share = round % 2 == 0 ? 1.0 : 0.97;
        for (std::uint32_t group = 0; group < graph_.groups.size(); ++group)
            if (unit(random) <= read_share) {
                read(*region, group);
                read(*other, group);
            }
        Camera camera = test::random_camera(random, terrain_.field);
        ShownClusters shown;
        for (int i = 0; i < 50; ++i) {
            SCOPED_TRACE("seed " + std::to_string(seed) + ", round " + std::to_string(round) + ", eye " +
                         std::to_string(i));
            if (i % 10 == 9) camera = test::random_camera(random, terrain_.field);
            camera.eye.lat_deg += 1e-4 * (unit(random) - 0.5);
            camera.attitude.heading_deg += 3.0 * unit(random);
            const double here_share = i % 4 == 0 ? 1.0 : 1.0 - 0.3 * unit(random) * unit(random);
            Numbers here(region->roots().begin(), region->roots().end());
            for (std::uint32_t cluster = 0; cluster < graph_.clusters.size(); ++cluster)
                if (unit(random) <= here_share) here.insert(cluster);
            const ClusterView eye = view(camera, i % 2 == 0 ? 1.0 : 0.25);
            const std::size_t room = i % 7 == 0 ? 20 + random() % 100 : 1'000'000;
            const IsClusterHere is_here = [&](std::uint32_t cluster) { return here.contains(cluster); };
            const auto kept = select_resident_cut(*region, eye, room, is_here, shown, &memory);
            const auto fresh = select_resident_cut(*other, eye, room, is_here, shown);
            ASSERT_TRUE(kept.ok() && fresh.ok());
            expect_same(*kept, *fresh);
            // Where all is read a choice finds out nothing, which the next one would know.
            if (read_share == 1.0) expect_left_out(*other, eye, room, is_here, shown, *fresh);
            drawn += fresh->drawn.clusters.size();
            to_come += fresh->clusters_to_come.size();
            coarser += fresh->offer.clusters.size() - fresh->offer.in_cut;
            without_room += fresh->without_room > 0 ? 1U : 0U;
            std::size_t expected = 0;
            for (const std::uint32_t cluster : fresh->clusters_wanted)
                expected += here.contains(cluster) ? 0U : 1U;
            EXPECT_EQ(fresh->clusters_to_come.size(), expected);
            shown.clear();
            if (i % 3 != 0)
                for (const std::uint32_t cluster : fresh->drawn.clusters) shown[cluster] = random() % 3 != 0;
        }
    }
    std::printf(
        "seed %u: 400 eyes, %zu clusters drawn, %zu coarser ones offered, %zu to come, %zu without room\n",
        seed, drawn, coarser, to_come, without_room);
    EXPECT_GT(drawn, 4000U);
    EXPECT_GT(coarser, 1000U);
    EXPECT_GT(to_come, 400U);
    EXPECT_GT(without_room, 10U);
    EXPECT_GT(left_out_, 50U);
}

}  // namespace
}  // namespace oro
