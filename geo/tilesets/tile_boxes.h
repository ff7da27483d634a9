// Boxes of tiles of a tileset.
#pragma once

#include <nlohmann/json.hpp>

#include "geo/tilesets/ground_mesh.h"

namespace oro {

// One that holds both. Longitudes stay in the first one's whole turn.
TileBox joined(const TileBox& a, const TileBox& b);
// How far from one corner of a box to the other it is, at most, in metres.
double size_m(const TileBox& box);
// boundingVolume.region: west, south, east, north in radians, lowest, highest h in metres. Source: OGC
// 22-025r4.
nlohmann::ordered_json region_json_of(const TileBox& box);

}  // namespace oro
