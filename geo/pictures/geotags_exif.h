// Geotags as EXIF fields: one list, which PNG and JPEG carry as a block and TIFF as directories of its own.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/base/result.h"
#include "geo/pictures/picture.h"

namespace oro {

struct ExifRational {
    std::uint32_t numerator{};
    std::uint32_t denominator{1};
};

// The TIFF field types that are used; the numbers are those of the TIFF 6.0 specification, section 2.
enum class ExifType : std::uint16_t {
    byte = 1,
    ascii = 2,
    short_integer = 3,
    long_integer = 4,
    rational = 5,
    undefined = 7
};

// A type of its own: a std::variant of standard strings and vectors alone takes itself for never empty, and
// GCC 12 frees what is not there when a copy of it runs out of memory.
struct ExifRationals : std::vector<ExifRational> {
    using vector::vector;
};

struct ExifField {
    std::uint16_t tag{};
    ExifType type{};
    // byte and undefined: bytes; short_integer and long_integer: integers.
    std::variant<std::string, std::vector<std::uint8_t>, std::vector<std::uint32_t>, ExifRationals> value;
};

struct ExifFields {
    std::vector<ExifField> image;  // software, time, copyright, resolution
    std::vector<ExifField> photo;  // the Exif directory
    std::vector<ExifField> gps;
};

// Errors: a value that is not finite or out of range, a time outside the years 0 to 9999.
// Rounding: positions 1e-7 second of arc (3 micrometres on the ground), heights 0.05 mm below 429 km,
// directions 5e-5 degree, distances 0.5 mm below 4294 km; beyond those a power of ten coarser as 32 bits
// demand. FocalLengthIn35mmFilm is in whole millimetres (EXIF has no fractions there), 0.5 mm, by the
// diagonal angle of view. The exact angle of view is in FocalLength and FocalPlane[XY]Resolution: those of a
// frame of the picture's shape with the diagonal of 36 x 24 mm film, so that
//     tan(vertical angle / 2) = height in pixels / (FocalPlaneYResolution pixels per cm) / 2 / FocalLength,
// to a part in 1e8. GPSDestDistance is the way along the ellipsoid to what the picture's middle shows, in km;
// not the length of the sight line, which is in no tag.
Result<ExifFields> exif_fields(const Geotags& tags);

// The fields as an EXIF block, from its byte order mark on, "II*\0": what PNG's eXIf holds and, behind
// "Exif\0\0", JPEG's APP1.
Result<std::vector<std::uint8_t>> exif_block(const ExifFields& fields);

// The focal length that gives the picture's diagonal angle of view on 36 x 24 mm film, in mm. EXIF (CIPA
// DC-008) says "equivalent focal length assuming a 35 mm film camera" and not by which side; CIPA DCG-001,
// the guideline of the same makers, takes the diagonal. For a 3:2 picture this is also the one by width, from
// which exiftool computes its field of view; for others the conventions differ. Hugin computes its crop
// factor from the tag in the same way.
double focal_length_35mm(double vertical_fov_deg, int width_px, int height_px);

}  // namespace oro
