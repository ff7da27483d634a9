// Values at the pixels of a picture, as a TIFF of the picture's size with one band and no CRS.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "geo/files/whole_file.h"

namespace oro {

struct LayerRaster {
    int width_px{};
    int height_px{};
    // Row by row from the top; NaN, declared as no data, where there is no value.
    std::variant<std::span<const float>, std::span<const double>> values;
    std::string what;                                       // the band's description
    std::string unit;                                       // "metre", "degree"; "" for none
    std::vector<std::pair<std::string, std::string>> tags;  // of the file, for people: names in capitals
};

// Whole, and without its name yet: Float32 or Float64, compressed (DEFLATE, predictor for floats). Same
// values, same bytes. Errors: those of WholeFile; what GDAL cannot write (a full disk).
Result<WholeFile> layer_raster(const std::string& path, bool overwrite, const LayerRaster& raster);

}  // namespace oro
