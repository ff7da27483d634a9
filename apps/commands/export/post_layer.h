// What a GeoTIFF of a region has at each of its posts.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/options/export_options.h"
#include "core/base/result.h"
#include "geo/canopy/canopy_map.h"
#include "geo/rasters/post_raster.h"
#include "geo/region/region.h"

namespace oro {

// What a raster of posts holds where there is no value.
inline constexpr float no_post_value = -32768.0F;

// What --layer names, with the files that it needs open.
struct PostLayer {
    std::string name{"H"};                    // H, slope or canopy
    std::shared_ptr<const CanopyMap> canopy;  // of canopy alone
    // Of the files that it was opened from, and of their directories.
    [[nodiscard]] std::vector<std::string> files() const;
};

// Refuses words that do not fit together, before any file is read. Errors (usage): --layer without cog;
// canopy without --canopy, and --canopy without it; ground between posts with another layer than H.
Result<void> check_layer_words(const ExportOptions& options);
// Opens the files of the layer. Errors: those of open_cover() and open_canopy().
Result<PostLayer> open_post_layer(const ExportOptions& options);

// The layer's values at the posts of a region's first grid, row by row from the north-west, with its name,
// unit and tags. H: metres above the geoid, the data's own values. slope: degrees, 0 to 90, of H by Horn's
// formula over the eight posts around (horn_slope_deg()). canopy: metres, 0 or more. Posts without a value
// hold no_post_value; of slope and canopy those are also the posts without a height. Errors: damage in a
// baked region; those of CanopyMap::heights_around().
Result<PostRaster> raster_of_layer(const Region& region, const PostLayer& layer);

}  // namespace oro
