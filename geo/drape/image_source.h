// Images that are laid over the ground: orthophotos, satellite scenes, scanned maps, by any raster that is
// trusted for terrain, too (raster_library.h).
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/drape/placed_raster.h"

namespace oro {

// What the values of an image stand for.
enum class ImageValues {
    by_file,     // as the file tells: values_in()
    codes,       // of sRGB
    reflectance  // light, linear
};

struct ImageSource : PlacedRaster {
    std::vector<int> bands;  // red, green, blue; or one: grey, or numbers in a palette
    bool palette{};
    // Stored values that become 0 and 255. Of codes of sRGB all that there may be; of light, which is encoded
    // as it is read, most of the values that there are.
    double black{0.0};
    double white{255.0};
    bool is_light{};
};

// Looks at an image: where it lies, and what its bands are. Errors: a file that is not there or damaged; one
// without a CRS, or with a georeference that is no map from pixels to places; complex numbers; as
// inspect_raster's for what a raster names and how long that takes. Colours of palettes are codes whatever
// `values` says.
Result<ImageSource> open_image(const std::string& file, ImageValues values = ImageValues::by_file);

}  // namespace oro
