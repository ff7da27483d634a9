// Small elevation files that tests write for themselves.
#pragma once

#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_srs_api.h>
#include <algorithm>

#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geo/files/raster_library.h"
#include "geo/region/region.h"
#include "tests/support/open_grid.h"

namespace oro::test {

// A height for each post, by row (from the north) and column (from the west).
using HeightOfPost = std::function<double(int row, int column)>;

// Bytes of a .hgt tile with `side` posts a side.
inline std::vector<unsigned char> hgt_bytes(int side, const HeightOfPost& height) {
    std::vector<unsigned char> bytes;
    bytes.reserve(static_cast<std::size_t>(2 * side * side));
    for (int r = 0; r < side; ++r) {
        for (int c = 0; c < side; ++c) {
            const auto value = static_cast<std::uint16_t>(static_cast<std::int16_t>(height(r, c)));
            bytes.push_back(static_cast<unsigned char>(value >> 8));
            bytes.push_back(static_cast<unsigned char>(value & 255));
        }
    }
    return bytes;
}

// Writes through GDAL's virtual files: a plain path, /vsizip/FILE.zip/ENTRY or /vsigzip/FILE.gz.
inline std::string write_bytes(const std::string& file, const std::vector<unsigned char>& bytes) {
    VSILFILE* const stream = VSIFOpenL(file.c_str(), "wb");
    if (!stream) return "";
    VSIFWriteL(bytes.data(), 1, bytes.size(), stream);
    VSIFCloseL(stream);
    return file;
}

inline std::string write_hgt(const std::filesystem::path& file, int side, const HeightOfPost& height) {
    return write_bytes(file.string(), hgt_bytes(side, height));
}

// What a GeoTIFF to be written is.
struct Raster {
    int rows{};
    int columns{};
    std::array<double, 6> cell_corners{};  // GDAL's geotransform
    std::string crs{"EPSG:4326"};          // "" for none
    GDALDataType type{GDT_Float32};
    int bands{1};
    bool points{false};
    std::string unit;
    std::optional<double> no_data;
    std::optional<double> scale, offset;
    std::string copyright;
    std::string format{"GTiff"};
    double epoch{0.0};  // of the coordinates, a year; 0: not stated
};

inline std::string write_raster(const std::filesystem::path& file, const Raster& raster,
                                const HeightOfPost& height) {
    start_gdal();
    GDALDriverH const driver = GDALGetDriverByName(raster.format.c_str());
    const GDALDatasetH dataset =
        GDALCreate(driver, file.c_str(), raster.columns, raster.rows, raster.bands, raster.type, nullptr);
    std::array<double, 6> corners = raster.cell_corners;
    if (raster.points) GDALSetMetadataItem(dataset, "AREA_OR_POINT", "Point", nullptr);
    GDALSetGeoTransform(dataset, corners.data());
    if (!raster.crs.empty()) {
        const OGRSpatialReferenceH crs = OSRNewSpatialReference(nullptr);
        OSRSetFromUserInput(crs, raster.crs.c_str());
        if (raster.epoch > 0.0) OSRSetCoordinateEpoch(crs, raster.epoch);
        GDALSetSpatialRef(dataset, crs);
        OSRDestroySpatialReference(crs);
    }
    if (!raster.copyright.empty())
        GDALSetMetadataItem(dataset, "TIFFTAG_COPYRIGHT", raster.copyright.c_str(), nullptr);
    std::vector<double> row(static_cast<std::size_t>(raster.columns));
    for (int b = 1; b <= raster.bands; ++b) {
        const GDALRasterBandH band = GDALGetRasterBand(dataset, b);
        if (!raster.unit.empty()) GDALSetRasterUnitType(band, raster.unit.c_str());
        if (raster.no_data) GDALSetRasterNoDataValue(band, *raster.no_data);
        if (raster.scale) GDALSetRasterScale(band, *raster.scale);
        if (raster.offset) GDALSetRasterOffset(band, *raster.offset);
        for (int r = 0; r < raster.rows; ++r) {
            for (int c = 0; c < raster.columns; ++c) row[static_cast<std::size_t>(c)] = height(r, c);
            if (GDALRasterIO(band, GF_Write, 0, r, raster.columns, 1, row.data(), raster.columns, 1,
                             GDT_Float64, 0, 0) != CE_None)
                return "";
        }
    }
    GDALClose(dataset);
    return file.string();
}

// Posts of `per_deg` a degree whose north-west one lies at (north, west), with cells around them.
inline std::array<double, 6> posts_from(double west_deg, double north_deg, double per_deg) {
    const double step = 1.0 / per_deg;
    return {west_deg - 0.5 * step, step, 0.0, north_deg + 0.5 * step, 0.0, -step};
}

// How many of some notes hold some words.
inline std::size_t notes_with(const std::vector<std::string>& notes, const std::string& words) {
    return static_cast<std::size_t>(std::ranges::count_if(
        notes, [&](const std::string& note) { return note.find(words) != std::string::npos; }));
}

inline RegionRequest request_for(std::vector<std::string> paths) {
    RegionRequest request;
    request.paths = std::move(paths);
    return request;
}

// The same, with posts in a CRS of their own brought onto latitudes and longitudes.
inline RegionRequest resampled_from(std::vector<std::string> paths) {
    RegionRequest request = request_for(std::move(paths));
    request.resample = true;
    return request;
}

// The region, or a test failure with the reason.
inline std::optional<RegionGrid> opened(const RegionRequest& request, std::string* reason = nullptr) {
    auto region = test::open_grid(request);
    if (region) return std::move(region).value();
    if (reason) *reason = region.error().line();
    return std::nullopt;
}

}  // namespace oro::test
