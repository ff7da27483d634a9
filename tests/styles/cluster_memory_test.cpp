// What is said where a GPU has too little memory for a picture that is drawn by clusters.
#include <gtest/gtest.h>

#include "apps/drawing/region_scene.h"
#include "tests/support/drawn/cluster_scene.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

class ClusterMemory : public test::GpuTest {};

// Half of the memory is for clusters, so blocks alone may have enough where both together have not.
TEST_F(ClusterMemory, BlocksAreNamedWhereClustersAreDrawn) {
    const test::ClusterTerrain terrain(test::rough_field(46.0, 8.0, 40, 50));
    auto made = Scene::create(*gpu_, pages_in_memory(terrain.field, 1.0, 1));
    ASSERT_TRUE(made.ok()) << made.error().line();
    Scene scene = std::move(made).value();
    const std::string pages = std::to_string(scene.grids()[0].store().capacity());
    EXPECT_EQ(lacks_gpu_memory(scene, "this view").line(),
              "--gpu-memory: the GPU may hold " + pages +
                  " pages of terrain; this view needs more (a larger --tau needs fewer)");
    test::draw_by_clusters(*gpu_, terrain, scene);
    EXPECT_EQ(lacks_gpu_memory(scene, "this view").line(),
              "--gpu-memory: the GPU may hold " + pages +
                  " pages of terrain; this view needs more (a larger --tau needs fewer; --mesh grid leaves "
                  "all of the memory to blocks)");
}

}  // namespace
}  // namespace oro
