// orograph fetch: gets tiles and named places of public sources.
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <map>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/fetch/fetch_progress.h"
#include "apps/fetch/places_fetching.h"
#include "apps/fetch/public_sources.h"
#include "apps/fetch/source_key.h"
#include "apps/fetch/tile_cache.h"
#include "apps/options/fetch_options.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/figures.h"
#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "core/base/elapsed.h"
#include "core/base/open_file.h"
#include "geo/fetch/fetch_tiles.h"
#include "geo/files/network_paths.h"
#include "geo/files/whole_file.h"

namespace oro {
namespace {

constexpr std::size_t most_tiles_fetched = 1000;
// Of a region whose places are asked for: more than Switzerland or Nepal.
constexpr double most_places_deg2 = 100.0;

Error no_such_source(const PublicSources& sources, const std::string& name) {
    std::vector<std::string> names;
    for (const TileLayout& layout : sources.tiles) names.push_back(layout.name);
    for (const PlacesSource& source : sources.places) names.push_back(source.name);
    std::ranges::sort(names);
    return refused("--source", name, (name.empty() ? "is missing: " : "") + choose_words(names));
}

Result<std::vector<BoundingBox>> boxes_named(const FetchOptions& options) {
    std::vector<BoundingBox> boxes;
    for (const std::string& tile : options.tiles) {
        const Result<BoundingBox> box = parse_tile_range(tile);
        if (!box.ok()) return refused("--tile", tile, box.error().what);
        boxes.push_back(*box);
    }
    if (!options.bbox.empty()) {
        const Result<BoundingBox> box = parse_bounding_box(options.bbox);
        if (!box.ok()) return refused("--bbox", options.bbox, box.error().what);
        boxes.push_back(*box);
    }
    if (boxes.empty())
        return refused("--bbox", "", "is missing: name the region, e.g. --bbox 7,46,9,47 or --tile N46E008");
    return boxes;
}

Result<std::vector<TileName>> tiles_named(const FetchOptions& options, const TileLayout& layout) {
    ORO_TRY(const std::vector<BoundingBox> boxes, boxes_named(options));
    std::vector<TileName> all;
    for (const BoundingBox& box : boxes) {
        ORO_TRY(const std::vector<TileName> tiles, tiles_in(box, layout, most_tiles_fetched));
        for (const TileName& tile : tiles) {
            const auto is_same = [&](const TileName& one) {
                return one.lat_deg == tile.lat_deg && one.lon_deg == tile.lon_deg;
            };
            if (std::ranges::find_if(all, is_same) == all.end()) all.push_back(tile);
        }
    }
    return all;
}

Result<void> make_folder(const std::string& folder) {
    ORO_CHECK(check_on_this_machine(folder));
    std::error_code fault;
    std::filesystem::create_directories(folder, fault);
    if (!fault && std::filesystem::is_directory(folder, fault)) return {};
    return Error{ErrorKind::failed, folder,
                 fault ? "cannot be made: " + fault.message() : "is there, and is no folder"};
}

const char* state_word(TileState state) {
    constexpr std::array words{"wanted", "fetched", "kept", "missing", "failed"};
    return words[static_cast<std::size_t>(state)];
}

std::size_t count_of(const std::vector<FetchedTile>& tiles, TileState state) {
    std::size_t count = 0;
    for (const FetchedTile& tile : tiles) count += tile.state == state ? 1 : 0;
    return count;
}

std::string tile_line(const FetchedTile& tile, const TileLayout& layout) {
    const std::string name = tile_name(tile.tile.lat_deg, tile.tile.lon_deg) + "  ";
    switch (tile.state) {
        case TileState::wanted:
            return name + "wanted   " + tile.url;
        case TileState::fetched:
            return name + "fetched  " + tile.file + ", " + megabytes_text(tile.bytes);
        case TileState::kept:
            return name + "kept     " + tile.file + ", " + megabytes_text(tile.bytes);
        case TileState::missing:
            return name + "missing  no tile there: sea" +
                   (layout.missing_words.empty() ? "" : ", " + layout.missing_words);
        case TileState::failed:
            break;
    }
    return name + "failed";
}

std::string fetch_text(const std::vector<FetchedTile>& tiles, const TileLayout& layout) {
    std::string text;
    for (const FetchedTile& tile : tiles) text += one_line(tile_line(tile, layout)) + "\n";
    std::string counts;
    for (const TileState state :
         {TileState::wanted, TileState::fetched, TileState::kept, TileState::missing, TileState::failed})
        if (const std::size_t count = count_of(tiles, state); count > 0)
            counts += (counts.empty() ? "" : ", ") + std::to_string(count) + " " + state_word(state);
    text += "Tiles: " + counts + "\n";
    text += one_line("Source: " + layout.title) + "\n";
    text += one_line("Licence: " + layout.licence) + "\n";
    text += one_line("To be named: " + layout.attribution) + "\n";
    return text;
}

nlohmann::ordered_json fetch_json(const std::vector<FetchedTile>& tiles, const TileLayout& layout) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array(), counts = json_object();
    for (const FetchedTile& tile : tiles) {
        list.push_back(json_object("tile", tile_name(tile.tile.lat_deg, tile.tile.lon_deg), "state",
                                   state_word(tile.state), "url", tile.url, "file", path_json(tile.file),
                                   "bytes", tile.bytes, "requests", tile.requests, "error", nullptr));
        if (tile.error) list.back()["error"] = tile.error->line();
    }
    for (const TileState state :
         {TileState::wanted, TileState::fetched, TileState::kept, TileState::missing, TileState::failed})
        counts[state_word(state)] = count_of(tiles, state);
    return json_object("source", layout.name, "title", layout.title, "licence", layout.licence, "attribution",
                       layout.attribution, "page", layout.page, "counts", counts, "tiles", list);
}

FetchLimits limits_of(const FetchOptions& options) {
    FetchLimits limits;
    limits.retries = options.retries;
    limits.transfer.program = "Orograph/" OROGRAPH_VERSION;
    return limits;
}

std::string places_text(const PlacesSource& source, const std::string& file, std::size_t count) {
    return one_line("Places: " + std::to_string(count) + " with names, in " + file) + "\n" +
           one_line("Source: " + source.title) + "\n" + one_line("Licence: " + source.licence) + "\n" +
           one_line("To be named: " + source.attribution) + "\n";
}

// Named places, as one file of GeoJSON.
Result<void> fetch_places_of(const PlacesSource& source, const FetchOptions& options) {
    ORO_TRY(const std::vector<BoundingBox> named, boxes_named(options));
    ORO_TRY(const std::vector<BoundingBox> boxes, boxes_to_ask(named, most_places_deg2));
    if (options.out.empty()) return refused("--out", "", "is missing: name the file for the places");
    nlohmann::ordered_json result =
        json_object("source", source.name, "title", source.title, "licence", source.licence, "attribution",
                    source.attribution, "page", source.page, "file", path_json(options.out));
    if (options.dry_run) {
        nlohmann::ordered_json urls = json_list();
        std::string lines;
        for (const BoundingBox& box : boxes) {
            urls.push_back(url_of(source, box));
            lines += one_line("wanted   " + url_of(source, box)) + "\n";
        }
        result["urls"] = urls;
        std::fputs((options.json ? json_text(result, true) + "\n" : lines).c_str(), stdout);
        return {};
    }
    ORO_CHECK(check_may_write(options.out, options.overwrite));
    ORO_TRY(const PlacesFound found, fetch_places(source, boxes, options.out, limits_of(options)));
    ORO_CHECK(write_whole_file(options.out, found.geojson(source, named), options.overwrite));
    result["places"] = found.count();
    result["left_out"] = found.left_out();
    std::fputs(
        (options.json ? json_text(result, true) + "\n" : places_text(source, options.out, found.count()))
            .c_str(),
        stdout);
    return {};
}

Result<void> fetch_tiles_of(const TileLayout& layout, const FetchOptions& options) {
    FetchTilesRequest request;
    request.layout = layout;
    ORO_TRY(request.tiles, tiles_named(options, layout));
    if (layout.key_variable.empty() && !options.key_file.empty())
        return refused("--key-file", options.key_file, "says nothing: " + layout.name + " needs no key");
    if (options.out.empty()) return refused("--out", "", "is missing: name the folder for the tiles");
    if (!layout.key_variable.empty() && !options.dry_run) {
        ORO_TRY(request.key, key_for(layout.name, layout.key_variable, options.key_file));
    }
    if (!options.dry_run) ORO_CHECK(make_folder(options.out));
    request.folder = options.out;
    request.dry_run = options.dry_run;
    request.jobs = options.jobs;
    request.limits = limits_of(options);
    ProgressBar bar(options.quiet);
    std::size_t done = 0;
    std::uint64_t bytes = 0;
    const auto start = Clock::now();
    const std::vector<FetchedTile> tiles = fetch_tiles(request, [&](const FetchedTile& tile) {
        ++done;
        bytes += tile.state == TileState::fetched ? tile.bytes : 0;
        bar.show(static_cast<double>(done) / static_cast<double>(request.tiles.size()),
                 fetch_progress_words({done, request.tiles.size(), bytes, seconds_since(start)}));
    });
    bar.clear();
    for (const FetchedTile& tile : tiles)
        if (tile.error) std::fprintf(stderr, "orograph: %s\n", tile.error->line().c_str());
    std::fputs((options.json ? json_text(fetch_json(tiles, request.layout), true) + "\n"
                             : fetch_text(tiles, request.layout))
                   .c_str(),
               stdout);
    const std::size_t failed = count_of(tiles, TileState::failed);
    if (failed == 0) return {};
    return Error{ErrorKind::failed, options.source,
                 std::to_string(failed) + " of " + std::to_string(tiles.size()) +
                     " tiles could not be fetched; the same command again goes on with them"};
}

// The cache of --fetch: trimmed to its limit, and what is in it by source.
Result<void> tell_cache(const PublicSources& sources, const FetchOptions& options) {
    const double limit_gb =
        options.cache_limit_gb.value_or(sources.cache_limit_gb.value_or(default_cache_limit_gb));
    if (!(limit_gb >= 0.0 && limit_gb <= 1e6))
        return refused("--cache-limit", figure(limit_gb), "must be 0 to 1,000,000 GB");
    ORO_TRY(const CacheTrimmed trimmed, trim_tile_cache(static_cast<std::uint64_t>(limit_gb * 1e9)));
    ORO_TRY(const std::vector<CachedTile> tiles, cached_tiles());
    std::map<std::string, std::pair<std::size_t, std::uint64_t>> by_source;
    nlohmann::ordered_json list = json_list();
    std::uint64_t bytes = 0;
    for (const CachedTile& tile : tiles) {
        auto& [count, source_bytes] = by_source[tile.source];
        ++count;
        source_bytes += tile.bytes;
        bytes += tile.bytes;
        list.push_back(json_object("source", tile.source, "file", path_json(tile.file), "bytes", tile.bytes,
                                   "used", time_text(tile.used_utc_s)));
    }
    std::string text;
    for (const auto& [source, sum] : by_source)
        text +=
            one_line(source + "  " + std::to_string(sum.first) + " tiles, " + megabytes_text(sum.second)) +
            "\n";
    text += "Cache: " + std::to_string(tiles.size()) + " tiles, " + megabytes_text(bytes) + " of at most " +
            figure(limit_gb) + " GB\n";
    if (trimmed.files > 0)
        text +=
            "Removed: " + std::to_string(trimmed.files) + " tiles, " + megabytes_text(trimmed.bytes) + "\n";
    const auto json = json_object("limit_gb", limit_gb, "bytes", bytes, "removed_tiles", trimmed.files,
                                  "removed_bytes", trimmed.bytes, "tiles", list);
    std::fputs((options.json ? json_text(json, true) + "\n" : text).c_str(), stdout);
    return {};
}

}  // namespace

Result<void> run_fetch(const FetchOptions& options) {
    ORO_TRY(const PublicSources sources, read_public_sources(options.sources_file));
    if (options.cache) return tell_cache(sources, options);
    if (options.cache_limit_gb)
        return refused("--cache-limit", figure(*options.cache_limit_gb), "says nothing without --cache");
    for (const TileLayout& layout : sources.tiles)
        if (layout.name == options.source) return fetch_tiles_of(layout, options);
    for (const PlacesSource& source : sources.places)
        if (source.name == options.source) return fetch_places_of(source, options);
    return no_such_source(sources, options.source);
}

}  // namespace oro
