// Whether a mesh has something in a box of degrees.
#pragma once

#include "geo/meshes/placed_mesh.h"
#include "geo/places/bounding_box.h"

namespace oro {

// Whether the box around one of a mesh's triangles meets a box. Both may cross the antimeridian.
bool reaches_into(const PlacedMesh& mesh, const BoundingBox& box);

}  // namespace oro
