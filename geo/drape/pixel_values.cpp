#include "geo/drape/pixel_values.h"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "geo/files/guarded_files.h"

namespace oro {
namespace {

// The middle of a raster's longitudes, where it has some: places are looked for in the turn around it.
double middle_lon_deg(const PlacedRaster& raster) {
    const auto& m = raster.crs_from_pixel;
    return m[0] + 0.5 * (m[1] * raster.columns + m[2] * raster.rows);
}

// False beyond the raster.
bool pixel_at(const PlacedRaster& raster, const PixelPlace& place, PixelValue& pixel) {
    if (!place.there()) return false;
    const double x = std::floor(place.column), y = std::floor(place.row);
    if (!(x >= 0.0 && y >= 0.0 && x < raster.columns && y < raster.rows)) return false;
    pixel.column = static_cast<int>(x);
    pixel.row = static_cast<int>(y);
    return true;
}

Result<void> read_each(const PlacedRaster& raster, GDALDatasetH dataset, std::span<const PixelPlace> places,
                       const PixelSink& sink) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    const GdalMessages messages;
    const FileWatch watch(reading_limit_s);
    for (std::size_t i = 0; i < places.size(); ++i) {
        PixelValue pixel{i};
        if (!pixel_at(raster, places[i], pixel)) continue;
        const bool is_read =
            band != nullptr && GDALRasterIO(band, GF_Read, pixel.column, pixel.row, 1, 1, &pixel.value, 1, 1,
                                            GDT_Float64, 0, 0) == CE_None;
        if (!is_read || !watch.fault().empty())
            return Error{ErrorKind::failed, raster.file,
                         !watch.fault().empty() ? watch.fault()
                                                : "cannot be read near row " + std::to_string(pixel.row) +
                                                      ": " + messages.last("the file is damaged")};
        ORO_CHECK(sink(pixel));
    }
    return {};
}

}  // namespace

Result<void> read_pixels_at(const PlacedRaster& raster, const SharedRaster& shared,
                            std::span<const double> lat_deg, std::span<const double> lon_deg,
                            const PixelSink& sink) {
    ORO_TRY(OpenRaster open, shared.take());
    std::vector<double> x(lon_deg.begin(), lon_deg.end()), y(lat_deg.begin(), lat_deg.end());
    std::vector<PixelPlace> places;
    open.placing.place(x, y, raster.geographic ? middle_lon_deg(raster) : 0.0, places);
    ORO_CHECK(read_each(raster, open.dataset.get(), places, sink));
    shared.give_back(std::move(open));
    return {};
}

}  // namespace oro
