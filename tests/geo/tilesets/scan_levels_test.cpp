// An airborne scan in 3D Tiles: its levels against the triangles of all its points.
#include <gtest/gtest.h>
#include <ogr_geometry.h>

#include <cmath>
#include <memory>

#include "tests/geo/tilesets/level_tiles.h"

namespace oro {
namespace {
using namespace test;

constexpr unsigned scan_seed = 20261201;

// The points of a LAS file, in metres from the first. Source: ASPRS, LAS specification 1.2, public header.
std::vector<glm::dvec3> points_of_las(const std::filesystem::path& path, double metres) {
    const std::string bytes = all_bytes(path);
    const auto first = value_at<std::uint32_t>(bytes, 96), count = value_at<std::uint32_t>(bytes, 107);
    const auto size = value_at<std::uint16_t>(bytes, 105);
    std::vector<glm::dvec3> points;
    for (std::size_t i = 0; i < count; ++i) {
        glm::dvec3& point = points.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t from = value_at<std::int32_t>(bytes, first + 4 * axis);
            const std::int64_t at = value_at<std::int32_t>(bytes, first + i * size + 4 * axis);
            point[static_cast<int>(axis)] =
                metres * static_cast<double>(at - from) * value_at<double>(bytes, 131 + 8 * axis);
        }
    }
    return points;
}

// Delaunay's triangles in plan; of points over each other the first.
SpaceMesh triangulated(const std::vector<glm::dvec3>& points) {
    std::map<std::pair<double, double>, std::uint32_t> numbers;
    SpaceMesh mesh;
    OGRMultiPoint all;
    for (const glm::dvec3& point : points)
        if (numbers.try_emplace({point.x, point.y}, static_cast<std::uint32_t>(mesh.vertices.size()))
                .second) {
            mesh.vertices.push_back(point);
            OGRPoint one(point.x, point.y);
            all.addGeometry(&one);
        }
    const std::unique_ptr<OGRGeometry> made(all.DelaunayTriangulation(0.0, FALSE));
    if (!made) return mesh;
    for (const OGRGeometry* const one : *made->toGeometryCollection()) {
        const OGRLinearRing* const ring = one->toPolygon()->getExteriorRing();
        std::array<std::uint32_t, 3> corners{};
        for (int i = 0; i < 3; ++i)
            corners[static_cast<std::size_t>(i)] = numbers.at({ring->getX(i), ring->getY(i)});
        if (ring->isClockwise() != 0) std::swap(corners[1], corners[2]);
        mesh.triangles.push_back(corners);
    }
    return mesh;
}

// 100,000 places of the scan, and as many drawn ones, in 50 cuts.
TEST(ScanLevels, OfAnAirborneScanAreWithinTheirErrors) {
    const auto file = real_data("meshes/autzen_trim.las");
    if (!file) GTEST_SKIP() << "needs meshes/autzen_trim.las";
    constexpr double foot_m = 0.3048;
    const PlacedMesh scan =
        placed_mesh(triangulated(points_of_las(*file, foot_m)), {46.58, 8.02, 1500.0}, "");
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
