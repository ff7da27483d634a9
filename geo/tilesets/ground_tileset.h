// The levels of a grid as 3D Tiles 1.1: each page is a tile, refined by the four below it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/frame/region_pages.h"
#include "geo/tilesets/glb.h"

namespace oro {

struct TilesetRequest {
    GlbLook look;
    // What the tileset says of itself, a name and its text each (tileset.json, metadata).
    std::vector<std::pair<std::string, std::string>> metadata;
    int threads{1};
};

struct TilesetLevel {
    int level{};                      // 0 has every post
    std::uint64_t tiles{};            // with content
    std::uint64_t without_content{};  // that cannot stand for what they cover, because of voids
    std::uint64_t triangles{};        // of ground
    std::uint64_t bytes{};
    double largest_error_m{};  // of those with content
};
struct TilesetWritten {
    std::vector<TilesetLevel> levels;  // the coarsest first
    TileBox box;
    double geometric_error_m{};  // of the tileset: what is missing when none of it is drawn
    double root_error_m{};       // of the root; of one without content that of the tileset
};

// Most tiles of a tileset, which is one text in memory.
inline constexpr std::uint64_t most_tileset_tiles = 300000;
// Pages of all levels.
std::uint64_t tileset_pages(const RegionPages& pages);

// Told how much is done, 0 .. 1, from the calling thread.
using TilesetProgress = std::function<void(double share)>;

// Writes FOLDER/LEVEL/ROW/COLUMN.glb of every page that has ground, and FOLDER/tileset.json. A tile's
// geometricError is the bound of TileBounds: nothing of the surface is farther than it from what the tile
// has in its place. A page that cannot stand for what it covers has no content, and an error as large as the
// tileset's, so that viewers go on to those below it. The folder is there and empty. Same bytes for any
// number of threads. Errors: what cannot be written, pages that cannot be read; no triangle (no_data).
Result<TilesetWritten> write_tileset(const std::string& folder, const RegionPages& pages,
                                     const TilesetRequest& request, const TilesetProgress& progress);

}  // namespace oro
