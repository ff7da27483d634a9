// What unit a raster's heights count in, from all that says it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/datum/vertical_datum.h"
#include "geo/files/raster_library.h"
#include "geo/sources/length_unit.h"
#include "geo/sources/source.h"

namespace oro {

// What a GeoTIFF says of its heights in tags that GDAL passes over or mixes with others.
struct GeoTiffHeights {
    std::optional<int> vertical_unit;  // GeoKey 4099 (VerticalUnitsGeoKey): a code of EPSG's, 9003
    bool band_has_unit{};              // its GDAL metadata (tag 42112) state a unit of the band's own
};
// Of the first directory of a TIFF or BigTIFF, by its name in GDAL's file system; nothing of other files.
GeoTiffHeights geotiff_heights(const std::string& file);

// Zunits of an Arc/Info .prj file beside a raster: the metres in its unit of heights; nothing where there is
// no such file or line, or it says NO. Errors (a reason, without the file's name): a word that is no unit of
// height.
Result<std::optional<double>> metres_of_zunits(const std::string& raster_file);

// Puts unit, scale and offset of a band into a source. By precedence: what was told (`specified_unit`); the
// band's own unit; GeoKey 4099, of the file or of all GeoTIFFs that a VRT is made of (`parts`); the vertical
// CRS; Zunits; else metres are assumed. `doubts` get what a user must know: that two of them contradict each
// other; that nothing says it although the CRS counts in another unit than metres. Errors (a reason, without
// the file's name): a unit that is none of heights; usage for one that was told.
struct HeightUnitSays {
    const StatedDatum& datum;
    OGRSpatialReferenceH horizontal;
    const std::string& specified_unit;
    const std::vector<std::string>& parts;
};
Result<void> read_height_unit(Source& source, GDALDatasetH dataset, const HeightUnitSays& says,
                              std::vector<std::string>& doubts);

}  // namespace oro
