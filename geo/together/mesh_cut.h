// Terrain cut out under a mesh: a pit, a quarry, a road in a cutting.
#pragma once

#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "geo/meshes/placed_mesh.h"

namespace oro {

// Cuts the terrain of a grid out inside a mesh's outline from above, and closes the rim: posts under the mesh
// become void; the mesh gets the parts of cut triangles that lie beside it as triangles of its own, with the
// terrain's heights, and rim_walls from there to the mesh's edge. The outline is made of the sides that an
// odd number of triangles have. Cells that are cut are split from their north-west post to their south-east
// one, whatever diagonal the terrain has there; the added triangles are straight in space, within s^2 / 8R of
// those halves for posts s apart (0.02 mm at 30 m). field: with its posts in memory. Errors (usage): posts
// that are not in memory; triangles that lie over each other from above, so that there is no one outline;
// what GEOS says. A mesh that lies beside the grid cuts nothing.
Result<void> cut_under(HeightField& field, PlacedMesh& mesh);

}  // namespace oro
