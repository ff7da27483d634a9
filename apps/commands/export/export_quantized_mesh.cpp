// The ground as tiles of terrain for globes, and how far they are from it.
#include <cstdio>
#include <string>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/commands/export/exported_region.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/region_json.h"
#include "core/base/parallel.h"
#include "geo/files/whole_file.h"
#include "geo/files/whole_folder.h"
#include "geo/together/region_ground.h"
#include "geo/web_maps/quantized_tiles.h"

namespace oro {
namespace {

struct TerrainReport {
    QuantizedTilesRequest request;
    QuantizedTiles written;
    std::vector<ZoomError> errors;
};

Result<int> highest_zoom_of(const ExportOptions& options, const Region& region) {
    std::vector<const PostGrid*> grids;
    for (const RegionGrid& grid : region.grids) grids.push_back(&grid.field.grid);
    int highest = geographic_zoom(grids, quantized_quads);
    if (options.zoom) {
        ORO_TRY(const ZoomRange zooms, zooms_from(*options.zoom));
        highest = zooms.high;
    }
    double tiles = 0.0;
    for (int zoom = 0; zoom <= highest; ++zoom) tiles += most_geographic_tiles(zoom, grids);
    if (tiles > most_web_tiles)
        return refused("--zoom", "0:" + std::to_string(highest),
                       "takes up to " + grouped(static_cast<std::uint64_t>(tiles)) +
                           " tiles, more than 4,000,000: give a lower zoom, or --bbox");
    return highest;
}

// Source: github.com/CesiumGS/quantized-mesh; TileJSON 2.1.0 with `available` and `projection` as terrain
// servers of Cesium have them.
std::string layer_json(const ExportOptions& options, const Region& region, const TerrainReport& report) {
    const int highest = report.request.highest_zoom;
    auto available = nlohmann::ordered_json::array();
    for (int zoom = 0; zoom <= highest; ++zoom) {
        auto of_zoom = nlohmann::ordered_json::array();
        for (const QuantizedTiles::Rectangle& one : report.written.rectangles(zoom))
            of_zoom.push_back(json_object("startX", one.first_x, "startY", one.first_y, "endX", one.last_x,
                                          "endY", one.last_y));
        available.push_back(std::move(of_zoom));
    }
    nlohmann::ordered_json json =
        json_object("tilejson", "2.1.0", "name", options.out, "version", "1.0.0", "format",
                    "quantized-mesh-1.0", "attribution", attribution_of(region), "scheme", "tms",
                    "projection", "EPSG:4326", "tiles", std::vector<std::string>{"{z}/{x}/{y}.terrain"},
                    "minzoom", 0, "maxzoom", highest, "bounds", bounds_of(region, 90.0));
    json["available"] = std::move(available);
    json["orograph"] =
        json_object("version", OROGRAPH_VERSION, "heights", heights_words(region), "tiles",
                    report.written.tiles.size(), "hole_corners", report.written.hole_corners, "hole_height_m",
                    report.request.hole_H_m, "error", errors_json(report.errors));
    return json_text(json, true) + "\n";
}

void tell_terrain(const ExportOptions& options, const Region& region, const TerrainReport& report) {
    if (options.json) {
        auto json = json_object("folder", options.out, "format", "quantized-mesh", "minzoom", 0, "maxzoom",
                                report.request.highest_zoom, "tiles", report.written.tiles.size(), "bytes",
                                report.written.bytes, "hole_corners", report.written.hole_corners,
                                "hole_height_m", report.request.hole_H_m, "heights", heights_words(region),
                                "bounds", bounds_of(region, 90.0), "attribution", attribution_of(region),
                                "error", errors_json(report.errors), "notes", all_notes(region));
        std::printf("%s\n", json_text(json, true).c_str());
        return;
    }
    std::printf("Wrote %s: %s of zoom 0 to %d, %s bytes\n", options.out.c_str(),
                counted(report.written.tiles.size(), "tile", "tiles").c_str(), report.request.highest_zoom,
                grouped(report.written.bytes).c_str());
    std::printf("Heights: h, above the ellipsoid WGS84; the data's are %s\n", heights_words(region).c_str());
    if (report.written.hole_corners > 0)
        std::printf("Without ground: %s, which hold H %s m\n",
                    counted(report.written.hole_corners, "corner", "corners").c_str(),
                    all_digits(report.request.hole_H_m).c_str());
    std::printf("Metres from the ground, on triangles between corners:\n");
    tell_errors(report.errors);
}

}  // namespace

Result<void> export_quantized_mesh(const ExportOptions& options, const Region& region, ProgressBar& bar) {
    TerrainReport report;
    report.request.hole_H_m = options.hole_height_m.value_or(0.0);
    report.request.threads = thread_count();
    ORO_TRY(report.request.highest_zoom, highest_zoom_of(options, region));
    ORO_TRY(const auto grids, RegionGround::of(region, 1.0));
    const TrueGround& ground = grids->ground();
    const std::string kept_folder = options.out + ".tiles";
    const std::string key =
        key_of_web_tiles(region, "quantized-mesh", {0, report.request.highest_zoom}, report.request.hole_H_m);
    ORO_TRY(const Shard shard, parse_shard(options.shard));
    const TilesProgress progress = [&](double share) { bar.show(share, "writing tiles"); };
    if (!options.shard.empty()) {
        ORO_TRY(const KeptWebTiles kept, KeptWebTiles::open(kept_folder, key));
        report.request.share = {&kept, static_cast<std::size_t>(shard.number - 1),
                                static_cast<std::size_t>(shard.count)};
        ORO_TRY(const std::uint64_t tiles, keep_quantized_tiles(ground, report.request, progress));
        bar.clear();
        tell_part(options, kept_folder, shard, tiles);
        return {};
    }
    ORO_TRY(WholeFolder folder, WholeFolder::create(options.out, options.overwrite));
    ORO_TRY(const KeptWebTiles kept, KeptWebTiles::open(kept_folder, key));
    report.request.share.kept = &kept;
    Result<QuantizedTiles> written = write_quantized_tiles(folder.path(), ground, report.request, progress);
    if (!written.ok() && written.error().kind == ErrorKind::no_data) kept.remove();
    ORO_TRY(report.written, std::move(written));
    bar.show(1.0, "measuring");
    ORO_TRY(report.errors, quantized_tiles_error(ground, report.written, report.request, measured_places));
    ORO_CHECK(write_whole_file(folder.path() + "/layer.json", layer_json(options, region, report), false));
    ORO_CHECK(folder.commit());
    kept.remove();
    bar.clear();
    say_notes(region, options.quiet);
    tell_terrain(options, region, report);
    return {};
}

}  // namespace oro
