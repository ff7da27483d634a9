// Values at the posts of a region as a GeoTIFF on the region's own grid: of latitudes and longitudes, or in
// the CRS of its sources.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/grid_part.h"
#include "core/terrain/post_grid.h"
#include "geo/files/whole_file.h"
#include "geo/region/region.h"

namespace oro {

struct PostRaster {
    struct Band {
        std::string name;
        std::vector<float> values;  // row by row, from the north-west
        const char* unit{"metre"};  // of a Cloud Optimized GeoTIFF
    };
    PostGrid grid;
    std::optional<PostsCrs> crs;  // where its posts lie in it; of a grid on a net
    GridPart part;                // that it has; longitudes may run past 180
    std::vector<Band> bands;
    float no_value{};
    bool fractions{};  // values are of a kind that has fractions, also where none happens to have any
    std::vector<std::pair<std::string, std::string>> tags;  // of the file, for people: names in capitals
};

// GDAL's transform of a raster of a grid's posts, from columns and rows to EPSG:4326 or the posts' CRS: of
// the corners of cells, whose middles are the posts.
std::array<double, 6> transform_of_posts(const PostGrid& grid, const std::optional<PostsCrs>& crs,
                                         const GridPart& part);

// The file has all of the raster, and gets its name by commit(), or with others by commit_together():
// Float32, compressed (DEFLATE), in EPSG:4326 or the posts' CRS; each post is the middle of a cell. Errors:
// those of WholeFile; what GDAL cannot write (a full disk).
Result<WholeFile> written_post_raster(const std::string& path, bool overwrite, const PostRaster& raster);
// The same, whole or not at all. Errors: the same.
Result<void> write_post_raster(const std::string& path, bool overwrite, const PostRaster& raster);

}  // namespace oro
