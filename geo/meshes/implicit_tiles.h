// Implicit tiles of 3D Tiles 1.1 and of 3DTILES_implicit_tiling:
// https://docs.ogc.org/cs/22-025r4/22-025r4.html, section 8. Which tiles there are stands in subtrees, as
// bits; where their files are, in templates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/meshes/tile_json.h"

namespace oro {

// What a tile states of the tiles that stand for it.
struct ImplicitTiling {
    bool is_octree{};
    std::uint32_t subtree_levels{};     // of a subtree
    std::uint32_t levels{};             // of all tiles: from 0 to less than that
    std::string subtrees;               // template of their uris
    std::vector<std::string> contents;  // templates of uris
};

// One of them; z is 0 in a quadtree.
struct ImplicitTile {
    std::uint32_t level{}, x{}, y{}, z{};
    [[nodiscard]] std::string name(bool is_octree) const;  // "implicit tile 2/1/0": level, x, y (and z)
};

// Nothing where the tile has none. contents: templates of its uris. Errors: what it states is none, or has
// more levels than are read (32; 12 of a subtree of quadrants, 8 of octants).
Result<std::optional<ImplicitTiling>> implicit_tiling_of(const TileMembers& tile,
                                                         std::vector<std::string> contents);

// A template's uri of a tile: {level}, {x}, {y} and {z} are its numbers.
std::string uri_of(const std::string& from, const ImplicitTile& tile);

// What walking implicit tiles asks for.
struct ImplicitWalk {
    // The bytes of a subtree by its uri. Errors: told as they are.
    std::function<Result<std::string>(const std::string& uri)> subtree;
    // The bytes of a buffer that a subtree names, by the uri of that subtree and its own.
    std::function<Result<std::string>(const std::string& subtree_uri, const std::string& uri)> buffer;
    // What is to be done with a content.
    std::function<Result<void>(const ImplicitTile& tile, const std::string& uri)> content;
    // Called for each tile. Errors: there are too many.
    std::function<Result<void>()> count;
};
// Calls walk.content for each content that is there: where children replace a tile (`replaced`), of tiles
// without children. Tiles of a subtree come before those of the subtrees below it. Errors: those of the walk;
// a subtree that is none, contradicts itself, or has tiles below the last level.
Result<void> walk_implicit_tiles(const ImplicitTiling& tiling, bool replaced, const ImplicitWalk& walk);

}  // namespace oro
