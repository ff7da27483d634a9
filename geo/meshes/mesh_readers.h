// One reader a format, over the bytes of a whole file. Each gives a mesh without its path, or an Error
// without its place: the reason, with the line or the byte. Vertices that are not finite stay; read_mesh()
// drops their triangles. scratch: where a mesh's arrays lie where they are large; null: in memory.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "geo/meshes/source_mesh.h"

namespace oro {

// Adds a polygon of a mesh, three corners or more, and counts it. Its vertices are there. A reason where it
// has too many corners.
const char* add_polygon(const std::vector<std::uint32_t>& corners, SourceMesh& mesh);

using ScratchOfMesh = std::shared_ptr<ScratchMemory>;
Result<SourceMesh> read_ply(std::string_view bytes, const ScratchOfMesh& scratch = nullptr);
Result<SourceMesh> read_stl(std::string_view bytes);
Result<SourceMesh> read_landxml(std::string_view bytes);
// CityJSON 1.0 to 2.0: solids, multi and composite surfaces and templates, each object a feature. lod: "", or
// the level of detail that is read; then objects without it are left out.
Result<SourceMesh> read_cityjson(std::string_view bytes, const std::string& lod);
// Reads a file beside the mesh's by its name.
using FileBeside = std::function<Result<std::string>(const std::string& name)>;
// OBJ, with the colours of its materials (Kd, map_Kd); a vertex that several of them use is one for each.
// beside: asked for files of materials and textures, by their path from the mesh's folder.
Result<SourceMesh> read_obj(std::string_view bytes, const FileBeside& beside,
                            const ScratchOfMesh& scratch = nullptr);
// glTF 2.0 as text or GLB, without extensions that say how triangles are to be found but
// KHR_mesh_quantization, EXT_meshopt_compression and CESIUM_RTC: the scene that is shown, its nodes'
// transforms in double. y is up: east is x, north is -z. Colours are those of COLOR_0, times the colour of
// the material where that has no texture. A model that says where it is (asset.extras.origin, as exports of
// this program do) is in ECEF. beside: asked for buffers
// and textures of other files.
Result<SourceMesh> read_gltf(std::string_view bytes, const FileBeside& beside);
// Whether a JSON text is that of 3D Tiles, by its first 64 KiB.
bool is_tileset(std::string_view bytes);
// The finest tiles of 3D Tiles 1.0 and 1.1: of tiles that others replace the last, of those that others are
// added to all. Explicit tiles alone, of glTF, GLB and b3dm, and of further tilesets; in ECEF. beside: asked
// for files by their path from the tileset's folder. Errors name the tile and its file.
Result<SourceMesh> read_tileset(std::string_view bytes, const FileBeside& beside);
// By OGR, which wants the file itself: TIN, PolyhedralSurface, MultiPolygon and Polygon with heights, of all
// layers, which lie in one CRS. limit_s: seconds that it may take.
Result<SourceMesh> read_geopackage_mesh(const std::string& path, double limit_s);

}  // namespace oro
