#include "geo/rasters/layer_raster.h"

#include <cpl_string.h>
#include <gdal.h>

#include <cstdio>
#include <limits>

#include "geo/files/raster_library.h"

namespace oro {
namespace {

bool fill(GDALDatasetH dataset, const LayerRaster& raster) {
    for (const auto& [name, value] : raster.tags)
        GDALSetMetadataItem(dataset, name.c_str(), value.c_str(), nullptr);
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    GDALSetDescription(band, raster.what.c_str());
    if (!raster.unit.empty()) GDALSetRasterUnitType(band, raster.unit.c_str());
    GDALSetRasterNoDataValue(band, std::numeric_limits<double>::quiet_NaN());
    const auto write = [&](auto values, GDALDataType type) {
        // GDAL writes from it, and takes no pointer to const.
        auto* const bytes =
            const_cast<std::remove_const_t<typename decltype(values)::element_type>*>(values.data());
        return GDALRasterIO(band, GF_Write, 0, 0, raster.width_px, raster.height_px, bytes, raster.width_px,
                            raster.height_px, type, 0, 0) == CE_None;
    };
    if (const auto* floats = std::get_if<std::span<const float>>(&raster.values))
        return write(*floats, GDT_Float32);
    return write(std::get<std::span<const double>>(raster.values), GDT_Float64);
}

}  // namespace

Result<WholeFile> layer_raster(const std::string& path, bool overwrite, const LayerRaster& raster) {
    start_gdal();
    ORO_TRY(WholeFile file, WholeFile::create(path, overwrite));
    // By its descriptor: it has no name yet.
    const std::string nameless = "/proc/self/fd/" + std::to_string(fileno(file.stream()));
    const GdalMessages messages;
    const auto failed = [&] {
        return Error{ErrorKind::failed, path, "cannot be written: " + messages.last("GDAL says no more")};
    };
    CPLStringList options;
    for (const char* option :
         {"COMPRESS=DEFLATE", "ZLEVEL=6", "PREDICTOR=3", "TILED=YES", "BIGTIFF=IF_SAFER"})
        options.AddString(option);
    const bool doubles = std::holds_alternative<std::span<const double>>(raster.values);
    Dataset dataset(GDALCreate(GDALGetDriverByName("GTiff"), nameless.c_str(), raster.width_px,
                               raster.height_px, 1, doubles ? GDT_Float64 : GDT_Float32, options.List()));
    if (!dataset || !fill(dataset.get(), raster)) return failed();
    dataset.reset();
    if (!messages.last("").empty()) return failed();
    return file;
}

}  // namespace oro
