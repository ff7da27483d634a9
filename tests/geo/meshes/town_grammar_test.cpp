// Towns by grammar: CityJSON and footprints that writers may make, and those with one rule broken.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "geo/meshes/footprints.h"
#include "geo/meshes/mesh_census.h"
#include "geo/meshes/mesh_file.h"
#include "tests/geo/vectors/written_vectors.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

class TownGrammar {
  public:
    explicit TownGrammar(unsigned seed) : random_(seed) {}

    std::string city() {
        odds_ = below(2) == 0 ? 60 : 100000;
        vertices_ = 4 + below(9);
        std::string objects;
        for (std::size_t i = 1 + below(4); i > 0; --i) objects += (objects.empty() ? "" : ",") + object(i);
        std::string vertices;
        for (std::size_t i = 0; i < vertices_; ++i) vertices += (i > 0 ? "," : "") + place();
        std::string text = R"({"type":)" + rarely_else(R"("CityJSON")", {"7", R"("Feature")"}) +
                           R"(,"version":")" + one_of({"1.0", "1.1", "2.0", "1.0.3"}) + "\",";
        if (below(2) == 0) text += R"("transform":{"scale":)" + place() + R"(,"translate":)" + place() + "},";
        if (below(2) == 0)
            text += R"("geometry-templates":{"templates":[)" + geometry() + R"(],"vertices-templates":[)" +
                    place() + "," + place() + "," + place() + "," + place() + "]},";
        text += R"("CityObjects":{)" + objects + R"(},"vertices":[)" + vertices + "]}";
        return below(odds_ / 4) == 0 ? text.substr(0, below(text.size())) : text;
    }

    std::string footprints() {
        odds_ = below(2) == 0 ? 30 : 100000;
        std::string features;
        for (std::size_t i = 1 + below(5); i > 0; --i)
            features += (features.empty() ? "" : ",") + footprint();
        const std::string text = test::collection(features);
        return below(odds_ / 2) == 0 ? text.substr(0, below(text.size())) : text;
    }

  private:
    std::size_t below(std::size_t end) { return random_() % end; }
    bool rarely() { return below(odds_) == 0; }
    std::string one_of(std::vector<std::string> words) { return words[below(words.size())]; }
    std::string rarely_else(const std::string& usual, std::vector<std::string> broken) {
        return rarely() ? one_of(std::move(broken)) : usual;
    }
    std::string number() {
        return rarely_else(std::to_string(static_cast<double>(below(1000)) / 8.0),
                           {"NaN", "1e999", "-Infinity", "\"1\"", "null", "[]", "1e300", "00"});
    }
    std::string place() {
        return "[" + number() + "," + number() + rarely_else("," + number() + "]", {"]", ",1,2]", ",1"});
    }
    std::string index() {
        return rarely_else(std::to_string(below(vertices_)),
                           {"-1", "99", "1.5", "\"0\"", "4294967296", "null"});
    }
    std::string list(const std::string& one, std::size_t count) {
        std::string text = "[";
        for (std::size_t i = 0; i < count; ++i) text += (i > 0 ? "," : "") + one;
        return text + rarely_else("]", {"", "}"});
    }
    std::string ring() {
        std::string text = "[";
        for (std::size_t i = rarely() ? below(3) : 3 + below(5); i > 0; --i)
            text += index() + (i > 1 ? "," : "");
        return text + "]";
    }
    std::string surface() { return "[" + ring() + (below(5) == 0 ? "," + ring() : "") + "]"; }
    std::string geometry() {
        const std::string lod =
            R"(,"lod":)" + one_of({"1", "\"2\"", "\"2.2\"", "\"1\""}) + R"(,"boundaries":)";
        switch (below(6)) {
            case 0:
                return R"({"type":"Solid")" + lod + "[" + list(surface(), 1 + below(4)) + "]}";
            case 1:
                return R"({"type":"MultiSolid")" + lod + "[[" + list(surface(), 1 + below(3)) + "]]}";
            case 2:
                return R"({"type":"MultiPoint")" + lod + ring() + "}";
            case 3:
                return R"({"type":"GeometryInstance","template":)" + rarely_else("0", {"1", "-1", "\"a\""}) +
                       R"(,"boundaries":[)" + index() +
                       R"(],"transformationMatrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]})";
            default:
                return R"({"type":")" + one_of({"MultiSurface", "CompositeSurface"}) + "\"" + lod +
                       list(surface(), 1 + below(4)) + "}";
        }
    }
    std::string object(std::size_t number) {
        const auto name = [](std::size_t n) { return "\"o" + std::to_string(n) + "\""; };
        std::string text = name(rarely() ? 1 : number) + R"(:{"type":"Building")";
        if (below(2) == 0)
            text += R"(,"attributes":{"a":)" + one_of({"1", "null", "\"x\"", "[1]", "{}"}) + "}";
        if (below(3) == 0) text += R"(,"parents":[)" + name(1 + below(4)) + "]";
        if (below(3) == 0) text += R"(,"children":[)" + name(1 + below(4)) + "]";
        return text + R"(,"geometry":[)" + geometry() + (below(3) == 0 ? "," + geometry() : "") + "]}";
    }
    std::string footprint() {
        std::string ring;
        for (std::size_t i = rarely() ? below(3) : 3 + below(6); i > 0; --i)
            ring += "[" + rarely_else("8.0" + std::to_string(10 + below(50)), {"190", "NaN", "\"8\""}) +
                    ",46.9" + std::to_string(40 + below(55)) + "],";
        ring += ring.substr(0, ring.find(']') + 1);
        return test::feature(
            "Polygon", "[[" + ring + "]]",
            R"("height":)" + rarely_else(std::to_string(1 + below(40)),
                                         {"0", "-1", "9999", "null", "\"4 m\"", "\"x\"", "[]"}));
    }

    std::size_t odds_{40};
    std::size_t vertices_{4};
    std::mt19937 random_;
};

void expect_sound(const SourceMesh& mesh, const std::string& text) {
    ASSERT_FALSE(mesh.triangles.empty()) << text;
    for (const SourceTriangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) {
            ASSERT_LT(corner, mesh.vertices.size()) << text;
            const glm::dvec3& at = mesh.vertices[corner];
            ASSERT_TRUE(std::isfinite(at.x) && std::isfinite(at.y) && std::isfinite(at.z)) << text;
        }
    ASSERT_FALSE(mesh.features.empty()) << text;
    ASSERT_EQ(mesh.features.front().first_triangle, 0U) << text;
    for (std::size_t i = 1; i < mesh.features.size(); ++i)
        ASSERT_LE(mesh.features[i - 1].first_triangle, mesh.features[i].first_triangle) << text;
    const MeshCensus census = census_of(mesh);
    EXPECT_LE(census.degenerate + census.duplicates, census.triangles) << text;
}

void expect_one_line(const Error& error, const std::string& text) {
    ASSERT_FALSE(error.what.empty()) << text;
    ASSERT_EQ(error.line().find('\n'), std::string::npos) << text;
}

TEST(TownGrammar, EachCityEndsInAMeshOrOneLine) {
    const unsigned seed = 5205;
    SCOPED_TRACE("seed " + std::to_string(seed));
    TownGrammar grammar(seed);
    int read_whole = 0;
    constexpr int rounds = 200;
    for (int round = 0; round < rounds; ++round) {
        const std::string text = grammar.city();
        const auto mesh = read_mesh(test::written("g.city.json", text));
        if (mesh.ok())
            expect_sound(*mesh, text), ++read_whole;
        else
            expect_one_line(mesh.error(), text);
    }
    EXPECT_GT(read_whole, rounds / 4);
    EXPECT_LT(read_whole, rounds - 10);
}

TEST(TownGrammar, EachFileOfFootprintsEndsInAMeshOrOneLine) {
    const unsigned seed = 5206;
    SCOPED_TRACE("seed " + std::to_string(seed));
    TownGrammar grammar(seed);
    const HeightField field = test::rough_field(47.0, 8.0, 90, 90);
    const HeightField* const fields[] = {&field};
    int read_whole = 0;
    constexpr int rounds = 100;
    for (int round = 0; round < rounds; ++round) {
        const std::string text = grammar.footprints();
        const auto mesh = buildings_on_footprints(
            test::written("g.geojson", text), {"height", ""}, fields,
            [](std::span<const VectorPlace>, std::span<double>) -> Result<void> { return {}; });
        if (mesh.ok())
            expect_sound(*mesh, text), ++read_whole;
        else
            expect_one_line(mesh.error(), text);
    }
    EXPECT_GT(read_whole, rounds / 4);
    EXPECT_LT(read_whole, rounds - 2);
}

}  // namespace
}  // namespace oro
