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

// A raster over memory that is ours.
Dataset over(void* data, GDALDataType type, const PostGrid& grid) {
    const GDALDriverH memory = GDALGetDriverByName("MEM");
    if (!memory) return nullptr;
    Dataset dataset(GDALCreate(memory, "", grid.columns(), grid.rows(), 0, type, nullptr));
    if (!dataset) return nullptr;
    std::array<char, 64> pointer{};
    CPLPrintPointer(pointer.data(), data, static_cast<int>(pointer.size()) - 1);
    const std::string option = std::string("DATAPOINTER=") + pointer.data();
    const char* const options[] = {option.c_str(), nullptr};
    if (GDALAddBand(dataset.get(), type, const_cast<char**>(options)) != CE_None) return nullptr;
    return dataset;
}

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
    const Dataset target = over(heights.data(), GDT_Float32, grid);
    const Dataset mask = over(known.data(), GDT_Byte, grid);
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
