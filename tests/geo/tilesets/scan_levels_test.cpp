// An airborne scan in 3D Tiles: its levels against the triangles of all its points.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "tests/geo/tilesets/airborne_scan.h"

namespace oro {
namespace {
using namespace test;

constexpr unsigned scan_seed = 20261201;

// 100,000 places of the scan, and as many drawn ones, in 50 cuts.
TEST(ScanLevels, OfAnAirborneScanAreWithinTheirErrors) {
    const auto mesh = airborne_scan();
    if (!mesh) GTEST_SKIP() << "needs meshes/autzen_trim.las";
    const PlacedMesh scan = placed_mesh(*mesh, {46.58, 8.02, 1500.0}, "");
    EXPECT_GT(scan.triangles.size(), 219900U);
    const LevelTiles levels(scan, 4096);
    std::printf("%llu tiles, %llu triangles, %llu bytes\n",
                static_cast<unsigned long long>(levels.written.meshes.tiles),
                static_cast<unsigned long long>(levels.written.meshes.triangles),
                static_cast<unsigned long long>(levels.written.meshes.bytes));
    expect_levels(levels, 3);
    std::mt19937 random(scan_seed);
    const LevelCheck check = check_levels(levels, 50, 2000, 1.0, random);
    print_check(check, scan_seed, 50);
    EXPECT_EQ(check.places_over, 0U);
    EXPECT_EQ(check.drawn_over, 0U);
    const LevelCheck halved = check_levels(levels, 20, 2000, 0.5, random);
    EXPECT_GT(halved.places_over + halved.drawn_over, 0U);
}

}  // namespace
}  // namespace oro
