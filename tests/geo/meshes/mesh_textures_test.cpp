// Textures of meshes: the colours that vertices get, how they are found, and what is refused.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "geo/meshes/mesh_file.h"
#include "geo/pictures/picture.h"
#include "geo/pictures/png_bytes.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb white{255, 255, 255}, black{0, 0, 0}, red{255, 0, 0}, green{0, 255, 0}, blue{0, 0, 255};

template <class T>
void put(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string png_of(const std::vector<Rgb>& pixels, int width) {
    std::vector<std::uint8_t> rgb;
    for (const Rgb& pixel : pixels) rgb.insert(rgb.end(), pixel.begin(), pixel.end());
    const auto bytes = png_bytes(rgb, width, static_cast<int>(pixels.size()) / width);
    EXPECT_TRUE(bytes.ok());
    return {bytes->begin(), bytes->end()};
}
// White at the top left.
const std::string& checker() {
    static const std::string bytes = png_of({white, black, black, white}, 2);
    return bytes;
}

std::string base64_of(const std::string& bytes) {
    const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : digits[group >> (18 - 6 * k) & 63U];
    }
    return text;
}

class MeshTextures : public ::testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    std::string write(const std::string& name, const std::string& bytes) const {
        const fs::path path = folder_ / name;
        fs::create_directories(path.parent_path());
        std::ofstream(path, std::ios::binary) << bytes;
        return path.string();
    }
    std::string why(const std::string& name, const std::string& bytes) const {
        const auto read = read_mesh(write(name, bytes));
        return read.ok() ? "" : read.error().what;
    }
    SourceMesh read(const std::string& name, const std::string& bytes) const {
        auto mesh = read_mesh(write(name, bytes));
        EXPECT_TRUE(mesh.ok()) << mesh.error().line();
        return mesh.ok() ? *mesh : SourceMesh();
    }

    const fs::path folder_ = fs::path(testing::TempDir()) / "mesh_textures";
};

// A square of two triangles, north-west corner first, then clockwise, that meet between its first and its
// third corner.
const std::string square_faces = "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n",
                  square_vertices = "v 0 10 0\nv 10 10 0\nv 10 0 0\nv 0 0 0\n",
                  square_coordinates = "vt 0 1\nvt 1 1\nvt 1 0\nvt 0 0\n",
                  textured_square =
                      "mtllib m.mtl\n" + square_vertices + square_coordinates + "usemtl a\n" + square_faces;

// glTF of the same square. more: members besides; texture, sampler, image: within their objects.
struct GltfSquare {
    std::array<float, 8> at{0, 0, 1, 0, 1, 1, 0, 1};
    std::string material = R"("baseColorTexture":{"index":0})", sampler = "{}", image, more;
    std::string appended;  // bytes behind the others: the last buffer view
    std::string coordinates = R"("TEXCOORD_0":1)";

    [[nodiscard]] std::string glb() const {
        std::string binary;
        for (const float number : {0.F, 0.F, -10.F, 10.F, 0.F, -10.F, 10.F, 0.F, 0.F, 0.F, 0.F, 0.F})
            put(binary, number);
        for (const float number : at) put(binary, number);
        for (const int index : {0, 1, 2, 0, 2, 3}) put(binary, static_cast<std::uint16_t>(index));
        const std::size_t own = binary.size();
        binary += appended;
        std::string json =
            R"({"asset":{"version":"2.0"},)" + more +
            R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,)" + coordinates +
            R"(},"indices":2,"material":0}]}],"materials":[{"pbrMetallicRoughness":{)" + material +
            R"(}}],"textures":[{"source":0,"sampler":0}],"samplers":[)" + sampler + R"(],"images":[{)" +
            image +
            R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
            R"({"bufferView":1,"componentType":5126,"count":4,"type":"VEC2"},)"
            R"({"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],"bufferViews":[)"
            R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":32},)"
            R"({"buffer":0,"byteOffset":80,"byteLength":12},{"buffer":0,"byteOffset":)" +
            std::to_string(own) + R"(,"byteLength":)" + std::to_string(appended.size()) +
            R"(}],"buffers":[{"byteLength":)" + std::to_string(binary.size()) + "}]}";
        while (json.size() % 4 != 0) json += ' ';
        std::string bytes = "glTF";
        for (const std::size_t number : {std::size_t{2}, 28 + json.size() + binary.size(), json.size()})
            put(bytes, static_cast<std::uint32_t>(number));
        bytes += "JSON" + json;
        put(bytes, static_cast<std::uint32_t>(binary.size()));
        return bytes + std::string("BIN\0", 4) + binary;
    }
};

void expect_codes(const SourceMesh& mesh, const std::vector<Rgb>& codes, int tolerance) {
    ASSERT_EQ(mesh.colours.size(), codes.size());
    for (std::size_t i = 0; i < codes.size(); ++i) {
        EXPECT_NEAR(mesh.colours[i].red, codes[i][0], tolerance) << i;
        EXPECT_NEAR(mesh.colours[i].green, codes[i][1], tolerance) << i;
        EXPECT_NEAR(mesh.colours[i].blue, codes[i][2], tolerance) << i;
        EXPECT_EQ(mesh.colours[i].is_stated, 1) << i;
    }
}

// The third of a triangle at one of its corners ends at the middles of two sides and at the centroid. That of
// the second corner (and of the fourth) lies in one quarter of the square, which is black. Of the first
// corner's two thirds a quarter reaches over the middle line of the square: the triangle (1/2, 0),
// (2/3, 1/3), (1/2, 1/2) has 1/24 of the square, and the third 1/6. Light of 0.75 is the code 225 of sRGB
// (IEC 61966-2-1: 1.055 * 0.75^(1/2.4) - 0.055 = 0.8808).
const std::vector<Rgb> checker_codes{{225, 225, 225}, {0, 0, 0}, {225, 225, 225}, {0, 0, 0}};

TEST_F(MeshTextures, OfObjAreAveragedAroundVertices) {
    write("m.mtl", "newmtl a\nKd 1 1 1\nmap_Kd c.png\n");
    write("c.png", checker());
    const SourceMesh mesh = read("a.obj", textured_square);
    expect_codes(mesh, checker_codes, 2);
    ASSERT_EQ(mesh.textures.size(), 1U);
    EXPECT_EQ(mesh.textures[0].name, "c.png");
    EXPECT_EQ(mesh.textures[0].width_px, 2);
    EXPECT_NEAR(mesh.texels / static_cast<double>(mesh.textured_vertices), 1.0, 1.0e-6);
    EXPECT_EQ(mesh.notes, std::vector<std::string>{
                              "colours of its texture are averaged at vertices, over 1.0 texels each"});
}

TEST_F(MeshTextures, OfGltfAreFoundInEachPlace) {
    write("c d.png", checker());
    GltfSquare square;
    const std::string data = R"("uri":"data:image/png;base64,)" + base64_of(checker()) + R"(")";
    for (const std::string& image : {std::string(R"("uri":"c%20d.png")"), data,
                                     std::string(R"("bufferView":3,"mimeType":"image/png")")}) {
        square.image = image;
        square.appended = image.find("bufferView") != std::string::npos ? checker() : "";
        expect_codes(read("a.glb", square.glb()), checker_codes, 2);
    }
}

// A JPEG of one colour comes back within 2 codes at our own quality.
TEST_F(MeshTextures, JpegsAreRead) {
    Geotags tags;
    tags.width_px = tags.height_px = 16, tags.geoid = "EGM96", tags.view_json = "{}";
    tags.vertical_fov_deg = 60.0;
    const std::string path = (folder_ / "j.jpg").string();
    auto writer = create_picture(path, tags, true);
    ASSERT_TRUE(writer.ok()) << writer.error().line();
    std::vector<std::uint8_t> row;
    for (int i = 0; i < 16; ++i) row.insert(row.end(), {200, 100, 50});
    for (int i = 0; i < 16; ++i) ASSERT_TRUE((*writer)->write_row(row).ok());
    ASSERT_TRUE((*writer)->finish().ok());
    write("m.mtl", "newmtl a\nmap_Kd j.jpg\n");
    const Rgb brown{200, 100, 50};
    expect_codes(read("a.obj", textured_square), {brown, brown, brown, brown}, 2);
    GltfSquare square;
    square.image = R"("uri":"j.jpg")";
    expect_codes(read("a.glb", square.glb()), {brown, brown, brown, brown}, 2);
}

// Rows of red, green, blue and white; the square lies beyond the first repetition, in the rows 1.5 to 1.75.
TEST_F(MeshTextures, WrapAsTheSamplerSays) {
    write("r.png", png_of({red, green, blue, white}, 1));
    GltfSquare square;
    square.image = R"("uri":"r.png")";
    square.at = {0.1F, 1.51F, 0.9F, 1.51F, 0.9F, 1.74F, 0.1F, 1.74F};
    const auto colour = [&](const std::string& sampler) {
        square.sampler = sampler;
        const SourceMesh mesh = read("a.glb", square.glb());
        EXPECT_EQ(mesh.colours.size(), 4U);
        return mesh.colours.empty() ? VertexColour{} : mesh.colours[1];
    };
    EXPECT_EQ(colour("{}"), (VertexColour{0, 0, 255, 1})) << "1.5 is 0.5: the third row";
    EXPECT_EQ(colour(R"({"wrapT":33071})"), (VertexColour{255, 255, 255, 1})) << "the last row";
    EXPECT_EQ(colour(R"({"wrapT":33648})"), (VertexColour{0, 255, 0, 1})) << "1.5 to 1.75 is 0.5 to 0.25";
    EXPECT_EQ(colour(R"({"wrapS":33071})"), (VertexColour{0, 0, 255, 1}));
    write("m.mtl", "newmtl a\nmap_Kd -clamp on r.png\n");
    std::string obj = textured_square;
    for (const char* const old : {"vt 0 1", "vt 1 1", "vt 1 0", "vt 0 0"})
        obj.replace(obj.find(old), 6,
                    std::string("vt 0 ") + (std::string(old).ends_with("1") ? "-1.1" : "-1.2"));
    EXPECT_EQ(read("a.obj", obj).colours.at(1), (VertexColour{255, 255, 255, 1})) << "below: the last row";
}

// Half of the light of white is the code 188; of a green of Kd's code 188 it is a quarter's: 137.
TEST_F(MeshTextures, AreTimesTheColourOfTheMaterial) {
    write("w.png", png_of({white}, 1));
    GltfSquare square;
    square.image = R"("uri":"w.png")";
    square.material += R"(,"baseColorFactor":[0.5,1,0,1])";
    const Rgb half_red{188, 255, 0};
    expect_codes(read("a.glb", square.glb()), {half_red, half_red, half_red, half_red}, 1);
    write("m.mtl", "newmtl a\nKd 1 0.7372549 0\nmap_Kd w.png\n");
    const Rgb of_kd{255, 188, 0};
    expect_codes(read("a.obj", textured_square), {of_kd, of_kd, of_kd, of_kd}, 1);
}

// Scaled by half, turned by a quarter, moved: the second corner (1, 0) lies at (0.25, 0.25 + 0.5 - 0.5).
TEST_F(MeshTextures, AreMovedByTheTransformOfTheExtension) {
    write("q.png", png_of({red, green, blue, white}, 2));
    GltfSquare square;
    square.image = R"("uri":"q.png")";
    const auto all = [&](const std::string& transform) {
        square.material =
            R"("baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":)" + transform + "}}";
        return read("a.glb", square.glb());
    };
    expect_codes(all(R"({"scale":[0.5,0.5]})"), {red, red, red, red}, 0);
    expect_codes(all(R"({"scale":[0.5,0.5],"offset":[0.5,0]})"), {green, green, green, green}, 0);
    expect_codes(all(R"({"scale":[0.5,0.5],"offset":[0,0.5]})"), {blue, blue, blue, blue}, 0);
    // By a quarter (u, v) goes to (v, -u): a half of the texture above its top is the lower left quarter.
    expect_codes(all(R"({"scale":[0.5,0.5],"rotation":1.5707963267948966})"), {blue, blue, blue, blue}, 0);
    EXPECT_EQ(
        why("a.glb",
            [&] {
                square.material =
                    R"("baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":{"scale":[1]}}})";
                return square.glb();
            }()),
        "its scale is no list of 2 numbers");
}

// Two triangles meet at a seam: their texture coordinates differ, one side is red, the other blue. What a
// vertex on the seam has is the mean by area, here half each (code 188); in OBJ and in glTF, whose vertices
// lie apart.
TEST_F(MeshTextures, SeamsAreAveragedWithinAMaterial) {
    write("s.png", png_of({red, blue}, 2));
    write("m.mtl", "newmtl a\nmap_Kd s.png\nnewmtl b\nmap_Kd s.png\n");
    const std::string coordinates =
        "vt 0.1 0.5\nvt 0.2 0.5\nvt 0.1 0.6\nvt 0.8 0.5\nvt 0.9 0.5\nvt 0.8 0.6\n";
    const std::string seam = "mtllib m.mtl\n" + square_vertices + coordinates + "usemtl a\nf 1/1 2/2 3/3\n";
    const Rgb both{188, 0, 188};
    expect_codes(read("a.obj", seam + "f 1/4 3/5 4/6\n"), {both, red, both, blue}, 1);
    // Of two materials the vertices lie apart: an edge between them stays sharp.
    const SourceMesh apart = read("b.obj", seam + "usemtl b\nf 1/4 3/5 4/6\n");
    expect_codes(apart, {red, red, red, blue, blue, blue}, 0);
    EXPECT_EQ(apart.triangles, (ScratchVector<SourceTriangle>{{0, 1, 2}, {4, 5, 3}}));
    EXPECT_EQ(apart.vertices.at(4), apart.vertices.at(0));
}

TEST_F(MeshTextures, ColoursOfObjMaterialsWithoutATexture) {
    write("m.mtl", "newmtl roof\nKd 1 0 0\nnewmtl wall\nKd 0 0 1 # blue\n");
    const SourceMesh mesh =
        read("a.obj", "mtllib m.mtl\n" + square_vertices +
                          "usemtl roof\nf 1 2 3\nusemtl wall\nf 1 3 4\nusemtl other\nf 2 3 4\n");
    ASSERT_EQ(mesh.colours.size(), 9U) << "the corners that two materials share are there for each";
    EXPECT_EQ(mesh.colours[0], (VertexColour{255, 0, 0, 1}));
    EXPECT_EQ(mesh.colours[mesh.triangles[1][0]], (VertexColour{0, 0, 255, 1}));
    EXPECT_EQ(mesh.colours[mesh.triangles[2][0]], VertexColour{}) << "a material that is not there";
    // A vertex's own colour is nearer than its material's.
    const SourceMesh own =
        read("b.obj", "mtllib m.mtl\nv 0 0 0 0 1 0\nv 1 0 0 0 1 0\nv 0 1 0 0 1 0\nusemtl roof\nf 1 2 3\n");
    expect_codes(own, {green, green, green}, 0);
}

// What is not there is told, and the mesh is drawn in its material's colour, or its grey.
TEST_F(MeshTextures, WhatIsMissingIsToldAndPassedOver) {
    write("m.mtl", "newmtl a\nKd 1 0 0\nmap_Kd none.png\n");
    SourceMesh mesh = read("a.obj", textured_square);
    expect_codes(mesh, {red, red, red, red}, 0);
    EXPECT_EQ(mesh.notes,
              std::vector<std::string>{
                  "its texture none.png cannot be opened: No such file or directory: drawn without it"});
    mesh = read("b.obj", "mtllib gone.mtl\n" + textured_square.substr(13));
    EXPECT_TRUE(mesh.colours.empty());
    EXPECT_EQ(mesh.notes, std::vector<std::string>{"its materials in gone.mtl are not read, which cannot be "
                                                   "opened: No such file or directory"});
    GltfSquare square;
    square.image = R"("uri":"none.png")";
    mesh = read("a.glb", square.glb());
    EXPECT_TRUE(mesh.colours.empty());
    ASSERT_EQ(mesh.notes.size(), 1U);
    square.material += R"(,"baseColorFactor":[1,0,0,1])";
    expect_codes(read("a.glb", square.glb()), {red, red, red, red}, 0);
    write("t.png", "II*\0 is no PNG");
    square.image = R"("uri":"t.png")";
    EXPECT_EQ(read("a.glb", square.glb()).notes.at(0),
              "its texture t.png is neither PNG nor JPEG: drawn without it");
    square.image = R"("uri":"none.png")", square.coordinates = R"("NORMAL":0)";
    EXPECT_EQ(read("a.glb", square.glb()).notes.size(), 1U);
    write("m.mtl", "newmtl a\nmap_Kd c.png\n");
    write("c.png", checker());
    mesh = read("c.obj", "mtllib m.mtl\n" + square_vertices + "usemtl a\nf 1 2 3\n");
    EXPECT_TRUE(mesh.colours.empty());
    EXPECT_EQ(mesh.notes, std::vector<std::string>{"its texture c.png has triangles without texture "
                                                   "coordinates: drawn without it"});
}

// A file outside the mesh's folder is not opened, though it is there.
TEST_F(MeshTextures, OnlyFilesBesideTheMeshAreOpened) {
    const std::string outside = write("outside.png", checker());
    write("in/m.mtl", "newmtl a\nmap_Kd ../outside.png\n");
    EXPECT_EQ(
        read("in/a.obj", textured_square).notes,
        std::vector<std::string>{"its texture ../outside.png is not read, as only files beside the mesh "
                                 "are: drawn without it"});
    GltfSquare square;
    for (const std::string& uri : {std::string("../outside.png"), outside, std::string("%2e%2e/outside.png"),
                                   "file://" + outside, std::string("https://example.org/a.png")}) {
        square.image = R"("uri":")" + uri + R"(")";
        const SourceMesh mesh = read("in/a.glb", square.glb());
        EXPECT_TRUE(mesh.colours.empty()) << uri;
        ASSERT_EQ(mesh.notes.size(), 1U) << uri;
        EXPECT_NE(mesh.notes[0].find("only files beside the mesh"), std::string::npos) << mesh.notes[0];
    }
    write("in/m.mtl", "newmtl a\nmap_Kd C:\\pictures\\a.png\n");
    EXPECT_EQ(read("in/a.obj", textured_square).notes.size(), 1U);
    write("in/t/m.mtl", "newmtl a\nmap_Kd -s 1 1 1 p\\c d.png\n");
    write("in/t/p/c d.png", checker());
    expect_codes(read("in/a.obj", "mtllib t/m.mtl\n" + textured_square.substr(13)), checker_codes, 2);
}

TEST_F(MeshTextures, DamageIsRefusedInOneLine) {
    write("m.mtl", "newmtl a\nmap_Kd c.png\n");
    write("c.png", checker().substr(0, checker().size() - 20));
    EXPECT_EQ(why("a.obj", textured_square).substr(0, 24), "its texture c.png: PNG: ");
    std::string huge = checker();
    huge[16] = 0, huge[17] = 1, huge[20] = 0, huge[21] = 1;  // 65,538 x 65,538
    write("c.png", huge);
    EXPECT_NE(why("a.obj", textured_square), "") << "its checksum is wrong, too";
    write("c.png", checker());
    write("m.mtl", "newmtl a\nKd 1 x 1\nmap_Kd c.png\n");
    EXPECT_EQ(why("a.obj", textured_square), "its materials in m.mtl: line 2: x is no number of a colour");
    write("m.mtl", "newmtl a\nmap_Kd c.png\n");
    std::string bad = textured_square;
    bad.replace(bad.find("vt 1 1"), 6, "vt nan 1");
    EXPECT_EQ(why("a.obj", bad), "line 7: nan is no number of a texture");
    bad = textured_square;
    bad.replace(bad.find("2/2"), 3, "2/9");
    EXPECT_EQ(why("a.obj", bad), "line 11: the texture coordinate 9 is none of the 4 before it");
    GltfSquare square;
    square.image = R"("uri":"c.png")";
    square.at[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(why("a.glb", square.glb()),
              "vertex 1 of a primitive has a TEXCOORD_0 that is no finite number");
    square.at[3] = 0.0F, square.material = R"("baseColorTexture":{"index":7})";
    EXPECT_EQ(why("a.glb", square.glb()), "a material has a texture that is not there");
    square.material = R"("baseColorTexture":{"index":0})", square.image = R"("bufferView":9)";
    EXPECT_EQ(why("a.glb", square.glb()), "image 0 has a buffer view that is not there");
    square.image = R"("uri":"c.png")", square.sampler = R"({"wrapS":1})";
    EXPECT_EQ(why("a.glb", square.glb()), "sampler 0 has a way to wrap that is none");
    square.sampler = "{}", square.coordinates = R"("TEXCOORD_0":0)";
    EXPECT_EQ(why("a.glb", square.glb()), "accessor 0 is no list of VEC2 in a buffer view");
    square.coordinates = R"("TEXCOORD_0":1)", square.image = R"("uri":"data:image/png;base64,*")";
    EXPECT_EQ(why("a.glb", square.glb()), "image 0 has a data uri whose base64 is damaged");
}

// Coordinates that are far away, or all one, still give a colour of the texture.
TEST_F(MeshTextures, WildCoordinatesEndInAColour) {
    write("c.png", checker());
    GltfSquare square;
    square.image = R"("uri":"c.png")";
    for (const float far : {3.0e38F, -3.0e38F, 1.0e7F, 0.0F}) {
        square.at.fill(far), square.at[2] = -far;
        for (const std::string sampler : {"{}", R"({"wrapS":33071,"wrapT":33648})"}) {
            square.sampler = sampler;
            EXPECT_EQ(read("a.glb", square.glb()).colours.size(), 4U);
        }
    }
}

// Files by grammar: each ends in a mesh with colours for all vertices or for none, or in one line.
TEST_F(MeshTextures, EachByGrammarEndsInAMeshOrOneLine) {
    const unsigned seed = 5261;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    const auto below = [&](std::size_t end) { return random() % end; };
    const auto one_of = [&](const std::vector<std::string>& all) { return all[below(all.size())]; };
    write("c.png", checker());
    write("cut.png", checker().substr(0, 60));
    int read_whole = 0;
    const auto check = [&](const std::string& path, const std::string& text) {
        const auto mesh = read_mesh(path);
        if (!mesh.ok()) {
            ASSERT_FALSE(mesh.error().what.empty()) << text;
            ASSERT_EQ(mesh.error().line().find('\n'), std::string::npos) << text;
            return;
        }
        ++read_whole;
        ASSERT_TRUE(mesh->colours.empty() || mesh->colours.size() == mesh->vertices.size()) << text;
        for (const SourceTriangle& triangle : mesh->triangles)
            for (const std::uint32_t corner : triangle) ASSERT_LT(corner, mesh->vertices.size()) << text;
    };
    const std::vector<std::string> names{"c.png",    "c.png",    "c.png", "cut.png",
                                         "none.png", "../c.png", "m.mtl"};
    for (int round = 0; round < 300; ++round) {
        std::string mtl;
        for (std::size_t i = 1 + below(3); i > 0; --i)
            mtl += "newmtl " + one_of({"a", "b", ""}) + "\n" +
                   one_of({"Kd 1 0 0", "Kd 0.5", "Kd spectral x 1", "d 1", "illum 2",
                           below(9) == 0 ? "Kd" : "Ns 1"}) +
                   "\nmap_Kd " +
                   one_of({"", "", "-s 1 1 ", "-o 0.5 -clamp on ", "-bm 2 -mm 0 1 ", "-s 1e300 "}) +
                   (below(20) == 0 ? "" : one_of(names)) + one_of({"\n", "\r\n", " \n"});
        write("m.mtl", mtl);
        std::string obj = one_of({"mtllib m.mtl\n", "mtllib m.mtl m.mtl\n", "mtllib\n"}) + square_vertices;
        for (std::size_t i = below(6); i > 0; --i)
            obj += "vt " + one_of({"0", "1", "0.3", "-7", "1e30", below(9) == 0 ? "nan" : "2"}) + " " +
                   one_of({"0", "1", ""}) + "\n";
        for (std::size_t i = 1 + below(4); i > 0; --i)
            obj += one_of({"usemtl a\n", "usemtl b\n", "usemtl\n", ""}) + "f 1/" +
                   one_of({"1", "2", "-1", ""}) + " 2/1 3/" + one_of({"1", "1/1", ""}) +
                   one_of({"", " 4/2", " 4"}) + "\n";
        check(write("x.obj", obj), obj + mtl);
    }
    EXPECT_GT(read_whole, 60);
    EXPECT_LT(read_whole, 290);
    GltfSquare square;
    square.image = R"("bufferView":3)", square.appended = checker();
    const std::string sound = square.glb();
    for (int round = 0; round < 600; ++round) {
        std::string bytes = sound;
        if (round % 4 == 0)
            bytes.resize(below(bytes.size()));
        else
            for (std::size_t i = 1 + below(3); i > 0; --i)
                bytes[below(bytes.size())] = static_cast<char>(below(256));
        check(write("x.glb", bytes), std::to_string(round));
    }
}

}  // namespace
}  // namespace oro
