// What the triangles of a mesh are coloured as, where ground is coloured by materials.
#pragma once

#include <cstdint>
#include <string>

#include "geo/meshes/source_mesh.h"

namespace oro {

// gpu::mesh_look_... of a mesh: a CityJSON town, footprints, and polygons of a GeoPackage are built; LandXML
// and a GeoPackage of nothing but TINs are ground; OBJ, PLY, STL and glTF, which do not say what they are of,
// are plain. asked: "ground", "built" or "plain" in their place; "": none.
std::uint32_t look_of_mesh(const SourceMesh& mesh, const std::string& asked);

// Whether a word is one that may be asked for: "ground", "built" or "plain".
bool is_mesh_look(const std::string& asked);

// The same of a feature of a built mesh, by its type in CityJSON: roads are paved, water is water, land and
// plants are ground, and all else is built.
std::uint32_t look_of_type(const std::string& type);

// A number of 0 to 1 for a feature, by the XXH64 of its name: the same in each file that has it.
float tone_of(const std::string& name);

}  // namespace oro
