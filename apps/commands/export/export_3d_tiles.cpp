// The levels of a grid as 3D Tiles, each with its proven error.
#include <cmath>
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
#include "geo/files/whole_folder.h"
#include "geo/tilesets/ground_tileset.h"

namespace oro {
namespace {

TilesetRequest request_of(const ExportOptions& options, const Region& region) {
    TilesetRequest request;
    request.look = look_of(region);
    request.metadata = {
        {"heights", heights_words(region)},
        {"sourceHeights", source_heights_words(region)},
        {"attribution", request.look.attribution},
        {"geometricError",
         "metres; no point of the surface of all posts is farther from what a tile has for it"}};
    request.finest_error_m =
        options.max_error_m.value_or(usual_finest_error_m(region.grids.front().field.grid));
    request.normals = !options.no_normals;
    request.threads = thread_count();
    return request;
}

nlohmann::ordered_json levels_json(const TilesetWritten& written) {
    auto list = nlohmann::ordered_json::array();
    for (const TilesetLevel& level : written.levels)
        list.push_back(json_object("level", level.level, "tiles", level.tiles, "triangles", level.triangles,
                                   "bytes", level.bytes, "largest_error_m", level.largest_error_m));
    return list;
}

void tell_tileset(const ExportOptions& options, const Region& region, const TilesetWritten& written) {
    std::uint64_t tiles = 0, bytes = 0;
    for (const TilesetLevel& level : written.levels) {
        tiles += level.tiles;
        bytes += level.bytes;
    }
    if (options.json) {
        auto json = json_object("folder", options.out, "format", "3dtiles", "tiles", tiles, "bytes", bytes,
                                "geometric_error_m", written.geometric_error_m, "heights",
                                heights_words(region), "attribution", attribution_of(region), "levels",
                                levels_json(written), "notes", all_notes(region));
        std::printf("%s\n", json_text(json, true).c_str());
        return;
    }
    std::printf("Wrote %s: %s, %s bytes\n", options.out.c_str(), counted(tiles, "tile", "tiles").c_str(),
                grouped(bytes).c_str());
    std::printf("Heights: h, above the ellipsoid WGS84; the data's are %s\n", heights_words(region).c_str());
    std::printf("Metres from the ground, at most (proven):\n  level   tiles   triangles   largest\n");
    for (const TilesetLevel& level : written.levels)
        std::printf("  %5d  %6s  %10s  %8s\n", level.level, grouped(level.tiles).c_str(),
                    grouped(level.triangles).c_str(),
                    level.tiles > 0 ? figure(level.largest_error_m).c_str() : "n/a");
}

}  // namespace

Result<void> export_3d_tiles(const ExportOptions& options, const Region& region, ProgressBar& bar) {
    ORO_CHECK(check_one_grid(options, region));
    const RegionGrid& grid = region.grids.front();
    if (const std::size_t posts = grid.field.grid.post_count(); posts > most_tileset_posts)
        return refused("--to", "3dtiles",
                       grouped(posts) + " posts are more than " + grouped(most_tileset_posts) +
                           ": give a part of the data with --bbox");
    bar.show(0.0, "building clusters");
    ORO_TRY(const std::unique_ptr<ClusteredGround> ground,
            ClusteredGround::of(grid.field, grid.clusters.get(), thread_count()));
    ORO_CHECK(region.health());
    ORO_TRY(WholeFolder folder, WholeFolder::create(options.out, options.overwrite));
    ORO_TRY(const TilesetWritten written,
            write_tileset(folder.path(), *ground, request_of(options, region),
                          [&](double share) { bar.show(share, "writing tiles"); }));
    ORO_CHECK(region.health());
    ORO_CHECK(folder.commit());
    bar.clear();
    say_notes(region, options.quiet);
    tell_tileset(options, region, written);
    return {};
}

}  // namespace oro
