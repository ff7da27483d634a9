// Groups and clusters that are loaded in the background.
#include "render/clusters/cluster_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <set>

#include "core/cluster_frame/streamed_choice.h"
#include "tests/core/clusters/cluster_terrain.h"
#include "tests/support/drawn/cracks.h"

namespace oro {
namespace {

class ClusterStreams : public ::testing::Test {
  protected:
    test::ClusterTerrain terrain_{test::rough_field(47.0, 8.0, 181, 203)};
    HorizonOccluder occluder_ = region_shape(terrain_.field, 1.0).occluder;

    // A group of whatever number that is not `torn` can be read.
    std::unique_ptr<RegionClusters> clusters(std::uint32_t torn = no_group) {
        std::uint32_t leaves = 0;
        while (terrain_.graph.clusters[leaves].made_by == no_group) ++leaves;
        auto made =
            RegionClusters::create(terrain_.field, occluder_, terrain_.graph.groups, leaves,
                                   [this, torn](std::uint32_t number, GroupPart& part) -> Result<void> {
                                       if (number == torn)
                                           return Error{ErrorKind::failed, "a file", "is damaged"};
                                       part = part_of(terrain_.graph, number);
                                       return {};
                                   });
        EXPECT_TRUE(made.ok());
        return std::move(made).value();
    }
    [[nodiscard]] ClusterView view(const Camera& camera) const {
        return {camera, {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}}, 1.0, {}, occluder_, {}};
    }
    // What comes within some seconds, until `is_enough` says so.
    template <class IsEnough>
    static Result<void> take_until(ClusterStream& stream, const IsEnough& is_enough) {
        for (int turn = 0; turn < 5000; ++turn) {
            ORO_TRY(ClusterStream::Ready ready, stream.take());
            if (is_enough(ready)) return {};
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return Error{ErrorKind::failed, "the stream", "loaded too little"};
    }
};

// For the topmost groups it loads all that the cut of the eye is found by, and no other; each once.
TEST_F(ClusterStreams, GoOnToAllThatAnEyeNeeds) {
    std::mt19937_64 random(351);
    for (int i = 0; i < 8; ++i) {
        SCOPED_TRACE(i);
        const ClusterView eye = view(test::random_camera(random, terrain_.field));
        const auto waited = clusters(), region = clusters();
        ASSERT_TRUE(choose_clusters(*waited, eye).ok());
        std::set<std::uint32_t> needed;
        for (std::uint32_t group = 0; group < waited->groups().size(); ++group)
            if (waited->read_part(group) != nullptr) needed.insert(group);
        ClusterStream stream(*region, {}, 3, 20);
        std::set<std::uint32_t> top;
        for (const std::uint32_t root : region->roots())
            if (!eye.is_beyond_frustum(region->groups()[region->maker(root)]))
                top.insert(region->maker(root));
        const std::vector<std::uint32_t> first(top.begin(), top.end());
        stream.request(eye, first, {});
        std::set<std::uint32_t> loaded;
        const auto done = take_until(stream, [&](ClusterStream::Ready& ready) {
            for (auto& group : ready.groups) {
                EXPECT_TRUE(loaded.insert(group.number).second) << "twice";
                for (const auto& seen : group.seen)
                    EXPECT_EQ(eye.look_at(seen.reach).seen, ClusterView::Seen::yes);
                region->keep(group);
            }
            return loaded.size() >= needed.size();
        });
        EXPECT_TRUE(done.ok()) << loaded.size() << " of " << needed.size();
        EXPECT_EQ(loaded, needed);
    }
}

// While frames choose, keep what has come and wait for other eyes, threads load; what was loaded is what
// would have been.
TEST_F(ClusterStreams, GoOnWhileOthersChoose) {
    std::mt19937_64 random(352);
    const auto region = clusters(), waited = clusters();
    ClusterStream stream(*region, {}, 4, 64);
    std::set<std::uint32_t> here(region->roots().begin(), region->roots().end());
    gpu::ClusterBlock block{};
    for (int i = 0; i < 12; ++i) {
        SCOPED_TRACE(i);
        const ClusterView eye = view(test::random_camera(random, terrain_.field));
        if (i % 4 == 3) {
            const Camera other = test::random_camera(random, terrain_.field);
            ASSERT_TRUE(choose_clusters(*region, view(other)).ok());
        }
        const auto keep = [&](const RegionClusters::LoadedCluster& loaded) {
            const auto counts = waited->fill(loaded.number, {}, block);
            EXPECT_EQ(*counts, loaded.counts);
            for (std::uint32_t at = 0; at < (loaded.counts & 255U); ++at)
                EXPECT_EQ(block.corners[at], loaded.block->corners[at]);
            region->keep(loaded.number, loaded.reach);
            here.insert(loaded.number);
        };
        const auto done = take_until(stream, [&](ClusterStream::Ready& ready) {
            for (auto& group : ready.groups) {
                region->keep(group);
                std::ranges::for_each(group.seen, keep);
            }
            std::ranges::for_each(ready.clusters, keep);
            const auto choice = select_resident_cut(
                *region, eye, 100'000, [&](std::uint32_t cluster) { return here.contains(cluster); });
            std::vector<std::uint32_t> to_come;
            std::ranges::copy_if(choice->clusters_wanted, std::back_inserter(to_come),
                                 [&](std::uint32_t cluster) { return !here.contains(cluster); });
            stream.request(eye, choice->groups_wanted, to_come);
            return choice->missing == 0;
        });
        EXPECT_TRUE(done.ok());
    }
}

// Under a budget what was evicted is loaded again, by threads, for eyes that come back.
TEST_F(ClusterStreams, LoadAgainWhatWasEvicted) {
    constexpr std::uint64_t budget = 150'000;
    std::mt19937_64 random(353);
    const auto region = clusters();
    region->hold_at_most(budget);
    ClusterStream stream(*region, {}, 3, 32);
    std::vector<Camera> cameras;
    for (int i = 0; i < 4; ++i) cameras.push_back(test::random_camera(random, terrain_.field));
    std::vector<int> brought(region->groups().size(), 0);
    std::set<std::uint32_t> on_gpu(region->roots().begin(), region->roots().end());
    const std::set<std::uint32_t> roots = on_gpu;
    const auto is_here = [&](std::uint32_t cluster) {
        return on_gpu.contains(cluster) &&
               (roots.contains(cluster) || region->known_reach(cluster) != nullptr);
    };
    for (int i = 0; i < 12; ++i) {
        SCOPED_TRACE(i);
        const ClusterView eye = view(cameras[static_cast<std::size_t>(i) % cameras.size()]);
        region->begin_frame();
        const auto done = take_until(stream, [&](ClusterStream::Ready& ready) {
            for (auto& group : ready.groups) {
                region->keep(group);
                ++brought[group.number];
                for (const auto& seen : group.seen) on_gpu.insert(seen.number);
            }
            for (const auto& cluster : ready.clusters) {
                region->keep(cluster.number, cluster.reach);
                on_gpu.insert(cluster.number);
            }
            const auto choice = select_resident_cut(*region, eye, 100'000, is_here);
            std::vector<std::uint32_t> to_come;
            std::ranges::copy_if(choice->clusters_wanted, std::back_inserter(to_come),
                                 [&](std::uint32_t cluster) { return !is_here(cluster); });
            stream.request(eye, choice->groups_wanted, to_come);
            return choice->missing == 0;
        });
        EXPECT_TRUE(done.ok());
        region->end_frame();
    }
    EXPECT_GT(*std::ranges::max_element(brought), 1) << "the budget binds";
}

// Groups that are wanted last, and all below them, come after all that the others lead to.
TEST_F(ClusterStreams, LoadWhatIsWantedLastAfterTheRest) {
    const ClusterGraph& graph = terrain_.graph;
    std::mt19937_64 random(354);
    int looked_at = 0;
    for (int i = 0; i < 8; ++i) {
        SCOPED_TRACE(i);
        const ClusterView eye = view(test::random_camera(random, terrain_.field));
        const auto region = clusters();
        std::vector<std::uint32_t> first;  // all of a level
        for (std::uint32_t level = graph.groups.back().level; first.size() < 4; --level) {
            first.clear();
            for (std::uint32_t group = 0; group < graph.groups.size(); ++group)
                if (graph.groups[group].level == level) first.push_back(group);
        }
        const std::size_t last = first.size() / 2;
        // What the others lead to.
        std::vector<std::uint32_t> to_look_at(first.begin(), first.end() - static_cast<std::ptrdiff_t>(last));
        std::set<std::uint32_t> before(to_look_at.begin(), to_look_at.end());
        const auto look_below = [&](std::set<std::uint32_t>& found) {
            while (!to_look_at.empty()) {
                const ClusterGroup& group = graph.groups[to_look_at.back()];
                to_look_at.pop_back();
                if (eye.stands(group)) continue;
                for (const std::uint32_t member : graph.members_of(group)) {
                    const std::uint32_t maker = graph.clusters[member].made_by;
                    if (maker != no_group && !eye.is_beyond_frustum(graph.groups[maker]) &&
                        found.insert(maker).second)
                        to_look_at.push_back(maker);
                }
            }
        };
        look_below(before);
        std::set<std::uint32_t> all = before;
        to_look_at.assign(first.end() - static_cast<std::ptrdiff_t>(last), first.end());
        all.insert(to_look_at.begin(), to_look_at.end());
        look_below(all);
        ClusterStream stream(*region, {}, 1, 100'000);
        stream.request(eye, first, {}, last);
        std::vector<std::uint32_t> loaded;
        const auto done = take_until(stream, [&](const ClusterStream::Ready& ready) {
            for (const auto& group : ready.groups) loaded.push_back(group.number);
            return loaded.size() >= all.size();
        });
        ASSERT_TRUE(done.ok());
        const std::set<std::uint32_t> came_first(loaded.begin(),
                                                 loaded.begin() + static_cast<std::ptrdiff_t>(before.size()));
        EXPECT_EQ(came_first, before);
        looked_at += before.size() < all.size() ? 1 : 0;
    }
    EXPECT_GT(looked_at, 3);
}

TEST_F(ClusterStreams, TellOfDamageOnce) {
    const std::uint32_t top = terrain_.graph.clusters.back().made_by;
    Camera camera;
    camera.width_px = camera.height_px = 100;
    camera.eye = {46.9, 8.13, 200000.0};
    camera.attitude.pitch_deg = -90.0;
    const auto region = clusters(top);
    ClusterStream stream(*region, {}, 2, 8);
    const std::vector<std::uint32_t> first{top};
    stream.request(view(camera), first, {});
    const auto done =
        take_until(stream, [](const ClusterStream::Ready& ready) { return !ready.groups.empty(); });
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.error().what, "is damaged");
    EXPECT_TRUE(stream.take().ok());
}

}  // namespace
}  // namespace oro
