// A raster that lies somewhere on the Earth: its size, its CRS, and where its pixels are.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

struct PlacedRaster {
    std::string file;
    int columns{};
    int rows{};
    std::string crs;  // "EPSG:2056 CH1903+ / LV95"
    std::string crs_wkt;
    bool geographic{};
    // Of corners of pixels: x = m[0] + m[1] column + m[2] row, y = m[3] + m[4] column + m[5] row; and back.
    std::array<double, 6> crs_from_pixel{};
    std::array<double, 6> pixel_from_crs{};
    std::vector<std::string> files;  // that it is made of, for those who must not write over them
    std::uint64_t fingerprint{};     // fingerprint of these files (files_fingerprint)
    std::vector<std::string> notes;  // what a user must know, one line each
    // The pixels of what is no raster in its file, row by row; else null.
    std::shared_ptr<std::vector<std::uint16_t>> held;
};

// XXH64 of the bytes of some files, each with its length; of one longer than 256 MiB its length, its ends,
// and a MiB at each of 64 places between them. Errors: a file that cannot be read.
Result<std::uint64_t> files_fingerprint(const std::vector<std::string>& files);

}  // namespace oro
