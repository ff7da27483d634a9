#include "geo/posts/voids.h"

#include <cpl_string.h>
#include <gdal_alg.h>

#include <array>
#include <cstdio>

#include "geo/files/raster_library.h"

namespace oro {
namespace {

constexpr double reach_posts = 100.0;
// What a post holds that GDALFillNodata found no neighbour for.
constexpr float not_filled = -32768.0F;

}  // namespace

Result<std::uint64_t> fill_voids(JoinedSurface& surface, const PostGrid& grid) {
    start_gdal();
    const GdalMessages messages;
    std::vector<float> heights = surface.heights();
    std::vector<unsigned char> known(heights.size());
    for (std::size_t i = 0; i < heights.size(); ++i) {
        known[i] = is_void(heights[i]) ? 0 : 255;
        if (!known[i]) heights[i] = not_filled;
    }
    const Dataset target = dataset_over(heights.data(), GDT_Float32, grid.columns(), grid.rows());
    const Dataset mask = dataset_over(known.data(), GDT_Byte, grid.columns(), grid.rows());
    const char* const options[] = {"TEMP_FILE_DRIVER=MEM", "NODATA=-32768", nullptr};
    if (!target || !mask ||
        GDALFillNodata(GDALGetRasterBand(target.get(), 1), GDALGetRasterBand(mask.get(), 1), reach_posts, 0,
                       0, const_cast<char**>(options), nullptr, nullptr) != CE_None)
        return Error{ErrorKind::failed, "filling voids", messages.last("GDALFillNodata failed")};
    GDALFlushCache(target.get());
    GDALFlushCache(mask.get());
    std::uint64_t filled = 0;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        float& height = surface.heights()[i];
        if (!is_void(height) || !surface.covered(i) || heights[i] == not_filled) continue;
        height = heights[i];
        ++filled;
    }
    return filled;
}

}  // namespace oro
