// What export writes of, and the two formats that it writes.
#pragma once

#include <memory>
#include <string>

#include "apps/options/export_options.h"
#include "apps/report/progress_bar.h"
#include "core/base/result.h"
#include "geo/region/region.h"

namespace oro {

// What heights are counted from: "H, above the geoid EGM96 (egm96_15.gtx)"; of several grids each once.
std::string heights_words(const Region& region);
// What the sources say that theirs are counted from, each once, joined by "; ".
std::string source_heights_words(const Region& region);

// Writes H of a region's one grid as a Cloud Optimized GeoTIFF, and tells so on standard output. Errors
// (usage): several grids, or more posts than go into memory at once; those of write_cloud_raster().
Result<void> export_cog(const ExportOptions& options, const Region& region, ProgressBar& bar);
// Writes the ground of a region as tiles of a web map with a tiles.json, measures their error, and tells it
// on standard output. Errors (usage): zooms that are none, or too many tiles; those of WholeFolder and
// write_terrain_tiles().
Result<void> export_terrain_rgb(const ExportOptions& options, const Region& region, ProgressBar& bar);
// Refuses zooms that are none before anything is read.
Result<void> check_zoom(const ExportOptions& options);

}  // namespace oro
