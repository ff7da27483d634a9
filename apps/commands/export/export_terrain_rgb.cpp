// The ground as tiles of a web map, and how far they are from it.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"
#include "apps/commands/export/exported_region.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/region_json.h"
#include "core/base/parallel.h"
#include "geo/files/whole_file.h"
#include "geo/files/whole_folder.h"
#include "geo/together/region_ground.h"
#include "geo/web_maps/terrain_tiles.h"

namespace oro {
namespace {

struct TilesReport {
    ZoomRange zooms;
    TerrainTilesWritten written;
    std::vector<ZoomError> errors;
    double hole_H_m{};
};

// Of the first grid, the one of most posts.
std::vector<double> centre_of(const Region& region, const ZoomRange& zooms) {
    const PostGrid& grid = region.grids.front().field.grid;
    const PostPlace middle = grid.place_at(0.5 * (grid.rows() - 1), 0.5 * (grid.columns() - 1));
    return {std::remainder(middle.lon_deg, 360.0),
            std::clamp(middle.lat_deg, -mercator_limit_deg, mercator_limit_deg),
            static_cast<double>(zooms.low)};
}

// Source: TileJSON 3.0.0, github.com/mapbox/tilejson-spec; `encoding` and `tileSize` as MapLibre's style
// specification has them.
std::string tile_json(const ExportOptions& options, const Region& region, const TilesReport& report) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(options.out).lexically_normal();
    nlohmann::ordered_json json =
        json_object("tilejson", "3.0.0", "name",
                    (folder.has_filename() ? folder : folder.parent_path()).filename().string(),
                    "attribution", attribution_of(region), "scheme", "xyz", "tiles",
                    std::vector<std::string>{"{z}/{x}/{y}.png"}, "minzoom", report.zooms.low, "maxzoom",
                    report.zooms.high, "bounds", bounds_of(region, mercator_limit_deg));
    json["center"] = centre_of(region, report.zooms);
    json["format"] = "png";
    json["encoding"] = "mapbox";
    json["tileSize"] = mercator_tile_px;
    json["orograph"] = json_object("version", OROGRAPH_VERSION, "heights", heights_words(region), "tiles",
                                   report.written.tiles, "hole_pixels", report.written.hole_pixels,
                                   "hole_height_m", report.hole_H_m, "error", errors_json(report.errors));
    return json_text(json, true) + "\n";
}

void tell_tiles(const ExportOptions& options, const Region& region, const TilesReport& report) {
    if (options.json) {
        auto json = json_object("folder", options.out, "format", "terrain-rgb", "minzoom", report.zooms.low,
                                "maxzoom", report.zooms.high, "tiles", report.written.tiles, "bytes",
                                report.written.bytes, "hole_pixels", report.written.hole_pixels);
        json["hole_height_m"] = report.hole_H_m;
        json["heights"] = heights_words(region);
        json["bounds"] = bounds_of(region, mercator_limit_deg);
        json["attribution"] = attribution_of(region);
        json["error"] = errors_json(report.errors);
        json["notes"] = all_notes(region);
        std::printf("%s\n", json_text(json, true).c_str());
        return;
    }
    std::printf("Wrote %s: %s of zoom %d to %d, %s bytes\n", options.out.c_str(),
                counted(report.written.tiles, "tile", "tiles").c_str(), report.zooms.low, report.zooms.high,
                grouped(report.written.bytes).c_str());
    std::printf("Heights: %s\n", heights_words(region).c_str());
    if (report.written.hole_pixels > 0)
        std::printf("Without ground: %s, which hold %s m\n",
                    counted(report.written.hole_pixels, "pixel", "pixels").c_str(),
                    all_digits(report.hole_H_m).c_str());
    std::printf("Metres from the ground, bilinear between pixels:\n");
    tell_errors(report.errors);
}

// Zooms that were asked for, or those that fit the posts.
Result<ZoomRange> zooms_of(const ExportOptions& options, const Region& region) {
    std::vector<const PostGrid*> grids;
    for (const RegionGrid& grid : region.grids) grids.push_back(&grid.field.grid);
    ZoomRange zooms = mercator_zooms(grids);
    if (options.zoom) {
        ORO_TRY(zooms, zooms_from(*options.zoom));
    }
    double tiles = 0.0;
    for (int zoom = zooms.low; zoom <= zooms.high; ++zoom) tiles += most_mercator_tiles(zoom, grids);
    if (tiles > most_web_tiles)
        return refused("--zoom", std::to_string(zooms.low) + ":" + std::to_string(zooms.high),
                       "takes up to " + grouped(static_cast<std::uint64_t>(tiles)) +
                           " tiles, more than 4,000,000: give a lower zoom, or --bbox");
    return zooms;
}

}  // namespace

Result<void> export_terrain_rgb(const ExportOptions& options, const Region& region, ProgressBar& bar) {
    TilesReport report;
    report.hole_H_m = options.hole_height_m.value_or(0.0);
    ORO_TRY(report.zooms, zooms_of(options, region));
    ORO_TRY(const auto grids, RegionGround::of(region, 1.0));
    const TrueGround& ground = grids->ground();
    const std::string kept_folder = options.out + ".tiles";
    const std::string key = key_of_web_tiles(region, "terrain-rgb", report.zooms, report.hole_H_m);
    ORO_TRY(const Shard shard, parse_shard(options.shard));
    TerrainTilesRequest request{report.zooms, report.hole_H_m, thread_count(), {}};
    const TilesProgress progress = [&](double share) { bar.show(share, "writing tiles"); };
    if (!options.shard.empty()) {
        ORO_TRY(const KeptWebTiles kept, KeptWebTiles::open(kept_folder, key));
        request.share = {&kept, static_cast<std::size_t>(shard.number - 1),
                         static_cast<std::size_t>(shard.count)};
        ORO_TRY(const std::uint64_t tiles, keep_terrain_tiles(ground, request, progress));
        bar.clear();
        tell_part(options, kept_folder, shard, tiles);
        return {};
    }
    ORO_TRY(WholeFolder folder, WholeFolder::create(options.out, options.overwrite));
    ORO_TRY(const KeptWebTiles kept, KeptWebTiles::open(kept_folder, key));
    request.share.kept = &kept;
    ORO_TRY(report.written, write_terrain_tiles(folder.path(), ground, request, progress));
    if (report.written.tiles == 0) {
        kept.remove();
        return Error{ErrorKind::no_data, "--to terrain-rgb",
                     "no pixel of these zooms has ground at its centre"};
    }
    bar.show(1.0, "measuring");
    ORO_TRY(report.errors, terrain_tiles_error(ground, report.zooms, measured_places, thread_count()));
    ORO_CHECK(write_whole_file(folder.path() + "/tiles.json", tile_json(options, region, report), false));
    ORO_CHECK(folder.commit());
    kept.remove();
    bar.clear();
    say_notes(region, options.quiet);
    tell_tiles(options, region, report);
    return {};
}

}  // namespace oro
