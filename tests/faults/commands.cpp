#include "tests/faults/commands.h"

#include <gdal.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <sstream>

#include "tests/support/test_data.h"

namespace oro::test {
namespace fs = std::filesystem;
namespace {

std::string bytes_in(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return bytes.str();
}

// The north-western corner of the bundled region, 20 x 20 posts.
const std::string& tile() {
    static const std::string bytes = [] {
        GDALAllRegister();
        const fs::path from = bundled_data() / "jacksboro.tif", to = scratch_folder() / "tile.tif";
        const GDALDatasetH whole = GDALOpen(from.c_str(), GA_ReadOnly);
        std::vector<std::int16_t> heights(400);
        std::array<double, 6> place{};
        EXPECT_TRUE(whole);
        EXPECT_EQ(GDALGetGeoTransform(whole, place.data()), CE_None);
        EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(whole, 1), GF_Read, 0, 0, 20, 20, heights.data(), 20, 20,
                               GDT_Int16, 0, 0),
                  CE_None);
        const GDALDatasetH corner =
            GDALCreate(GDALGetDriverByName("GTiff"), to.c_str(), 20, 20, 1, GDT_Int16, nullptr);
        EXPECT_TRUE(corner);
        GDALSetGeoTransform(corner, place.data());
        GDALSetProjection(corner, GDALGetProjectionRef(whole));
        EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(corner, 1), GF_Write, 0, 0, 20, 20, heights.data(), 20, 20,
                               GDT_Int16, 0, 0),
                  CE_None);
        GDALClose(corner);
        GDALClose(whole);
        return bytes_in(to);
    }();
    return bytes;
}

using Files = std::map<std::string, std::string>;

// What an undisturbed run makes of the inputs: all files but these.
Files made(const std::vector<std::string>& words, const Files& inputs) {
    const fs::path folder = scratch_folder();
    for (const auto& [name, bytes] : inputs) std::ofstream(folder / name, std::ios::binary) << bytes;
    DisturbedProgram program(words, folder, 1);
    const Disturbed run = program.run({"thread"});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    Files files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (!inputs.contains(entry.path().filename().string()))
            files[entry.path().filename().string()] = bytes_in(entry.path());
    return files;
}

// Of a file there already nobody reads a byte: it is replaced or stays.
constexpr const char* there_before = "a file of before";

const std::string& baked() {
    static const std::string bytes =
        made({"bake", "tile.tif", "-q", "--out", "tile.oro"}, {{"tile.tif", tile()}}).at("tile.oro");
    return bytes;
}

// A triangle on the tile, in metres of UTM zone 16 north; y is up in glTF, and south is z.
constexpr const char* mesh = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0, "translation": [731700, 300, -4067600]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0, 0, -40], "max": [40, 30, 0]}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "buffers": [{"byteLength": 36, "uri":
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAAAgQgAAAAAAAAAAAAAAAAAA8EEAACDC"}]})";

Command shot_of(const std::string& name, const std::string& bytes, const std::string& style = "default",
                const std::string& size = "32x24") {
    const std::vector<std::string> words{"shot",   name, "-q",    "--overwrite", "--pipeline", "mesh",
                                         "--size", size, "--out", "p.png",       "--style",    style};
    return {"shot " + name, words, {{name, bytes}}, {{"p.png", there_before}}, false};
}

}  // namespace

Command info_of_tiles() {
    return {"info tile.tif", {"info", "tile.tif"}, {{"tile.tif", tile()}}, {}, false};
}

Command info_of_baked() {
    return {"info --check tile.oro", {"info", "--check", "tile.oro"}, {{"tile.oro", baked()}}, {}, false};
}

Command info_of_mesh() {
    const std::vector<std::string> words{"info",   "tile.tif",   "--mesh-file",
                                         "m.gltf", "--mesh-crs", "EPSG:32616"};
    return {"info --mesh-file m.gltf", words, {{"tile.tif", tile()}, {"m.gltf", mesh}}, {}, false};
}

Command info_of_baked_mesh() {
    static const std::string bytes = [] {
        const Command bake = bake_with_mesh();
        return made(bake.words, bake.inputs).at("n.oro");
    }();
    return {"info --check n.oro", {"info", "--check", "n.oro"}, {{"n.oro", bytes}}, {}, false};
}

Command bake_with_mesh() {
    const std::vector<std::string> words{"bake",       "tile.tif",   "-q",    "--mesh-file", "m.gltf",
                                         "--mesh-crs", "EPSG:32616", "--out", "n.oro"};
    return {
        "bake --mesh-file m.gltf", words, {{"tile.tif", tile()}, {"m.gltf", mesh}}, {{"n.oro", ""}}, true};
}

Command bake_new() {
    return {"bake tile.tif",
            {"bake", "tile.tif", "-q", "--out", "n.oro"},
            {{"tile.tif", tile()}},
            {{"n.oro", ""}},
            true};
}

Command bake_again() {
    const std::vector<std::string> words{"bake", "tile.tif", "-q", "--overwrite", "--out", "n.oro"};
    const auto other =
        made({"bake", "tile.tif", "-q", "--fill-voids", "--out", "n.oro"}, {{"tile.tif", tile()}});
    return {"bake --overwrite tile.tif", words, {{"tile.tif", tile()}}, other, true};
}

Command shot_of_tiles() {
    return shot_of("tile.tif", tile());
}

Command shot_with_labels() {
    return shot_of("tile.tif", tile(), "contours", "160x120");
}

Command viewshed_of_tiles() {
    const std::vector<std::string> words{"viewshed",       "tile.tif", "-q",  "--overwrite", "--at",
                                         "36.725,-84.405", "--radius", "0.6", "--out",       "s.tif"};
    return {"viewshed tile.tif", words, {{"tile.tif", tile()}}, {{"s.tif", there_before}}, false};
}

Command viewshed_of_table() {
    const std::vector<std::string> words{"viewshed",    "tile.tif",  "-q",      "--overwrite",
                                         "--observers", "masts.csv", "--table", "t.csv",
                                         "--radius",    "0.6",       "--out",   "s.tif"};
    return {"viewshed --observers masts.csv",
            words,
            {{"tile.tif", tile()}, {"masts.csv", "lat,lon\n36.725,-84.405\n36.724,-84.404\n"}},
            {{"s.tif", there_before}, {"t.csv", "another of before"}, {"s.qml", "a style of before"}},
            false};
}

Command horizon_of_tiles() {
    const std::vector<std::string> words{"horizon", "tile.tif", "-q",  "--overwrite", "--directions",
                                         "4",       "--radius", "0.6", "--out",       "h.tif"};
    return {"horizon tile.tif",
            words,
            {{"tile.tif", tile()}},
            {{"h.horizon.tif", there_before},
             {"h.sky-view.tif", "another of before"},
             {"h.horizon.qml", "a style of before"}},
            false};
}

Command profile_of_tiles() {
    const std::vector<std::string> words{
        "profile", "tile.tif", "-q",    "--overwrite", "--along", "36.72,-84.41; 36.73,-84.40",
        "--step",  "100",      "--out", "p.csv"};
    return {"profile tile.tif", words, {{"tile.tif", tile()}}, {{"p.csv", there_before}}, false};
}

Command export_of_tiles() {
    const std::vector<std::string> words{"export", "tile.tif", "-q",    "--overwrite",
                                         "--to",   "cog",      "--out", "h.tif"};
    return {"export tile.tif", words, {{"tile.tif", tile()}}, {{"h.tif", there_before}}, false};
}

Command shot_of_baked() {
    return shot_of("tile.oro", baked());
}

}  // namespace oro::test
