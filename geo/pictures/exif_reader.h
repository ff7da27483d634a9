// EXIF as other programs and cameras write it: not for use outside geo/pictures and its tests.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/pictures/picture_view.h"

namespace oro {

// What the fields of one directory hold, by their tags.
struct ExifDirectory {
    std::map<std::uint16_t, std::vector<double>> numbers;  // a fraction over 0 is no number (NaN or infinity)
    std::map<std::uint16_t, std::string> texts;            // up to the first zero byte

    [[nodiscard]] std::optional<double> number(std::uint16_t tag) const;  // the first, where it is finite
    [[nodiscard]] std::string text(std::uint16_t tag) const;              // "" where there is none
};

struct ExifDirectories {
    ExifDirectory image, photo, gps;
};

// The EXIF of a JPEG (APP1), a PNG (eXIf) or a TIFF (its own directories; not of a BigTIFF). Nothing where
// there is none. Fields of more than 1,024 values and those that lie outside the file are passed over.
// Errors: bytes of another kind; a picture that is cut off before its EXIF; EXIF without a directory.
Result<std::optional<ExifDirectories>> find_exif(PictureBytes& bytes, const std::string& path);

}  // namespace oro
