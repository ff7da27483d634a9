// Every tileset that is written keeps the rules of 3D Tiles 1.1, and a tileset that breaks one is found out.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "geo/tilesets/ground_tileset.h"
#include "geo/tilesets/region_tiles.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"
#include "tests/support/three_grids.h"
#include "tests/support/tileset_rules.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using Rules = std::vector<std::string>;

// Two houses and a lawn, with attributes that are named as what is known of each feature is.
std::shared_ptr<const std::vector<PlacedMesh>> made_town(double lat_deg, double lon_deg) {
    PlacedMesh mesh;
    mesh.path = "/data/town.city.json";
    mesh.crs = "EPSG:2056";
    mesh.heights = "sea level";
    const std::array<const char*, 3> types{"Building", "Building", "LandUse"};
    for (std::uint32_t i = 0; i < types.size(); ++i) {
        MeshFeature feature;
        feature.name = i == 0 ? "Rathaus zu Z\xC3\xBCrich" : "";
        feature.type = types[i];
        feature.first_triangle = i;
        if (i == 1) feature.attributes = {{"Name", "Turm"}, {"Type", "1000"}, {"h\xC3\xB6he m", "12"}};
        mesh.features.push_back(feature);
        mesh.feature_of.push_back(i);
        for (const std::array<double, 3>& by :
             {std::array{0.0, 0.0, 0.0}, std::array{0.0, 0.0002, 0.0}, std::array{0.0001, 0.0, 9.0}})
            mesh.vertices.push_back({lat_deg + 0.001 * i + by[0], lon_deg + by[1], 500.0 + by[2]});
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return std::make_shared<const std::vector<PlacedMesh>>(1, mesh);
}

TilesetRequest made_request() {
    TilesetRequest request;
    request.tile_quads = 64;
    request.threads = 2;
    request.look = {{0.5, 0.4, 0.3}, {}, "nobody", "test"};
    request.metadata = {{"heights", "H, above \"the\" geoid"}, {"attribution", "nobody"}};
    return request;
}

// The tileset of one grid in a folder of its own.
fs::path written_tileset(const HeightField& field, const TilesetRequest& request) {
    TilesetGrid grid;
    grid.posts = &field.grid;
    grid.ground = [&field] { return ClusteredGround::of(field, nullptr, 2); };
    grid.finest_error_m = 5.0;
    grid.sources = {{"a.hgt", "nobody", "EGM96", 92.5, 16.0}, {"b.tif", "", "", 1.0, -1.0}};
    grid.facts = [](int, std::span<const VertexPlace> places) {
        VertexFacts facts;
        facts.sources.resize(places.size(), 1);
        return Result<VertexFacts>(facts);
    };
    fs::path folder = test::scratch_folder();
    const auto done = write_tileset(folder, {{std::move(grid)}, {}}, request, {});
    EXPECT_TRUE(done.ok()) << done.error().line();
    return folder;
}

TEST(TilesetSchema, HoldsOfOneGridWithAndWithoutMeshes) {
    const HeightField field = test::rough_field(47.0, 8.0, 150, 170);
    TilesetRequest request = made_request();
    EXPECT_EQ(test::broken_rules(written_tileset(field, request)), Rules{});
    request.meshes = TilesetMeshes{made_town(46.95, 8.05), {}, 256};
    EXPECT_EQ(test::broken_rules(written_tileset(field, request)), Rules{});
    request.metadata.clear();
    request.normals = false;
    EXPECT_EQ(test::broken_rules(written_tileset(field, request)), Rules{});
}

// 180 E is in the middle; the poles are inside.
TEST(TilesetSchema, HoldsAcrossTheAntimeridianAndPoles) {
    const auto slope = [](double lat, double lon) {
        return static_cast<float>(100.0 * (lat - 9.0) + 50.0 * (lon - 179.0));
    };
    EXPECT_EQ(test::broken_rules(
                  written_tileset(test::made_field(10.0, 179.8, 600.0, 150, 240, slope), made_request())),
              Rules{});
    for (const double lat_deg : {89.99, -89.0}) {
        const test::PlaneOfPosts plane{140, 140, {lat_deg, 179.0}, 20000.0, 10.0};
        const HeightField field = test::net_field(plane, [](double row, double column) {
            return static_cast<float>(100.0 + std::sin(0.1 * row) * 300.0 + column);
        });
        EXPECT_EQ(test::broken_rules(written_tileset(field, made_request())), Rules{});
    }
}

TEST(TilesetSchema, HoldsOfSeveralGrids) {
    const Region region = test::three_grids(100);
    const auto tiles = RegionTiles::of(region, 2);
    ASSERT_TRUE(tiles.ok()) << tiles.error().line();
    for (TilesetGrid& grid : (*tiles)->ground.grids) grid.finest_error_m = 4.0;
    const fs::path folder = test::scratch_folder();
    ASSERT_TRUE(write_tileset(folder, (*tiles)->ground, made_request(), {}).ok());
    EXPECT_EQ(test::broken_rules(folder), Rules{});
}

// What is done to a tileset, and a part of the rule that it then breaks.
struct TilesetDamage {
    const char* rule;
    std::function<void(nlohmann::json& tileset)> to_json;
};

// The first tile below the root.
nlohmann::json& first_child(nlohmann::json& tileset) {
    return tileset["root"]["children"][0];
}

std::vector<TilesetDamage> damages_of_tiles() {
    using Json = nlohmann::json;
    return {
        {"asset.version", [](Json& json) { json["asset"]["version"] = "1.0"; }},
        {"asset.version", [](Json& json) { json.erase("asset"); }},
        {"there is a root", [](Json& json) { json.erase("root"); }},
        {"no name but those", [](Json& json) { json["root"]["geometricErorr"] = 1.0; }},
        {"is 0 or more", [](Json& json) { json["root"].erase("geometricError"); }},
        {"is 0 or more", [](Json& json) { first_child(json)["geometricError"] = -1.0; }},
        {"no less than the root's", [](Json& json) { json["geometricError"] = 0.0; }},
        {"geometricError falls", [](Json& json) { first_child(json)["geometricError"] = 1.0e9; }},
        {"says how it is refined", [](Json& json) { json["root"].erase("refine"); }},
        {"REPLACE or ADD", [](Json& json) { first_child(json)["refine"] = "replace"; }},
        {"has a bounding volume", [](Json& json) { first_child(json).erase("boundingVolume"); }},
        {"six numbers", [](Json& json) { json["root"]["boundingVolume"]["region"].erase(5); }},
        {"radians in range", [](Json& json) { json["root"]["boundingVolume"]["region"][3] = 47.0; }},
        {"south is before north",
         [](Json& json) {
             Json& region = first_child(json)["boundingVolume"]["region"];
             std::swap(region[1], region[3]);
         }},
        {"the lowest height before",
         [](Json& json) {
             Json& region = first_child(json)["boundingVolume"]["region"];
             std::swap(region[4], region[5]);
         }},
        {"a child lies in its parent",
         [](Json& json) {
             Json& region = json["root"]["boundingVolume"]["region"];
             region[2] = region[2].get<double>() - 1.0e-4;
         }},
        {"a child lies in its parent",
         [](Json& json) { first_child(json)["boundingVolume"]["region"][4] = -9000.0; }},
        {"that of a file", [](Json& json) { first_child(json)["content"]["uri"] = "0/0/77.glb"; }},
        {"that of a file", [](Json& json) { first_child(json)["content"]["uri"] = "/etc/passwd"; }},
        {"content has a URI", [](Json& json) { first_child(json)["content"].erase("uri"); }},
        {"exclude each other", [](Json& json) { first_child(json)["contents"] = Json::array(); }},
    };
}

std::vector<TilesetDamage> damages_of_metadata() {
    using Json = nlohmann::json;
    const auto properties = [](Json& json) -> Json& {
        return json["schema"]["classes"]["ground"]["properties"];
    };
    return {
        {"schema has an identifier", [](Json& json) { json["schema"]["id"] = "the ground's"; }},
        {"class is in the schema", [](Json& json) { json["metadata"]["class"] = "sea"; }},
        {"class has each property", [](Json& json) { json["metadata"]["properties"]["depth"] = "deep"; }},
        {"of its property's type", [](Json& json) { json["metadata"]["properties"]["heights"] = 7; }},
        {"of its property's type", [](Json& json) { json["metadata"]["properties"]["sources"] = "one"; }},
        {"what is required",
         [=](Json& json) {
             properties(json)["heights"]["required"] = true;
             json["metadata"]["properties"].erase("heights");
         }},
        {"one of ten", [=](Json& json) { properties(json)["heights"]["type"] = "TEXT"; }},
        {"numbers have a component",
         [=](Json& json) { properties(json)["sourcesVerticalLe90"].erase("componentType"); }},
        {"its name is an identifier",
         [=](Json& json) {
             properties(json)["90 percent"] = Json{{"type", "STRING"}};
         }},
    };
}

void write_text(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

bool is_found(const Rules& rules, const std::string& part) {
    return std::ranges::any_of(rules,
                               [&](const std::string& rule) { return rule.find(part) != std::string::npos; });
}

// A sound tileset of ground with meshes, and a way to damage it and to mend it again.
struct SoundTileset {
    SoundTileset() {
        TilesetRequest request = made_request();
        request.meshes = TilesetMeshes{made_town(46.95, 8.05), {}, 256};
        folder = written_tileset(field, request);
        text = test::content_of(folder / "tileset.json");
        for (const auto& entry : fs::recursive_directory_iterator(folder / "meshes"))
            if (entry.path().extension() == ".glb") mesh = entry.path();
    }
    // With the grid's tree, whose levels refine each other, as the root.
    [[nodiscard]] nlohmann::json tree() const {
        auto json = nlohmann::json::parse(text);
        const auto error_m = json["geometricError"];
        json["root"] = nlohmann::json(json["root"]["children"][0]);
        json["geometricError"] = error_m;
        return json;
    }
    const HeightField field = test::rough_field(47.0, 8.0, 150, 170);
    fs::path folder, mesh;
    std::string text;  // of tileset.json
};

TEST(TilesetSchema, FindsEachDamageToATileset) {
    const SoundTileset sound;
    const fs::path file = sound.folder / "tileset.json";
    write_text(file, sound.tree().dump());
    ASSERT_EQ(test::broken_rules(sound.folder), Rules{});
    std::vector<TilesetDamage> damages = damages_of_tiles();
    for (TilesetDamage& one : damages_of_metadata()) damages.push_back(std::move(one));
    for (const TilesetDamage& damage : damages) {
        nlohmann::json json = sound.tree();
        damage.to_json(json);
        write_text(file, json.dump());
        EXPECT_TRUE(is_found(test::broken_rules(sound.folder), damage.rule)) << damage.rule;
    }
    write_text(file, "\xEF\xBB\xBF" + sound.text);
    EXPECT_TRUE(is_found(test::broken_rules(sound.folder), "byte order mark"));
    write_text(file, "{\"asset\":{\"version\":\"1.1\"}," + sound.text.substr(1));
    EXPECT_TRUE(is_found(test::broken_rules(sound.folder), "in an object once"));
    write_text(file, sound.text.substr(0, sound.text.size() / 2));
    EXPECT_TRUE(is_found(test::broken_rules(sound.folder), "it is JSON"));
    fs::remove(file);
    EXPECT_TRUE(is_found(test::broken_rules(sound.folder), "it is JSON"));
}

// The bytes of a binary glTF with other JSON.
std::string with_json(const std::string& glb, const std::function<void(nlohmann::json& gltf)>& change) {
    std::uint32_t before = 0;
    std::memcpy(&before, glb.data() + 12, sizeof(before));
    auto gltf = nlohmann::json::parse(glb.substr(20, before));
    change(gltf);
    std::string text = gltf.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto now = static_cast<std::uint32_t>(text.size()),
               all = static_cast<std::uint32_t>(glb.size() - before + now);
    std::string made = glb.substr(0, 20) + text + glb.substr(20 + before);
    std::memcpy(made.data() + 8, &all, sizeof(all));
    std::memcpy(made.data() + 12, &now, sizeof(now));
    return made;
}

TEST(TilesetSchema, FindsEachDamageToTablesOfFeatures) {
    using Json = nlohmann::json;
    const SoundTileset sound;
    const std::string glb = test::content_of(sound.mesh);
    const auto metadata = [](Json& gltf) -> Json& { return gltf["extensions"]["EXT_structural_metadata"]; };
    const auto column = [=](Json& gltf, const char* name) -> Json& {
        return metadata(gltf)["propertyTables"][0]["properties"][name];
    };
    const auto view = [](Json& gltf, const Json& number) -> Json& {
        return gltf["bufferViews"][number.get<std::size_t>()];
    };
    const auto set = [](Json& gltf) -> Json& {
        return gltf["meshes"][0]["primitives"][0]["extensions"]["EXT_mesh_features"]["featureIds"][0];
    };
    const std::vector<TilesetDamage> damages{
        {"table's class", [=](Json& gltf) { metadata(gltf)["propertyTables"][0]["class"] = "tree"; }},
        {"a row or more", [=](Json& gltf) { metadata(gltf)["propertyTables"][0]["count"] = 0; }},
        {"an offset more than rows", [=](Json& gltf) { metadata(gltf)["propertyTables"][0]["count"] = 7; }},
        {"a row for each id", [=](Json& gltf) { set(gltf)["featureCount"] = 7; }},
        {"the class has each column", [=](Json& gltf) { column(gltf, "colour") = column(gltf, "name"); }},
        {"a column is in a view", [=](Json& gltf) { column(gltf, "name")["values"] = 777; }},
        {"texts have offsets", [=](Json& gltf) { column(gltf, "name").erase("stringOffsets"); }},
        {"offsets ascend", [=](Json& gltf) { view(gltf, column(gltf, "name")["values"])["byteLength"] = 1; }},
        {"a multiple of its component",
         [=](Json& gltf) {
             Json& of = view(gltf, column(gltf, "name")["stringOffsets"]);
             of["byteOffset"] = of["byteOffset"].get<int>() + 1;
         }},
        {"a view lies in its buffer",
         [=](Json& gltf) { view(gltf, column(gltf, "name")["values"])["byteOffset"] = 1 << 30; }},
        {"extensions are listed", [](Json& gltf) { gltf["extensionsUsed"] = Json::array(); }},
        {"the attribute is there", [=](Json& gltf) { set(gltf)["attribute"] = 3; }},
        {"the table is there", [=](Json& gltf) { set(gltf)["propertyTable"] = 1; }},
        {"a set has a count", [=](Json& gltf) { set(gltf).erase("featureCount"); }},
        {"other property of the class has its name",
         [=](Json& gltf) {
             metadata(gltf)["schema"]["classes"]["feature"]["properties"]["type"]["name"] = "Name";
         }},
    };
    for (const TilesetDamage& damage : damages) {
        write_text(sound.mesh, with_json(glb, damage.to_json));
        EXPECT_TRUE(is_found(test::broken_rules(sound.folder), damage.rule)) << damage.rule;
    }
    write_text(sound.mesh, with_json(glb, [](Json&) {}));
    EXPECT_EQ(test::broken_rules(sound.folder), Rules{});
    write_text(sound.mesh, glb.substr(0, glb.size() - 4));
    EXPECT_TRUE(is_found(test::broken_rules(sound.folder), "lengths add up"));
}

}  // namespace
}  // namespace oro
