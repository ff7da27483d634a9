#include "geo/drape/raster_opening.h"

#include <cpl_string.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/base/checksum.h"
#include "core/base/open_file.h"
#include "geo/sources/raster_crs.h"
#include "geo/sources/raster_parts.h"

namespace oro {
namespace {

Error reason(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

}  // namespace

Result<Dataset> open_dataset(PlacedRaster& raster, const GdalMessages& messages) {
    ORO_TRY(const RasterParts parts, parts_of_raster(raster.file));
    Dataset dataset(GDALOpenEx(raster.file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                               trusted_drivers(), nullptr, nullptr));
    if (!dataset)
        return reason("is not an image in an accepted format (" + trusted_formats() +
                      "): " + messages.last("unknown format"));
    raster.columns = GDALGetRasterXSize(dataset.get());
    raster.rows = GDALGetRasterYSize(dataset.get());
    raster.files = parts.files;
    const CPLStringList listed(GDALGetFileList(dataset.get()));
    for (int i = 0; i < listed.size(); ++i) {
        const std::string file = local_file_of(listed[i]);
        if (std::ranges::find(raster.files, file) == raster.files.end()) raster.files.push_back(file);
    }
    for (const std::string& doubt : parts.doubts) raster.notes.push_back(raster.file + ": " + doubt);
    return dataset;
}

Dataset held_dataset(const PlacedRaster& raster) {
    return dataset_over(raster.held->data(), GDT_UInt16, raster.columns, raster.rows);
}

Result<void> place_raster(PlacedRaster& raster, GDALDatasetH dataset) {
    ORO_TRY(const SpatialReference crs, crs_of(dataset));
    auto& m = raster.crs_from_pixel;
    if (GDALGetGeoTransform(dataset, m.data()) != CE_None)
        return reason("states no georeference: where its pixels lie is unknown");
    const double area = m[1] * m[5] - m[2] * m[4];
    const bool finite = std::ranges::all_of(m, [](double value) { return std::isfinite(value); });
    if (!finite || area == 0.0 || !GDALInvGeoTransform(m.data(), raster.pixel_from_crs.data()))
        return reason("its georeference is no map from pixels to places");
    const SpatialReference horizontal = horizontal_part(crs.get());
    raster.crs = crs_name(horizontal.get());
    raster.crs_wkt = wkt_of(horizontal.get());
    raster.geographic = OSRIsGeographic(horizontal.get()) != 0;
    return {};
}

Error with_file(const std::string& file, const Error& error) {
    return {error.kind, error.where.empty() ? file : file + ": " + error.where, error.what};
}

Result<std::uint64_t> files_fingerprint(const std::vector<std::string>& files) {
    constexpr std::uint64_t piece = std::uint64_t{1} << 20U, whole = 256 * piece, places = 64;
    std::vector<std::byte> bytes(piece);
    RunningChecksum sum;
    for (const std::string& name : files) {
        ORO_TRY(const OpenFile file, OpenFile::open(name, OpenFile::Use::read));
        ORO_TRY(const std::uint64_t size, file.size());
        sum.add(std::as_bytes(std::span(&size, 1)));
        const std::uint64_t step = size <= whole ? piece : (size - piece) / places;
        for (std::uint64_t at = 0; at < size; at += step) {
            const std::span<std::byte> part = std::span(bytes).first(std::min(piece, size - at));
            ORO_CHECK(file.read(at, part));
            sum.add(part);
        }
    }
    return sum.sum();
}

}  // namespace oro
