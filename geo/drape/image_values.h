// What a file tells of the values of an image (ImageValues).
#pragma once

#include <gdal.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "geo/drape/image_source.h"

namespace oro {

// What an ICC profile says of its values, by the curve of its red (or of its grey): reflectance where that is
// a straight line, else codes. Nothing where this is no profile. Source: ICC.1:2022, 7.2, 7.3, 10.6, 10.18.
std::optional<ImageValues> values_by_profile(std::span<const std::byte> profile);

// What some bands of an image hold. Bytes are codes. Of other numbers the file's ICC profile tells; without
// one they are reflectance: bands named red, green and blue are no sign, for scenes name theirs so, too.
ImageValues values_in(GDALDatasetH dataset, const std::vector<int>& bands);

// The code that is white in a band whose values are codes: the largest number that it can hold, by its type
// and the bits that the file says it uses; of floats 1. 255 where there are bytes in wider numbers: nothing
// in the band is above that (`largest`), and, of floats, something above 1.
double white_code(GDALRasterBandH band, double largest);

}  // namespace oro
