// Tiles that commands have fetched for themselves: a folder of the user's cache, of a limited size.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// Where no limit is set.
inline constexpr double default_cache_limit_gb = 20.0;

struct CachedTile {
    std::string source;
    std::string file;  // its path
    std::uint64_t bytes{};
    std::int64_t used_utc_s{};  // when a command last asked for it; seconds since 1970
};

struct CacheTrimmed {
    std::uint64_t files{}, bytes{};  // that were removed
};

// The folder of one source's tiles, which is made if need be; each source has its own, `fetched/SOURCE` in
// the user's cache. Errors: there is no folder for caches; it cannot be made.
Result<std::string> tile_cache_folder(const std::string& source);

// What is there, those used longest ago first. Parts of tiles and other files are left out. Errors: it cannot
// be listed.
Result<std::vector<CachedTile>> cached_tiles();

// Remembers that a tile is used now: by the time of a file beside it, FILE.used.
void note_use(const std::string& file);

// Removes the tiles that were used longest ago, until the others have no more than `limit_bytes`. What was
// used in the last hour stays, whatever it has: another program may read it. Errors: it cannot be listed, or
// a file cannot be removed.
Result<CacheTrimmed> trim_tile_cache(std::uint64_t limit_bytes);

}  // namespace oro
