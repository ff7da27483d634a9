// A window of a band, as coarse as it is asked for. What a file holds nothing of costs nothing: a raster of a
// thousand million pixels may be a file of some kilobytes.
#pragma once

#include <gdal.h>

#include <vector>

#include "geo/files/guarded_files.h"

namespace oro {

// A window of an image, whole pixels.
struct PixelWindow {
    int column{};
    int row{};
    int columns{};
    int rows{};
};

// Which pixels of a window a band's file holds, as a share of all, 0 to 1. GDAL gives the others one value.
// 1 where the format does not tell.
[[nodiscard]] double share_held(GDALRasterBandH band, const PixelWindow& window);

// What of a band is asked for.
struct WindowRequest {
    GDALRasterBandH band{};
    GDALRasterBandH held_as{};  // the band that tells which pixels the file holds: itself, or one it follows
    PixelWindow window;
    int columns{};  // that the window is brought to
    int rows{};
    GDALRIOResampleAlg how{GRIORA_NearestNeighbour};
};

// Reads it row by row into `to`, T: of one byte, or float. False where it could not be read, and when the
// watch's time or bytes are spent.
template <class T>
bool read_window(const WindowRequest& request, FileWatch& watch, std::vector<T>& to);

}  // namespace oro
