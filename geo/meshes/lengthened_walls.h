// Walls of buildings that end above the terrain, led down to it.
#pragma once

#include <span>

#include "core/terrain/post_grid.h"
#include "geo/meshes/placed_mesh.h"

namespace oro {

// How far walls are led below the lowest ground under a building.
inline constexpr double walls_below_ground_m = 0.5;

// Adds triangles below the walls of a CityJSON mesh's buildings (types Building and BuildingPart) that end
// above the lowest ground under their triangles, down to walls_below_ground_m below it; roofs and all that
// was there stay as they are. fields: the ground's, the best first. A wall's foot is a side of an upright
// triangle of which both ends are within 1 m of the building's lowest vertex: overhangs and arcades stay
// open. Sets PlacedMesh::lengthened and most_lengthened_m. Of any other mesh nothing changes. From any
// thread.
void lengthen_walls(std::span<const HeightField* const> fields, PlacedMesh& mesh);

}  // namespace oro
