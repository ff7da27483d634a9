// Tiles of a public layout, several at a time.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geo/fetch/fetch_file.h"
#include "geo/fetch/tile_layout.h"

namespace oro {

enum class TileState {
    wanted,   // not there, and not asked for
    fetched,  // in this run
    kept,     // was there, and is what it should be
    missing,  // the server has none, which the layout takes for sea
    failed,
};

struct FetchedTile {
    TileName tile;
    std::string url;   // without a key
    std::string file;  // its path
    TileState state{TileState::wanted};
    std::uint64_t bytes{};
    int requests{};
    std::optional<Error> error;  // of one that failed
};

struct FetchTilesRequest {
    TileLayout layout;
    std::vector<TileName> tiles;
    std::string folder;  // must be there
    std::string key;     // the user's, of layouts that need one
    FetchLimits limits;
    int jobs{4};     // requests at a time
    bool dry_run{};  // looks at what is there, and asks no server
};

// Called after each tile, one call at a time, from any thread.
using AfterTile = std::function<void(const FetchedTile& tile)>;

// Fetches what is not there, each file whole or not at all; what is there and passes the check is kept, and
// what does not is left and failed. One tile's failure does not stop the others. In the order of the request.
std::vector<FetchedTile> fetch_tiles(const FetchTilesRequest& request, const AfterTile& after);

}  // namespace oro
