// The cut that the GPU makes of what a frame offers is the processor's.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <set>
#include <thread>

#include "core/cluster_frame/cluster_choice.h"
#include "tests/support/asked_count.h"
#include "tests/support/drawn/cluster_scene.h"
#include "tests/support/drawn/cracks.h"
#include "tests/support/drawn/streamed_frames.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

using Numbers = std::set<std::uint32_t>;

// OROGRAPH_CLUSTER_CUTS: how many eyes, in the place of what a test asks for.
int asked_eyes(int asked) {
    return test::asked_count("OROGRAPH_CLUSTER_CUTS", asked);
}

class ClusterCuts : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    static constexpr int side_px = test::crack_side_px;
    test::ClusterTerrain terrain_{test::rough_field(47.0, 8.0, 260, 310)};

    test::DrawnScene scene(std::optional<std::uint32_t> level = {}) {
        test::DrawnScene drawn(*gpu_, pages_in_memory(terrain_.field, 1.0, 2), GetParam(), side_px, side_px);
        test::draw_by_clusters(*gpu_, terrain_, drawn.scene(), std::uint64_t{64} << 20U, level);
        return drawn;
    }
    // As a window draws it that nothing is missing of, once nothing has come for a while that is coarser,
    // either.
    static test::DrawnFrame settled(test::DrawnScene& drawn, const Camera& camera, double tau_px) {
        test::DrawnFrame frame;
        std::size_t asked = 0;
        for (int turns = 0; turns < 50; ++turns) {
            frame = test::stream_frames(drawn, camera, tau_px, [](const test::DrawnFrame&) {}).last;
            EXPECT_TRUE(frame.plan.is_settled());
            if (frame.plan.grids[0].clusters.asked.size() != asked) turns = 0;
            asked = frame.plan.grids[0].clusters.asked.size();
            EXPECT_TRUE(drawn.scene().advance().ok());
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return frame;
    }
    // The clusters that the GPU has made the cut of a plan of.
    static Numbers cut_on_gpu(test::DrawnScene& drawn, const FramePlan& plan) {
        auto report = drawn.renderer().draw(plan, {});
        EXPECT_TRUE(report.ok()) << report.error().line();
        const auto states = drawn.renderer().read_cluster_states(plan.grids[0].clusters.drawn.size());
        EXPECT_TRUE(states.ok()) << states.error().line();
        Numbers cut;
        for (std::size_t i = 0; i < states->size(); ++i)
            if (((*states)[i] & gpu::cluster_kept) != 0) cut.insert(plan.grids[0].clusters.drawn[i].number);
        return cut;
    }
    ClusterView view(const Camera& camera, double tau_px, const HorizonOccluder& occluder,
                     std::optional<std::uint32_t> level = {}) const {
        return {camera, test::whole_picture(camera), tau_px, {}, occluder, {}, level};
    }
    static Numbers cut_here(RegionClusters& region, const ClusterView& view) {
        auto choice = choose_clusters(region, view);
        EXPECT_TRUE(choice.ok()) << choice.error().line();
        return {choice->clusters.begin(), choice->clusters.end()};
    }
    // What each pixel shows, whatever the numbers of a frame.
    static std::vector<std::uint64_t> shown(const FramePlan& plan, const std::vector<std::uint32_t>& ids) {
        std::vector<std::uint64_t> triangles;
        for (const std::uint32_t id : ids)
            triangles.push_back(
                id == 0
                    ? 0
                    : std::uint64_t{plan.grids[0].clusters.drawn[(id - 1) / gpu::cluster_triangles].number} *
                              gpu::cluster_triangles +
                          (id - 1) % gpu::cluster_triangles + 1);
        return triangles;
    }
};

// By the frame's rule, and by those that ask for less: of what is offered the GPU makes the cut that the
// processor makes from the beginning, and shows what is seen where that one is drawn.
TEST_P(ClusterCuts, AreTheProcessors) {
    constexpr unsigned seed = 351;
    const int eyes = asked_eyes(12);
    std::mt19937_64 random(seed);
    test::DrawnScene offers = scene(), waits = scene();
    const HorizonOccluder& occluder = offers.scene().grids()[0].pages().facts().shape.occluder;
    const auto region = clusters_of_graph(terrain_.graph, terrain_.field, occluder);
    ASSERT_TRUE(region.ok());
    std::size_t clusters = 0, asked = 0, coarser = 0;
    for (int i = 0; i < eyes; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        const Camera camera = test::random_camera(random, terrain_.field);
        FramePlan plan = settled(offers, camera, 1.0).plan;
        asked += plan.grids[0].clusters.asked.size();
        const Numbers finest = cut_on_gpu(offers, plan);
        EXPECT_EQ(finest, cut_here(**region, view(camera, 1.0, occluder)));
        const double tau_px = 1.0 + std::pow(2.0, static_cast<double>(random() % 8) - 3.0);
        const ClusterView other = view(camera, tau_px, occluder);
        plan.grids[0].constants.cut.rule = other.cut_rule();
        const Numbers cut = cut_on_gpu(offers, plan);
        EXPECT_EQ(cut, cut_here(**region, other)) << "tau " << tau_px;
        clusters += finest.size() + cut.size();
        coarser += cut != finest ? 1 : 0;
        if (i % 5 != 0) continue;
        const test::DrawnFrame waited = waits.draw(camera, tau_px);
        EXPECT_EQ(shown(plan, *offers.renderer().read_ids(side_px, side_px)), shown(waited.plan, waited.ids));
    }
    std::printf(
        "seed %u: %d eyes, two cuts of each are the processor's: %zu clusters; %zu groups asked, %zu "
        "coarser\n",
        seed, eyes, clusters, asked, coarser);
    EXPECT_GT(asked, 10U * static_cast<unsigned>(eyes));
    EXPECT_GT(3 * coarser, static_cast<unsigned>(eyes));
}

// The same of levels of the graph.
TEST_P(ClusterCuts, OfLevelsAreTheProcessors) {
    constexpr unsigned seed = 352;
    const int eyes = asked_eyes(4);
    std::mt19937_64 random(seed);
    test::DrawnScene offers = scene(1);
    const HorizonOccluder& occluder = offers.scene().grids()[0].pages().facts().shape.occluder;
    const auto region = clusters_of_graph(terrain_.graph, terrain_.field, occluder);
    ASSERT_TRUE(region.ok());
    for (int i = 0; i < eyes; ++i) {
        SCOPED_TRACE("seed " + std::to_string(seed) + ", eye " + std::to_string(i));
        const Camera camera = test::random_camera(random, terrain_.field);
        FramePlan plan = settled(offers, camera, 1.0).plan;
        for (const std::uint32_t level : {1U, 2U, 5U}) {
            const ClusterView other = view(camera, 1.0, occluder, level);
            plan.grids[0].constants.cut.rule = other.cut_rule();
            EXPECT_EQ(cut_on_gpu(offers, plan), cut_here(**region, other)) << "level " << level;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Paths, ClusterCuts, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) {
                             return std::string(path.param == RasterPath::mesh ? "mesh" : "compute");
                         });

}  // namespace
}  // namespace oro
