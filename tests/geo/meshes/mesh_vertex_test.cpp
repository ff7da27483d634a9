// A mesh's vertices as they are drawn, against PROJ (by OGR) and GeographicLib.
#include "tests/geo/meshes/drawn_corners.h"

namespace oro {
namespace {

TEST(MeshVertex, IsDrawnWithinAMillimetre) {
    const unsigned seed = 5207;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const test::WorstCorner worst = test::worst_drawn_corner(seed);
    EXPECT_GE(worst.asked, 600U) << "corners of the file that are drawn";
    EXPECT_LE(worst.off_m, 0.001) << "m";
    std::printf("worst of %zu corners: %.3f mm\n", worst.asked, 1000.0 * worst.off_m);
}

}  // namespace
}  // namespace oro
