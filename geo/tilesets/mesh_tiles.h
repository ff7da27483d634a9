// Meshes (surveys, towns) as tiles of a tileset: each tile adds things to those of the tiles above it, and
// large things have tiles of their own, which replace each other.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/tilesets/glb.h"
#include "geo/tilesets/ground_mesh.h"
#include "geo/tilesets/mesh_palette.h"

namespace oro {

struct MeshTilesRequest {
    GlbLook look;  // without features
    MeshPalette palette;
    bool normals{true};
    std::size_t most_triangles{16384};  // of a tile; at least 4
    std::size_t whole_triangles{4096};  // things of more have levels of detail
    int threads{1};
};

// A tile, and what the tileset says of it.
struct MeshTile {
    std::string name;  // "meshes/DEPTH/NUMBER.glb"; "": nothing is drawn of it
    TileBox box;       // of all that is below it, too
    // Metres. No thing of a mesh (building, or what hangs together) is missing when the tile and those above
    // it are drawn that is larger than that: larger between any two of its points. Things that are drawn are
    // off by less than a millimetre, which is in it. At least those of the tiles that refine it. Of a tile
    // with a level the bound of ThingTile instead.
    double error_m{};
    // Of a tile of a large thing, which its children replace: 0 has all triangles, and larger ones are
    // coarser.
    std::optional<int> level;
    std::uint64_t triangles{}, bytes{};  // of the tile alone
    std::vector<std::size_t> children;   // among the tiles
};

// Writes FOLDER/meshes/DEPTH/NUMBER.glb; the first of what it gives is the root of all others, which refine
// each other by addition, but for those with a level, which their children replace. Vertices are rounded to
// steps of 2^-11 m along three axes around the tile's centre, which is in double: a vertex is less than 0.5
// mm off (of tiles with a level see ThingTile). Each vertex has the colour of its triangles
// (colour_of_triangle()), and names its feature (EXT_mesh_features). Nothing where meshes have no triangle.
// undulation: N of the region; empty: 0. Same bytes for any number of threads. Errors (failed): what cannot
// be written.
Result<std::vector<MeshTile>> write_mesh_tiles(const std::string& folder, std::span<const PlacedMesh> meshes,
                                               const UndulationField& undulation,
                                               const MeshTilesRequest& request);

}  // namespace oro
