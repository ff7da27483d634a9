// What a raster has no values for although it gives some: gaps of a mosaic, and blocks that were never
// written. GDAL reads both as 0.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geo/files/raster_library.h"
#include "geo/sources/source.h"

namespace oro {

// One file that a VRT's band is made of.
struct VrtPart {
    std::string file;  // as GDAL's file system opens it
    int band{1};
    bool is_plain{};                // its values are the VRT's, all of them, pixel by pixel or resampled
    bool changes_values{};          // they are scaled, looked up, or mixed by resampling
    bool is_masked{};               // only some of its pixels are painted: those that its mask has, or
    std::optional<double> no_data;  // those with another value
    // Corners and sizes in pixels, of its own raster and of the VRT's.
    double own_column{}, own_row{}, own_columns{}, own_rows{};
    double column{}, row{}, columns{}, rows{};
};

// What a band of a VRT is made of, in the order of painting, later parts over earlier ones. Nothing for
// rasters of other formats, and where a VRT computes its values otherwise (a warp, say).
std::vector<VrtPart> parts_of_vrt_band(GDALDatasetH dataset, int band);

// The file that a warped VRT takes a band's values from; only file, band and changes_values are set. Nothing
// for all others.
std::optional<VrtPart> source_of_warped_vrt(GDALDatasetH dataset, int band);

// Rectangles of a window of a band, by the raster's own rows and columns, that hold no values: between the
// sources of a VRT, where all that would be painted is no data in its sources, outside the source of a warped
// VRT, and in blocks of a TIFF that are not in the file; those of a VRT's sources, too. Nothing where a band
// declares a no-data value, which then stands there. They do not overlap.
std::vector<PostWindow> unwritten_parts(GDALDatasetH dataset, int band, const PostWindow& window);

}  // namespace oro
