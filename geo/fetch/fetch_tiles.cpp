#include "geo/fetch/fetch_tiles.h"

#include <filesystem>
#include <mutex>
#include <utility>

#include "core/base/parallel.h"
#include "geo/fetch/terrarium_tile.h"
#include "geo/fetch/tile_content.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

void fail(FetchedTile& tile, const Error& error) {
    tile.state = TileState::failed;
    tile.error = error;
}

// Of a file that is there.
void look_at(FetchedTile& tile, const TileLayout& layout) {
    const Result<void> checked = check_tile(tile.file, tile.file, layout, tile.tile);
    if (!checked.ok())
        return fail(tile, {ErrorKind::failed, checked.error().where,
                           checked.error().what + "; remove it to fetch the tile again"});
    tile.state = TileState::kept;
    std::error_code ignored;
    tile.bytes = fs::file_size(tile.file, ignored);
}

// Such a tile is many requests itself.
bool is_of_pictures(const FetchTilesRequest& request) {
    return request.layout.format == TileFormat::terrarium;
}

void fetch(FetchedTile& tile, const FetchTilesRequest& request) {
    FetchLimits limits = request.limits;
    limits.transfer.most_bytes = request.layout.most_bytes;
    const auto check = [&](const std::string& part) {
        return check_tile(part, tile.url, request.layout, tile.tile);
    };
    const Result<FetchedFile> fetched =
        is_of_pictures(request)
            ? fetch_terrarium_tile(request.layout, tile.tile, tile.file, limits, request.jobs)
            : fetch_file(address_of(request.layout, tile.tile, request.key), tile.file, limits, check);
    if (!fetched.ok()) return fail(tile, fetched.error());
    tile.requests = fetched->requests;
    tile.bytes = fetched->bytes;
    if (fetched->is_there) {
        tile.state = TileState::fetched;
    } else if (request.layout.missing == MissingTile::sea) {
        tile.state = TileState::missing;
    } else {
        fail(tile, {ErrorKind::failed, tile.url, "the server has no such tile"});
    }
}

}  // namespace

std::vector<FetchedTile> fetch_tiles(const FetchTilesRequest& request, const AfterTile& after) {
    std::vector<FetchedTile> tiles;
    for (const TileName& tile : request.tiles)
        tiles.push_back({tile, url_of(request.layout, tile),
                         (fs::path(request.folder) / file_of(request.layout, tile)).string(),
                         TileState::wanted, 0, 0, std::nullopt});
    std::mutex one_at_a_time;
    const int at_a_time = is_of_pictures(request) ? 1 : request.jobs;
    in_parallel(static_cast<int>(tiles.size()), at_a_time, [&](int number) {
        FetchedTile& tile = tiles[static_cast<std::size_t>(number)];
        std::error_code unread;
        const fs::file_status there = fs::symlink_status(tile.file, unread);
        if (fs::exists(there)) {
            look_at(tile, request.layout);
        } else if (!request.dry_run) {
            fetch(tile, request);
        }
        const std::lock_guard lock(one_at_a_time);
        if (after) after(tile);
    });
    return tiles;
}

}  // namespace oro
