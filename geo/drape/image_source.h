// Images that are laid over the ground: orthophotos, satellite scenes, scanned maps, by any raster that is
// trusted for terrain, too (raster_library.h).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// What the values of an image stand for.
enum class ImageValues {
    by_file,     // as the file tells: values_in()
    codes,       // of sRGB
    reflectance  // light, linear
};

struct ImageSource {
    std::string file;
    int columns{};
    int rows{};
    std::string crs;  // "EPSG:2056 CH1903+ / LV95"
    std::string crs_wkt;
    bool geographic{};
    // Of corners of pixels: x = m[0] + m[1] column + m[2] row, y = m[3] + m[4] column + m[5] row; and back.
    std::array<double, 6> crs_from_pixel{};
    std::array<double, 6> pixel_from_crs{};
    std::vector<int> bands;  // red, green, blue; or one: grey, or numbers in a palette
    bool palette{};
    // Stored values that become 0 and 255. Of codes of sRGB all that there may be; of light, which is encoded
    // as it is read, most of the values that there are.
    double black{0.0};
    double white{255.0};
    bool is_light{};
    std::vector<std::string> files;  // that it is made of, for those who must not write over them
    std::uint64_t fingerprint{};     // fingerprint of these files (image_fingerprint)
    std::vector<std::string> notes;  // what a user must know, one line each
};

// Looks at an image: where it lies, and what its bands are. Errors: a file that is not there or damaged; one
// without a CRS, or with a georeference that is no map from pixels to places; complex numbers; as
// inspect_raster's for what a raster names and how long that takes. Colours of palettes are codes whatever
// `values` says.
Result<ImageSource> open_image(const std::string& file, ImageValues values = ImageValues::by_file);

// XXH64 of the bytes of some files, each with its length; of one longer than 256 MiB its length, its ends,
// and a MiB at each of 64 places between them. Errors: a file that cannot be read.
Result<std::uint64_t> image_fingerprint(const std::vector<std::string>& files);

}  // namespace oro
