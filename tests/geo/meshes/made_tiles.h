// 3D Tiles that tests make.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "geo/meshes/mesh_file.h"

namespace oro::test {

// A folder of a tileset's own.
class FolderOfTiles : public ::testing::Test {
  protected:
    void SetUp() override { std::filesystem::create_directories(folder_); }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    std::string write(const std::string& name, const std::string& bytes) const {
        const std::filesystem::path path = folder_ / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << bytes;
        return path.string();
    }
    // Of a tileset with this root.
    Result<SourceMesh> read(const std::string& root, const std::string& more = "") const {
        return read_mesh(write("tileset.json", R"({"asset":{"version":"1.1"},"geometricError":9,)" + more +
                                                   R"("root":)" + root + "}"));
    }
    std::string refusal(const std::string& root, const std::string& more = "") const {
        const auto mesh = read(root, more);
        return mesh.ok() ? "" : mesh.error().what;
    }

    const std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "tilesets";
};

template <class T>
void put_number(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// A triangle whose first corner lies at x, on the ground of glTF: (x, 0, 0), (x + 1, 0, 0), (x, 0, -1).
// material: its colour; "": none.
inline std::string glb_at(float x, const std::string& material = "", const std::string& more = "") {
    std::string binary;
    for (const float number : {x, 0.F, 0.F, x + 1.F, 0.F, 0.F, x, 0.F, -1.F}) put_number(binary, number);
    std::string json = R"({"asset":{"version":"2.0"},)" + more +
                       R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0})" +
                       (material.empty() ? "" : R"(,"material":0)") + R"(}]}],)" +
                       (material.empty() ? "" : R"("materials":[)" + material + "],") +
                       R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],)"
                       R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]})";
    while (json.size() % 4 != 0) json += ' ';
    std::string bytes = "glTF";
    for (const std::size_t number : {std::size_t{2}, 28 + json.size() + binary.size(), json.size()})
        put_number(bytes, static_cast<std::uint32_t>(number));
    bytes += "JSON" + json;
    put_number(bytes, static_cast<std::uint32_t>(binary.size()));
    return bytes + std::string("BIN\0", 4) + binary;
}

inline std::string b3dm_of(const std::string& glb, std::string features) {
    while (features.size() % 8 != 4) features += ' ';
    std::string bytes = "b3dm";
    for (const std::size_t number : {std::size_t{1}, 28 + features.size() + glb.size(), features.size(),
                                     std::size_t{0}, std::size_t{0}, std::size_t{0}})
        put_number(bytes, static_cast<std::uint32_t>(number));
    return bytes + features + glb;
}

// The x of each triangle's first corner, in the order of the file.
inline std::vector<double> firsts_of(const SourceMesh& mesh) {
    std::vector<double> all;
    for (const SourceTriangle& triangle : mesh.triangles) all.push_back(mesh.vertices[triangle[0]].x);
    return all;
}

inline std::string content_of(const std::string& uri) {
    return R"("content":{"uri":")" + uri + R"("})";
}

}  // namespace oro::test
