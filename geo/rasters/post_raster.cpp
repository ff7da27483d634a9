#include "geo/rasters/post_raster.h"

#include <cpl_string.h>
#include <gdal.h>

#include <array>
#include <cstdio>

#include "geo/files/raster_library.h"
#include "geo/rasters/post_raster_place.h"

namespace oro {
namespace {

// GDAL says that it cannot write, and not why (a full disk, a limit): the system says it of a few bytes more,
// at the end of the file that will not be kept.
Error fault_of_writing(WholeFile& file, const std::string& path, const std::string& words) {
    const std::string more(std::size_t{1} << 16U, '\0');
    if (std::fseek(file.stream(), 0, SEEK_END) == 0) {
        if (Result<void> written = file.write(more.data(), more.size()); !written.ok())
            return written.error();
        if (Result<void> settled = file.settle(); !settled.ok()) return settled.error();
    }
    return Error{ErrorKind::failed, path, "cannot be written: " + words};
}

// False: GDAL has said why not, as far as it says it.
bool fill(GDALDatasetH dataset, const PostRaster& raster) {
    if (!place_posts(dataset, raster)) return false;
    for (std::size_t i = 0; i < raster.bands.size(); ++i) {
        const GDALRasterBandH band = GDALGetRasterBand(dataset, static_cast<int>(i) + 1);
        GDALSetDescription(band, raster.bands[i].name.c_str());
        GDALSetRasterNoDataValue(band, static_cast<double>(raster.no_value));
    }
    for (std::size_t i = 0; i < raster.bands.size(); ++i) {
        const GDALRasterBandH band = GDALGetRasterBand(dataset, static_cast<int>(i) + 1);
        // GDAL writes from it, and takes no pointer to const.
        auto* const values = const_cast<float*>(raster.bands[i].values.data());
        if (GDALRasterIO(band, GF_Write, 0, 0, raster.part.columns, raster.part.rows, values,
                         raster.part.columns, raster.part.rows, GDT_Float32, 0, 0) != CE_None)
            return false;
    }
    GDALFlushCache(dataset);
    return true;
}

}  // namespace

std::array<double, 6> transform_of_posts(const PostGrid& grid, const std::optional<PostsCrs>& crs,
                                         const GridPart& part) {
    if (crs) {
        const auto& m = crs->crs_from_post;
        const double column = part.first_column - 0.5, row = part.first_row - 0.5;
        return {m[0] + m[1] * column + m[2] * row, m[1], m[2], m[3] + m[4] * column + m[5] * row, m[4], m[5]};
    }
    const double wide_deg = grid.lon.spacing_deg(), tall_deg = grid.lat.spacing_deg();
    return {grid.lon.at_deg(part.first_column) - 0.5 * wide_deg, wide_deg, 0.0,
            grid.lat.at_deg(part.first_row) + 0.5 * tall_deg,    0.0,      -tall_deg};
}

bool place_posts(void* dataset, const PostRaster& raster) {
    std::array<double, 6> corners = transform_of_posts(raster.grid, raster.crs, raster.part);
    if (GDALSetGeoTransform(dataset, corners.data()) != CE_None) return false;
    const SpatialReference crs = raster.crs ? spatial_reference(raster.crs->wkt) : wgs84_degrees();
    if (!crs || GDALSetSpatialRef(dataset, crs.get()) != CE_None) return false;
    for (const auto& [name, value] : raster.tags)
        GDALSetMetadataItem(dataset, name.c_str(), value.c_str(), nullptr);
    GDALSetMetadataItem(dataset, "AREA_OR_POINT", "Point", nullptr);
    return true;
}

Result<WholeFile> written_post_raster(const std::string& path, bool overwrite, const PostRaster& raster) {
    start_gdal();
    ORO_TRY(WholeFile file, WholeFile::create(path, overwrite));
    // By its descriptor: it has no name yet.
    const std::string nameless = "/proc/self/fd/" + std::to_string(fileno(file.stream()));
    const GdalMessages messages;
    CPLStringList options;
    for (const char* option :
         {"COMPRESS=DEFLATE", "ZLEVEL=1", "PREDICTOR=3", "TILED=YES", "BIGTIFF=IF_SAFER"})
        options.AddString(option);
    // Bands are written one after the other: of many, tiles that hold all of them would be packed again and
    // again.
    constexpr std::size_t few_bands = 4;
    if (raster.bands.size() > few_bands) options.AddString("INTERLEAVE=BAND");
    Dataset dataset(GDALCreate(GDALGetDriverByName("GTiff"), nameless.c_str(), raster.part.columns,
                               raster.part.rows, static_cast<int>(raster.bands.size()), GDT_Float32,
                               options.List()));
    if (!dataset)
        return Error{ErrorKind::failed, path, "cannot be written: " + messages.last("GDAL says no more")};
    const bool filled = fill(dataset.get(), raster);
    dataset.reset();
    if (const std::string fault = messages.last(""); !filled || !fault.empty())
        return fault_of_writing(file, path, fault.empty() ? "GDAL says no more" : fault);
    return file;
}

Result<void> write_post_raster(const std::string& path, bool overwrite, const PostRaster& raster) {
    ORO_TRY(WholeFile file, written_post_raster(path, overwrite, raster));
    return file.commit();
}

}  // namespace oro
