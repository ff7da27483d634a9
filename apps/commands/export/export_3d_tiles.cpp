// The levels of a grid as 3D Tiles, each with its proven error.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
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
#include "geo/files/whole_folder.h"
#include "geo/tilesets/ground_tileset.h"
#include "geo/tilesets/region_tiles.h"

namespace oro {
namespace {

// "zurich.city.json: EPSG:2056 CH1903+ / LV95, heights above sea level (EGM96)"
std::string meshes_words(const std::vector<PlacedMesh>& meshes) {
    std::string words;
    for (const PlacedMesh& mesh : meshes)
        words += (words.empty() ? "" : "; ") + std::filesystem::path(mesh.path).filename().string() + ": " +
                 mesh.crs + ", heights above " + mesh.heights;
    return words;
}

TilesetRequest request_of(const ExportOptions& options, const Region& region) {
    TilesetRequest request;
    request.look = look_of(region);
    request.metadata = {
        {"heights", heights_words(region)},
        {"sourceHeights", source_heights_words(region)},
        {"attribution", request.look.attribution},
        {"geometricError",
         "metres; no point of the surface of all posts is farther from what a tile has for it"}};
    if (region.meshes) {
        request.meshes = TilesetMeshes{region.meshes, palette_of_meshes()};
        request.undulation = &region.grids.front().field.undulation;
        request.metadata.emplace_back("meshes", meshes_words(*region.meshes));
    }
    request.normals = !options.no_normals;
    request.threads = thread_count();
    return request;
}

// The colours and sources of each grid.
using FactsOfGrids = std::vector<std::unique_ptr<ExportedFacts>>;

Result<FactsOfGrids> facts_of(const ExportOptions& options, const Region& region) {
    FactsOfGrids facts;
    for (std::size_t i = 0; i < region.grids.size(); ++i) {
        ORO_TRY(std::unique_ptr<ExportedFacts> one,
                ExportedFacts::of(options, region, i, look_of(region).colour));
        facts.push_back(std::move(one));
    }
    return facts;
}

void lay_facts(const ExportOptions& options, const FactsOfGrids& facts, TilesetGround& ground) {
    for (std::size_t i = 0; i < facts.size(); ++i) {
        TilesetGrid& grid = ground.grids[i];
        const ExportedFacts* const of_grid = facts[i].get();
        grid.sources = of_grid->sources();
        grid.facts = [of_grid](int level, std::span<const VertexPlace> places) {
            return of_grid->at(level, places);
        };
        grid.finest_error_m = options.max_error_m.value_or(usual_finest_error_m(*grid.posts));
    }
}

nlohmann::ordered_json levels_json(const std::vector<TilesetLevel>& levels) {
    auto list = nlohmann::ordered_json::array();
    for (const TilesetLevel& level : levels)
        list.push_back(json_object("level", level.level, "tiles", level.tiles, "triangles", level.triangles,
                                   "bytes", level.bytes, "largest_error_m", level.largest_error_m));
    return list;
}

// "levels" of one grid alone; else "grids", with what is between them.
void add_levels_json(const Region& region, const TilesetWritten& written, nlohmann::ordered_json& json) {
    if (written.grids.size() == 1) {
        json["levels"] = levels_json(written.grids.front());
        return;
    }
    auto grids = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < written.grids.size(); ++i) {
        const PostGrid& posts = region.grids[i].field.grid;
        grids.push_back(json_object("grid", i + 1, "rows", posts.rows(), "columns", posts.columns(), "levels",
                                    levels_json(written.grids[i])));
    }
    json["grids"] = std::move(grids);
    json["between"] =
        json_object("tiles", written.between.tiles, "triangles", written.between.triangles, "bytes",
                    written.between.bytes, "largest_error_m", written.between.largest_error_m);
}

struct AllTiles {
    std::uint64_t tiles{}, bytes{};
    explicit AllTiles(const TilesetWritten& written) {
        for (const std::vector<TilesetLevel>& levels : written.grids)
            for (const TilesetLevel& level : levels) add(level);
        add(written.between);
        add(written.meshes);
    }

  private:
    void add(const TilesetLevel& level) {
        tiles += level.tiles;
        bytes += level.bytes;
    }
};

void tell_level(const TilesetLevel& level) {
    std::printf("  %5d  %6s  %10s  %8s\n", level.level, grouped(level.tiles).c_str(),
                grouped(level.triangles).c_str(),
                level.tiles > 0 ? figure(level.largest_error_m).c_str() : "n/a");
}

void tell_levels(const Region& region, const TilesetWritten& written) {
    std::printf("Metres from the ground, at most (proven):\n");
    for (std::size_t i = 0; i < written.grids.size(); ++i) {
        const PostGrid& posts = region.grids[i].field.grid;
        if (written.grids.size() > 1)
            std::printf("  grid %zu of %zu: %s x %s posts\n", i + 1, written.grids.size(),
                        grouped(static_cast<std::uint64_t>(posts.columns())).c_str(),
                        grouped(static_cast<std::uint64_t>(posts.rows())).c_str());
        std::printf("  level   tiles   triangles   largest\n");
        for (const TilesetLevel& level : written.grids[i]) tell_level(level);
    }
    if (written.between.tiles > 0)
        std::printf("Between grids: %s in %s, %s bytes, %s m from the ground at most\n",
                    counted(written.between.triangles, "triangle", "triangles").c_str(),
                    counted(written.between.tiles, "tile", "tiles").c_str(),
                    grouped(written.between.bytes).c_str(), figure(written.between.largest_error_m).c_str());
}

void tell_meshes(const TilesetWritten& written) {
    std::printf(
        "Meshes: %s in %s, %s bytes", counted(written.meshes.triangles, "triangle", "triangles").c_str(),
        counted(written.meshes.tiles, "tile", "tiles").c_str(), grouped(written.meshes.bytes).c_str());
    if (written.meshes.largest_error_m > 0.0)
        std::printf("; of their things none larger than %s m is missing",
                    figure(written.meshes.largest_error_m).c_str());
    std::printf("\n");
    if (written.mesh_levels.empty()) return;
    std::printf("Metres from large things of meshes, at most (proven):\n");
    std::printf("  level   tiles   triangles   largest\n");
    for (const TilesetLevel& level : written.mesh_levels) tell_level(level);
}

void tell_tileset(const ExportOptions& options, const Region& region, const TilesetWritten& written) {
    const AllTiles all(written);
    if (options.json) {
        auto json = json_object("folder", options.out, "format", "3dtiles", "tiles", all.tiles, "bytes",
                                all.bytes, "geometric_error_m", written.geometric_error_m, "heights",
                                heights_words(region), "attribution", attribution_of(region));
        add_levels_json(region, written, json);
        if (region.meshes) {
            json["meshes"] =
                json_object("tiles", written.meshes.tiles, "triangles", written.meshes.triangles, "bytes",
                            written.meshes.bytes, "largest_missing_m", written.meshes.largest_error_m);
            if (!written.mesh_levels.empty()) json["meshes"]["levels"] = levels_json(written.mesh_levels);
        }
        json["notes"] = all_notes(region);
        std::printf("%s\n", json_text(json, true).c_str());
        return;
    }
    std::printf("Wrote %s: %s, %s bytes\n", options.out.c_str(), counted(all.tiles, "tile", "tiles").c_str(),
                grouped(all.bytes).c_str());
    std::printf("Heights: h, above the ellipsoid WGS84; the data's are %s\n", heights_words(region).c_str());
    tell_levels(region, written);
    if (region.meshes) tell_meshes(written);
}

// What the bytes of a grid's tiles depend on.
nlohmann::ordered_json key_of(const RegionGrid& grid, const TilesetGrid& tiles, bool is_cut,
                              const std::string& colours) {
    nlohmann::ordered_json sources = nlohmann::ordered_json::array();
    for (const GroundSource& source : tiles.sources)
        sources.push_back(json_object("name", source.name, "attribution", source.attribution, "heights",
                                      source.heights, "spacing_m", source.spacing_m));
    return json_object("posts", grid.posts_hash, "geoid", grid.geoid_fingerprint, "rows",
                       grid.field.grid.rows(), "columns", grid.field.grid.columns(), "north_deg",
                       grid.field.grid.north_deg(), "west_deg", grid.field.grid.west_deg(), "rank", grid.rank,
                       "clusters", grid.clusters && !is_cut ? "baked" : "built", "max_error_m",
                       tiles.finest_error_m, "sources", sources, "colours", colours);
}

// All that the bytes of tiles depend on, the program's version among it.
std::string key_of(const Region& region, const RegionTiles& tiles, const TilesetRequest& request,
                   const FactsOfGrids& facts) {
    auto grids = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < region.grids.size(); ++i)
        grids.push_back(key_of(region.grids[i], tiles.ground.grids[i], tiles.is_cut(i), facts[i]->key()));
    const auto key = json_object("generator", request.look.generator, "normals", request.normals,
                                 "attribution", request.look.attribution, "grids", grids);
    return json_text(key, true) + "\n";
}

// Of all grids: their cluster graphs are in memory together.
Result<void> check_posts(const Region& region) {
    std::size_t posts = 0;
    for (const RegionGrid& grid : region.grids) posts += grid.field.grid.post_count();
    if (posts <= most_tileset_posts) return {};
    return refused("--to", "3dtiles",
                   grouped(posts) + " posts are more than " + grouped(most_tileset_posts) +
                       ": give a part of the data with --bbox");
}

// Says on the bar that clusters are built, which takes longest, and that posts were all read.
void watch_grounds(const Region& region, ProgressBar& bar, TilesetGround& ground) {
    for (TilesetGrid& grid : ground.grids)
        grid.ground = [&region, &bar,
                       from = std::move(grid.ground)]() -> Result<std::unique_ptr<ClusteredGround>> {
            bar.show(0.0, "building clusters");
            ORO_TRY(std::unique_ptr<ClusteredGround> built, from());
            ORO_CHECK(region.health());
            return built;
        };
}

Result<void> write_whole(const ExportOptions& options, const Region& region, const RegionTiles& tiles,
                         TilesetRequest& asked, const FactsOfGrids& facts, ProgressBar& bar) {
    const std::string kept_folder = options.out + ".tiles";
    ORO_TRY(WholeFolder folder, WholeFolder::create(options.out, options.overwrite));
    ORO_TRY(const KeptTiles kept, KeptTiles::open(kept_folder, key_of(region, tiles, asked, facts)));
    asked.kept = &kept;
    ORO_TRY(const TilesetWritten written,
            write_tileset(folder.path(), tiles.ground, asked,
                          [&](double share) { bar.show(share, "writing tiles"); }));
    ORO_CHECK(folder.commit());
    kept.remove();
    bar.clear();
    say_notes(region, options.quiet);
    for (const std::string& note : facts.front()->notes()) say(options.quiet, "note: " + note);
    tell_tileset(options, region, written);
    return {};
}

}  // namespace

Result<void> export_3d_tiles(const ExportOptions& options, const Region& region, ProgressBar& bar) {
    ORO_CHECK(check_posts(region));
    ORO_TRY(const FactsOfGrids facts, facts_of(options, region));
    ORO_TRY(const std::unique_ptr<RegionTiles> tiles, RegionTiles::of(region, thread_count()));
    lay_facts(options, facts, tiles->ground);
    watch_grounds(region, bar, tiles->ground);
    TilesetRequest asked = request_of(options, region);
    ORO_TRY(const Shard shard, parse_shard(options.shard));
    if (options.shard.empty()) return write_whole(options, region, *tiles, asked, facts, bar);
    const std::string kept_folder = options.out + ".tiles";
    ORO_TRY(const KeptTiles kept, KeptTiles::open(kept_folder, key_of(region, *tiles, asked, facts)));
    asked.kept = &kept;
    asked.part = static_cast<int>(shard.number - 1);
    asked.parts = static_cast<int>(shard.count);
    ORO_TRY(const std::uint64_t made,
            make_tiles(tiles->ground, asked, [&](double share) { bar.show(share, "writing tiles"); }));
    bar.clear();
    tell_part(options, kept_folder, shard, made);
    return {};
}

}  // namespace oro
