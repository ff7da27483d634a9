// The levels of a grid as 3D Tiles, each with its proven error.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/commands/export/exported_region.h"
#include "apps/commands/export/vertex_facts.h"
#include "apps/options/shard.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/region_json.h"
#include "core/base/parallel.h"
#include "core/base/srgb.h"
#include "geo/files/whole_folder.h"
#include "geo/tilesets/ground_tileset.h"

namespace oro {
namespace {

// Of meshes, sRGB.
constexpr double mesh_grey = 0.72;

// "zurich.city.json: EPSG:2056 CH1903+ / LV95, heights above sea level (EGM96)"
std::string meshes_words(const std::vector<PlacedMesh>& meshes) {
    std::string words;
    for (const PlacedMesh& mesh : meshes)
        words += (words.empty() ? "" : "; ") + std::filesystem::path(mesh.path).filename().string() + ": " +
                 mesh.crs + ", heights above " + mesh.heights;
    return words;
}

TilesetRequest request_of(const ExportOptions& options, const Region& region, const ExportedFacts& facts) {
    TilesetRequest request;
    request.look = look_of(region);
    request.look.sources = facts.sources();
    request.facts = [&facts](int level, std::span<const VertexPlace> places) {
        return facts.at(level, places);
    };
    request.metadata = {
        {"heights", heights_words(region)},
        {"sourceHeights", source_heights_words(region)},
        {"attribution", request.look.attribution},
        {"geometricError",
         "metres; no point of the surface of all posts is farther from what a tile has for it"}};
    if (region.meshes) {
        TilesetMeshes meshes{region.meshes, {}};
        for (double& part : meshes.colour) part = light_of_srgb(mesh_grey);
        request.meshes = std::move(meshes);
        request.undulation = &region.grids.front().field.undulation;
        request.metadata.emplace_back("meshes", meshes_words(*region.meshes));
    }
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
    tiles += written.meshes.tiles;
    bytes += written.meshes.bytes;
    if (options.json) {
        auto json =
            json_object("folder", options.out, "format", "3dtiles", "tiles", tiles, "bytes", bytes,
                        "geometric_error_m", written.geometric_error_m, "heights", heights_words(region),
                        "attribution", attribution_of(region), "levels", levels_json(written));
        if (region.meshes)
            json["meshes"] =
                json_object("tiles", written.meshes.tiles, "triangles", written.meshes.triangles, "bytes",
                            written.meshes.bytes, "largest_missing_m", written.meshes.largest_error_m);
        json["notes"] = all_notes(region);
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
    if (region.meshes)
        std::printf("Meshes: %s in %s, %s bytes; of their things none larger than %s m is missing\n",
                    counted(written.meshes.triangles, "triangle", "triangles").c_str(),
                    counted(written.meshes.tiles, "tile", "tiles").c_str(),
                    grouped(written.meshes.bytes).c_str(), figure(written.meshes.largest_error_m).c_str());
}

// All that the bytes of tiles depend on, the program's version among it.
std::string key_of(const RegionGrid& grid, const TilesetRequest& request, const ExportedFacts& facts) {
    nlohmann::ordered_json sources = nlohmann::ordered_json::array();
    for (const GroundSource& source : facts.sources())
        sources.push_back(json_object("name", source.name, "attribution", source.attribution, "heights",
                                      source.heights, "spacing_m", source.spacing_m));
    const auto key = json_object(
        "generator", request.look.generator, "posts", grid.posts_hash, "geoid", grid.geoid_fingerprint,
        "rows", grid.field.grid.rows(), "columns", grid.field.grid.columns(), "north_deg",
        grid.field.grid.north_deg(), "west_deg", grid.field.grid.west_deg(), "clusters",
        grid.clusters ? "baked" : "built", "max_error_m", request.finest_error_m, "normals", request.normals,
        "attribution", request.look.attribution, "sources", sources, "colours", facts.key());
    return json_text(key, true) + "\n";
}

}  // namespace

Result<void> export_3d_tiles(const ExportOptions& options, const Region& region, ProgressBar& bar) {
    ORO_CHECK(check_one_grid(options, region));
    const RegionGrid& grid = region.grids.front();
    if (const std::size_t posts = grid.field.grid.post_count(); posts > most_tileset_posts)
        return refused("--to", "3dtiles",
                       grouped(posts) + " posts are more than " + grouped(most_tileset_posts) +
                           ": give a part of the data with --bbox");
    ORO_TRY(const std::unique_ptr<ExportedFacts> facts,
            ExportedFacts::of(options, region, 0, look_of(region).colour));
    TilesetRequest asked = request_of(options, region, *facts);
    const std::string kept_folder = options.out + ".tiles";
    ORO_TRY(const Shard shard, parse_shard(options.shard));
    const GroundSourceOfTiles ground = [&]() -> Result<std::unique_ptr<ClusteredGround>> {
        bar.show(0.0, "building clusters");
        ORO_TRY(std::unique_ptr<ClusteredGround> built,
                ClusteredGround::of(grid.field, grid.clusters.get(), thread_count()));
        ORO_CHECK(region.health());
        return built;
    };
    const TilesetProgress progress = [&](double share) { bar.show(share, "writing tiles"); };
    if (!options.shard.empty()) {
        ORO_TRY(const KeptTiles kept, KeptTiles::open(kept_folder, key_of(grid, asked, *facts)));
        asked.kept = &kept;
        asked.part = static_cast<int>(shard.number - 1);
        asked.parts = static_cast<int>(shard.count);
        ORO_TRY(const std::uint64_t tiles, make_tiles(grid.field.grid, ground, asked, progress));
        bar.clear();
        tell_part(options, kept_folder, shard, tiles);
        return {};
    }
    ORO_TRY(WholeFolder folder, WholeFolder::create(options.out, options.overwrite));
    ORO_TRY(const KeptTiles kept, KeptTiles::open(kept_folder, key_of(grid, asked, *facts)));
    asked.kept = &kept;
    ORO_TRY(const TilesetWritten written,
            write_tileset(folder.path(), grid.field.grid, ground, asked, progress));
    ORO_CHECK(folder.commit());
    kept.remove();
    bar.clear();
    say_notes(region, options.quiet);
    for (const std::string& note : facts->notes()) say(options.quiet, "note: " + note);
    tell_tileset(options, region, written);
    return {};
}

}  // namespace oro
