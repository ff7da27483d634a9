// CityJSON: what towns hold, in all of its versions; literal places and attributes, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "geo/meshes/mesh_census.h"
#include "geo/meshes/mesh_file.h"
#include "tests/geo/vectors/written_vectors.h"

namespace oro {
namespace {

// A cube of 10 m at 1,000 m and 2,000 m, whose sides are given from outside.
const std::string cube_shell = "[[[0,3,2,1]],[[4,5,6,7]],[[0,1,5,4]],[[1,2,6,5]],[[2,3,7,6]],[[3,0,4,7]]]";
const std::string cube_vertices =
    "[[0,0,0],[10000,0,0],[10000,10000,0],[0,10000,0],[0,0,10000],[10000,0,10000],[10000,10000,10000],"
    "[0,10000,10000]]";

std::string town(const std::string& objects, const std::string& version = "2.0",
                 const std::string& more = "") {
    return R"({"type":"CityJSON","version":")" + version +
           R"(","metadata":{"referenceSystem":"https://www.opengis.net/def/crs/EPSG/0/7415"},)" +
           R"("transform":{"scale":[0.001,0.001,0.001],"translate":[1000,2000,-0.5]},)" + more +
           R"("CityObjects":{)" + objects + R"(},"vertices":)" + cube_vertices + "}";
}

std::string solid(const std::string& lod = "\"1\"") {
    return R"({"type":"Solid","lod":)" + lod + R"(,"boundaries":[)" + cube_shell + "]}";
}

Result<SourceMesh> read_town(const std::string& text, const std::string& lod = "") {
    return read_mesh(test::written("town.city.json", text), lod);
}

std::string town_refusal(const std::string& text) {
    const auto read = read_town(text);
    return read.ok() ? "" : read.error().what;
}

TEST(CityJson, ASolidIsReadInDouble) {
    for (const std::string version : {"1.0", "1.1", "2.0"}) {
        const auto mesh = read_town(
            town(R"("b1":{"type":"Building","attributes":{"height":10.5,"name":"Town hall","tags":["a",1],)"
                 R"("none":null},"geometry":[)" +
                     solid(version == "1.0" ? "1" : "\"1\"") + "]}",
                 version));
        ASSERT_TRUE(mesh.ok()) << mesh.error().line();
        EXPECT_EQ(mesh->triangles.size(), 12U);
        EXPECT_EQ(mesh->crs, "EPSG:7415");
        EXPECT_EQ(mesh->vertices[6], glm::dvec3(1010.0, 2010.0, 9.5));
        ASSERT_EQ(mesh->features.size(), 1U);
        const MeshFeature& feature = mesh->features[0];
        EXPECT_EQ(feature.name, "b1");
        EXPECT_EQ(feature.type, "Building");
        const std::vector<std::pair<std::string, std::string>> attributes{
            {"height", "10.5"}, {"name", "Town hall"}, {"tags", "[\"a\",1]"}, {"none", ""}};
        EXPECT_EQ(feature.attributes, attributes);
        const MeshCensus census = census_of(*mesh);
        EXPECT_EQ(census.rim_edges, 0U) << "a cube is closed";
        EXPECT_EQ(census.turned_edges, 0U);
    }
}

TEST(CityJson, PartsKnowTheirBuilding) {
    const auto mesh = read_town(
        town(R"("b":{"type":"Building","attributes":{"year":1890,"use":"school"},"children":["p1","p2"],)"
             R"("geometry":[{"type":"MultiSurface","lod":"0","boundaries":[[[0,1,2,3]]]}]},)"
             R"("p1":{"type":"BuildingPart","parents":["b"],"attributes":{"use":"hall"},"geometry":[)" +
             solid("\"2\"") + R"(]},"p2":{"type":"BuildingPart","parents":["b"],"geometry":[)" +
             solid("\"1.2\"") + "," + solid("\"2.2\"") + "]}"));
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->triangles.size(), 24U) << "the floor plan of the whole is not drawn beside its parts";
    ASSERT_EQ(mesh->features.size(), 2U);
    EXPECT_EQ(mesh->features[0].part_of, "b");
    const std::vector<std::pair<std::string, std::string>> attributes{{"use", "hall"}, {"year", "1890"}};
    EXPECT_EQ(mesh->features[0].attributes, attributes) << "its own first";
    EXPECT_EQ(mesh->features[1].first_triangle, 12U);
    ASSERT_EQ(mesh->notes.size(), 1U);
    EXPECT_EQ(mesh->notes[0], "1 object drawn by its parts alone, which are there in more detail");
}

TEST(CityJson, ALevelOfDetailIsTakenWhereAskedFor) {
    const std::string text = town(R"("b":{"type":"Building","geometry":[)" + solid("\"1\"") +
                                  R"(,{"type":"MultiSurface","lod":"0","boundaries":[[[0,1,2,3]]]}]},)"
                                  R"("c":{"type":"Building","geometry":[)" +
                                  solid("\"2.2\"") + "]}");
    EXPECT_EQ(read_town(text)->triangles.size(), 24U);
    const auto flat = read_town(text, "0");
    ASSERT_TRUE(flat.ok()) << flat.error().line();
    EXPECT_EQ(flat->triangles.size(), 2U);
    ASSERT_EQ(flat->notes.size(), 1U);
    EXPECT_EQ(flat->notes[0], "1 object without the level of detail 0 left out (the file has 0, 1, 2.2)");
    const auto none = read_town(text, "3");
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().kind, ErrorKind::usage);
    EXPECT_EQ(none.error().what, "has nothing in the level of detail 3 (--lod): it has 0, 1, 2.2");
}

// A square of 10 m with a hole of 4 corners: 4 + 4 + 2 - 2 triangles.
TEST(CityJson, SurfacesMayHaveHoles) {
    std::string text = town(
        R"("b":{"type":"Building","geometry":[{"type":"CompositeSurface","lod":"2","boundaries":[[[0,1,2,3],[8,9,10,11]]]}]})");
    const std::size_t end = text.rfind("]}");
    text.insert(end, ",[2000,2000,0],[2000,4000,0],[4000,4000,0],[4000,2000,0]");
    const auto mesh = read_town(text);
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->triangles.size(), 8U);
    double area = 0.0;
    for (const SourceTriangle& triangle : mesh->triangles) {
        const glm::dvec3 &a = mesh->vertices[triangle[0]], &b = mesh->vertices[triangle[1]],
                         &c = mesh->vertices[triangle[2]];
        area += 0.5 * std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
    }
    EXPECT_NEAR(area, 96.0, 1.0e-9) << "m2";
}

// A template of one triangle, twice as large, turned by 90 degrees and put at vertex 2.
TEST(CityJson, TemplatesAreMovedAndTurned) {
    const auto mesh = read_town(town(
        R"("t":{"type":"SolitaryVegetationObject","geometry":[{"type":"GeometryInstance","template":0,)"
        R"("boundaries":[2],"transformationMatrix":[0,-2,0,1, 2,0,0,0, 0,0,2,5, 0,0,0,1]}]})",
        "1.1",
        R"("geometry-templates":{"templates":[{"type":"MultiSurface","lod":"2","boundaries":[[[0,1,2]]]}],)"
        R"("vertices-templates":[[0,0,0],[1,0,0],[0,0,1]]},)"));
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    ASSERT_EQ(mesh->triangles.size(), 1U);
    const SourceTriangle& triangle = mesh->triangles[0];
    EXPECT_EQ(mesh->vertices[triangle[0]], glm::dvec3(1011.0, 2010.0, 4.5));
    EXPECT_EQ(mesh->vertices[triangle[1]], glm::dvec3(1011.0, 2012.0, 4.5));
    EXPECT_EQ(mesh->vertices[triangle[2]], glm::dvec3(1011.0, 2010.0, 6.5));
}

TEST(CityJson, DamageIsRefusedInOneLine) {
    const auto one = [](const std::string& geometry) {
        return town(R"("b":{"type":"Building","geometry":[)" + geometry + "]}");
    };
    EXPECT_NE(town_refusal(one(R"({"type":"Solid","lod":"1","boundaries":[[[[0,1,8]]]]})"))
                  .find("there is no vertex 8: the file has 8"),
              std::string::npos);
    EXPECT_NE(town_refusal(one(R"({"type":"Solid","lod":"1","boundaries":[[[[0,1,-1]]]]})"))
                  .find("there is no vertex -1"),
              std::string::npos);
    EXPECT_NE(town_refusal(one(R"({"type":"Solid","lod":"1","boundaries":[[[0,1,2]]]})"))
                  .find("a ring is no list of vertices"),
              std::string::npos);
    EXPECT_NE(town_refusal(one(R"({"type":"Solid","lod":"1"})")).find("has no 'boundaries'"),
              std::string::npos);
    EXPECT_NE(town_refusal(one(R"({"type":"GeometryInstance","template":7,"boundaries":[0]})"))
                  .find("there is no template 7: the file has 0"),
              std::string::npos);
    EXPECT_EQ(town_refusal(one(R"({"type":"MultiPoint","lod":"1","boundaries":[0,1]})")), "no triangles");
    EXPECT_EQ(town_refusal(town("")), "no triangles");
    EXPECT_NE(town_refusal(town("", "3.0")).find("is CityJSON 3.0: 1.0, 1.1 and 2.0 are read"),
              std::string::npos);
    EXPECT_NE(town_refusal(R"({"type":"FeatureCollection"})").find("its 'type' is 'FeatureCollection'"),
              std::string::npos);
    EXPECT_NE(town_refusal(town("").substr(0, town("").size() - 2)).find("it is cut"), std::string::npos);
    std::string short_place = town("");
    short_place.replace(short_place.find("[0,0,0]"), 7, "[0,0]");
    EXPECT_NE(town_refusal(short_place).find("is no list of 3 numbers"), std::string::npos);
    EXPECT_NE(town_refusal(std::string(200, '[')).find("deep"), std::string::npos);
}

// Parents in a circle: the walk up ends.
TEST(CityJson, ACircleOfParentsEnds) {
    const auto mesh =
        read_town(town(R"("a":{"type":"BuildingPart","parents":["b"],"geometry":[)" + solid() +
                       R"(]},"b":{"type":"BuildingPart","parents":["a"],"geometry":[)" + solid() + "]}"));
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->features[0].part_of, "b");
    EXPECT_EQ(mesh->features[1].part_of, "a");
}

TEST(CityJson, PlainJsonIsKnownByWhatIsInIt) {
    EXPECT_TRUE(is_mesh_file(test::written("a.json", town(""))));
    EXPECT_FALSE(is_mesh_file(test::written("b.json", R"({"type":"FeatureCollection","features":[]})")));
    EXPECT_TRUE(is_mesh_name("Delft.CITY.JSON"));
    EXPECT_TRUE(is_mesh_name("delft.cityjson"));
    EXPECT_FALSE(is_mesh_name("delft.json"));
}

// Counts of the files' own triangles and polygons by Python's json (shared/data/meshes/README.md).
TEST(CityJson, RealTownsAreReadWhole) {
    const auto delft = test::real_data("meshes/delft.city.json"),
               zurich = test::real_data("meshes/zurich_subset_lod2.city.json");
    if (!delft || !zurich) GTEST_SKIP() << "needs meshes/delft.city.json and zurich_subset_lod2.city.json";
    const auto town_of_delft = read_mesh(delft->string());
    ASSERT_TRUE(town_of_delft.ok()) << town_of_delft.error().line();
    EXPECT_EQ(town_of_delft->features.size(), 570U);
    const MeshCensus census = census_of(*town_of_delft);
    EXPECT_EQ(census.duplicates, 10U);
    EXPECT_EQ(census.degenerate, 2U) << "on the lattice of the file's own axes; 3 on that of ECEF";
    EXPECT_EQ(census.triangles - census.duplicates, 36261U);
    EXPECT_EQ(census.crowded_edges, 780U);
    const auto parts_of_zurich = read_mesh(zurich->string());
    ASSERT_TRUE(parts_of_zurich.ok()) << parts_of_zurich.error().line();
    EXPECT_EQ(parts_of_zurich->features.size(), 161U);
    EXPECT_EQ(parts_of_zurich->crs, "EPSG:2056");
    EXPECT_TRUE(std::ranges::all_of(parts_of_zurich->features, [](const MeshFeature& part) {
        return part.part_of.starts_with("UUID_");
    }));
}

}  // namespace
}  // namespace oro
