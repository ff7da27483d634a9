// Where public data lie: files of whole-degree squares, whose addresses follow from latitude and longitude.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/places/bounding_box.h"

namespace oro {

enum class TileFormat { hgt_gz, geotiff };
enum class TileHolds { heights, land_cover };
// What it means that a server has no file of a tile.
enum class MissingTile { sea, error };

// In `url` and `file`, {latitude} stands for N46 and {longitude} for E008, of the south-west corner.
struct TileLayout {
    std::string name;  // as --source takes it
    std::string title;
    std::string url;   // http or https
    std::string file;  // the name of the file that is written
    int side_deg{1};   // of a tile; its corners are at multiples of it
    TileFormat format{TileFormat::hgt_gz};
    TileHolds holds{TileHolds::heights};
    MissingTile missing{MissingTile::error};
    std::string missing_words;   // what else a missing tile may be, for people; or ""
    std::uint64_t most_bytes{};  // a larger file is refused
    std::string licence;
    std::string attribution;
    std::string page;  // where its makers describe it
};

// What is wrong with a layout, in words: an address that is none or has no place for latitude and longitude,
// a file name that is none; "" where nothing is.
std::string fault_of(const TileLayout& layout);

// The tiles of a layout that a box touches with more than its rim, from the north-west, row by row. A box
// over the antimeridian is one. Errors (usage): more than `most` tiles.
Result<std::vector<TileName>> tiles_in(const BoundingBox& box, const TileLayout& layout, std::size_t most);

// The address and the file name of a tile.
std::string url_of(const TileLayout& layout, const TileName& tile);
std::string file_of(const TileLayout& layout, const TileName& tile);

}  // namespace oro
