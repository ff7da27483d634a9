// The pixels of an image, as fine as they are asked for.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "geo/drape/image_source.h"
#include "geo/drape/window_read.h"
#include "geo/files/raster_library.h"

namespace oro {

// Red, green, blue (codes 0 to 255) times alpha, and alpha (0 to 1).
using Colour = std::array<float, 4>;

struct ImagePixels {
    PixelWindow window;
    int columns{};  // that the window was brought to: as many as it has, or fewer
    int rows{};
    std::vector<Colour> colours;

    // Bilinear at a place of the image (column and row of corners of pixels); beyond the window's pixels
    // there is nothing.
    [[nodiscard]] Colour at(double column, double row) const;
};

// Reads a window, `step` pixels along either axis averaged into one. What the image leaves out (masks, alpha,
// no-data) is transparent. Uses the image's overviews. Errors: a file that has changed, is damaged, ends
// early or takes too long.
Result<ImagePixels> read_pixels(const ImageSource& image, GDALDatasetH dataset, const PixelWindow& window,
                                int step);

}  // namespace oro
