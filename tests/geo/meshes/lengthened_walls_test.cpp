// Walls of buildings that end above the terrain: led down to the lowest ground below them, roofs as they
// were.
#include "geo/meshes/lengthened_walls.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/made_terrain.h"

namespace oro {
namespace {

// A box of 0.0004 degrees whose floor is at 500 m and whose roof is at 510 m, with an eave 5 m under the
// roof.
PlacedMesh box(const std::string& type) {
    PlacedMesh mesh;
    mesh.kind = MeshKind::city_model;
    for (const double H_m : {500.0, 510.0})
        for (const auto& [north, east] : {std::pair{0.0, 0.0}, {0.0, 4.0}, {4.0, 4.0}, {4.0, 0.0}})
            mesh.vertices.push_back({46.95 + 1.0e-4 * north, 8.05 + 1.0e-4 * east, H_m});
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t next = (i + 1) % 4;
        mesh.triangles.push_back({i, next, next + 4});
        mesh.triangles.push_back({i, next + 4, i + 4});
    }
    mesh.vertices.push_back({46.9501, 8.0498, 505.0});
    mesh.vertices.push_back({46.9503, 8.0498, 505.0});
    mesh.triangles.push_back({8, 9, 4});
    mesh.features.push_back({"house", type, "", {}, 0});
    mesh.feature_of.assign(mesh.triangles.size(), 0);
    return mesh;
}

// The ground falls by 10 m a thousandth of a degree to the north: at the box from 498 m down to 494 m.
HeightField slope() {
    return test::made_field(47.0, 8.0, 1200.0, 120, 120, [](double lat_deg, double) {
        return static_cast<float>(498.0 - 1.0e4 * (lat_deg - 46.95));
    });
}

TEST(LengthenedWalls, EndBelowTheLowestGround) {
    const HeightField field = slope();
    const HeightField* const fields[] = {&field};
    PlacedMesh mesh = box("BuildingPart");
    const PlacedMesh before = mesh;
    lengthen_walls(fields, mesh);
    EXPECT_EQ(mesh.lengthened, 1U);
    // The lowest ground is 494 m at the north side, half a metre below it 493.5 m.
    EXPECT_NEAR(mesh.most_lengthened_m, 6.5, 0.01) << "m";
    ASSERT_EQ(mesh.triangles.size(), before.triangles.size() + 8U) << "two below each of four walls";
    ASSERT_EQ(mesh.vertices.size(), before.vertices.size() + 4U);
    EXPECT_EQ(mesh.feature_of.size(), mesh.triangles.size());
    for (std::size_t i = 0; i < before.vertices.size(); ++i)
        EXPECT_EQ(mesh.vertices[i].H_m, before.vertices[i].H_m) << "nothing that was there moves";
    EXPECT_TRUE(std::equal(before.triangles.begin(), before.triangles.end(), mesh.triangles.begin()));
    for (std::size_t i = before.vertices.size(); i < mesh.vertices.size(); ++i)
        EXPECT_NEAR(mesh.vertices[i].H_m, 493.5, 0.01) << "m";
    EXPECT_NE(note_of_mesh(mesh).find("walls of 1 building led down to the ground, by up to 6.5 m"),
              std::string::npos)
        << note_of_mesh(mesh);
}

TEST(LengthenedWalls, OnlyOfBuildingsThatFloat) {
    const HeightField field = slope();
    const HeightField* const fields[] = {&field};
    for (const char* const type : {"Bridge", "Road", "TINRelief", "BuildingInstallation"}) {
        PlacedMesh mesh = box(type);
        lengthen_walls(fields, mesh);
        EXPECT_EQ(mesh.lengthened, 0U) << type;
        EXPECT_EQ(mesh.triangles.size(), box(type).triangles.size()) << type;
    }
    PlacedMesh other = box("Building");
    other.kind = MeshKind::unknown;
    lengthen_walls(fields, other);
    EXPECT_EQ(other.lengthened, 0U);
    PlacedMesh sunk = box("Building");
    for (PlacedVertex& vertex : sunk.vertices) vertex.H_m -= 7.0;
    lengthen_walls(fields, sunk);
    EXPECT_EQ(sunk.lengthened, 0U) << "its floor is at 493 m";
    PlacedMesh beside = box("Building");
    for (PlacedVertex& vertex : beside.vertices) vertex.lat_deg += 10.0;
    lengthen_walls(fields, beside);
    EXPECT_EQ(beside.lengthened, 0U);
}

}  // namespace
}  // namespace oro
