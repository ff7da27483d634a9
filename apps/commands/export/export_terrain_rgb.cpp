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

constexpr int measured_places = 10000;
constexpr double most_tiles = 4.0e6;
constexpr double least_hole_H_m = -10000.0, most_hole_H_m = 10000.0;

std::optional<int> zoom_from(std::string_view text) {
    int zoom = 0;
    if (!read_whole(text, zoom) || zoom < 0 || zoom > most_mercator_zoom || text.front() == '-')
        return std::nullopt;
    return zoom;
}

// LOW:HIGH.
Result<ZoomRange> zooms_from(const std::string& text) {
    const std::size_t colon = text.find(':');
    const auto low = zoom_from(text.substr(0, colon));
    const auto high = colon == std::string::npos ? low : zoom_from(text.substr(colon + 1));
    if (!low || !high || *low > *high)
        return refused("--zoom", text,
                       "must be LOW:HIGH as in 5:12, from 0 to " + std::to_string(most_mercator_zoom));
    return ZoomRange{*low, *high};
}

struct TilesReport {
    ZoomRange zooms;
    TerrainTilesWritten written;
    std::vector<ZoomError> errors;
    double hole_H_m{};
};

nlohmann::ordered_json errors_json(const std::vector<ZoomError>& errors) {
    auto list = nlohmann::ordered_json::array();
    for (const ZoomError& error : errors) {
        auto one = json_object("zoom", error.zoom, "places", error.places);
        one["largest_m"] = nullptr;
        one["rms_m"] = nullptr;
        if (error.places > 0) {
            one["largest_m"] = error.largest_m;
            one["rms_m"] = error.rms_m;
        }
        list.push_back(std::move(one));
    }
    return list;
}

// What there is of the map: west, south, east, north. TileJSON lets no box cross 180 degrees.
std::vector<double> bounds_of(const Region& region) {
    std::vector<double> box{180.0, mercator_limit_deg, -180.0, -mercator_limit_deg};
    for (const RegionGrid& grid : region.grids) {
        const PostGrid& posts = grid.field.grid;
        const double turn_deg = 360.0 * std::floor((posts.west_deg() + 180.0) / 360.0);
        double west_deg = posts.west_deg() - turn_deg, east_deg = posts.east_deg() - turn_deg;
        if (east_deg > 180.0) west_deg = -180.0, east_deg = 180.0;
        box = {std::min(box[0], west_deg), std::min(box[1], posts.south_deg()), std::max(box[2], east_deg),
               std::max(box[3], posts.north_deg())};
    }
    box[1] = std::clamp(box[1], -mercator_limit_deg, mercator_limit_deg);
    box[3] = std::clamp(box[3], -mercator_limit_deg, mercator_limit_deg);
    return box;
}

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
    nlohmann::ordered_json json = json_object(
        "tilejson", "3.0.0", "name",
        (folder.has_filename() ? folder : folder.parent_path()).filename().string(), "attribution",
        attribution_of(region), "scheme", "xyz", "tiles", std::vector<std::string>{"{z}/{x}/{y}.png"},
        "minzoom", report.zooms.low, "maxzoom", report.zooms.high, "bounds", bounds_of(region));
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
        json["bounds"] = bounds_of(region);
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
    std::printf("Metres from the ground, bilinear between pixels:\n  zoom  places   largest       rms\n");
    for (const ZoomError& error : report.errors)
        std::printf("  %4d  %6s  %8s  %8s\n", error.zoom, grouped(error.places).c_str(),
                    error.places > 0 ? figure(error.largest_m).c_str() : "n/a",
                    error.places > 0 ? figure(error.rms_m).c_str() : "n/a");
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
    if (tiles > most_tiles)
        return refused("--zoom", std::to_string(zooms.low) + ":" + std::to_string(zooms.high),
                       "takes up to " + grouped(static_cast<std::uint64_t>(tiles)) +
                           " tiles, more than 4,000,000: give a lower zoom, or --bbox");
    return zooms;
}

}  // namespace

Result<void> check_zoom(const ExportOptions& options) {
    if (options.zoom) ORO_CHECK(zooms_from(*options.zoom));
    const double hole_H_m = options.hole_height_m.value_or(0.0);
    if (!(hole_H_m >= least_hole_H_m && hole_H_m <= most_hole_H_m))
        return refused("--hole-height", all_digits(hole_H_m), between_words(least_hole_H_m, most_hole_H_m));
    return check_folder(options.out, options.overwrite, ".png", "tiles.json");
}

Result<void> export_terrain_rgb(const ExportOptions& options, const Region& region, ProgressBar& bar) {
    TilesReport report;
    report.hole_H_m = options.hole_height_m.value_or(0.0);
    ORO_TRY(report.zooms, zooms_of(options, region));
    ORO_TRY(const auto grids, RegionGround::of(region, 1.0));
    const TrueGround& ground = grids->ground();
    ORO_TRY(WholeFolder folder, WholeFolder::create(options.out, options.overwrite));
    ORO_TRY(report.written,
            write_terrain_tiles(folder.path(), ground, {report.zooms, report.hole_H_m, thread_count()},
                                [&](double share) { bar.show(share, "writing tiles"); }));
    if (report.written.tiles == 0)
        return Error{ErrorKind::no_data, "--to terrain-rgb",
                     "no pixel of these zooms has ground at its centre"};
    bar.show(1.0, "measuring");
    ORO_TRY(report.errors, terrain_tiles_error(ground, report.zooms, measured_places, thread_count()));
    ORO_CHECK(write_whole_file(folder.path() + "/tiles.json", tile_json(options, region, report), false));
    ORO_CHECK(folder.commit());
    bar.clear();
    say_notes(region, options.quiet);
    tell_tiles(options, region, report);
    return {};
}

}  // namespace oro
