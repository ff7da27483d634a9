// The table of public sources: that of the program, and what users add to it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/fetch/places_source.h"
#include "geo/fetch/tile_layout.h"

namespace oro {

// Each kind of source by name, and the user's limit of the cache of tiles.
struct PublicSources {
    std::vector<TileLayout> tiles;
    std::vector<PlacesSource> places;
    std::optional<double> cache_limit_gb;  // 10^9 bytes
};

// The sources of a JSON text; `where` is its file, for messages. Errors: what is wrong in it.
Result<PublicSources> public_sources_from(const std::string& text, const std::string& where);

// The sources of the program's own table (sources/sources.json of its data), of sources.json in the user's
// folder of settings where that is there, and of `file` unless it is "". Of sources of one name the last
// counts. Sorted by name. Errors: a file that cannot be read or holds something else.
Result<PublicSources> read_public_sources(const std::string& file);

}  // namespace oro
