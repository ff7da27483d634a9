// Images that tests write for themselves.
#pragma once

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geo/files/raster_library.h"

namespace oro::test {

struct WrittenImage {
    int columns{};
    int rows{};
    std::array<double, 6> crs_from_pixel{};  // of pixels' corners
    std::string crs{"EPSG:4326"};            // "" for none
    int bands{3};
    GDALDataType type{GDT_Byte};
    bool alpha{};  // the last band
    std::optional<double> no_data{};
    std::vector<std::array<short, 4>> palette{};
    std::vector<int> overviews{};
    std::vector<std::byte> profile{};  // ICC; none where it is empty
    std::string photometric{};         // of the format; nothing: as the bands are
    int bits{};                        // that values use, where not all of their type
};

// The value of a band (from 0) at a pixel.
using PixelValue = std::function<double(int band, int row, int column)>;

inline std::string write_image(const std::filesystem::path& file, const WrittenImage& image,
                               const PixelValue& value) {
    start_gdal();
    CPLStringList options;
    options.SetNameValue("TILED", "YES");
    options.SetNameValue("SPARSE_OK", "TRUE");
    if (image.alpha) options.SetNameValue("ALPHA", "YES");
    if (!image.palette.empty()) options.SetNameValue("PHOTOMETRIC", "PALETTE");
    if (!image.photometric.empty()) options.SetNameValue("PHOTOMETRIC", image.photometric.c_str());
    if (image.bits != 0) options.SetNameValue("NBITS", std::to_string(image.bits).c_str());
    if (!image.profile.empty()) {
        char* const text = CPLBase64Encode(static_cast<int>(image.profile.size()),
                                           reinterpret_cast<const GByte*>(image.profile.data()));
        options.SetNameValue("SOURCE_ICC_PROFILE", text);
        CPLFree(text);
    }
    const GDALDatasetH dataset = GDALCreate(GDALGetDriverByName("GTiff"), file.c_str(), image.columns,
                                            image.rows, image.bands, image.type, options.List());
    std::array<double, 6> corners = image.crs_from_pixel;
    GDALSetGeoTransform(dataset, corners.data());
    if (!image.crs.empty()) {
        const OGRSpatialReferenceH crs = OSRNewSpatialReference(nullptr);
        OSRSetFromUserInput(crs, image.crs.c_str());
        GDALSetSpatialRef(dataset, crs);
        OSRDestroySpatialReference(crs);
    }
    if (!image.palette.empty()) {
        GDALColorTableH const table = GDALCreateColorTable(GPI_RGB);
        for (std::size_t i = 0; i < image.palette.size(); ++i) {
            const auto& colour = image.palette[i];
            const GDALColorEntry entry{colour[0], colour[1], colour[2], colour[3]};
            GDALSetColorEntry(table, static_cast<int>(i), &entry);
        }
        GDALSetRasterColorTable(GDALGetRasterBand(dataset, 1), table);
        GDALDestroyColorTable(table);
    }
    std::vector<double> line(static_cast<std::size_t>(image.columns));
    for (int band = 0; band < image.bands; ++band) {
        const GDALRasterBandH to = GDALGetRasterBand(dataset, band + 1);
        if (image.no_data) GDALSetRasterNoDataValue(to, *image.no_data);
        for (int row = 0; value && row < image.rows; ++row) {
            for (int column = 0; column < image.columns; ++column)
                line[static_cast<std::size_t>(column)] = value(band, row, column);
            if (GDALRasterIO(to, GF_Write, 0, row, image.columns, 1, line.data(), image.columns, 1,
                             GDT_Float64, 0, 0) != CE_None)
                return "";
        }
    }
    CPLErr built = CE_None;
    if (!image.overviews.empty())
        built = GDALBuildOverviews(dataset, "AVERAGE", static_cast<int>(image.overviews.size()),
                                   image.overviews.data(), 0, nullptr, nullptr, nullptr);
    GDALClose(dataset);
    return built == CE_None ? file.string() : "";
}

}  // namespace oro::test
