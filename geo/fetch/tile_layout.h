// Where public data lie: files of whole-degree squares, whose addresses follow from latitude and longitude.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/fetch/fetch_address.h"
#include "geo/places/bounding_box.h"

namespace oro {

// terrarium: pictures of web maps (geo/fetch/terrarium_tile.h), which become a GeoTIFF.
enum class TileFormat { hgt_gz, geotiff, terrarium };
enum class TileHolds { heights, land_cover, canopy };
// What it means that a server has no file of a tile.
enum class MissingTile { sea, error };

// In `url` and `file`, {latitude} stands for N46 and {longitude} for E008, of the south-west corner; in
// `url`, {south}, {west}, {north} and {east} for the sides in degrees, {key} for the user's key, and {z}, {x}
// and {y} for the numbers of a picture of terrarium.
struct TileLayout {
    std::string name;  // as --source takes it
    std::string title;
    std::string url;           // http or https
    std::string file;          // the name of the file that is written
    std::string key_variable;  // of the environment, which may have the key; "" where none is needed
    int zoom{};                // of pictures of terrarium
    int side_deg{1};           // of a tile; its corners are at multiples of it
    TileFormat format{TileFormat::hgt_gz};
    TileHolds holds{TileHolds::heights};
    MissingTile missing{MissingTile::error};
    std::string missing_words;   // what else a missing tile may be, for people; or ""
    std::uint64_t most_bytes{};  // a larger file is refused
    std::string licence;
    std::string attribution;
    std::string page;  // where its makers describe it
};

// What is wrong with a layout, in words: an address that is none, has no place for what tells tiles apart, or
// would carry a key unencrypted to another machine; a file name that is none; "" where nothing is.
std::string fault_of(const TileLayout& layout);

// The tiles of a layout that a box touches with more than its rim, from the north-west, row by row. A box
// over the antimeridian is one. Errors (usage): more than `most` tiles.
Result<std::vector<TileName>> tiles_in(const BoundingBox& box, const TileLayout& layout, std::size_t most);

// The address and the file name of a tile. {key}, {z}, {x} and {y} stay in the address.
std::string url_of(const TileLayout& layout, const TileName& tile);
// The address with the user's key; without it, where the layout needs none.
FetchAddress address_of(const TileLayout& layout, const TileName& tile, const std::string& key);
std::string file_of(const TileLayout& layout, const TileName& tile);

}  // namespace oro
