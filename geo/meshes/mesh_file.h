// Files of triangle meshes: OBJ, PLY, STL, glTF, 3D Tiles, LandXML, CityJSON and GeoPackage.
#pragma once

#include <memory>
#include <string>

#include "core/base/result.h"
#include "geo/meshes/source_mesh.h"

namespace oro {

// The largest file that is read: 1 GiB.
inline constexpr std::size_t most_mesh_bytes = std::size_t{1} << 30U;
// ... of a PLY in scratch files: 16 GiB.
inline constexpr std::size_t most_scratch_mesh_bytes = std::size_t{16} << 30U;

// Whether a name ends as those of meshes do: .obj, .ply, .stl, .gltf, .glb, .xml, .landxml, .city.json,
// .cityjson, in any letter case.
bool is_mesh_name(const std::string& path);

// Whether a file is to be read as a mesh: by its name, and where that is .xml or .json, which much else has,
// by its first 64 KiB: the first element is LandXML, or a member CityObjects or a text CityJSON is there, or
// it is a tileset.
// False of a file that cannot be read.
bool is_mesh_file(const std::string& path);

// Reads a mesh; its name says the format: those of is_mesh_name(), .json of CityJSON and 3D Tiles, and .gpkg
// of a GeoPackage, which is no mesh by its name alone. lod: of CityJSON, the level of detail that is read;
// "": the highest that each object has. Numbers are kept in double (those of STL, and float ones of PLY, are
// float in the file). Memory is taken after what a header promises was held against the file's length.
// Errors: the file cannot be read, is larger than 1 GiB, is cut off or damaged (with the line or the byte),
// has an index beyond its vertices, has no triangle, or none whose vertices are finite. From any thread.
// scratch: the file's bytes lie there where they are large, and so do the arrays of what comes out; of PLY
// and OBJ from the beginning. Null: in memory. std::bad_alloc: its error() says why there is no room.
Result<SourceMesh> read_mesh(const std::string& path, const std::string& lod = {},
                             const std::shared_ptr<ScratchMemory>& scratch = nullptr);

}  // namespace oro
