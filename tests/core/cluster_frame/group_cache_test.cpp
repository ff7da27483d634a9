// Groups that were read, within a budget of memory.
#include "core/cluster_frame/group_cache.h"

#include <cstring>
#include <random>

#include "tests/core/cluster_frame/streamed_choices.h"

namespace oro {
namespace {

// Five groups over a dozen leaves: group i uses leaves 2 i and 2 i + 1, and makes cluster 12 + i.
class HeldOfAGraph : public ::testing::Test {
  protected:
    GroupCache held_;

    void SetUp() override { held_.make_places(5, 17, 12); }
    static std::unique_ptr<GroupPart> part(std::uint32_t number) {
        auto made = std::make_unique<GroupPart>();
        made->number = number;
        made->group.first_made = 12 + number;
        made->group.made = 1;
        made->members = {2 * number, 2 * number + 1};
        made->made.resize(1);
        made->triangles.resize(100);
        return made;
    }
    static std::uint64_t bytes_of_one() { return held_bytes(*part(0)); }
    void put(std::uint32_t number) { held_.put(number, part(number)); }
    [[nodiscard]] test::Numbers here() const {
        test::Numbers numbers;
        for (std::uint32_t i = 0; i < 5; ++i)
            if (held_.find(i) != nullptr) numbers.insert(i);
        return numbers;
    }
};

TEST_F(HeldOfAGraph, ThoseLeastRecentlyUsedGiveWay) {
    held_.hold_at_most(3 * bytes_of_one());
    for (const std::uint32_t group : {0U, 1U, 2U}) {
        held_.begin_frame();
        put(group);
    }
    held_.begin_frame();
    EXPECT_EQ(held_.use(0)->number, 0U);
    put(3);
    EXPECT_EQ(here(), (test::Numbers{0, 2, 3}));
    held_.begin_frame();
    put(1);
    EXPECT_EQ(here(), (test::Numbers{0, 1, 3}));
    EXPECT_EQ(held_.bytes(), 3 * bytes_of_one());
    EXPECT_EQ(held_.size(), 3U);
    EXPECT_EQ(held_.use(2), nullptr);
}

TEST_F(HeldOfAGraph, WhatTheFrameUsesStaysUntilTheNext) {
    held_.hold_at_most(2 * bytes_of_one());
    held_.begin_frame();
    for (const std::uint32_t group : {0U, 1U, 2U, 3U}) put(group);
    held_.end_frame();
    EXPECT_EQ(here(), (test::Numbers{0, 1, 2, 3}));
    held_.begin_frame();
    held_.use(1);
    EXPECT_EQ(here(), (test::Numbers{0, 1, 2, 3}));
    held_.end_frame();
    EXPECT_EQ(here(), (test::Numbers{1, 3}));
    EXPECT_EQ(held_.bytes(), 2 * bytes_of_one());
}

// As long as the frame does not use them.
TEST_F(HeldOfAGraph, HiddenOnesGiveWayFirst) {
    held_.hold_at_most(4 * bytes_of_one());
    for (const std::uint32_t group : {0U, 1U, 2U, 3U}) {
        held_.begin_frame();
        put(group);
    }
    held_.mark_occluded({2, 3, 4, no_group});  // the last: of a cluster alone, which no group made or uses
    held_.begin_frame();
    held_.use(3);
    put(4);
    EXPECT_EQ(here(), (test::Numbers{0, 1, 3, 4}));
    held_.mark_occluded({});
    held_.begin_frame();
    put(2);
    EXPECT_EQ(here(), (test::Numbers{1, 2, 3, 4}));
}

TEST_F(HeldOfAGraph, WithoutFramesNothingGivesWay) {
    held_.hold_at_most(1);
    for (const std::uint32_t group : {0U, 1U, 2U, 3U, 4U}) put(group);
    held_.end_frame();
    EXPECT_EQ(held_.size(), 5U);
}

// Of what a group made, and of leaves that it uses.
TEST_F(HeldOfAGraph, ReachesGoWithTheirGroup) {
    held_.begin_frame();
    held_.put_reach(2, no_group, {});
    held_.put_reach(13, 1, {});
    EXPECT_EQ(held_.bytes(), 0U) << "of a group that is not here";
    put(1);
    put(2);
    for (const std::uint32_t leaf : {2U, 3U, 4U}) held_.put_reach(leaf, no_group, {});
    held_.put_reach(13, 1, {});
    held_.put_reach(13, 1, {});
    EXPECT_EQ(held_.bytes(), 2 * bytes_of_one() + 4 * held_reach_bytes);
    held_.hold_at_most(bytes_of_one() + held_reach_bytes);
    held_.begin_frame();
    held_.use(2);
    held_.end_frame();
    EXPECT_EQ(here(), (test::Numbers{2}));
    for (const std::uint32_t cluster : {2U, 3U, 13U}) EXPECT_EQ(held_.reach(cluster), nullptr) << cluster;
    EXPECT_NE(held_.reach(4), nullptr);
    EXPECT_EQ(held_.bytes(), bytes_of_one() + held_reach_bytes);
}

TEST_F(HeldOfAGraph, WhatAThreadSharesOutlivesIt) {
    held_.begin_frame();
    put(4);
    const std::shared_ptr<const GroupPart> shared = held_.share(4);
    held_.hold_at_most(0);
    held_.begin_frame();
    held_.end_frame();
    EXPECT_EQ(held_.find(4), nullptr);
    EXPECT_EQ(held_.share(4), nullptr);
    EXPECT_EQ(shared->number, 4U);
}

class HeldByFrames : public test::StreamedChoices {
  protected:
    // What a frame that waits asks for; clusters and their blocks, as they come.
    std::vector<gpu::ClusterBlock> frame(RegionClusters& region, const ClusterView& view) {
        region.begin_frame();
        const auto choice = choose_clusters(region, view);
        EXPECT_TRUE(choice.ok()) << choice.error().line();
        std::vector<gpu::ClusterBlock> blocks;
        for (const std::uint32_t cluster : choice->clusters) {
            blocks.push_back({});
            EXPECT_TRUE(region.fill(cluster, {}, blocks.back()).ok());
        }
        region.end_frame();
        return blocks;
    }
};

// Groups that gave way are read again, and clusters are the same. No more is held than may be, or than one
// frame needs.
TEST_F(HeldByFrames, AreTheSameClustersWithinTheBudget) {
    constexpr std::uint64_t budget = 1'000'000;
    constexpr unsigned seed = 361;
    std::mt19937_64 random(seed);
    const auto free = clusters(), bound = clusters();
    bound->hold_at_most(budget);
    std::vector<Camera> cameras;
    for (int i = 0; i < 10; ++i) cameras.push_back(test::random_camera(random, terrain_.field));
    int above = 0, blocks = 0;
    for (int i = 0; i < 30; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        const ClusterView eye = view(cameras[static_cast<std::size_t>(i) % cameras.size()], 1.0);
        const auto once = clusters();
        const auto alone = frame(*once, eye), with_all = frame(*free, eye), with_few = frame(*bound, eye);
        ASSERT_EQ(with_few.size(), with_all.size());
        ASSERT_EQ(with_few.size(), alone.size());
        if (!alone.empty()) {
            EXPECT_EQ(std::memcmp(with_few.data(), with_all.data(), alone.size() * sizeof(alone[0])), 0);
        }
        EXPECT_LE(bound->held().bytes(), budget + once->held().bytes());
        above += bound->held().bytes() > budget ? 1 : 0;
        blocks += static_cast<int>(alone.size());
    }
    EXPECT_GT(free->held().bytes(), 2 * budget) << "the budget binds";
    EXPECT_LT(bound->held().bytes(), free->held().bytes());
    EXPECT_GT(blocks, 500);
    EXPECT_GT(above, 3);
    EXPECT_LT(above, 27);
    std::printf("seed %u: %d of 30 frames need more than the budget, %d clusters; %.2f MB of all of them\n",
                seed, above, blocks, 1.0e-6 * static_cast<double>(free->held().bytes()));
}

// A cluster is loaded although its group gave way.
TEST_F(HeldByFrames, ThreadsLoadClustersOfGroupsThatGaveWay) {
    const auto region = clusters();
    const std::uint32_t cluster = region->roots().front(), group = region->maker(cluster);
    region->begin_frame();
    read(*region, group);
    const auto before = region->load_cluster(cluster, {});
    EXPECT_TRUE(region->is_held(group));
    region->hold_at_most(0);
    region->begin_frame();
    region->end_frame();
    EXPECT_FALSE(region->is_held(group));
    EXPECT_EQ(region->held().bytes(), 0U);
    const auto after = region->load_cluster(cluster, {});
    ASSERT_TRUE(before.ok() && after.ok());
    EXPECT_EQ(before->counts, after->counts);
    EXPECT_EQ(std::memcmp(before->block.get(), after->block.get(), sizeof(gpu::ClusterBlock)), 0);
    // Where it is is not kept without its group.
    region->keep(cluster, after->reach);
    EXPECT_EQ(region->known_reach(cluster), nullptr);
    EXPECT_EQ(region->held().bytes(), 0U);
    EXPECT_TRUE(region->reach(cluster).ok());
    EXPECT_NE(region->known_reach(cluster), nullptr);
}

}  // namespace
}  // namespace oro
