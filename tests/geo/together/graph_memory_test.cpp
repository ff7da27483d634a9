// What building a graph needs is told before it is begun.
#include "geo/together/graph_memory.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

constexpr std::uint64_t gb = 1'000'000'000;

TEST(GraphMemory, IsNoLessThanWhatWasMeasured) {
    // Of a scan of 999,698 triangles, its terrain of 1 MB among it: 819 MB with the graph in memory, and 39
    // MB of memory (without pages of scratch files) where it is baked.
    EXPECT_GE(graph_bytes(999698), 819 * gb / 1000);
    EXPECT_LE(graph_bytes(999698), 900 * gb / 1000);
    EXPECT_GE(bake_bytes(999698), 39 * gb / 1000);
    EXPECT_LE(bake_bytes(999698), 120 * gb / 1000);
}

TEST(GraphMemory, MoreThanThreeQuartersOfTheMachinesIsRefusedWithBothNumbers) {
    EXPECT_TRUE(check_graph_memory("scan.ply", 2000000, 6 * gb).ok());
    const auto refused = check_graph_memory("scan.ply", 4000000, 4 * gb);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(
        refused.error().line(),
        "scan.ply: building the cluster graph of its 4000000 triangles needs 3.1 GB of memory, and this "
        "machine has 4.0 GB, enough for 3866666: bake it, which takes less, or give a part of the mesh");
    const auto bake = check_bake_memory("scan.ply", 90000000, gb);
    ASSERT_FALSE(bake.ok());
    EXPECT_EQ(bake.error().line(),
              "scan.ply: baking its 90000000 triangles needs 1.2 GB of memory, and this machine has 1.0 GB, "
              "enough for 54166666: give a part of the mesh, or bake it on a larger machine");
    // What it says would fit does, and one more does not.
    EXPECT_TRUE(check_bake_memory("scan.ply", 54166666, gb).ok());
    EXPECT_FALSE(check_bake_memory("scan.ply", 54166667, gb).ok());
    // The most triangles that a mesh may have, on a machine that has 2 GB for them.
    EXPECT_TRUE(check_bake_memory("scan.ply", 100000000, 2 * gb).ok());
}

TEST(GraphMemory, OfASmallMeshIsThereOnAnyMachine) {
    EXPECT_TRUE(check_graph_memory("box.obj", 12).ok());
}

}  // namespace
}  // namespace oro
