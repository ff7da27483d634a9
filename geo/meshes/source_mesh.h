// A mesh of triangles as a file has it: in double, in the file's own CRS and units.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/scratch_vector.h"
#include "core/seam/vertex_colour.h"

namespace oro {

// A named part of a mesh: the triangles from `first_triangle` to the next part's first.
struct MeshPart {
    std::string name;  // "" where the file gives none
    std::size_t first_triangle{};
};

// A thing that a file tells apart, a building say: the triangles from `first_triangle` to the next feature's
// first.
struct MeshFeature {
    std::string name;     // its identifier, or what a field `name` says
    std::string type;     // "BuildingPart"; "" where there is none
    std::string part_of;  // the building that it is part of; "" for none
    std::vector<std::pair<std::string, std::string>>
        attributes;  // as written; then those of what it is part of
    std::size_t first_triangle{};
};

using SourceTriangle = std::array<std::uint32_t, 3>;  // numbers of vertices, from 0

// What a mesh is of, as far as its format tells.
enum class MeshKind {
    unknown,     // triangles of whatever there is
    survey,      // ground
    built,       // buildings, without types of their features
    city_model,  // features with types: buildings, roads, water
};

// A texture whose colours vertices have.
struct MeshTexture {
    std::string name;
    int width_px{};
    int height_px{};
};

// Earth-centred coordinates of WGS84, metres: the CRS of 3D Tiles.
inline constexpr const char* ecef_crs = "EPSG:4978";

// What a file of triangles holds. Each triangle's vertices are there, and are finite.
struct SourceMesh {
    std::string path;
    std::string format;  // "OBJ", "PLY", "STL", "glTF", "LandXML", "GeoPackage", "GeoPackage TIN" (nothing
                         // else is in it), "CityJSON", "3D Tiles", "footprints"
    MeshKind kind{MeshKind::unknown};
    ScratchVector<glm::dvec3> vertices;   // east (x), north (y), height, in the file's units
    ScratchVector<VertexColour> colours;  // of each vertex; empty: the file states none
    std::vector<MeshTexture> textures;    // that some of these colours are means of
    double texels{};                      // that triangles cover of them
    std::size_t textured_vertices{};      // that have such a colour
    ScratchVector<SourceTriangle> triangles;
    std::vector<MeshPart> parts;
    std::vector<MeshFeature> features;  // none, or every triangle belongs to one
    std::string unit;                   // as the file names it: "foot"; "" where it names none
    double metres_per_unit{1.0};        // of `unit`; 1 where there is none
    std::string crs;                  // that the file states, as "EPSG:2056" or WKT; "" where it states none
    std::size_t not_finite{};         // triangles left out: a vertex is NaN or infinite
    std::vector<std::string> notes;   // what a user must know of what was left out, one line each
    std::size_t invisible{};          // triangles left out: the file says that they are not to be seen
    std::size_t polygons_cut{};       // polygons of more than three corners, cut into triangles
    std::size_t polygons_crossing{};  // ... of which no cut is sound: they cross themselves, or have no area

    // Before it has anything: where its arrays will lie. Null: in ordinary memory.
    void lie_in(const std::shared_ptr<ScratchMemory>& scratch) {
        vertices = ScratchVector<glm::dvec3>(scratch), triangles = ScratchVector<SourceTriangle>(scratch);
        colours = ScratchVector<VertexColour>(scratch);
    }
};

}  // namespace oro
