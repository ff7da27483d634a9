// Pictures that carry nothing but their pixels: legends, plots, what other files hold within them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// A PNG of 8-bit sRGB pixels, rgb row by row. Same pixels, same bytes. Errors: what libpng says.
Result<std::vector<std::uint8_t>> png_bytes(std::span<const std::uint8_t> rgb, int width_px, int height_px);

// Writes the PNG as a file, whole or not at all. Errors: those of the file (geo/files/whole_file.h).
Result<void> write_png(const std::string& path, std::span<const std::uint8_t> rgb, int width_px,
                       int height_px, bool overwrite);

}  // namespace oro
