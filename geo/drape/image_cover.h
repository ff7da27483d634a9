// Where images hide the ground.
#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "geo/drape/image_source.h"

namespace oro {

// Whether a pixel of any of the images that hides what is below it lies at each place, WGS84 degrees: one
// that the image leaves out (mask, alpha, no-data), and a half transparent one, do not. Both of one length.
// Errors: a file that has changed, is damaged or takes too long.
Result<std::vector<bool>> hidden_by_images(std::span<const ImageSource> images,
                                           std::span<const double> lat_deg, std::span<const double> lon_deg);

}  // namespace oro
