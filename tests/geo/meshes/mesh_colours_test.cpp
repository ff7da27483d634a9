// Colours that files of meshes state: how they are read, and which triangles are drawn in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/seam/cleared_map.h"  // gpu::mesh_look_...
#include "core/seam/seam.h"
#include "geo/meshes/mesh_file.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/together/mesh_surface.h"

namespace oro {
namespace {

std::string coloured_file(const std::string& name, const std::string& bytes) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "mesh_colours";
    std::filesystem::create_directories(folder);
    const std::string path = (folder / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

// Three vertices and a face between them; colours: of each vertex, behind its place.
std::string coloured_ply(const std::string& properties, const std::array<std::string, 3>& colours) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
        "property double z\n" +
        properties + "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    const std::array<std::string, 3> places{"2600000 1200000 500 ", "2600100 1200000 500 ",
                                            "2600000 1200100 501 "};
    for (std::size_t i = 0; i < 3; ++i) text += places[i] + colours[i] + "\n";
    return text + "3 0 1 2\n";
}
std::string three_of(const std::string& type, const std::string& prefix = "") {
    std::string text;
    for (const char* const part : {"red", "green", "blue"})
        text += "property " + type + " " + prefix + part + "\n";
    return text;
}

ScratchVector<VertexColour> colours_in(const std::string& name, const std::string& bytes) {
    const auto read = read_mesh(coloured_file(name, bytes));
    EXPECT_TRUE(read.ok()) << read.error().line();
    return read.ok() ? read->colours : ScratchVector<VertexColour>();
}

const ScratchVector<VertexColour> red_green_grey{{255, 0, 0, 1}, {0, 255, 0, 1}, {128, 128, 128, 1}};

// The largest number of a whole type is full light, and so is 1 of a real one. 128/255 = 32896/65535.
TEST(FileColours, OfPlyAreReadInEachType) {
    EXPECT_EQ(colours_in("u8.ply", coloured_ply(three_of("uchar"), {"255 0 0", "0 255 0", "128 128 128"})),
              red_green_grey);
    EXPECT_EQ(colours_in("u16.ply",
                         coloured_ply(three_of("ushort"), {"65535 0 0", "0 65535 0", "32896 32896 32896"})),
              red_green_grey);
    EXPECT_EQ(colours_in("f.ply", coloured_ply(three_of("float"), {"1 0 0", "-1 7 0", "0.502 0.502 0.502"})),
              red_green_grey);
    EXPECT_EQ(colours_in("d.ply",
                         coloured_ply(three_of("uchar", "diffuse_"), {"255 0 0", "0 255 0", "128 128 128"})),
              red_green_grey);
    const std::string alpha = three_of("uchar") + "property uchar alpha\n";
    EXPECT_EQ(colours_in("a.ply", coloured_ply(alpha, {"255 0 0 9", "0 255 0 9", "128 128 128 9"})),
              red_green_grey);
    EXPECT_TRUE(colours_in("two.ply", coloured_ply("property uchar red\nproperty uchar green\n",
                                                   {"255 0", "0 255", "1 2"}))
                    .empty())
        << "without blue there is no colour";
    EXPECT_TRUE(colours_in("none.ply", coloured_ply("", {"", "", ""})).empty());
}

// They are cut to what their type may hold, and that is reported.
TEST(FileColours, OfPlyBeyondTheirTypeAreCounted) {
    const auto lying = read_mesh(
        coloured_file("lying.ply", coloured_ply(three_of("uchar"), {"300 0 0", "0 255 0", "nan -5 128"})));
    ASSERT_TRUE(lying.ok()) << lying.error().line();
    EXPECT_EQ(lying->colours, (ScratchVector<VertexColour>{{255, 0, 0, 1}, {0, 255, 0, 1}, {0, 0, 128, 1}}));
    EXPECT_EQ(lying->notes,
              (std::vector<std::string>{"colours of 2 of its 3 vertices are beyond what their type "
                                        "may hold, and are cut"}));
    const auto sound = read_mesh(
        coloured_file("sound.ply", coloured_ply(three_of("uchar"), {"255 0 0", "0 255 0", "1 2 3"})));
    ASSERT_TRUE(sound.ok()) << sound.error().line();
    EXPECT_TRUE(sound->notes.empty());
}

TEST(FileColours, OfBinaryPlyAreReadInBothByteOrders) {
    for (const bool is_big : {false, true}) {
        std::string bytes = std::string("ply\nformat binary_") + (is_big ? "big" : "little") +
                            "_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                            "property float z\n" +
                            three_of("ushort") +
                            "element face 1\nproperty list uchar uchar vertex_index\nend_header\n";
        const auto put = [&](auto value) {
            char raw[sizeof value];
            std::memcpy(raw, &value, sizeof value);
            if (is_big) std::reverse(raw, raw + sizeof value);
            bytes.append(raw, sizeof value);
        };
        const std::array<std::array<std::uint16_t, 3>, 3> codes{
            {{65535, 0, 0}, {0, 65535, 0}, {32896, 32896, 32896}}};
        for (std::size_t i = 0; i < 3; ++i) {
            for (const float place : {i == 1 ? 1.0F : 0.0F, i == 2 ? 1.0F : 0.0F, 0.0F}) put(place);
            for (const std::uint16_t code : codes[i]) put(code);
        }
        bytes += std::string("\x03\x00\x01\x02", 4);
        EXPECT_EQ(colours_in("b.ply", bytes), red_green_grey);
    }
}

// From 0 to 1, or to 255 where a number of the file is larger than 1.
TEST(FileColours, OfObjAreReadInBothRanges) {
    const std::string face = "f 1 2 3\n";
    EXPECT_EQ(
        colours_in("one.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0 # green\nv 0 1 0 0.502 0.502 0.502 0.5\n" + face),
        red_green_grey);
    EXPECT_EQ(colours_in("codes.obj", "v 0 0 0 255 0 0\nv 1 0 0 0 255 0\nv 0 1 0 128 128 128\n" + face),
              red_green_grey);
    const ScratchVector<VertexColour> one_without{{255, 0, 0, 1}, {}, {0, 0, 255, 1}};
    EXPECT_EQ(colours_in("some.obj", "v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 0 0 1\n" + face), one_without);
    EXPECT_TRUE(colours_in("weights.obj", "v 0 0 0 1.0\nv 1 0 0 0.5\nv 0 1 0 1\n" + face).empty());
    const auto bad = read_mesh(coloured_file("bad.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 x 0\nv 0 1 0\n" + face));
    ASSERT_FALSE(bad.ok());
    EXPECT_EQ(bad.error().what, "line 2: x is no number of a colour");
    const auto infinite = read_mesh(coloured_file("inf.obj", "v 0 0 0 inf 0 0\nv 1 0 0\nv 0 1 0\n" + face));
    ASSERT_FALSE(infinite.ok());
    EXPECT_EQ(infinite.error().what, "line 1: inf is no number of a colour");
}

PlacedMesh placed_in_colours(const std::string& obj, const std::string& look = "") {
    MeshRequest request;
    request.files = {coloured_file("placed.obj", obj)}, request.crs = "EPSG:2056", request.look = look;
    const auto meshes = open_meshes(request, false, {});
    EXPECT_TRUE(meshes.ok()) << meshes.error().line();
    return meshes.ok() ? meshes->get()->front() : PlacedMesh();
}

// Two triangles of 100 m, the second of which has a corner without a colour.
const std::string two_triangles =
    "v 2600000 1200000 500 1 0 0\nv 2600100 1200000 500 0 1 0\n"
    "v 2600000 1200100 501 0 0 1\nv 2600100 1200100 500\nf 1 2 3\nf 2 4 3\n";

TEST(FileColours, AreThoseOfTrianglesWithAllThree) {
    const PlacedMesh mesh = placed_in_colours(two_triangles);
    Seam seam;
    add_mesh(mesh, {}, 1.0, seam);
    ASSERT_EQ(seam.pieces.size(), 2U);
    EXPECT_EQ(seam.pieces[0].look, gpu::mesh_look_coloured);
    EXPECT_EQ(seam.pieces[0].colours,
              (std::array<VertexColour, 3>{{{255, 0, 0, 1}, {0, 255, 0, 1}, {0, 0, 255, 1}}}));
    EXPECT_EQ(seam.pieces[1].look, gpu::mesh_look_plain);
    EXPECT_EQ(seam.pieces[1].colours, (std::array<VertexColour, 3>{}));
}

// What a mesh is of may be said besides; plaster, or grey, may be asked for in the place of colours.
TEST(FileColours, StayWithTheLookOfGroundAlone) {
    const PlacedMesh ground = placed_in_colours(two_triangles, "ground");
    EXPECT_EQ(ground.look, gpu::mesh_look_ground);
    EXPECT_TRUE(is_coloured(ground, 0));
    EXPECT_FALSE(is_coloured(ground, 1));
    for (const std::string look : {"built", "plain"}) {
        const PlacedMesh mesh = placed_in_colours(two_triangles, look);
        EXPECT_TRUE(mesh.colours.empty()) << look;
        EXPECT_EQ(mesh.look, look == "built" ? gpu::mesh_look_built : gpu::mesh_look_plain);
    }
}

// Sides of 300 m are cut in the middle, where the light is the mean: of black and white 0.5, whose code of
// sRGB is 188 (IEC 61966-2-1: 1.055 * 0.5^(1/2.4) - 0.055 = 0.7354).
TEST(FileColours, AreMeansOfLightWhereSidesAreCut) {
    const PlacedMesh mesh = placed_in_colours(
        "v 2600000 1200000 500 0 0 0\nv 2600300 1200000 500 1 1 1\n"
        "v 2600000 1200100 500 0 0 0\nf 1 2 3\n");
    ASSERT_GT(mesh.vertices.size(), 3U);
    ASSERT_EQ(mesh.colours.size(), mesh.vertices.size());
    EXPECT_EQ(mesh.colours[3], (VertexColour{188, 188, 188, 1}));
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) EXPECT_TRUE(is_coloured(mesh, i));
}

// The same triangles without colours are the same mesh as before, by the same fingerprint; other colours are
// another mesh.
TEST(FileColours, CountInTheFingerprintWhereThereAreSome) {
    const std::string bare = "v 2600000 1200000 500\nv 2600100 1200000 500\nv 2600000 1200100 501\nf 1 2 3\n",
                      red =
                          "v 2600000 1200000 500 1 0 0\nv 2600100 1200000 500 1 0 0\n"
                          "v 2600000 1200100 501 1 0 0\nf 1 2 3\n",
                      blue =
                          "v 2600000 1200000 500 0 0 1\nv 2600100 1200000 500 0 0 1\n"
                          "v 2600000 1200100 501 0 0 1\nf 1 2 3\n";
    EXPECT_TRUE(placed_in_colours(bare).colours.empty());
    EXPECT_NE(placed_in_colours(bare).fingerprint, placed_in_colours(red).fingerprint);
    EXPECT_NE(placed_in_colours(blue).fingerprint, placed_in_colours(red).fingerprint);
}

// A roof of two squares of 10 m that fall by an angle each, and so meet at twice that.
PlacedMesh roof_of(double fall_deg, double crease_deg) {
    const double fall_m = 10.0 * std::tan(fall_deg * 3.14159265358979 / 180.0);
    const std::string low = std::to_string(500.0 - fall_m);
    PlacedMesh mesh =
        placed_in_colours("v 2600000 1200000 " + low + "\nv 2600010 1200000 500\n" +
                          "v 2600010 1200010 500\nv 2600000 1200010 " + low + "\nv 2600020 1200000 " + low +
                          "\nv 2600020 1200010 " + low + "\nf 1 2 3 4\nf 2 5 6 3\n");
    mesh.crease_deg = crease_deg;
    return mesh;
}
// The angle between the normals that a vertex of the ridge has on its two sides, degrees.
double angle_at_ridge_deg(const PlacedMesh& mesh) {
    Seam seam;
    add_mesh(mesh, {}, 1.0, seam);
    double most = 0.0;
    for (const SeamPiece& one : seam.pieces)
        for (const SeamPiece& other : seam.pieces)
            for (const SeamCorner& a : one.corners)
                for (const SeamCorner& b : other.corners)
                    if (a.at.m == b.at.m)
                        most = std::max(most, std::acos(std::min(1.0, glm::dot(a.normal, b.normal))));
    return most * 180.0 / 3.14159265358979;
}

// 20 degrees are smooth by default, 40 are a crease; and as another angle says.
TEST(MeshCrease, TrianglesShareLightBelowTheAngle) {
    EXPECT_EQ(placed_in_colours(two_triangles).crease_deg, 30.0);
    EXPECT_NEAR(angle_at_ridge_deg(roof_of(10.0, 30.0)), 0.0, 1.0e-4);
    EXPECT_NEAR(angle_at_ridge_deg(roof_of(20.0, 30.0)), 40.0, 0.01);
    EXPECT_NEAR(angle_at_ridge_deg(roof_of(20.0, 45.0)), 0.0, 1.0e-4);
    EXPECT_NEAR(angle_at_ridge_deg(roof_of(10.0, 15.0)), 20.0, 0.01);
    EXPECT_NEAR(angle_at_ridge_deg(roof_of(10.0, 0.0)), 20.0, 0.01) << "all are flat";
    EXPECT_NEAR(angle_at_ridge_deg(roof_of(40.0, 180.0)), 0.0, 1.0e-4) << "all are smooth";
}

}  // namespace
}  // namespace oro
