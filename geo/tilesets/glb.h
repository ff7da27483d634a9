// Meshes as binary glTF 2.0, as viewers of 3D Tiles read them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "geo/tilesets/ground_mesh.h"

namespace oro {

// One of the sources that the ground comes from, as metadata tell it.
struct GroundSource {
    std::string name;         // of its file
    std::string attribution;  // "" when unknown
    std::string heights;      // what it says that its heights refer to
    double spacing_m{};       // from post to post
    // What nine heights in ten are off, at most, as its makers state it; negative when unknown.
    double vertical_le90_m{-1.0};
};

// A thing of a mesh on the ground, a building say, as metadata tell it.
struct GlbFeature {
    std::string name, type, part_of;  // "" where there is none
    std::string file;                 // name of the file that it comes from
    std::vector<std::pair<std::string, std::string>> attributes;
};

// What is known of the vertices of a mesh, one by one; each may be empty. Not both sources and features.
struct VertexFacts {
    std::vector<std::array<double, 3>> colours;  // linear light, 0 .. 1
    std::vector<std::uint8_t> sources;           // numbers among those of GlbLook
    std::vector<std::uint16_t> features;         // ... likewise
};

struct GlbLook {
    std::array<double, 3> colour{};  // of the ground where vertices have none, linear light, 0 .. 1
    std::vector<GroundSource> sources;
    std::string attribution;  // what viewers show as asset.copyright; "" for none
    std::string generator;
    std::vector<GlbFeature> features{};  // of a mesh on the ground, of which nothing is ground
    bool two_sided{};                    // triangles are seen from behind, too
};

// A colour (linear light; what is not 0 to 1 is taken as the nearer end) as a vertex has it in a file: bytes
// that stand for 0 to 1, the fourth unused, as vertices begin at multiples of four.
std::array<std::uint8_t, 4> colour_bytes(const std::array<double, 3>& light);
// The bytes of a .glb of a mesh that has a triangle: one node, which takes whole steps along the mesh's axes
// to their place, in double; one mesh, one buffer that is compressed (EXT_meshopt_compression; a viewer that
// does not know it cannot read the file). y is up in glTF, so ECEF's (x, y, z) is (x, z, -y); viewers of 3D
// Tiles turn it back. Positions are the mesh's own whole numbers, as shorts where they fit
// (KHR_mesh_quantization), else as float32. Normals, if there are any, have 8 bits, and are 1/100 off at
// most. Triangles come in another order. mesh.extras.groundTriangles: how many of them, the first ones, are
// ground; the others are walls. Source: Khronos, glTF 2.0 specification; OGC 22-025r4, 3D Tiles 1.1.
std::vector<std::uint8_t> glb_bytes(const GroundMesh& mesh, const VertexFacts& facts, const GlbLook& look);
// The bytes of a .glb around a text of JSON and its one buffer.
std::vector<std::uint8_t> glb_around(const std::string& json, std::vector<std::uint8_t> buffer);

}  // namespace oro
