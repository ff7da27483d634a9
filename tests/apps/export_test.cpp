// orograph export as people and programs use it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"
#include "tests/support/tileset_rules.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::names_in;
using oro::test::object_said_by;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;

Words export_words(const std::string& format, const fs::path& out, const Words& more = {}) {
    return oro::test::joined({"export", bundled(), "-q", "--to", format, "--out", out.string()}, more);
}

TEST(ExportCommand, CogHasTheFilesOwnHeights) {
    const fs::path out = oro::test::scratch_folder() / "h.tif";
    const auto said = object_said_by(export_words("cog", out, {"--json"}));
    EXPECT_EQ(said["type"], "int16");
    EXPECT_EQ(said["columns"], 403);
    EXPECT_EQ(said["rows"], 344);
    EXPECT_EQ(said["bytes"], fs::file_size(out));
    const auto info = run_program({"gdalinfo", "-json", "-checksum", out.string()});
    if (info.exit_code == 127) GTEST_SKIP() << "needs gdalinfo";
    const auto raster = oro::test::one_object(info.out);
    const auto source = oro::test::one_object(run_program({"gdalinfo", "-json", "-checksum", bundled()}).out);
    EXPECT_EQ(raster["metadata"]["IMAGE_STRUCTURE"]["LAYOUT"], "COG");
    EXPECT_EQ(raster["bands"][0]["checksum"], source["bands"][0]["checksum"]);
    EXPECT_EQ(raster["bands"][0]["noDataValue"], -32768.0);
    EXPECT_EQ(raster["metadata"][""]["VERTICAL_DATUM"], said["heights"]);
    for (std::size_t i = 0; i < 6; ++i)
        EXPECT_NEAR(raster["geoTransform"][i].get<double>(), source["geoTransform"][i].get<double>(), 1e-12);
}

TEST(ExportCommand, TilesHaveTheHeightsThatSightTells) {
    const fs::path out = oro::test::scratch_folder() / "tiles";
    const auto said = object_said_by(export_words("terrain-rgb", out, {"--json", "--zoom", "9:12"}));
    const auto written = nlohmann::json::parse(bytes_of(out / "tiles.json"));
    EXPECT_EQ(written["tilejson"], "3.0.0");
    EXPECT_EQ(written["minzoom"], 9);
    EXPECT_EQ(written["maxzoom"], 12);
    EXPECT_EQ(written["attribution"], "USGS, public domain");
    EXPECT_EQ(written["bounds"].size(), 4U);
    EXPECT_EQ(written["orograph"]["error"], said["error"]);
    EXPECT_EQ(written["orograph"]["error"].size(), 4U);
    // Finer zooms are nearer to the ground; the finest is within a few metres of these hills.
    EXPECT_GT(said["error"][0]["largest_m"].get<double>(), said["error"][3]["largest_m"].get<double>());
    EXPECT_EQ(said["error"][3]["places"], 10000);
    std::size_t tiles = 0;
    for (const auto& entry : fs::recursive_directory_iterator(out))
        tiles += entry.path().extension() == ".png";
    EXPECT_EQ(tiles, said["tiles"].get<std::size_t>());
    // The centre of pixel (100, 100) of tile 12/1088/1600.
    const double side = std::pow(2.0, 12) * 256.0, pi = std::acos(-1.0);
    const double lon = (1088 * 256 + 100.5) / side * 360.0 - 180.0;
    const double lat = std::atan(std::sinh(pi * (1.0 - 2.0 * (1600 * 256 + 100.5) / side))) * 180.0 / pi;
    const auto tile = oro::test::pixels_of(out / "12" / "1088" / "1600.png");
    ASSERT_EQ(tile.width, 256U);
    const std::size_t at = 3 * (100 * 256 + 100);
    const double H_m = -10000.0 + 0.1 * (tile.rgb[at] * 65536 + tile.rgb[at + 1] * 256 + tile.rgb[at + 2]);
    std::ostringstream to;
    to.precision(12);
    to << std::fixed << lat << "," << lon;
    const auto sight = object_said_by({"sight", bundled(), "-q", "--json", "--from", "36.5,-84.2", "--above",
                                       "500", "--to", to.str(), "--target", "1"});
    EXPECT_NEAR(sight["to"]["H_m"].get<double>() - 1.0, H_m, 0.05 + 1e-3);
}

// jacksboro.tif has 403 x 344 posts of 3 seconds: 4 x 3 pages of 128 x 128 quads, 2 x 2 of every second post,
// and one.
TEST(ExportCommand, A3dTilesetHasTheProvenErrors) {
    const fs::path out = oro::test::scratch_folder() / "tiles";
    const auto said = object_said_by(export_words("3dtiles", out, {"--json"}));
    EXPECT_EQ(said["tiles"], 4 + 1);
    ASSERT_EQ(said["levels"].size(), 2U);
    // A fifth of 3" along a meridian, with the equator's radius: 6378137 m pi / 180 / 1200 / 5.
    EXPECT_LE(said["levels"][1]["largest_error_m"].get<double>(), 18.5533);
    EXPECT_GT(said["levels"][1]["largest_error_m"].get<double>(), 17.0);
    const auto every =
        object_said_by(export_words("3dtiles", out.string() + "0", {"--json", "--max-error", "0"}));
    EXPECT_EQ(every["levels"][1]["triangles"], 2 * 402 * 343);
    // Rounding alone where each post is drawn: steps of 2^-4 m at most.
    EXPECT_LT(every["levels"][1]["largest_error_m"].get<double>(), 0.07);
    const auto bare = object_said_by(export_words("3dtiles", out.string() + "1", {"--json", "--no-normals"}));
    EXPECT_EQ(bare["levels"][1]["triangles"], said["levels"][1]["triangles"]);
    EXPECT_LT(bare["bytes"].get<double>(), 0.85 * said["bytes"].get<double>());
    const auto tileset = nlohmann::json::parse(bytes_of(out / "tileset.json"));
    EXPECT_EQ(tileset["asset"]["version"], "1.1");
    EXPECT_EQ(tileset["root"]["geometricError"], said["levels"][0]["largest_error_m"]);
    EXPECT_EQ(tileset["metadata"]["properties"]["attribution"], "USGS, public domain");
    EXPECT_EQ(tileset["metadata"]["properties"]["heights"], said["heights"]);
    std::uintmax_t bytes = 0;
    for (const auto& entry : fs::recursive_directory_iterator(out))
        if (entry.path().extension() == ".glb") bytes += entry.file_size();
    EXPECT_EQ(bytes, said["bytes"].get<std::uintmax_t>());
    EXPECT_EQ(oro::test::broken_rules(out), Words{});
}

// A raster of one value in each band over all the ground. False where there is no gdal_create.
bool make_raster(const fs::path& file, const std::vector<const char*>& bands) {
    Words words{"gdal_create", "-q",        "-of",     "GTiff", "-outsize", "50",    "40",   "-ot",   "Byte",
                "-a_srs",      "EPSG:4326", "-a_ullr", "-84.5", "36.8",     "-84.0", "36.4", "-bands"};
    words.push_back(std::to_string(bands.size()));
    for (const char* const value : bands) words.insert(words.end(), {"-burn", value});
    words.push_back(file.string());
    return run_program(words).exit_code == 0;
}

// An image of one colour over all the ground: every file has colours of vertices, and is larger for them.
TEST(ExportCommand, A3dTilesetIsColouredByAnImage) {
    const fs::path folder = oro::test::scratch_folder(), image = folder / "red.tif";
    if (!make_raster(image, {"255", "0", "0"})) GTEST_SKIP() << "needs gdal_create";
    const Words part{"--bbox=-84.4,36.5,-84.3,36.6", "--json"};
    const auto plain = object_said_by(export_words("3dtiles", folder / "plain", part));
    const auto red = object_said_by(
        export_words("3dtiles", folder / "red", oro::test::joined(part, {"--drape", image.string()})));
    EXPECT_EQ(red["tiles"], plain["tiles"]);
    EXPECT_EQ(oro::test::broken_rules(folder / "red"), Words{});
    const std::string with = bytes_of(folder / "red" / "0" / "0" / "0.glb"),
                      without = bytes_of(folder / "plain" / "0" / "0" / "0.glb");
    EXPECT_NE(with.find("COLOR_0"), std::string::npos);
    EXPECT_EQ(without.find("COLOR_0"), std::string::npos);
    EXPECT_NE(without.find("\"class\":\"source\""), std::string::npos);
    EXPECT_NE(without.find("jacksboro.tif"), std::string::npos);
    // All vertices have one colour, which takes next to nothing.
    EXPECT_LT(with.size(), without.size() + 2000);
    expect_refusal(run_orograph(export_words("cog", folder / "t.tif", {"--drape", image.string()})),
                   oro::test::usage, {"needs --to 3dtiles"});
    expect_refusal(run_orograph(export_words("3dtiles", folder / "t", {"--drape", "none.tif"})),
                   oro::test::failed, {"none.tif"});
}

// What a model says, and the bytes of its buffer.
struct ModelInFile {
    nlohmann::json gltf;
    std::string buffer;

    explicit ModelInFile(const fs::path& file) {
        const std::string bytes = bytes_of(file);
        std::uint32_t json_bytes = 0;
        std::memcpy(&json_bytes, bytes.data() + 12, sizeof(json_bytes));
        gltf = nlohmann::json::parse(bytes.substr(20, json_bytes));
        buffer = bytes.substr(28 + json_bytes);
    }
    // How many vertices of a node have each colour, "RRGGBB" of light.
    [[nodiscard]] std::map<std::string, int> colours(std::size_t node) const {
        std::map<std::string, int> counts;
        const auto& primitive =
            gltf["meshes"][gltf["nodes"][node]["mesh"].get<std::size_t>()]["primitives"][0];
        if (!primitive["attributes"].contains("COLOR_0")) return counts;
        const auto& accessor = gltf["accessors"][primitive["attributes"]["COLOR_0"].get<std::size_t>()];
        const auto& view = gltf["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); ++i) {
            const std::size_t at =
                view["byteOffset"].get<std::size_t>() + i * view["byteStride"].get<std::size_t>();
            char text[8];
            std::snprintf(text, sizeof(text), "%02x%02x%02x", static_cast<unsigned char>(buffer[at]),
                          static_cast<unsigned char>(buffer[at + 1]),
                          static_cast<unsigned char>(buffer[at + 2]));
            ++counts[text];
        }
        return counts;
    }
};

// Images and land cover colour the vertices of a model, too. The class 50 of ESA WorldCover is #8d8680 in
// data/cover/worldcover.json: light of 0.266, 0.238 and 0.216.
TEST(ExportCommand, AModelIsColouredByAnImageAndByLandCover) {
    const fs::path folder = oro::test::scratch_folder(), image = folder / "red.tif",
                   classes = folder / "classes.tif";
    if (!make_raster(image, {"255", "0", "0"}) || !make_raster(classes, {"50"}))
        GTEST_SKIP() << "needs gdal_create";
    const Words part{"--bbox=-84.4,36.5,-84.3,36.6", "--json", "--max-error", "20"};
    const auto model = [&](const char* name, const Words& more) {
        return object_said_by(export_words("gltf", folder / name, oro::test::joined(part, more)));
    };
    const auto plain = model("plain.glb", {}), red = model("red.glb", {"--drape", image.string()}),
               built = model("built.glb", {"--landcover", classes.string() + ",worldcover"});
    EXPECT_EQ(red["triangles"], plain["triangles"]);
    EXPECT_EQ(red["error_m"], plain["error_m"]);
    const int vertices = plain["vertices"];
    EXPECT_TRUE(ModelInFile(folder / "plain.glb").colours(0).empty());
    EXPECT_EQ(ModelInFile(folder / "red.glb").colours(0), (std::map<std::string, int>{{"ff0000", vertices}}));
    EXPECT_EQ(ModelInFile(folder / "built.glb").colours(0),
              (std::map<std::string, int>{{"443d37", vertices}}));
    EXPECT_EQ(ModelInFile(folder / "red.glb").gltf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"],
              (std::vector<double>{1.0, 1.0, 1.0, 1.0}));
    expect_refusal(run_orograph(export_words("terrain-rgb", folder / "t", {"--drape", image.string()})),
                   oro::test::usage, {"needs --to 3dtiles or gltf"});
    expect_refusal(run_orograph(export_words("gltf", folder / "t.glb", {"--drape", "none.tif"})),
                   oro::test::failed, {"none.tif"});
}

// A house of an OBJ is the second node, with its own triangles and without harm to its file.
TEST(ExportCommand, AModelHasTheMeshesOnTheGround) {
    const fs::path folder = oro::test::scratch_folder(), house = folder / "house.obj";
    oro::test::write_bytes(house,
                           "v -84.35 36.55 420\nv -84.3495 36.55 420\nv -84.3495 36.5505 420\n"
                           "v -84.35 36.5505 440\nf 1 2 3\nf 1 3 4\n");
    const Words part{"--bbox=-84.4,36.5,-84.3,36.6",
                     "--json",
                     "--max-error",
                     "20",
                     "--mesh-file",
                     house.string(),
                     "--mesh-crs",
                     "EPSG:4326"};
    const auto said = object_said_by(export_words("gltf", folder / "house.glb", part));
    EXPECT_EQ(said["meshes"]["triangles"], 2);
    const ModelInFile model(folder / "house.glb");
    ASSERT_EQ(model.gltf["nodes"].size(), 2U);
    EXPECT_EQ(model.gltf["nodes"][0]["name"], "ground");
    EXPECT_EQ(model.gltf["nodes"][1]["name"], "house.obj");
    EXPECT_TRUE(model.colours(0).empty());
    // The grey of meshes that do not say what they are of: 0.40, 0.395 and 0.385.
    EXPECT_EQ(model.colours(1).size(), 1U);
    EXPECT_EQ(model.colours(1).count("666562"), 1U);
    expect_refusal(run_orograph(export_words("cog", folder / "t.tif", {"--mesh-file", house.string()})),
                   oro::test::usage, {"--mesh-file", "3D Tiles and models alone"});
    expect_refusal(run_orograph(export_words("gltf", folder / "house.glb",
                                             {"--overwrite", "--mesh-file", (folder / "house.glb").string(),
                                              "--mesh-crs", "EPSG:4326"})),
                   oro::test::failed, {"house.glb"});
    EXPECT_EQ(ModelInFile(folder / "house.glb").gltf, model.gltf);
}

// Parts by themselves, and then all: the files of one go, and nothing else is left.
TEST(ExportCommand, A3dTilesetIsMadeInParts) {
    const fs::path folder = oro::test::scratch_folder();
    const Words part{"--bbox=-84.4,36.5,-84.3,36.6", "--json"};
    const auto whole = object_said_by(export_words("3dtiles", folder / "whole", part));
    const fs::path out = folder / "parts";
    for (const char* const shard : {"1/2", "2/2"}) {
        const auto said =
            object_said_by(export_words("3dtiles", out, oro::test::joined(part, {"--shard", shard})));
        EXPECT_EQ(said["parts"], 2);
        EXPECT_FALSE(fs::exists(out));
    }
    expect_refusal(
        run_orograph(export_words("3dtiles", out, {"--bbox=-84.4,36.5,-84.3,36.6", "--no-normals"})),
        oro::test::failed, {"parts.tiles: holds tiles of other data, options"});
    const auto joined = object_said_by(export_words("3dtiles", out, part));
    EXPECT_EQ(joined["bytes"], whole["bytes"]);
    for (const char* const file : {"tileset.json", "0/0/0.glb"})
        EXPECT_TRUE(bytes_of(out / file) == bytes_of(folder / "whole" / file));
    EXPECT_EQ(names_in(folder), (Words{"parts", "whole"}));
    expect_refusal(run_orograph(export_words("gltf", folder / "t.glb", {"--shard", "1/2"})), oro::test::usage,
                   {"--shard 1/2: needs --to 3dtiles, quantized-mesh or terrain-rgb"});
    expect_refusal(run_orograph(export_words("3dtiles", folder / "t", {"--shard", "3/2"})), oro::test::usage,
                   {"--shard 3/2"});
}

TEST(ExportCommand, TerrainOfAGlobeTellsWhatIsThere) {
    const fs::path out = oro::test::scratch_folder() / "globe";
    const auto said = object_said_by(export_words("quantized-mesh", out, {"--json", "--zoom", "0:10"}));
    const auto layer = nlohmann::json::parse(bytes_of(out / "layer.json"));
    EXPECT_EQ(layer["format"], "quantized-mesh-1.0");
    EXPECT_EQ(layer["scheme"], "tms");
    EXPECT_EQ(layer["projection"], "EPSG:4326");
    EXPECT_EQ(layer["maxzoom"], 10);
    EXPECT_EQ(layer["orograph"]["error"], said["error"]);
    EXPECT_GT(said["error"][8]["rms_m"].get<double>(), said["error"][10]["rms_m"].get<double>());
    std::size_t named = 0, there = 0;
    for (std::size_t zoom = 0; zoom < layer["available"].size(); ++zoom)
        for (const auto& one : layer["available"][zoom])
            for (int x = one["startX"]; x <= one["endX"].get<int>(); ++x)
                for (int y = one["startY"]; y <= one["endY"].get<int>(); ++y) {
                    EXPECT_TRUE(fs::exists(out / std::to_string(zoom) / std::to_string(x) /
                                           (std::to_string(y) + ".terrain")));
                    ++named;
                }
    for (const auto& entry : fs::recursive_directory_iterator(out))
        there += entry.path().extension() == ".terrain";
    EXPECT_EQ(named, there);
    EXPECT_EQ(there, said["tiles"].get<std::size_t>());
    expect_refusal(run_orograph(export_words("quantized-mesh", out, {"--zoom", "3:9"})), oro::test::usage,
                   {"--zoom 3:9: must begin with 0"});
    expect_refusal(run_orograph(export_words("terrain-rgb", out, {"--overwrite"})), oro::test::failed,
                   {"which is no tile"});
}

TEST(ExportCommand, AModelKeepsToItsError) {
    const fs::path folder = oro::test::scratch_folder(), out = folder / "hills.glb";
    const auto every = object_said_by(export_words("gltf", out, {"--json"}));
    EXPECT_EQ(every["triangles"], 2 * 402 * 343);
    EXPECT_EQ(every["vertices"], 403 * 344);
    EXPECT_EQ(every["bytes"], fs::file_size(out));
    EXPECT_EQ(bytes_of(out).substr(0, 4), "glTF");
    expect_refusal(run_orograph(export_words("gltf", out)), oro::test::failed, {"--overwrite"});
    const auto fewer =
        object_said_by(export_words("gltf", out, {"--json", "--overwrite", "--max-error", "20"}));
    EXPECT_LT(fewer["triangles"].get<int>(), 2 * 402 * 343 * 9 / 10);
    EXPECT_LT(fewer["error_m"].get<double>(), 20.1);
    EXPECT_EQ(names_in(folder), Words{"hills.glb"});
    expect_refusal(run_orograph(export_words("gltf", folder / "t.tif")), oro::test::usage,
                   {"must end in .glb"});
    expect_refusal(run_orograph(export_words("gltf", folder / "t.glb", {"--max-error", "-1"})),
                   oro::test::usage, {"--max-error -1"});
    expect_refusal(run_orograph(export_words("cog", folder / "t.tif", {"--max-error", "1"})),
                   oro::test::usage, {"--max-error 1: needs --to gltf"});
}

TEST(ExportCommand, A3dTilesetReplacesOnlyATileset) {
    const fs::path folder = oro::test::scratch_folder(), out = folder / "tiles";
    const Words words = export_words("3dtiles", out, {"--bbox=-84.4,36.5,-84.3,36.6"});
    EXPECT_EQ(run_orograph(words).exit_code, 0);
    EXPECT_EQ(names_in(out), (Words{"0", "tileset.json"}));
    const std::string before = bytes_of(out / "tileset.json");
    expect_refusal(run_orograph(words), oro::test::failed, {"is there already (--overwrite replaces it)"});
    const Words again = oro::test::joined(words, {"--overwrite"});
    EXPECT_EQ(run_orograph(again).exit_code, 0);
    EXPECT_EQ(bytes_of(out / "tileset.json"), before);
    oro::test::write_bytes(out / "0" / "0" / "notes.txt", "mine");
    expect_refusal(run_orograph(again), oro::test::failed, {"notes.txt, which is no tile"});
    EXPECT_EQ(bytes_of(out / "0" / "0" / "notes.txt"), "mine");
    EXPECT_EQ(names_in(folder), Words{"tiles"});
}

TEST(ExportCommand, SparesWhatIsThere) {
    const fs::path folder = oro::test::scratch_folder(), out = folder / "tiles";
    const Words words = export_words("terrain-rgb", out, {"--zoom", "9"});
    EXPECT_EQ(run_orograph(words).exit_code, 0);
    const std::string before = bytes_of(out / "tiles.json");
    expect_refusal(run_orograph(words), oro::test::failed, {"is there already (--overwrite replaces it)"});
    const Words again = export_words("terrain-rgb", out, {"--zoom", "10", "--overwrite"});
    EXPECT_EQ(run_orograph(again).exit_code, 0);
    EXPECT_NE(bytes_of(out / "tiles.json"), before);
    EXPECT_EQ(names_in(out), (Words{"10", "tiles.json"}));
    oro::test::write_bytes(out / "notes.txt", "mine");
    expect_refusal(run_orograph(again), oro::test::failed, {"holds notes.txt, which is no tile"});
    EXPECT_EQ(bytes_of(out / "notes.txt"), "mine");
    EXPECT_EQ(names_in(folder), Words{"tiles"});
    const fs::path copy = folder / "copy.tif";
    fs::copy_file(bundled(), copy);
    expect_refusal(run_orograph({"export", copy, "--to", "cog", "--out", copy, "--overwrite"}),
                   oro::test::usage, {"would replace", "which the elevation data are in"});
    EXPECT_EQ(bytes_of(copy), bytes_of(bundled()));
}

TEST(ExportCommand, AFolderThatIsNotThereIsNamed) {
    const fs::path folder = oro::test::scratch_folder(), none = folder / "none";
    for (const auto& [format, name] : {std::pair{"cog", "deep.tif"},
                                       {"gltf", "deep.glb"},
                                       {"3dtiles", "deep"},
                                       {"quantized-mesh", "deep"},
                                       {"terrain-rgb", "deep/"}})
        expect_refusal(run_orograph(export_words(format, none / name)), oro::test::failed,
                       {(none / name).string() + ": the folder " + none.string() + " is not there"});
    EXPECT_EQ(names_in(folder), Words{});
}

TEST(ExportCommand, RefusesWhatHasNoMeaning) {
    const fs::path folder = oro::test::scratch_folder();
    for (const char* zoom : {"12:11", "3:23", "-1:4", "a", "3:", ":4", "1:2:3", "1.5"})
        expect_refusal(
            run_orograph(export_words("terrain-rgb", folder / "t", {std::string("--zoom=") + zoom})),
            oro::test::usage, {"--zoom", "must be LOW:HIGH as in 5:12, from 0 to 22"});
    expect_refusal(run_orograph(export_words("terrain-rgb", folder / "t", {"--zoom", "22"})),
                   oro::test::usage, {"more than 4,000,000"});
    expect_refusal(run_orograph(export_words("terrain-rgb", folder / "t", {"--hole-height", "20000"})),
                   oro::test::usage, {"--hole-height 20000"});
    expect_refusal(run_orograph(export_words("cog", folder / "t.tif", {"--zoom", "3:4"})), oro::test::usage,
                   {"--zoom 3:4: needs --to terrain-rgb or quantized-mesh"});
    expect_refusal(run_orograph(export_words("cog", folder / "t.tif", {"--hole-height", "1"})),
                   oro::test::usage, {"--hole-height", "needs --to terrain-rgb or quantized-mesh"});
    expect_refusal(run_orograph(export_words("3dtiles", folder / "t", {"--zoom", "3:4"})), oro::test::usage,
                   {"--zoom 3:4: needs --to terrain-rgb or quantized-mesh"});
    expect_refusal(run_orograph(export_words("cog", folder / "t.tif", {"--max-error", "1"})),
                   oro::test::usage, {"--max-error 1: needs --to gltf or 3dtiles"});
    expect_refusal(run_orograph(export_words("gltf", folder / "t.glb", {"--no-normals"})), oro::test::usage,
                   {"--no-normals: needs --to 3dtiles"});
    expect_refusal(run_orograph(export_words("obj", folder / "t")), oro::test::usage,
                   {"choose cog, terrain-rgb, 3dtiles, quantized-mesh or gltf"});
    EXPECT_TRUE(names_in(folder).empty());
}

}  // namespace
