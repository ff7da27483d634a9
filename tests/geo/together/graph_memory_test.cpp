// What building a graph needs is told before it is begun.
#include "geo/together/graph_memory.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

constexpr std::uint64_t gb = 1'000'000'000;

// Measured: baking a scan of 4,999,122 triangles took 5.55 GB at most, its terrain of 1 MB among them.
TEST(GraphMemory, IsNoLessThanWhatWasMeasured) {
    EXPECT_GE(graph_bytes(4999122), 5547 * gb / 1000);
    EXPECT_LE(graph_bytes(4999122), 6500 * gb / 1000);
}

TEST(GraphMemory, MoreThanThreeQuartersOfTheMachinesIsRefusedWithBothNumbers) {
    EXPECT_TRUE(check_graph_memory("scan.ply", 2000000, 6 * gb).ok());
    const auto refused = check_graph_memory("scan.ply", 5000000, 6 * gb);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(
        refused.error().line(),
        "scan.ply: building the cluster graph of its 5000000 triangles needs 6.1 GB of memory, and this "
        "machine has 6.0 GB, enough for 3666666: give a part of the mesh, or bake it on a larger machine");
    // What it says would fit does, and one more does not.
    EXPECT_TRUE(check_graph_memory("scan.ply", 3666666, 6 * gb).ok());
    EXPECT_FALSE(check_graph_memory("scan.ply", 3666667, 6 * gb).ok());
}

TEST(GraphMemory, OfASmallMeshIsThereOnAnyMachine) {
    EXPECT_TRUE(check_graph_memory("box.obj", 12).ok());
}

}  // namespace
}  // namespace oro
