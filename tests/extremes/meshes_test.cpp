// Meshes: where their corners are drawn.
#include "tests/extremes/accuracy_table.h"
#include "tests/geo/meshes/drawn_corners.h"

namespace oro {
namespace {

TEST(Extremes, CornersOfMeshesLieWhereProjHasThem) {
    const test::WorstCorner worst = test::worst_drawn_corner(5207);
    ASSERT_GE(worst.asked, 600U);
    test::measured("Places", "corners of meshes in four CRSs", 1000.0 * worst.off_m, worst.asked);
}

}  // namespace
}  // namespace oro
