// orograph export: heights in the formats of others.
#include <filesystem>

#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/commands/export/exported_region.h"
#include "apps/commands/export/post_layer.h"
#include "apps/options/region_option_table.h"
#include "apps/options/shard.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/different_words.h"
#include "apps/report/figures.h"
#include "apps/report/region_json.h"
#include "apps/view/view.h"
#include "geo/files/letter_case.h"
#include "geo/files/numbered_tiles.h"
#include "geo/files/whole_folder.h"
#include "geo/opening/open_region.h"
#include "geo/sources/notes.h"
#include "geo/sources/source_words.h"
#include "geo/together/covered_grids.h"

namespace oro {
namespace {

// One of triangles, which have colours, and meshes beside the ground.
bool is_mesh_format(const std::string& to) {
    return to == "3dtiles" || to == "gltf";
}

Result<void> check_file(const ExportOptions& options) {
    const std::string name = lower_case(options.out);
    if (options.to == "gltf" && !name.ends_with(".glb"))
        return refused("--out", options.out, "the file's name must end in .glb");
    if (options.to == "cog" && !name.ends_with(".tif") && !name.ends_with(".tiff"))
        return refused("--out", options.out, "the file's name must end in .tif");
    return check_may_write(options.out, options.overwrite);
}

Result<void> check_words(const ExportOptions& options) {
    if (!options.to)
        return refused("--to", "", "is missing: choose cog, terrain-rgb, 3dtiles, quantized-mesh or gltf");
    if (options.out.empty())
        return refused("--out", "",
                       *options.to == "cog"    ? "is missing: name the file to write (.tif)"
                       : *options.to == "gltf" ? "is missing: name the file to write (.glb)"
                                               : "is missing: name the folder to write");
    const bool has_zooms = *options.to == "terrain-rgb" || *options.to == "quantized-mesh";
    const char* const needed = "needs --to terrain-rgb or quantized-mesh";
    if (options.zoom && !has_zooms) return refused("--zoom", *options.zoom, needed);
    if (options.hole_height_m && !has_zooms) return refused("--hole-height", "", needed);
    if (options.max_error_m && !is_mesh_format(*options.to))
        return refused("--max-error", all_digits(*options.max_error_m), "needs --to gltf or 3dtiles");
    if (options.no_normals && *options.to != "3dtiles")
        return refused("--no-normals", "", "needs --to 3dtiles");
    if (options.detail && *options.to != "cog")
        return refused("--detail", std::to_string(*options.detail), "needs --to cog");
    if (!options.shard.empty() && (*options.to == "cog" || *options.to == "gltf"))
        return refused("--shard", options.shard, "needs --to 3dtiles, quantized-mesh or terrain-rgb");
    if (const Result<Shard> shard = parse_shard(options.shard); !shard.ok()) return shard.error();
    if (!options.drape.empty() && !is_mesh_format(*options.to))
        return refused("--drape", options.drape.front(), "needs --to 3dtiles or gltf");
    ORO_CHECK(check_layer_words(options));
    if (!options.landcover.empty() && !is_mesh_format(*options.to) && options.canopy.empty())
        return refused("--landcover", options.landcover.front(),
                       "needs --to 3dtiles or gltf, or --canopy class");
    if (!options.landcover.empty() && !options.drape.empty())
        return refused("--landcover", options.landcover.front(),
                       "colours the ground, and so does --drape: give one");
    constexpr double most_error_m = 100000.0;
    if (const double error_m = options.max_error_m.value_or(0.0);
        !(error_m >= 0.0 && error_m <= most_error_m))
        return refused("--max-error", all_digits(error_m), between_words(0.0, most_error_m));
    if (*options.to == "cog" || *options.to == "gltf") return check_file(options);
    if (*options.to == "3dtiles") return check_folder(options.out, options.overwrite, ".glb", "tileset.json");
    ORO_CHECK(check_zoom(options));
    return *options.to == "terrain-rgb"
               ? check_folder(options.out, options.overwrite, ".png", "tiles.json")
               : check_folder(options.out, options.overwrite, ".terrain", "layer.json");
}

}  // namespace

Result<void> check_folder(const std::string& out, bool overwrite, const std::string& extension,
                          const std::string& index) {
    std::error_code ignored;
    if (overwrite && std::filesystem::is_directory(out, ignored))
        ORO_CHECK(check_holds_tiles_alone(out, extension, index,
                                          extension == ".glb" ? std::vector<std::string>{"between", "meshes"}
                                                              : std::vector<std::string>{}));
    // Whether it can be written at all.
    ORO_TRY(const WholeFolder trial, WholeFolder::create(out, overwrite));
    return {};
}

std::string heights_words(const Region& region) {
    DifferentWords geoids;
    for (const RegionGrid& grid : region.grids) geoids.add(grid.geoid);
    return "H, above the geoid " + geoids.all();
}

std::string source_heights_words(const Region& region) {
    DifferentWords datums;
    for (const RegionGrid& grid : region.grids)
        for (const SourceReport& source : grid.sources) datums.add(datum_words(source.vertical_datum));
    return datums.all();
}

Result<void> run_export(const ExportOptions& options) {
    ORO_CHECK(check_words(options));
    if (!is_mesh_format(*options.to))
        ORO_CHECK(check_without_meshes(options.region,
                                       "goes into 3D Tiles and models alone (--to 3dtiles or gltf)"));
    ORO_TRY(const RegionRequest request, region_request(options.region));
    ORO_TRY(const PostLayer layer, open_post_layer(options));
    ProgressBar bar(options.quiet);
    ORO_TRY(Region region, open_region(request, bar.progress()));
    leave_covered_grids_out(region);
    if (!is_mesh_format(*options.to) && region.meshes && !region.meshes->empty())
        add_note(region.grids.front().notes,
                 counted(region.meshes->size(), "mesh", "meshes") + " of this baked region " +
                     (region.meshes->size() == 1 ? "is" : "are") +
                     " left out: meshes go into 3D Tiles and models alone (--to 3dtiles or gltf)");
    ORO_CHECK(spare_inputs({options.out}, {files_of_ground(options.region.paths, region),
                                           {request.meshes.files, "which the meshes are in"},
                                           {options.drape, "which the colours are in"},
                                           {options.landcover, "which the land cover is in"}}));
    if (layer.canopy) ORO_CHECK(spare_inputs({options.out}, {{layer.files(), "which the canopy is in"}}));
    if (*options.to == "cog") return export_cog(options, region, layer, bar);
    if (*options.to == "gltf") return export_gltf(options, region, bar);
    if (*options.to == "3dtiles") return export_3d_tiles(options, region, bar);
    if (*options.to == "quantized-mesh") return export_quantized_mesh(options, region, bar);
    return export_terrain_rgb(options, region, bar);
}

}  // namespace oro
