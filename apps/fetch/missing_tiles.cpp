#include "apps/fetch/missing_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "apps/command_line/refusals.h"
#include "apps/fetch/fetch_progress.h"
#include "apps/fetch/public_sources.h"
#include "apps/fetch/source_key.h"
#include "apps/fetch/tile_cache.h"
#include "apps/report/progress_bar.h"
#include "apps/view/view.h"
#include "core/base/elapsed.h"
#include "geo/fetch/fetch_tiles.h"
#include "geo/listing/file_listing.h"
#include "geo/places/place.h"
#include "geo/places/widened_box.h"

namespace oro {
namespace {

constexpr std::size_t most_missing_tiles = 200;
constexpr double share_wait_s = 600.0;
// Posts lie half a step inside of their tiles.
constexpr double rim_deg = 0.002;

Result<TileLayout> heights_named(const PublicSources& sources, const std::string& name) {
    std::vector<std::string> names;
    for (const TileLayout& layout : sources.tiles) {
        if (layout.holds != TileHolds::heights) continue;
        if (layout.name == name) return layout;
        names.push_back(layout.name);
    }
    return refused("--fetch", name, choose_words(names));
}

// Around a place, or around what it stands for.
BoundingBox box_around(const Place& place, double km) {
    const PlaceCell cell =
        place.cell.value_or(PlaceCell{place.lat_deg, place.lon_deg, place.lat_deg, place.lon_deg});
    return widened_box({cell.west_deg, cell.south_deg, cell.east_deg, cell.north_deg}, 1000.0 * km);
}

Result<std::vector<BoundingBox>> boxes_asked(const RegionOptions& region,
                                             const std::vector<AskedPlace>& places,
                                             const FetchingOptions& options) {
    if (!region.bbox.empty()) {
        const Result<BoundingBox> box = parse_bounding_box(region.bbox);
        if (!box.ok()) return refused("--bbox", region.bbox, box.error().what);
        return std::vector{*box};
    }
    if (!region.tile.empty()) {
        const Result<BoundingBox> box = parse_tile_range(region.tile);
        if (!box.ok()) return refused("--tile", region.tile, box.error().what);
        return std::vector{*box};
    }
    std::vector<BoundingBox> boxes;
    for (const AskedPlace& asked : places) {
        const Result<Place> place = parse_place(asked.text);
        if (!place.ok()) return refused(asked.option, asked.text, place.error().what);
        boxes.push_back(box_around(*place, options.km));
    }
    if (boxes.empty())
        return refused("--fetch", options.source, "needs to know where: name a place, --bbox or --tile");
    return boxes;
}

// Whether data from paths lie under all of a tile.
bool is_covered(const TileName& tile, int side_deg, const std::vector<BoundingBox>& data) {
    return std::ranges::any_of(data, [&](const BoundingBox& box) {
        // The tile's west side, in the turn of the box.
        const double west_deg = box.west_deg + std::remainder(tile.lon_deg - box.west_deg, 360.0);
        const double east_deg = box.east_deg + (box.east_deg < box.west_deg ? 360.0 : 0.0);
        return box.south_deg <= tile.lat_deg + rim_deg && box.west_deg <= west_deg + rim_deg &&
               box.north_deg >= tile.lat_deg + side_deg - rim_deg &&
               east_deg >= west_deg + side_deg - rim_deg;
    });
}

// Where the files of a region have data.
Result<std::vector<BoundingBox>> boxes_of_data(const RegionOptions& region) {
    if (region.paths.empty()) return std::vector<BoundingBox>();
    RegionOptions whole = region;
    whole.bbox.clear();
    whole.tile.clear();
    ORO_TRY(const RegionRequest request, region_request(whole));
    ORO_TRY(const FileListing listing, list_files(request, {}, {}));
    std::vector<BoundingBox> boxes;
    for (const ListedFile& file : listing.files)
        if (file.report) boxes.push_back(file.report->box);
    return boxes;
}

Result<std::vector<TileName>> tiles_missing(const RegionOptions& region,
                                            const std::vector<BoundingBox>& boxes, const TileLayout& layout) {
    ORO_TRY(const std::vector<BoundingBox> data, boxes_of_data(region));
    std::vector<TileName> all;
    for (const BoundingBox& box : boxes) {
        ORO_TRY(const std::vector<TileName> tiles, tiles_in(box, layout, most_missing_tiles));
        for (const TileName& tile : tiles) {
            const bool is_known = std::ranges::any_of(all, [&](const TileName& one) {
                return one.lat_deg == tile.lat_deg && one.lon_deg == tile.lon_deg;
            });
            if (!is_known && !is_covered(tile, layout.side_deg, data)) all.push_back(tile);
        }
    }
    return all;
}

// "3 tiles of skadi fetched (24.1 MB), 1 was there, 1 is sea; to be named: ..."
std::string words_of(const std::vector<FetchedTile>& tiles, const TileLayout& layout) {
    std::size_t fetched = 0, kept = 0, missing = 0;
    double megabytes = 0.0;
    for (const FetchedTile& tile : tiles) {
        fetched += tile.state == TileState::fetched ? 1 : 0;
        kept += tile.state == TileState::kept ? 1 : 0;
        missing += tile.state == TileState::missing ? 1 : 0;
        megabytes += tile.state == TileState::fetched ? static_cast<double>(tile.bytes) / 1e6 : 0.0;
    }
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  " tiles: %zu fetched (%.1f MB), %zu from the cache, %zu not there; to be named: ", fetched,
                  megabytes, kept, missing);
    return "note: " + layout.name + text.data() + layout.attribution;
}

Result<std::vector<FetchedTile>> fetched_into_cache(const TileLayout& layout,
                                                    const std::vector<TileName>& tiles, bool quiet) {
    FetchTilesRequest request;
    request.layout = layout;
    request.tiles = tiles;
    request.limits.transfer.program = "Orograph/" OROGRAPH_VERSION;
    // Many jobs of one cluster may share a cache.
    request.limits.share_wait_s = share_wait_s;
    ORO_TRY(request.folder, tile_cache_folder(layout.name));
    if (!layout.key_variable.empty()) {
        ORO_TRY(request.key, key_for(layout.name, layout.key_variable, ""));
    }
    ProgressBar bar(quiet);
    std::size_t done = 0;
    std::uint64_t bytes = 0;
    const auto start = Clock::now();
    const std::vector<FetchedTile> fetched = fetch_tiles(request, [&](const FetchedTile& tile) {
        ++done;
        bytes += tile.state == TileState::fetched ? tile.bytes : 0;
        bar.show(
            static_cast<double>(done) / static_cast<double>(tiles.size()),
            layout.name + ": " + fetch_progress_words({done, tiles.size(), bytes, seconds_since(start)}));
    });
    bar.clear();
    for (const FetchedTile& tile : fetched)
        if (tile.error) return *tile.error;
    return fetched;
}

}  // namespace

Result<void> fetch_missing_tiles(RegionOptions& region, const std::vector<AskedPlace>& places,
                                 const FetchingOptions& options, bool quiet) {
    ORO_TRY(const PublicSources sources, read_public_sources(""));
    ORO_TRY(const TileLayout layout, heights_named(sources, options.source));
    ORO_TRY(const std::vector<BoundingBox> boxes, boxes_asked(region, places, options));
    ORO_TRY(const std::vector<TileName> missing, tiles_missing(region, boxes, layout));
    if (missing.empty()) return {};
    ORO_TRY(const std::vector<FetchedTile> tiles, fetched_into_cache(layout, missing, quiet));
    for (const FetchedTile& tile : tiles) {
        if (tile.state == TileState::missing) continue;
        note_use(tile.file);
        region.paths.push_back(tile.file);
    }
    if (!quiet) std::fprintf(stderr, "%s\n", one_line("orograph: " + words_of(tiles, layout)).c_str());
    // What is used now stays.
    ORO_TRY(const CacheTrimmed trimmed, trim_tile_cache(static_cast<std::uint64_t>(
                                            sources.cache_limit_gb.value_or(default_cache_limit_gb) * 1e9)));
    (void)trimmed;
    if (region.paths.empty())
        return Error{ErrorKind::no_data, options.source, "the server has no tile there: it is sea"};
    return {};
}

}  // namespace oro
