// glTF: places by nodes' transforms in double, both kinds of file, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "geo/meshes/mesh_file.h"

namespace oro {
namespace {

std::string gltf_written(const std::string& name, const std::string& bytes) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "gltf";
    std::filesystem::create_directories(folder);
    const std::string path = (folder / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

template <class T>
void append(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// A triangle of 1 m, 2 m up: three VEC3 of float, then indices 2, 1, 0.
std::string triangle_bytes() {
    std::string bytes;
    for (const float number : {0.F, 2.F, 0.F, 1.F, 2.F, 0.F, 0.F, 2.F, -1.F}) append(bytes, number);
    for (const int index : {2, 1, 0}) append(bytes, static_cast<std::uint16_t>(index));
    return bytes;
}

std::string gltf_text(const std::string& uri, const std::string& nodes, const std::string& more = "") {
    return R"({"asset":{"version":"2.0"},)" + more + R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":)" +
           nodes +
           R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
           R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
           R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],"bufferViews":[)"
           R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],"buffers":[{"byteLength":42)" +
           uri + "}]}";
}
const std::string beside_it = R"(,"uri":"a%20b.bin")";
const std::string far_node =
    R"([{"children":[1],"translation":[2600000.125,500.25,-1200000.5]},{"name":"yard","mesh":0,"scale":[2,2,2]}])";

std::string gltf_refusal(const std::string& text) {
    gltf_written("a b.bin", triangle_bytes());
    const auto read = read_mesh(gltf_written("bad.gltf", text));
    return read.ok() ? "" : read.error().what;
}

std::string glb(const std::string& text, const std::string& binary) {
    std::string json = text, bytes = "glTF";
    while (json.size() % 4 != 0) json += ' ';
    append(bytes, 2U);
    append(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + binary.size()));
    append(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    append(bytes, static_cast<std::uint32_t>(binary.size()));
    return bytes + std::string("BIN\0", 4) + binary;
}

// y is up and z is south: (x, y, z) lies at east x, north -z, height y. Float alone would keep 0.25 m of E.
TEST(Gltf, NodesAreMultipliedInDouble) {
    gltf_written("a b.bin", triangle_bytes());
    const std::string data = R"(,"uri":"data:application/octet-stream;base64,)"
                             R"(AAAAAAAAAEAAAAAAAACAPwAAAEAAAAAAAAAAAAAAAEAAAIC/AgABAAAA")";
    for (const std::string& path :
         {gltf_written("yard.gltf", gltf_text(beside_it, far_node)),
          gltf_written("data.gltf", gltf_text(data, far_node)),
          gltf_written("yard.glb", glb(gltf_text("", far_node), triangle_bytes()))}) {
        const auto mesh = read_mesh(path);
        ASSERT_TRUE(mesh.ok()) << mesh.error().line();
        ASSERT_EQ(mesh->vertices.size(), 3U);
        EXPECT_EQ(mesh->vertices[0], glm::dvec3(2600000.125, 1200000.5, 504.25));
        EXPECT_EQ(mesh->vertices[1], glm::dvec3(2600002.125, 1200000.5, 504.25));
        EXPECT_EQ(mesh->vertices[2], glm::dvec3(2600000.125, 1200002.5, 504.25));
        EXPECT_EQ(mesh->triangles, (ScratchVector<SourceTriangle>{{2, 1, 0}}));
        EXPECT_EQ(mesh->format, "glTF");
        EXPECT_EQ(mesh->parts.at(0).name, "yard");
        EXPECT_EQ(mesh->crs, "");
    }
}

// A quarter turn around the vertical axis, and the same as a matrix (column by column).
TEST(Gltf, RotationsAndMatricesAgree) {
    gltf_written("a b.bin", triangle_bytes());
    const std::string turned = R"([{"mesh":0,"rotation":[0,0.70710678118654752,0,0.70710678118654752]}])",
                      matrix = R"([{"mesh":0,"matrix":[0,0,-1,0,0,1,0,0,1,0,0,0,0,0,0,1]}])";
    for (const std::string& nodes : {turned, matrix}) {
        const auto mesh = read_mesh(gltf_written("turned.gltf", gltf_text(beside_it, nodes)));
        ASSERT_TRUE(mesh.ok()) << mesh.error().line();
        // (1, 2, 0) turns to (0, 2, -1), which is 1 m to the north.
        EXPECT_NEAR(mesh->vertices[1].x, 0.0, 1.0e-15);
        EXPECT_NEAR(mesh->vertices[1].y, 1.0, 1.0e-15);
        EXPECT_EQ(mesh->vertices[1].z, 2.0);
    }
}

TEST(Gltf, StripsAndFansTurnAsTheyAreDrawn) {
    std::string bytes;
    for (int i = 0; i < 5; ++i)
        for (const float number : {static_cast<float>(i), static_cast<float>(i % 2), 0.F})
            append(bytes, number);
    const auto read = [&](const std::string& mode) {
        return read_mesh(gltf_written(
            "strip.glb",
            glb(R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
                R"({"POSITION":0},"mode":)" +
                    mode +
                    R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"}],)"
                    R"("bufferViews":[{"buffer":0,"byteLength":60}],"buffers":[{"byteLength":60}]})",
                bytes)));
    };
    const auto strip = read("5"), fan = read("6"), lines = read("1");
    ASSERT_TRUE(strip.ok()) << strip.error().line();
    EXPECT_EQ(strip->triangles, (ScratchVector<SourceTriangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
    ASSERT_TRUE(fan.ok()) << fan.error().line();
    EXPECT_EQ(fan->triangles, (ScratchVector<SourceTriangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
    ASSERT_FALSE(lines.ok());
    EXPECT_EQ(lines.error().what, "no triangles");
}

TEST(Gltf, RefusesInOneLine) {
    EXPECT_EQ(gltf_refusal("{}"), "is glTF without a version: 2.0 is read");
    EXPECT_EQ(gltf_refusal(
                  gltf_text(beside_it, far_node, R"("extensionsRequired":["KHR_draco_mesh_compression"],)")),
              "needs the extension KHR_draco_mesh_compression, which is not read");
    EXPECT_EQ(gltf_refusal(gltf_text(beside_it, R"([{"children":[1]},{"children":[0]}])")),
              "node 0 is below itself");
    EXPECT_EQ(gltf_refusal(gltf_text(R"(,"uri":"http://example.org/a.bin")", far_node)),
              "buffer 0 is at http://example.org/a.bin: only files beside it are read");
    EXPECT_EQ(gltf_refusal(gltf_text(R"(,"uri":"../a.bin")", far_node)),
              "buffer 0 is at ../a.bin: only files beside it are read");
    EXPECT_EQ(gltf_refusal(gltf_text(R"(,"uri":"data:;base64,AAAA")", far_node)),
              "buffer 0 promises 42 bytes and has 3");
    std::string beyond = gltf_text(beside_it, far_node);
    beyond.replace(beyond.find("\"byteLength\":36"), 15, "\"byteLength\":35");
    EXPECT_EQ(gltf_refusal(beyond), "accessor 0 lies beyond its buffer view");
    std::string huge = gltf_text(beside_it, far_node);
    huge.replace(huge.find("\"count\":3"), 9, "\"count\":18446744073709551615");
    EXPECT_EQ(gltf_refusal(huge), "accessor 0 is no list of VEC3 in a buffer view");
    std::string none = gltf_text(beside_it, far_node);
    none.replace(none.find("\"mesh\":0"), 8, "\"mesh\":7");
    EXPECT_EQ(gltf_refusal(none), "node 1 has a mesh that is not there");
    EXPECT_NE(gltf_refusal("{\"asset\":").find("line 1"), std::string::npos) << gltf_refusal("{\"asset\":");
}

// A triangle with colours of a type, and a material; more: members of the file.
std::string coloured_gltf(const std::string& colours, const std::string& accessor,
                          const std::string& material, const std::string& more = "") {
    const std::string bytes = triangle_bytes().substr(0, 36) + colours;
    return glb(
        R"({"asset":{"version":"2.0"},)" + more +
            R"("nodes":[{"mesh":0}],"meshes":[{"primitives":)"
            R"([{"attributes":{"POSITION":0,"COLOR_0":1},"material":0}]}],"materials":[)" +
            material +
            R"(],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
            R"({"bufferView":1,"count":3,)" +
            accessor +
            R"(}],"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":)" +
            std::to_string(colours.size()) + R"(}],"buffers":[{"byteLength":)" +
            std::to_string(bytes.size()) + "}]}",
        bytes);
}

// Colours are light, and the material's is a factor: half of half is 0.25, whose code of sRGB is 137
// (IEC 61966-2-1: 1.055 * 0.25^(1/2.4) - 0.055 = 0.5371).
TEST(Gltf, ColoursAreLightTimesThatOfTheMaterial) {
    const std::string half = R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1]}})";
    std::string real, shorts, bytes;
    for (int vertex = 0; vertex < 3; ++vertex)
        for (const float part : {0.5F, 1.0F, 0.0F, 0.3F}) {
            append(real, part);
            append(shorts, static_cast<std::uint16_t>(std::lround(part * 65535.0F)));
            append(bytes, static_cast<std::uint8_t>(std::lround(part * 255.0F)));
        }
    const std::pair<std::string, std::string> kinds[] = {
        {real, R"("componentType":5126,"type":"VEC4")"},
        {shorts, R"("componentType":5123,"normalized":true,"type":"VEC4")"},
        {bytes, R"("componentType":5121,"normalized":true,"type":"VEC4")"}};
    for (const auto& [colours, accessor] : kinds) {
        const auto mesh = read_mesh(gltf_written("coloured.glb", coloured_gltf(colours, accessor, half)));
        ASSERT_TRUE(mesh.ok()) << mesh.error().line();
        ASSERT_EQ(mesh->colours.size(), 3U);
        EXPECT_NEAR(mesh->colours[1].red, 137, 1) << accessor;
        EXPECT_EQ(mesh->colours[1].green, 255);
        EXPECT_EQ(mesh->colours[1].blue, 0);
        EXPECT_EQ(mesh->colours[1].is_stated, 1);
    }
    const auto why = [&](const std::string& accessor, const std::string& material) {
        const auto mesh = read_mesh(gltf_written("bad.glb", coloured_gltf(bytes, accessor, material)));
        return mesh.ok() ? "" : mesh.error().what;
    };
    EXPECT_EQ(why(R"("componentType":5121,"type":"VEC4")", half),
              "a primitive has colours of a type that colours do not have");
    EXPECT_EQ(why(R"("componentType":5121,"normalized":true,"type":"VEC2")", half),
              "accessor 1 is no list of VEC3 in a buffer view");
    EXPECT_EQ(why(R"("componentType":5121,"normalized":true,"type":"VEC4")",
                  R"({"pbrMetallicRoughness":{"baseColorFactor":[1,1]}})"),
              "its baseColorFactor is no list of 4 numbers");
    std::string other = coloured_gltf(bytes, R"("componentType":5121,"normalized":true,"type":"VEC4")", half);
    other.replace(other.find("\"material\":0"), 12, "\"material\":4");
    const auto none = read_mesh(gltf_written("other.glb", other));
    ASSERT_FALSE(none.ok());
    EXPECT_EQ(none.error().what, "a primitive has a material that is not there");
}

// CESIUM_RTC and KHR_mesh_quantization are read though a file needs them; the centre is one of z up.
TEST(Gltf, TheCentreOfCesiumIsAdded) {
    gltf_written("a b.bin", triangle_bytes());
    const auto mesh = read_mesh(gltf_written(
        "rtc.gltf", gltf_text(beside_it, R"([{"mesh":0}])",
                              R"("extensionsRequired":["CESIUM_RTC","KHR_mesh_quantization"],)"
                              R"("extensions":{"CESIUM_RTC":{"center":[4278123.25,637000,4670000]}},)")));
    ASSERT_TRUE(mesh.ok()) << mesh.error().line();
    EXPECT_EQ(mesh->vertices[1], glm::dvec3(4278124.25, 637000.0, 4670002.0));
    EXPECT_EQ(gltf_refusal(gltf_text(beside_it, far_node, R"("extensions":{"CESIUM_RTC":{"center":[1]}},)")),
              "its center is no list of 3 numbers");
}

// Each cut, and each of many damaged bytes, ends in a mesh whose corners are there or in an error.
TEST(Gltf, CutAndDamagedFilesEndInAnAnswer) {
    const unsigned seed = 5207;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    gltf_written("a b.bin", triangle_bytes());
    const std::pair<std::string, std::string> files[] = {
        {"x.glb", glb(gltf_text("", far_node), triangle_bytes())},
        {"x.gltf", gltf_text(beside_it, far_node)}};
    for (const auto& [name, bytes] : files)
        for (int i = 0; i < 600; ++i) {
            std::string text = bytes;
            if (i % 3 == 0)
                text.resize(random() % text.size());
            else
                text[random() % text.size()] = static_cast<char>(random() % 256);
            const auto read = read_mesh(gltf_written(name, text));
            if (!read.ok()) {
                EXPECT_FALSE(read.error().what.empty());
                continue;
            }
            for (const SourceTriangle& triangle : read->triangles)
                for (const std::uint32_t corner : triangle) ASSERT_LT(corner, read->vertices.size());
        }
}

}  // namespace
}  // namespace oro
