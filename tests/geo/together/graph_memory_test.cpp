// What building a graph needs is told before it is begun.
#include "geo/together/graph_memory.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

constexpr std::uint64_t gb = 1'000'000'000;

// Measured: baking a scan of 1,996,002 triangles took 1.67 GB at most, its terrain of 1 MB among them.
TEST(GraphMemory, IsNoLessThanWhatWasMeasured) {
    EXPECT_GE(graph_bytes(1996002), 1670 * gb / 1000);
    EXPECT_LE(graph_bytes(1996002), 2000 * gb / 1000);
}

TEST(GraphMemory, MoreThanThreeQuartersOfTheMachinesIsRefusedWithBothNumbers) {
    EXPECT_TRUE(check_graph_memory("scan.ply", 2000000, 4 * gb).ok());
    const auto refused = check_graph_memory("scan.ply", 5000000, 4 * gb);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(
        refused.error().line(),
        "scan.ply: building the cluster graph of its 5000000 triangles needs 4.3 GB of memory, and this "
        "machine has 4.0 GB, enough for 3411765: give a part of the mesh, or bake it on a larger machine");
    // What it says would fit does, and one more does not.
    EXPECT_TRUE(check_graph_memory("scan.ply", 3411764, 4 * gb).ok());
    EXPECT_FALSE(check_graph_memory("scan.ply", 3411766, 4 * gb).ok());
}

TEST(GraphMemory, OfASmallMeshIsThereOnAnyMachine) {
    EXPECT_TRUE(check_graph_memory("box.obj", 12).ok());
}

}  // namespace
}  // namespace oro
