// Meshes put on the Earth: places and heights against literal ones, long sides, and what is refused.
#include "geo/meshes/placed_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>

#include "core/earth/ellipsoid.h"
#include "geo/meshes/mesh_in_box.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

Result<std::shared_ptr<const std::vector<PlacedMesh>>> placed_from(const std::string& name,
                                                                   const std::string& text,
                                                                   const std::string& crs,
                                                                   const std::string& unit = "") {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "placed_meshes";
    std::filesystem::create_directories(folder);
    const std::string path = (folder / name).string();
    std::ofstream(path, std::ios::binary) << text;
    MeshRequest request;
    request.files = {path}, request.crs = crs, request.unit = unit;
    return open_meshes(request, false, {});
}

const std::string near_bern =
    "v 2600000 1200000 500\nv 2600100 1200000 500.25\nv 2600000 1200100 501\nf 1 2 3\n";

// Latitude and longitude by gdaltransform 3.6.2 (PROJ 9.1.1) from EPSG:2056 to EPSG:4326, of places without a
// height, as posts of rasters in that CRS are placed.
TEST(PlacedMesh, VerticesLieWhereProjHasThem) {
    const auto meshes = placed_from("bern.obj", near_bern, "EPSG:2056");
    ASSERT_TRUE(meshes.ok()) << meshes.error().line();
    const PlacedMesh& mesh = (*meshes)->front();
    constexpr double micrometre_deg = 1.0e-11;
    EXPECT_NEAR(mesh.vertices[0].lat_deg, 46.9510827718711, 10.0 * micrometre_deg);
    EXPECT_NEAR(mesh.vertices[0].lon_deg, 7.43863242087181, 10.0 * micrometre_deg);
    EXPECT_EQ(mesh.vertices[0].H_m, 500.0);
    EXPECT_EQ(mesh.vertices[1].H_m, 500.25);
    EXPECT_EQ(mesh.heights, "sea level (EGM96)");
    EXPECT_EQ(mesh.crs, "EPSG:2056 CH1903+ / LV95");
}

// 0.3048 m a foot: the corner 2600000 m is 8530183.727034 ft.
TEST(PlacedMesh, AUnitScalesPlacesAndHeights) {
    const auto meshes = placed_from("feet.obj",
                                    "v 8530183.7270341207 3937007.8740157480 1000\nv 8530500 3937007.8 1000\n"
                                    "v 8530183 3937300 1000\nf 1 2 3\n",
                                    "EPSG:2056", "ft");
    ASSERT_TRUE(meshes.ok()) << meshes.error().line();
    const PlacedMesh& mesh = (*meshes)->front();
    EXPECT_NEAR(mesh.vertices[0].lat_deg, 46.9510827718711, 1.0e-10);
    EXPECT_NEAR(mesh.vertices[0].H_m, 304.8, 1.0e-9) << "m";
    EXPECT_NE(mesh.note.find("times 0.3048"), std::string::npos) << mesh.note;
}

TEST(PlacedMesh, HeightsAboveTheEllipsoidAreLessByN) {
    UndulationField fifty_m;
    fifty_m.lat = {1.0, 0.0, 48, -1, 3};
    fifty_m.lon = {1.0, 0.0, 6, +1, 3};
    fifty_m.N_m.assign(9, 50.0F);
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "above.obj";
    std::ofstream(path) << "v 7.4 46.9 500\nv 7.401 46.9 500\nv 7.4 46.901 500\nf 1 2 3\n";
    MeshRequest request;
    request.files = {path.string()}, request.crs = "EPSG:4979";
    const auto meshes = open_meshes(request, true, fifty_m);
    ASSERT_TRUE(meshes.ok()) << meshes.error().line();
    const PlacedMesh& mesh = (*meshes)->front();
    EXPECT_NEAR(mesh.vertices[0].lat_deg, 46.9, 1.0e-10);
    EXPECT_NEAR(mesh.vertices[0].H_m, 450.0, 1.0e-3) << "m";
}

// N of 50 m: a base at 480 m above the ellipsoid is one at 430 m.
TEST(PlacedMesh, BasesOfFootprintsCountFromTheDatumThatIsAsked) {
    HeightField field = test::rough_field(47.0, 8.0, 90, 90);
    std::ranges::fill(field.H_m, 400.0F);
    const HeightField* const ground[] = {&field};
    UndulationField fifty_m;
    fifty_m.lat = {1.0, 0.0, 48, -1, 3};
    fifty_m.lon = {1.0, 0.0, 6, +1, 3};
    fifty_m.N_m.assign(9, 50.0F);
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "bases.geojson";
    std::ofstream(path) << R"({"type":"Feature","properties":{"height":10,"floor":480},"geometry":)"
                           R"({"type":"Polygon","coordinates":[[[8.03,46.97],[8.031,46.97],[8.031,46.971],)"
                           R"([8.03,46.97]]]}})";
    MeshRequest request;
    request.files = {path.string()}, request.crs = "EPSG:4979";
    request.building_height = "height", request.building_base = "floor";
    const auto meshes = open_meshes(request, true, fifty_m, ground);
    ASSERT_TRUE(meshes.ok()) << meshes.error().line();
    const PlacedMesh& mesh = (*meshes)->front();
    EXPECT_NEAR(mesh.vertices[0].H_m, 440.0, 1.0e-3) << "m";
    EXPECT_NE(mesh.heights.find("WGS 84"), std::string::npos) << mesh.heights;
    EXPECT_EQ(mesh.crs, "EPSG:4326 WGS 84") << "its horizontal part, as of other meshes";
    request.unit = "ft", request.building_base = "", request.crs = "";
    const auto feet = open_meshes(request, true, fifty_m, ground);
    ASSERT_TRUE(feet.ok()) << feet.error().line();
    EXPECT_NEAR((*feet)->front().vertices[0].H_m, 403.048, 1.0e-9) << "m: 10 ft over the ground";
    request.lod = "2";
    EXPECT_EQ(open_meshes(request, true, fifty_m, ground).error().line(),
              "--lod 2: is of CityJSON, and no mesh is in that format");
}

// Sides of neighbours are cut alike: each edge inside has two triangles.
TEST(PlacedMesh, LongSidesAreCutAlike) {
    const auto meshes = placed_from(
        "long.obj",
        "v 2600000 1200000 500\nv 2603000 1200000 900\nv 2603000 1202100 700\nv 2600000 1202100 500\n"
        "f 1 2 3\nf 1 3 4\n",
        "EPSG:2056");
    ASSERT_TRUE(meshes.ok()) << meshes.error().line();
    const PlacedMesh& mesh = (*meshes)->front();
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (const SourceTriangle& triangle : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
            ++edges[std::minmax(a, b)];
            const auto at = [&](std::uint32_t v) {
                return ecef_from_geodetic({mesh.vertices[v].lat_deg, mesh.vertices[v].lon_deg, 0.0}).m;
            };
            EXPECT_LE(glm::distance(at(a), at(b)), longest_side_m);
        }
    }
    int rim = 0;
    for (const auto& [edge, triangles] : edges) {
        EXPECT_LE(triangles, 2);
        rim += triangles == 1 ? 1 : 0;
    }
    // 3,000 m are halved 4 times, 2,100 m likewise: 2 x 16 each.
    EXPECT_EQ(rim, 64);
    EXPECT_EQ(mesh.in_file, 2U);
}

// A thousand triangles of 5 km were refused for "more than 5,000,000 triangles with sides of 200 m and less".
// Of a square of 300 km no fewer than 5.2 million are left: 9e10 m2 / 17,320 m2. Its diagonal has 424.3 km.
TEST(PlacedMesh, TooManyPiecesAreToldWithTheirReason) {
    const auto meshes = placed_from("large.obj",
                                    "v 350000 5000000 500\nv 650000 5000000 500\nv 650000 5300000 500\n"
                                    "v 350000 5300000 500\nf 1 2 3\nf 1 3 4\n",
                                    "EPSG:25832");
    ASSERT_FALSE(meshes.ok());
    EXPECT_TRUE(meshes.error().what.starts_with("has 2 triangles with sides of up to 424"))
        << meshes.error().what;
    for (const char* const words :
         {"Sides are cut to 200 m", "more than 5,000,000 triangles, which is the limit", "--mesh-unit"})
        EXPECT_NE(meshes.error().what.find(words), std::string::npos) << meshes.error().what;
    // Between its corners, which have places, a triangle may leave what a CRS is made for.
    const auto beyond = placed_from(
        "beyond.obj", "v 2500000 1080000 500\nv 2500000 4000000 500\nv 2500100 1080000 500\nf 1 2 3\n",
        "EPSG:2056");
    ASSERT_FALSE(beyond.ok());
    EXPECT_EQ(beyond.error().what.find("heights are beyond"), std::string::npos) << beyond.error().what;
}

// In degrees: a triangle across the antimeridian, and boxes beside it.
TEST(PlacedMesh, WhatReachesIntoABox) {
    const auto meshes = placed_from(
        "fiji.obj", "v 179.9995 -17 5\nv -179.9995 -17 5\nv 180 -16.999 5\nf 1 2 3\n", "EPSG:4326");
    ASSERT_TRUE(meshes.ok()) << meshes.error().line();
    const PlacedMesh& mesh = (*meshes)->front();
    EXPECT_TRUE(reaches_into(mesh, {179.0, -18.0, -179.0, -16.0}));
    EXPECT_TRUE(reaches_into(mesh, {-180.0, -18.0, -179.9998, -16.0}));
    EXPECT_TRUE(reaches_into(mesh, {179.0, -17.5, 180.0, -16.9995}));
    EXPECT_FALSE(reaches_into(mesh, {-179.99, -18.0, -179.0, -16.0}));
    EXPECT_FALSE(reaches_into(mesh, {179.0, -18.0, -179.0, -17.1}));
    EXPECT_FALSE(reaches_into(mesh, {-1.0, -18.0, 1.0, -16.0}));
}

TEST(PlacedMesh, RefusesWhatHasNoPlace) {
    const auto why = [](const auto& result) { return result.ok() ? "" : result.error().line(); };
    EXPECT_NE(why(placed_from("a.obj", near_bern, "")).find("states no coordinate reference system"),
              std::string::npos);
    EXPECT_NE(why(placed_from("b.obj", near_bern, "EPSG:999999")).find("--mesh-crs EPSG:999999"),
              std::string::npos);
    EXPECT_NE(why(placed_from("c.obj", "v 5000 5000 1\nv 5010 5000 1\nv 5000 5010 1\nf 1 2 3\n", "EPSG:2056"))
                  .find("outside the area of use"),
              std::string::npos);
    EXPECT_NE(why(placed_from("d.obj", near_bern, "EPSG:2056", "cubit")).find("--mesh-unit cubit"),
              std::string::npos);
    EXPECT_NE(why(placed_from("e.obj",
                              "v 2600000 1200000 1\nv 2600000 1200000.0001 1\nv 2600000 1200000 1\nf 1 2 3\n",
                              "EPSG:2056"))
                  .find("no triangle has an area"),
              std::string::npos);
    // One triangle outside: left out, counted.
    const auto some = placed_from("f.obj", near_bern + "v 1 1 1\nf 1 2 4\nf 1 2 2\n", "EPSG:2056");
    ASSERT_TRUE(some.ok()) << some.error().line();
    EXPECT_EQ((*some)->front().not_placed, 1U);
    EXPECT_EQ((*some)->front().degenerate, 1U);
    EXPECT_NE(note_of_mesh((*some)->front()).find("1 left out, with a vertex that has no place"),
              std::string::npos);
}

}  // namespace
}  // namespace oro
