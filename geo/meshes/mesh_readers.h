// One reader a format, over the bytes of a whole file. Each gives a mesh without its path, or an Error
// without its place: the reason, with the line or the byte. Vertices that are not finite stay; read_mesh()
// drops their triangles.
#pragma once

#include <string_view>

#include "core/base/result.h"
#include "geo/meshes/source_mesh.h"

namespace oro {

Result<SourceMesh> read_obj(std::string_view bytes);
Result<SourceMesh> read_ply(std::string_view bytes);
Result<SourceMesh> read_stl(std::string_view bytes);
Result<SourceMesh> read_landxml(std::string_view bytes);

}  // namespace oro
