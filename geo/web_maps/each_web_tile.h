// Work on the tiles of a web map or globe, the same for all formats.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/result.h"
#include "core/truth/true_ground.h"
#include "geo/web_maps/kept_web_tiles.h"
#include "geo/web_maps/terrain_tiles.h"

namespace oro {

// Calls work(number), which gives a Result<void>, for each of so many tiles on several threads, in parts, so
// that progress is told between them. Errors: the first that a call has; posts that cannot be read.
template <class Work>
Result<void> each_web_tile(const TrueGround& ground, std::size_t count, int threads,
                           const TilesProgress& progress, const Work& work) {
    std::mutex mutex;
    Result<void> fault;
    const std::size_t at_once = std::size_t{32} * static_cast<std::size_t>(threads);
    for (std::size_t first = 0; first < count && fault.ok(); first += at_once) {
        const std::size_t now = std::min(at_once, count - first);
        in_parallel(static_cast<int>(now), threads, [&](int i) {
            const Result<void> done = work(first + static_cast<std::size_t>(i));
            if (done.ok()) return;
            const std::scoped_lock lock(mutex);
            if (fault.ok()) fault = done;
        });
        if (progress) progress(static_cast<double>(first + now) / static_cast<double>(count));
    }
    ORO_CHECK(fault);
    return ground.health();
}

// The tile that is kept, or what make() gives as a Result<KeptWebTile>, which is kept then: but of posts that
// cannot be read nothing is. kept: null for nowhere. Errors: those of make(), of the ground and of `kept`.
template <class Tile, class Make>
Result<KeptWebTile> kept_or_made(const KeptWebTiles* kept, const TrueGround& ground, const Tile& tile,
                                 const Make& make) {
    if (kept == nullptr) return make();
    ORO_TRY(std::optional<KeptWebTile> known, kept->read(tile.zoom, tile.x, tile.y));
    if (known) return std::move(*known);
    ORO_TRY(KeptWebTile one, make());
    ORO_CHECK(ground.health());
    ORO_CHECK(kept->write(tile.zoom, tile.x, tile.y, one));
    return one;
}

}  // namespace oro
