// Clusters that other ground hides are left out, and nothing that shows: from eyes in motion the ids in every
// pixel are those of frames that draw the whole cut, on both paths.
#include <chrono>
#include <thread>

#include "tests/support/drawn/cluster_scene.h"
#include "tests/support/drawn/occlusion_pairs.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

class OccludedClusters : public test::GpuTest, public ::testing::WithParamInterface<RasterPath> {
  protected:
    // No power of two, and not the same in both directions.
    static constexpr int width_px = 203, height_px = 117;
    test::ClusterTerrain terrain_{test::rough_field(47.0, 8.0, 400, 500)};

    Scene scene() {
        auto made =
            Scene::create(*gpu_, pages_in_memory(terrain_.field, 1.0, 2), {std::uint64_t{256} << 20U, 0});
        EXPECT_TRUE(made.ok()) << made.error().line();
        test::draw_by_clusters(*gpu_, terrain_, *made);
        return std::move(made).value();
    }
    test::EyeGround where() const {
        return {46.70, 46.95, 8.05, 8.35, [this](double lat_deg, double lon_deg) {
                    return *ground_h_m(terrain_.field, lat_deg, lon_deg);
                }};
    }
};

TEST_P(OccludedClusters, PicturesAreThoseWithout) {
    Scene drawn = scene();
    test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px);
    EXPECT_EQ(
        test::draw_pairs(renderers, drawn, where(), 171, test::occlusion_pairs(60), width_px, height_px), 0U);
    EXPECT_LT(3 * renderers.drawn_with, 2 * renderers.drawn_without) << "or little was left out";
    EXPECT_GT(renderers.later, 0U);
    EXPECT_GT(renderers.hidden, 0U);
}

TEST_P(OccludedClusters, PicturesAreThoseWithoutInOtherModels) {
    unsigned seed = 172;
    for (const double k : {0.13, 0.9, -1.0}) {
        Scene drawn = scene();
        test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px);
        WorldModel model;
        model.air.k = k;
        EXPECT_EQ(test::draw_pairs(renderers, drawn, where(), seed++, test::occlusion_pairs(8), width_px,
                                   height_px, model),
                  0U)
            << "refraction " << k;
    }
    for (const Precision precision : {Precision::rounded_posts, Precision::naive}) {
        Scene drawn = scene();
        test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px);
        WorldModel model;
        model.precision = precision;
        EXPECT_EQ(test::draw_pairs(renderers, drawn, where(), ++seed, test::occlusion_pairs(8), width_px,
                                   height_px, model),
                  0U);
    }
}

// The comparison can fail: with the nearest depths instead of the farthest it tells of lost ground.
TEST_P(OccludedClusters, AWrongPyramidIsNoticed) {
    Scene drawn = scene();
    test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px, true);
    EXPECT_GT(test::draw_pairs(renderers, drawn, where(), 179, 16, width_px, height_px), 10U);
}

// A window's frames have coarser clusters beside the cut, which no round draws.
TEST_P(OccludedClusters, WindowsAreThoseWithout) {
    Scene drawn = scene();
    test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px);
    std::mt19937 random(181);
    const Tile tile{0, 0, width_px, height_px, {0.5, 0.5}};
    std::size_t coarser = 0;
    for (int i = 0; i < 4; ++i) {
        const auto [one, other] = test::eyes_in_motion(where(), random, width_px, height_px);
        for (const Camera& camera : {one, other}) {
            auto plan = drawn.plan({camera, tile, 1.0});
            for (int turn = 0; turn < 2000 && plan.ok() && !plan->is_settled(); ++turn) {
                ASSERT_EQ(renderers.differing(*plan), 0U) << "seed 181, eye " << i;
                for (int news = 0; news < 100; ++news) {
                    const auto better = drawn.advance();
                    ASSERT_TRUE(better.ok()) << better.error().line();
                    if (*better) break;
                    std::this_thread::sleep_for(std::chrono::milliseconds(2));
                }
                plan = drawn.plan({camera, tile, 1.0});
            }
            ASSERT_TRUE(plan.ok()) << plan.error().line();
            EXPECT_TRUE(plan->is_settled());
            ASSERT_EQ(renderers.differing(*plan), 0U) << "seed 181, eye " << i;
            coarser += plan->grids[0].clusters.drawn.size() - plan->grids[0].clusters.in_cut;
        }
    }
    EXPECT_GT(coarser, 50U);
    EXPECT_GT(renderers.hidden, 0U);
}

// One renderer draws blocks and clusters by turns: what either saw says nothing of the other.
TEST_P(OccludedClusters, TakeTurnsWithBlocks) {
    Scene clusters = scene();
    auto blocks =
        Scene::create(*gpu_, pages_in_memory(terrain_.field, 1.0, 2), {std::uint64_t{256} << 20U, 0});
    ASSERT_TRUE(blocks.ok()) << blocks.error().line();
    test::OcclusionPair renderers(*gpu_, GetParam(), width_px, height_px);
    std::mt19937 random(180);
    const Tile tile{0, 0, width_px, height_px, {0.5, 0.5}};
    for (int i = 0; i < 8; ++i) {
        const auto [one, other] = test::eyes_in_motion(where(), random, width_px, height_px);
        for (const Camera& camera : {one, other, one}) {
            for (Scene* const drawn : {&clusters, &*blocks, &clusters}) {
                auto plan = drawn->settled_plan({camera, tile, 1.0});
                ASSERT_TRUE(plan.ok()) << plan.error().line();
                ASSERT_EQ(renderers.differing(*plan), 0U) << "eye " << i;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Paths, OccludedClusters, ::testing::Values(RasterPath::mesh, RasterPath::compute),
                         [](const auto& path) {
                             return std::string(path.param == RasterPath::mesh ? "mesh" : "compute");
                         });

}  // namespace
}  // namespace oro
