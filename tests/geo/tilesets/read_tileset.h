// 3D Tiles as a stranger reads them: by the specifications alone, with nothing of what wrote them.
#pragma once

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace oro::test {

struct ReadTile {
    std::string uri;     // "" for none
    std::string refine;  // its own or what it has from those above
    double error_m{};
    std::array<double, 6> region{};  // west, south, east, north in radians, lowest, highest in metres
    int parent{-1};
    std::vector<int> children;
    // Of the content: ECEF, and the triangles, the first ones of which are ground.
    std::vector<glm::dvec3> posts_m, normals;
    std::vector<glm::dvec3> colours;        // 0 .. 1, linear
    std::vector<int> sources;               // of each vertex, its row of the table of sources
    std::vector<std::string> source_names;  // of the table
    std::vector<float> source_le90_m;
    std::vector<int> features;               // of each vertex of a mesh, its row of the table of features
    std::vector<std::string> feature_names;  // of the table
    std::vector<std::string> feature_types;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::size_t ground_triangles{};
};

inline std::string all_bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

template <class Value>
Value value_at(const std::string& bytes, std::size_t at) {
    Value value{};
    if (at + sizeof(Value) > bytes.size()) {
        ADD_FAILURE() << "beyond the end";
        return value;
    }
    std::memcpy(&value, bytes.data() + at, sizeof(Value));
    return value;
}

// The bytes of a view, decompressed. Source: Khronos, EXT_meshopt_compression.
inline std::string view_bytes(const nlohmann::json& gltf, const std::string& bin, std::size_t number) {
    const auto& view = gltf["bufferViews"][number];
    EXPECT_TRUE(gltf["buffers"][view["buffer"].get<std::size_t>()]["extensions"]["EXT_meshopt_compression"]
                    ["fallback"]
                        .get<bool>());
    const auto& packed = view["extensions"]["EXT_meshopt_compression"];
    EXPECT_EQ(packed["buffer"], 0);
    const auto count = packed["count"].get<std::size_t>(), stride = packed["byteStride"].get<std::size_t>();
    EXPECT_EQ(view["byteLength"], count * stride);
    const auto first = packed["byteOffset"].get<std::size_t>(),
               size = packed["byteLength"].get<std::size_t>();
    EXPECT_LE(first + size, bin.size());
    const auto* const from = reinterpret_cast<const unsigned char*>(bin.data()) + first;
    std::string bytes(count * stride, '\0');
    if (packed["mode"] == "TRIANGLES") {
        EXPECT_EQ(meshopt_decodeIndexBuffer(bytes.data(), count, stride, from, size), 0);
        return bytes;
    }
    EXPECT_EQ(packed["mode"], "ATTRIBUTES");
    EXPECT_EQ(meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, size), 0);
    const std::string filter = packed.value("filter", "NONE");
    if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(bytes.data(), count, stride);
    if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(bytes.data(), count, stride);
    return bytes;
}

// Vectors of an accessor of floats, of shorts or of normalized bytes, as they stand.
inline std::vector<glm::dvec3> vectors_of(const nlohmann::json& gltf, const std::string& bin, int accessor) {
    const auto& of = gltf["accessors"][static_cast<std::size_t>(accessor)];
    const auto number = of["bufferView"].get<std::size_t>();
    const std::string bytes = view_bytes(gltf, bin, number);
    EXPECT_EQ(of["type"], "VEC3");
    const int component = of["componentType"];
    EXPECT_TRUE(component == 5120 || component == 5121 || component == 5122 || component == 5126)
        << component;
    EXPECT_EQ(of.value("normalized", false), component <= 5121);
    const std::size_t part = component <= 5121 ? 1 : component == 5122 ? 2 : 4;
    const auto stride = gltf["bufferViews"][number]["byteStride"].get<std::size_t>(),
               count = of["count"].get<std::size_t>();
    EXPECT_EQ(count * stride, bytes.size());
    std::vector<glm::dvec3> vectors;
    for (std::size_t i = 0; i < count; ++i) {
        std::array<double, 3> parts{};
        for (std::size_t j = 0; j < 3; ++j) {
            const std::size_t at = i * stride + j * part;
            parts[j] = component == 5120   ? std::max(-1.0, value_at<std::int8_t>(bytes, at) / 127.0)
                       : component == 5121 ? value_at<std::uint8_t>(bytes, at) / 255.0
                       : component == 5122 ? value_at<std::int16_t>(bytes, at)
                                           : static_cast<double>(value_at<float>(bytes, at));
        }
        vectors.emplace_back(parts[0], parts[1], parts[2]);
        for (std::size_t j = 0; of.contains("min") && j < 3; ++j) {
            EXPECT_GE(parts[j], of["min"][j].get<double>());
            EXPECT_LE(parts[j], of["max"][j].get<double>());
        }
    }
    return vectors;
}

// From glTF's y up to the z up of 3D Tiles (OGC 22-025r4, "glTF transforms"): (x, y, z) is (x, -z, y).
inline glm::dvec3 z_up(const glm::dvec3& y_up) {
    return {y_up.x, -y_up.z, y_up.y};
}

// A view of a property table, which is not compressed.
inline std::string plain_view_bytes(const nlohmann::json& gltf, const std::string& bin, std::size_t number) {
    const auto& view = gltf["bufferViews"][number];
    EXPECT_EQ(view["buffer"], 0);
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 8, 0U);
    EXPECT_LE(view["byteOffset"].get<std::size_t>() + view["byteLength"].get<std::size_t>(), bin.size());
    return bin.substr(view["byteOffset"], view["byteLength"]);
}

// Source: Cesium, EXT_mesh_features and EXT_structural_metadata.
inline void read_sources(const nlohmann::json& gltf, const std::string& bin, const nlohmann::json& primitive,
                         ReadTile& tile) {
    const auto& features = primitive["extensions"]["EXT_mesh_features"]["featureIds"][0];
    EXPECT_EQ(features["attribute"], 0);
    const auto& accessor = gltf["accessors"][primitive["attributes"]["_FEATURE_ID_0"].get<std::size_t>()];
    EXPECT_EQ(accessor["type"], "SCALAR");
    EXPECT_EQ(accessor["componentType"], 5121);
    const std::string ids = view_bytes(gltf, bin, accessor["bufferView"]);
    for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); ++i)
        tile.sources.push_back(static_cast<unsigned char>(ids[4 * i]));
    const auto& metadata = gltf["extensions"]["EXT_structural_metadata"];
    const auto& table = metadata["propertyTables"][features["propertyTable"].get<std::size_t>()];
    EXPECT_TRUE(metadata["schema"]["classes"].contains(table["class"].get<std::string>()));
    EXPECT_EQ(table["count"], features["featureCount"]);
    const auto& name = table["properties"]["name"];
    const std::string text = plain_view_bytes(gltf, bin, name["values"]),
                      ends = plain_view_bytes(gltf, bin, name["stringOffsets"]),
                      le90 = plain_view_bytes(gltf, bin, table["properties"]["vertical_le90_m"]["values"]);
    for (std::size_t i = 0; i < table["count"].get<std::size_t>(); ++i) {
        const auto begin = value_at<std::uint32_t>(ends, 4 * i),
                   end = value_at<std::uint32_t>(ends, 4 * i + 4);
        tile.source_names.push_back(text.substr(begin, end - begin));
        tile.source_le90_m.push_back(value_at<float>(le90, 4 * i));
    }
}

// A column of texts of the first property table.
inline std::vector<std::string> texts_in(const nlohmann::json& gltf, const std::string& bin,
                                         const std::string& column) {
    const auto& table = gltf["extensions"]["EXT_structural_metadata"]["propertyTables"][0];
    const auto& of = table["properties"][column];
    const std::string text = plain_view_bytes(gltf, bin, of["values"]),
                      ends = plain_view_bytes(gltf, bin, of["stringOffsets"]);
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < table["count"].get<std::size_t>(); ++i) {
        const auto begin = value_at<std::uint32_t>(ends, 4 * i),
                   end = value_at<std::uint32_t>(ends, 4 * i + 4);
        texts.push_back(text.substr(begin, end - begin));
    }
    return texts;
}

inline void read_features(const nlohmann::json& gltf, const std::string& bin, const nlohmann::json& primitive,
                          ReadTile& tile) {
    const auto& accessor = gltf["accessors"][primitive["attributes"]["_FEATURE_ID_0"].get<std::size_t>()];
    EXPECT_EQ(accessor["type"], "SCALAR");
    ASSERT_EQ(accessor["componentType"], 5123);
    const std::string ids = view_bytes(gltf, bin, accessor["bufferView"]);
    tile.feature_names = texts_in(gltf, bin, "name");
    tile.feature_types = texts_in(gltf, bin, "type");
    for (std::size_t i = 0; i < accessor["count"].get<std::size_t>(); ++i) {
        tile.features.push_back(value_at<std::uint16_t>(ids, 4 * i));
        ASSERT_LT(static_cast<std::size_t>(tile.features.back()), tile.feature_names.size());
    }
}

inline void read_glb(const std::string& bytes, ReadTile& tile) {
    ASSERT_GT(bytes.size(), 28U);
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(value_at<std::uint32_t>(bytes, 4), 2U);
    EXPECT_EQ(value_at<std::uint32_t>(bytes, 8), bytes.size());
    const auto json_size = value_at<std::uint32_t>(bytes, 12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(json_size % 4, 0U);
    const auto gltf = nlohmann::json::parse(bytes.substr(20, json_size));
    const auto bin_size = value_at<std::uint32_t>(bytes, 20 + json_size);
    EXPECT_EQ(bytes.substr(24 + json_size, 4), std::string("BIN\0", 4));
    const std::string bin = bytes.substr(28 + json_size, bin_size);
    ASSERT_EQ(bin.size(), bin_size);
    const auto& node = gltf["nodes"][gltf["scenes"][0]["nodes"][0].get<std::size_t>()];
    glm::dmat4 matrix(1.0);
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node["matrix"][static_cast<std::size_t>(i)];
    const auto& mesh = gltf["meshes"][node["mesh"].get<std::size_t>()];
    const auto& primitive = mesh["primitives"][0];
    for (const glm::dvec3& position : vectors_of(gltf, bin, primitive["attributes"]["POSITION"]))
        tile.posts_m.push_back(z_up(glm::dvec3(matrix * glm::dvec4(position, 1.0))));
    if (primitive["attributes"].contains("NORMAL"))
        for (const glm::dvec3& normal : vectors_of(gltf, bin, primitive["attributes"]["NORMAL"]))
            tile.normals.push_back(glm::normalize(z_up(glm::dmat3(matrix) * normal)));
    if (primitive["attributes"].contains("COLOR_0"))
        tile.colours = vectors_of(gltf, bin, primitive["attributes"]["COLOR_0"]);
    const bool is_ground = mesh.contains("extras");
    if (primitive["attributes"].contains("_FEATURE_ID_0"))
        is_ground ? read_sources(gltf, bin, primitive, tile) : read_features(gltf, bin, primitive, tile);
    const auto& indices = gltf["accessors"][primitive["indices"].get<std::size_t>()];
    const bool shorts = indices["componentType"] == 5123;
    EXPECT_EQ(shorts, tile.posts_m.size() <= 65535U);
    const std::string bytes_of_indices = view_bytes(gltf, bin, indices["bufferView"].get<std::size_t>());
    for (std::size_t i = 0; i < indices["count"].get<std::size_t>() / 3; ++i) {
        auto& triangle = tile.triangles.emplace_back();
        for (std::size_t j = 0; j < 3; ++j) {
            triangle[j] = shorts ? value_at<std::uint16_t>(bytes_of_indices, 2 * (3 * i + j))
                                 : value_at<std::uint32_t>(bytes_of_indices, 4 * (3 * i + j));
            ASSERT_LT(triangle[j], tile.posts_m.size());
        }
    }
    if (is_ground) tile.ground_triangles = mesh["extras"]["groundTriangles"];
}

inline void read_tile(const nlohmann::json& json, const std::filesystem::path& folder, int parent,
                      std::vector<ReadTile>& tiles) {
    const auto number = static_cast<int>(tiles.size());
    tiles.emplace_back();
    tiles.back().parent = parent;
    if (parent >= 0) tiles[static_cast<std::size_t>(parent)].children.push_back(number);
    tiles.back().error_m = json["geometricError"];
    tiles.back().refine =
        json.value("refine", parent < 0 ? "" : tiles[static_cast<std::size_t>(parent)].refine);
    for (std::size_t i = 0; i < 6; ++i) tiles.back().region[i] = json["boundingVolume"]["region"][i];
    if (json.contains("content")) {
        tiles.back().uri = json["content"]["uri"];
        read_glb(all_bytes(folder / tiles.back().uri), tiles.back());
    }
    if (json.contains("children"))
        for (const auto& child : json["children"]) read_tile(child, folder, number, tiles);
}

// All tiles, the root first, each after its parent.
inline std::vector<ReadTile> read_tileset(const std::filesystem::path& folder,
                                          const std::string& refine = "REPLACE") {
    const auto json = nlohmann::json::parse(all_bytes(folder / "tileset.json"));
    EXPECT_EQ(json["asset"]["version"], "1.1");
    EXPECT_EQ(json["root"]["refine"], refine);
    EXPECT_GE(json["geometricError"].get<double>(), json["root"]["geometricError"].get<double>());
    std::vector<ReadTile> tiles;
    read_tile(json["root"], folder, -1, tiles);
    return tiles;
}

}  // namespace oro::test
