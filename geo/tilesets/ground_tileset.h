// The ground of grids as 3D Tiles 1.1: cuts of their cluster graphs, coarser and coarser, divided into tiles.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/seam/seam.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/tilesets/clustered_ground.h"
#include "geo/tilesets/glb.h"
#include "geo/tilesets/kept_tiles.h"
#include "geo/tilesets/mesh_palette.h"
#include "geo/tilesets/tileset_layout.h"

namespace oro {

// Meshes that lie on the ground.
struct TilesetMeshes {
    std::shared_ptr<const std::vector<PlacedMesh>> meshes;
    MeshPalette palette;
    std::size_t most_triangles{16384};  // of a tile
    std::size_t whole_triangles{4096};  // things of more have levels of detail
};

// Gives the ground with its clusters, which takes long: asked once, and not at all where all tiles are kept.
using GroundSourceOfTiles = std::function<Result<std::unique_ptr<ClusteredGround>>()>;
// What is known of vertices of tiles of a level; asked from several threads.
using VertexFactsOfTiles = std::function<Result<VertexFacts>(int level, std::span<const VertexPlace> places)>;

// The ground of one grid of a tileset. What finer grids cover is void in it.
struct TilesetGrid {
    const PostGrid* posts{};  // stays where it is
    GroundSourceOfTiles ground;
    std::string name;                   // of several, its files' folder; "" of one alone
    std::vector<GroundSource> sources;  // that its vertices come from
    VertexFactsOfTiles facts;           // none: nothing is known of them
    // What tiles of level 0 may be off, metres; 0: they have every post.
    double finest_error_m{};
    // By post, 1 where what is between grids touches this one; empty: nowhere.
    std::vector<char> beside;

    // Before the names of its files.
    [[nodiscard]] std::string folder() const { return name.empty() ? "" : name + "/"; }
};

// What is drawn between grids: pieces of the surface of one of them that is cut, and upright steps.
struct TilesetBetween {
    Seam seam;
    std::size_t grid{};  // among those of the tileset: its vertices' facts and sources
};

struct TilesetRequest {
    GlbLook look;  // without sources
    std::optional<TilesetMeshes> meshes;
    const UndulationField* undulation{};  // of the meshes; null or empty: 0. It stays where it is.
    // What the tileset says of itself, a name and its text each (tileset.json, metadata).
    std::vector<std::pair<std::string, std::string>> metadata;
    bool normals{true};
    int tile_quads{TilesetLayout::usual_quads};  // along the sides of a tile of level 0
    std::size_t most_between{8192};              // pieces and halves of steps of a tile between grids
    // Where tiles that are done are kept, and taken from; null: nowhere. It stays where it is.
    const KeptTiles* kept{};
    // Of several parts that share `kept` this one, 0 .. parts - 1: the others' tiles are not made.
    int part{}, parts{1};
    int threads{1};
};

struct TilesetLevel {
    int level{};  // 0 is the finest
    std::uint64_t tiles{};
    std::uint64_t triangles{};  // of ground
    std::uint64_t bytes{};
    double largest_error_m{};
};
struct TilesetWritten {
    std::vector<std::vector<TilesetLevel>> grids;  // of each its levels, the coarsest first
    TileBox box;
    TilesetLevel between;  // of all tiles between grids, which are always drawn
    // Of all tiles of meshes. largest_error_m is that of what is missing where the first of them are drawn.
    TilesetLevel meshes;
    std::vector<TilesetLevel> mesh_levels;  // of things that have levels: among these tiles, likewise
    double geometric_error_m{};             // of the tileset: what is missing when none of it is drawn
    double root_error_m{};                  // of one grid alone
};

// Most posts of a tileset, whose cluster graphs are in memory: some 9 GB.
inline constexpr std::size_t most_tileset_posts = 64000000;
// A fifth of the way from a post to the next, where that is longest: what tiles of level 0 are off where
// nobody says it. Heights of such data are off about as much.
double usual_finest_error_m(const PostGrid& grid);

// Told how much is done, 0 .. 1, from the calling thread.
using TilesetProgress = std::function<void(double share)>;

// The grids of a tileset, and what is between them: all of that lies in tiles of its own.
struct TilesetGround {
    std::vector<TilesetGrid> grids;  // at least one
    std::vector<TilesetBetween> between;
};

// Writes FOLDER/[GRID/]LEVEL/ROW/COLUMN.glb of every tile that has ground, FOLDER/between/NUMBER.glb, and
// FOLDER/tileset.json. A tile's geometricError is the bound of TileBounds: nothing of the surface is farther
// than it from what the tile has in its place. The folder is there and empty. Same bytes for any number of
// threads, and wherever tiles that are kept were made. With several grids the root has their trees, each of
// its own levels, and the tiles between them side by side; walls along the rims close what the levels of any
// of them leave open. So it has the tiles of MeshTile. Errors: what cannot be written; no triangle (no_data);
// those of `ground`.
Result<TilesetWritten> write_tileset(const std::string& folder, const TilesetGround& ground,
                                     const TilesetRequest& request, const TilesetProgress& progress);

// Makes the tiles of one part that are not kept yet, and keeps them: how many there are now of the part.
// request.kept is there. Errors: as write_tileset().
Result<std::uint64_t> make_tiles(const TilesetGround& ground, const TilesetRequest& request,
                                 const TilesetProgress& progress);

}  // namespace oro
