// What tiles for web maps and those for globes have in common: zooms, bounds, measured errors.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"
#include "apps/commands/export/exported_region.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"

namespace oro {
namespace {

constexpr double least_hole_H_m = -10000.0, most_hole_H_m = 10000.0;

std::optional<int> zoom_from(std::string_view text) {
    int zoom = 0;
    if (!read_whole(text, zoom) || zoom < 0 || zoom > most_mercator_zoom || text.front() == '-')
        return std::nullopt;
    return zoom;
}

}  // namespace

Result<ZoomRange> zooms_from(const std::string& text) {
    const std::size_t colon = text.find(':');
    const auto low = zoom_from(text.substr(0, colon));
    const auto high = colon == std::string::npos ? low : zoom_from(text.substr(colon + 1));
    if (!low || !high || *low > *high)
        return refused("--zoom", text,
                       "must be LOW:HIGH as in 5:12, from 0 to " + std::to_string(most_mercator_zoom));
    return ZoomRange{*low, *high};
}

Result<void> check_zoom(const ExportOptions& options) {
    if (options.zoom) {
        ORO_TRY(const ZoomRange zooms, zooms_from(*options.zoom));
        // It is what viewers of globes begin with.
        if (options.to == "quantized-mesh" && zooms.low != 0)
            return refused("--zoom", *options.zoom, "must begin with 0 for quantized-mesh, as in 0:12");
    }
    const double hole_H_m = options.hole_height_m.value_or(0.0);
    if (!(hole_H_m >= least_hole_H_m && hole_H_m <= most_hole_H_m))
        return refused("--hole-height", all_digits(hole_H_m), between_words(least_hole_H_m, most_hole_H_m));
    return {};
}

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

std::vector<double> bounds_of(const Region& region, double limit_deg) {
    std::vector<double> box{180.0, limit_deg, -180.0, -limit_deg};
    for (const RegionGrid& grid : region.grids) {
        const PostGrid& posts = grid.field.grid;
        const double turn_deg = 360.0 * std::floor((posts.west_deg() + 180.0) / 360.0);
        double west_deg = posts.west_deg() - turn_deg, east_deg = posts.east_deg() - turn_deg;
        if (east_deg > 180.0) west_deg = -180.0, east_deg = 180.0;
        box = {std::min(box[0], west_deg), std::min(box[1], posts.south_deg()), std::max(box[2], east_deg),
               std::max(box[3], posts.north_deg())};
    }
    box[1] = std::clamp(box[1], -limit_deg, limit_deg);
    box[3] = std::clamp(box[3], -limit_deg, limit_deg);
    return box;
}

void tell_errors(const std::vector<ZoomError>& errors) {
    std::printf("  zoom  places   largest       rms\n");
    for (const ZoomError& error : errors)
        std::printf("  %4d  %6s  %8s  %8s\n", error.zoom, grouped(error.places).c_str(),
                    error.places > 0 ? figure(error.largest_m).c_str() : "n/a",
                    error.places > 0 ? figure(error.rms_m).c_str() : "n/a");
}

void tell_part(const ExportOptions& options, const std::string& folder, const Shard& shard,
               std::uint64_t tiles) {
    if (options.json) {
        const auto json = json_object("folder", folder, "format", *options.to, "part", shard.number, "parts",
                                      shard.count, "tiles", tiles);
        std::printf("%s\n", json_text(json, true).c_str());
        return;
    }
    std::printf("Kept in %s: %s, part %lld of %lld\n", folder.c_str(),
                counted(tiles, "tile", "tiles").c_str(), static_cast<long long>(shard.number),
                static_cast<long long>(shard.count));
}

std::string key_of_web_tiles(const Region& region, const std::string& format, const ZoomRange& zooms,
                             double hole_H_m) {
    auto grids = nlohmann::ordered_json::array();
    for (const RegionGrid& grid : region.grids)
        grids.push_back(json_object("posts", grid.posts_hash, "geoid", grid.geoid_fingerprint, "rows",
                                    grid.field.grid.rows(), "columns", grid.field.grid.columns(), "north_deg",
                                    grid.field.grid.north_deg(), "west_deg", grid.field.grid.west_deg()));
    const auto key =
        json_object("generator", "orograph " OROGRAPH_VERSION, "format", format, "lowest_zoom", zooms.low,
                    "highest_zoom", zooms.high, "hole_height_m", hole_H_m, "grids", grids);
    return json_text(key, true) + "\n";
}

}  // namespace oro
