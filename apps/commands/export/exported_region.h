// What export writes of, and the formats that it writes.
#pragma once

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "apps/options/export_options.h"
#include "apps/options/shard.h"
#include "apps/report/progress_bar.h"
#include "core/base/result.h"
#include "geo/region/region.h"
#include "geo/tilesets/glb.h"
#include "geo/tilesets/mesh_palette.h"
#include "geo/web_maps/terrain_tiles.h"

namespace oro {

struct PostLayer;

// What heights are counted from: "H, above the geoid EGM96 (egm96_15.gtx)"; of several grids each once.
std::string heights_words(const Region& region);
// What the sources say that theirs are counted from, each once, joined by "; ".
std::string source_heights_words(const Region& region);

// Writes a layer of a region's one grid as a Cloud Optimized GeoTIFF, and tells so on standard output. Errors
// (usage): several grids, or more posts than go into memory at once; those of raster_of_layer() and
// write_cloud_raster().
Result<void> export_cog(const ExportOptions& options, const Region& region, const PostLayer& layer,
                        ProgressBar& bar);
// Writes the ground of a region as tiles of a web map with a tiles.json, measures their error, and tells it
// on standard output. Errors (usage): zooms that are none, or too many tiles; those of WholeFolder and
// write_terrain_tiles().
Result<void> export_terrain_rgb(const ExportOptions& options, const Region& region, ProgressBar& bar);
// Writes the ground of a region as 3D Tiles whose errors are proven, and tells them on standard output.
// Errors (usage): too many posts; those of WholeFolder, RegionTiles::of() and write_tileset().
Result<void> export_3d_tiles(const ExportOptions& options, const Region& region, ProgressBar& bar);
// Writes the ground of a region's one grid and the meshes on it as one model, and tells how far it is from
// the ground at most. Errors (usage): several grids, too many triangles; those of ExportedFacts and
// WholeFile.
Result<void> export_gltf(const ExportOptions& options, const Region& region, ProgressBar& bar);
// What meshes of the ground look like, and whose they are.
GlbLook look_of(const Region& region);
// What meshes on the ground are coloured with.
MeshPalette palette_of_meshes();
// Refuses several grids where what is written is made of one.
Result<void> check_one_grid(const ExportOptions& options, const Region& region);
// Refuses a folder that cannot be written, before anything is read; with `overwrite` also one that holds more
// than tiles with that extension and the file `index`.
Result<void> check_folder(const std::string& out, bool overwrite, const std::string& extension,
                          const std::string& index);
// Writes the ground of a region as tiles of terrain for globes with a layer.json, measures their error, and
// tells it on standard output. Errors: as export_terrain_rgb().
Result<void> export_quantized_mesh(const ExportOptions& options, const Region& region, ProgressBar& bar);

// LOW:HIGH. Errors (usage): what is no such range.
Result<ZoomRange> zooms_from(const std::string& text);
// Refuses zooms and heights of holes that are none before anything is read.
Result<void> check_zoom(const ExportOptions& options);
// All that the bytes of tiles of a web map or globe depend on, the program's version among it.
std::string key_of_web_tiles(const Region& region, const std::string& format, const ZoomRange& zooms,
                             double hole_H_m);
// Tells on standard output that a part of the tiles is kept in a folder.
void tell_part(const ExportOptions& options, const std::string& folder, const Shard& shard,
               std::uint64_t tiles);
// Most tiles of a web map or globe.
inline constexpr double most_web_tiles = 4.0e6;
// Of each zoom, how far random places were from the ground; and the same as lines for people.
inline constexpr int measured_places = 10000;
nlohmann::ordered_json errors_json(const std::vector<ZoomError>& errors);
void tell_errors(const std::vector<ZoomError>& errors);
// What there is of the map: west, south, east, north, within limit_deg of the equator. TileJSON lets no box
// cross 180 degrees.
std::vector<double> bounds_of(const Region& region, double limit_deg);

}  // namespace oro
