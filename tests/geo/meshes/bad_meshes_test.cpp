// What is wrong with files of meshes, row by row: each gets one clear line, or is drawn and counted.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "geo/meshes/mesh_census.h"
#include "geo/meshes/mesh_file.h"
#include "geo/meshes/mesh_over_ground.h"
#include "geo/meshes/placed_mesh.h"
#include "tests/support/made_terrain.h"

namespace oro {
namespace {

std::string bad_written(const std::string& name, const std::string& bytes) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "bad_meshes";
    std::filesystem::create_directories(folder);
    const std::string path = (folder / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

std::string why_not_read(const std::string& name, const std::string& bytes) {
    const auto read = read_mesh(bad_written(name, bytes));
    return read.ok() ? "" : read.error().what;
}

struct Placing {
    std::string refusal;
    PlacedMesh mesh;
};
Placing placing_of(const std::string& obj, const std::string& crs, const std::string& unit = "") {
    MeshRequest request;
    request.files = {bad_written("placed.obj", obj)}, request.crs = crs, request.unit = unit;
    const auto meshes = open_meshes(request, false, {});
    if (!meshes.ok()) return {meshes.error().what, {}};
    return {"", meshes->get()->front()};
}

const std::string lv95_corners = "v 2600000 1200000 500\nv 2600100 1200000 500\nv 2600000 1200100 501\n";

TEST(BadMeshes, HugeIndicesNameTheirLine) {
    EXPECT_EQ(why_not_read("a.obj", "v 0 0 0\nf 1 1 4294967297\n"),
              "line 2: the corner 4294967297 is none of the 1 vertices before it");
    EXPECT_EQ(why_not_read("b.obj", "v 0 0 0\nf 1 1 99999999999999999999999\n"),
              "line 2: the corner 99999999999999999999999 is none of the 1 vertices before it");
    EXPECT_NE(why_not_read("c.ply",
                           "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                           "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                           "end_header\n0 0 0\n3 0 0 2147483647\n"),
              "");
}

// What a header does not count was left out without a word.
TEST(BadMeshes, APlyWithMoreThanItsHeaderNamesIsRefused) {
    const auto ply = [](const char* format, int vertices, int faces) {
        return "ply\nformat " + std::string(format) + " 1.0\nelement vertex " + std::to_string(vertices) +
               "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
               std::to_string(faces) + "\nproperty list uchar int vertex_indices\nend_header\n";
    };
    const std::string body = "0 0 0\n1 0 0\n0 1 0\n1 1 1\n3 0 1 2\n3 1 2 3\n";
    EXPECT_EQ(why_not_read("a.ply", ply("ascii", 4, 2) + body + " \n\n"), "");
    EXPECT_EQ(why_not_read("a.ply", ply("ascii", 4, 1) + body),
              "line 15: the file goes on behind all that its header names (4 of vertex, 1 of face): is a "
              "count in it "
              "too small?");
    std::string binary = ply("binary_little_endian", 3, 1);
    const std::size_t header = binary.size();
    for (const float value : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F})
        binary.append(reinterpret_cast<const char*>(&value), sizeof value);
    const std::string face("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
    EXPECT_EQ(why_not_read("b.ply", binary + face), "");
    EXPECT_EQ(
        why_not_read("b.ply", binary + face + face),
        "byte " + std::to_string(header + 36 + 13) +
            ": the file goes on behind all that its header names (3 of vertex, 1 of face): is a count in it "
            "too small?");
}

TEST(BadMeshes, LandXmlWithoutSurfacesSaysSo) {
    EXPECT_EQ(why_not_read("a.xml", "<LandXML><Units/></LandXML>"), "no triangles");
    EXPECT_EQ(why_not_read("b.xml", "<LandXML><Surfaces/></LandXML>"), "no triangles");
    EXPECT_EQ(why_not_read("c.xml", "<LandXML><Surfaces><Surface name=\"x\"/></Surfaces></LandXML>"),
              "no triangles");
    EXPECT_EQ(why_not_read("d.xml", "<LandXML><Units><Imperial linearUnit=\"cubit\"/></Units></LandXML>"),
              "has an unknown unit of length: cubit");
}

// Entities are not expanded: a text that would grow to gigabytes stays as small as it is.
TEST(BadMeshes, EntitiesOfXmlDoNotExpand) {
    std::string bomb = "<?xml version=\"1.0\"?><!DOCTYPE LandXML [<!ENTITY a \"aaaaaaaaaa\">";
    for (char name = 'b'; name < 'l'; ++name) {
        bomb += std::string("<!ENTITY ") + name + " \"";
        for (int i = 0; i < 10; ++i) bomb += std::string("&") + static_cast<char>(name - 1) + ";";
        bomb += "\">";
    }
    bomb += "]><LandXML><Surfaces><Surface name=\"&k;\"/></Surfaces></LandXML>";
    EXPECT_NE(why_not_read("bomb.xml", bomb), "");
}

TEST(BadMeshes, DeepNestingIsRefused) {
    std::string deep = R"({"type":"CityJSON","version":"2.0","x":)" + std::string(100000, '[');
    EXPECT_NE(why_not_read("deep.city.json", deep).find("line 1"), std::string::npos);
    std::string xml = "<LandXML>";
    for (int i = 0; i < 100000; ++i) xml += "<a>";
    EXPECT_NE(why_not_read("deep.xml", xml), "");
}

TEST(BadMeshes, CityJsonWithoutTransformIsReadAndNamed) {
    const std::string members =
        R"("CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface",)"
        R"("lod":"1","boundaries":[[[0,1,2]]]}]}},"vertices":[[0,0,0],[9,0,0],[0,9,0]]})";
    for (const std::string version : {"1.0", "1.1", "2.0"}) {
        const auto read = read_mesh(
            bad_written("t.city.json", R"({"type":"CityJSON","version":")" + version + "\"," + members));
        ASSERT_TRUE(read.ok()) << read.error().line();
        EXPECT_EQ(read->vertices[1], glm::dvec3(9.0, 0.0, 0.0));
        EXPECT_EQ(read->notes.size(), version == "1.0" ? 0U : 1U) << "1.0 may do without";
    }
    EXPECT_NE(why_not_read("u.city.json",
                           R"({"type":"CityJSON","version":"2.0","transform":{"scale":[1,1,1]},)" + members)
                  .find("'transform' has no scale and translate"),
              std::string::npos);
}

TEST(BadMeshes, JsonThatIsNoneNamesItsLine) {
    EXPECT_NE(why_not_read("a.city.json", "{\"type\":\"CityJSON\",\n\"version\" 2}").find("line 2"),
              std::string::npos);
    EXPECT_NE(why_not_read("b.city.json", "[]"), "");
    EXPECT_NE(why_not_read("c.city.json", ""), "");
}

// LV95 in feet: 2,600,000 ft are 792,480 m, where LV95 has no place.
TEST(BadMeshes, AWrongUnitHasNoPlace) {
    EXPECT_NE(placing_of(lv95_corners + "f 1 2 3\n", "EPSG:2056", "ft").refusal.find("is --mesh-crs right?"),
              std::string::npos);
}

// The CRS was blamed.
TEST(BadMeshes, AHeightBeyondAllIsNamed) {
    const std::string one = "v 2600000 1200000 500\nv 2600100 1200000 1000000500\nv 2600000 1200100 501\n";
    EXPECT_EQ(placing_of(one + "f 1 2 3\n", "EPSG:2056").refusal,
              "none of its triangles has a place: the height at 2600100, 1200000 is 1000000500 m, beyond 100 "
              "km; is its unit right (--mesh-unit)?");
    const Placing rest = placing_of(one + lv95_corners + "f 1 2 3\nf 4 5 6\n", "EPSG:2056");
    EXPECT_EQ(rest.refusal, "");
    EXPECT_EQ(rest.mesh.note, "the height at 2600100, 1200000 is 1000000500 m, beyond 100 km");
}

// A file that names a CRS that is none is a bad file, not bad usage.
TEST(BadMeshes, ACrsThatTheFileMakesUpIsTheFiles) {
    MeshRequest request;
    request.files = {bad_written(
        "crs.city.json",
        R"({"type":"CityJSON","version":"1.0","metadata":{"referenceSystem":"urn:ogc:def:crs:EPSG::999999"},)"
        R"("CityObjects":{"b":{"type":"Building","geometry":[{"type":"MultiSurface",)"
        R"("lod":"1","boundaries":[[[0,1,2]]]}]}},"vertices":[[0,0,0],[9,0,0],[0,9,0]]})")};
    const auto of_file = open_meshes(request, false, {});
    ASSERT_FALSE(of_file.ok());
    EXPECT_EQ(of_file.error().kind, ErrorKind::failed);
    EXPECT_NE(of_file.error().line().find("EPSG:999999"), std::string::npos);
    request.crs = "EPSG:999999";
    EXPECT_EQ(open_meshes(request, false, {}).error().kind, ErrorKind::usage);
}

TEST(BadMeshes, LevelsOfDetailAreOfCityJson) {
    MeshRequest request;
    request.files = {bad_written("flat.obj", lv95_corners + "f 1 2 3\n")}, request.crs = "EPSG:2056";
    request.lod = "2";
    const auto meshes = open_meshes(request, false, {});
    ASSERT_FALSE(meshes.ok());
    EXPECT_EQ(meshes.error().kind, ErrorKind::usage);
    EXPECT_EQ(meshes.error().line(), "--lod 2: is of CityJSON, and no mesh is in that format");
}

TEST(BadMeshes, FormatsThatAreNotReadNameTheWay) {
    const std::string citygml = "<?xml version=\"1.0\"?><core:CityModel xmlns:core=\"x\"/>";
    EXPECT_EQ(why_not_read("t.gml", citygml),
              "is GML: CityGML is not read; citygml-tools turns it into CityJSON");
    EXPECT_EQ(why_not_read("t.xml", citygml), "CityGML is not read; citygml-tools turns it into CityJSON");
    EXPECT_EQ(why_not_read("t.las", "LASF").find("is a point cloud, and these are not read: "), 0U);
}

TEST(BadMeshes, SwappedAxesAreNamed) {
    const std::string swapped =
        "v 1200000 2600000 500\nv 1200000 2600100 500\nv 1200100 2600000 501\nf 1 2 3\n";
    EXPECT_NE(
        placing_of(swapped, "EPSG:2056").refusal.find("with x and y swapped they have: x is the easting"),
        std::string::npos)
        << placing_of(swapped, "EPSG:2056").refusal;
}

// Latitude first: 46.9 N, 7.4 E is taken for 7.4 N, 46.9 E, which is a place, too.
TEST(BadMeshes, LatitudeBeforeLongitudeIsNamed) {
    const Placing placing =
        placing_of("v 46.95 8.05 500\nv 46.951 8.05 500\nv 46.95 8.051 500\nf 1 2 3\n", "EPSG:4326");
    ASSERT_EQ(placing.refusal, "");
    const HeightField field =
        test::made_field(47.0, 8.0, 1200.0, 120, 120, [](double, double) { return 450.0F; });
    const HeightField* const fields[] = {&field};
    EXPECT_FALSE(mesh_over_ground(placing.mesh, fields).has_value());
    EXPECT_TRUE(is_over_ground_swapped(placing.mesh, fields));
}

TEST(BadMeshes, GeographicHeightsMayBeInTheCrs) {
    const Placing placing =
        placing_of("v 7.4 46.9 500\nv 7.401 46.9 500\nv 7.4 46.901 500\nf 1 2 3\n", "EPSG:4979");
    ASSERT_EQ(placing.refusal, "");
    EXPECT_NE(placing.mesh.heights.find("WGS 84"), std::string::npos) << placing.mesh.heights;
}

TEST(BadMeshes, OneThatIsTooFarOutIsRefused) {
    const Placing placing = placing_of(
        "v 0 0 0\nv 0.001 0 0\nv 0 0.001 0\nf 1 2 3\nv 40 0 0\nv 40.001 0 0\nv 40 0.001 0\nf 4 5 6\n",
        "EPSG:4326");
    EXPECT_NE(placing.refusal.find("one mesh may reach 2,000 km; is --mesh-crs right?"), std::string::npos)
        << placing.refusal;
    EXPECT_NE(placing_of("v 1e9 1e9 0\nv 1e9 1.1e9 0\nv 1.1e9 1e9 0\nf 1 2 3\n", "EPSG:2056").refusal, "");
}

TEST(BadMeshes, OneTriangleIsDrawn) {
    const Placing placing = placing_of(lv95_corners + "f 1 2 3\n", "EPSG:2056");
    ASSERT_EQ(placing.refusal, "");
    EXPECT_EQ(placing.mesh.triangles.size(), 1U);
}

// Given again, and the other way round: one is left; two corners at one place: none.
TEST(BadMeshes, DuplicatesAndSliversAreCounted) {
    const Placing placing =
        placing_of(lv95_corners + "v 2600000 1200000 500\nf 1 2 3\nf 2 3 1\nf 1 3 2\nf 1 4 2\n", "EPSG:2056");
    ASSERT_EQ(placing.refusal, "");
    EXPECT_EQ(placing.mesh.triangles.size(), 1U);
    EXPECT_EQ(placing.mesh.degenerate, 1U);
    EXPECT_NE(note_of_mesh(placing.mesh).find("2 left out, given twice"), std::string::npos)
        << note_of_mesh(placing.mesh);
}

// An edge of three triangles, turned ones, and two that cross each other: drawn as they are.
TEST(BadMeshes, CrowdedTurnedAndCrossingOnesAreDrawn) {
    const Placing placing = placing_of(
        lv95_corners +
            "v 2600000 1199900 502\nv 2600010 1200020 600\nv 2600050 1200050 400\nf 1 2 3\nf 1 2 4\n"
            "f 1 2 5\nf 4 5 6\n",
        "EPSG:2056");
    ASSERT_EQ(placing.refusal, "");
    EXPECT_EQ(placing.mesh.triangles.size(), 4U);
}

TEST(BadMeshes, HeightsThatAreNoneAreLeftOut) {
    const Placing placing =
        placing_of(lv95_corners + "v 2600100 1200100 inf\nv 2600100 1200100 1e7\nf 1 2 3\nf 2 3 4\nf 2 3 5\n",
                   "EPSG:2056");
    ASSERT_EQ(placing.refusal, "");
    EXPECT_EQ(placing.mesh.not_finite, 1U);
    EXPECT_EQ(placing.mesh.not_placed, 1U) << "10,000 km high";
}

}  // namespace
}  // namespace oro
