// Points of a laser scan as a mesh.
#pragma once

#include <string>

#include "core/base/result.h"
#include "geo/meshes/source_mesh.h"

namespace oro {

// Delaunay's triangles in plan between the points of a LAS file (1.0 to 1.4, not packed); of points over each
// other the first. Coordinates are the file's. Errors: the file cannot be read, is no LAS file, or is cut
// off.
Result<SourceMesh> triangles_of_las(const std::string& path);

}  // namespace oro
