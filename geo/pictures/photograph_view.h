// Where a photograph was taken from, and where to: what its EXIF and XMP tell.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// What is not told is nothing. Angles in degrees.
struct PhotographView {
    double lat_deg{};  // GPSLatitude, GPSLongitude; WGS84
    double lon_deg{};
    // GPSAltitude. Above sea level, or where the file says so (EXIF 3.0) above the ellipsoid. That of a
    // telephone is easily 20 m off.
    std::optional<double> height_m;
    bool is_height_ellipsoidal{};
    // Of the line of sight, from true north: GPSImgDirection, or the camera's yaw in XMP.
    std::optional<double> heading_deg;
    // Above level, and of the right side down: from XMP of Orograph's pictures and of DJI's cameras.
    std::optional<double> pitch_deg;
    std::optional<double> roll_deg;
    // From the bottom of the picture to its top, as it is shown (Orientation): by FocalLengthIn35mmFilm, of a
    // frame of the picture's shape with the diagonal of 36 x 24 mm (CIPA DCG-001); more finely by FocalLength
    // and FocalPlaneYResolution where these agree with it.
    std::optional<double> vertical_fov_deg;
    int width_px{};  // as it is shown; 0 where the file does not say it
    int height_px{};
    std::optional<std::int64_t>
        time_utc_s;                  // GPSDateStamp and GPSTimeStamp; else DateTimeOriginal and its offset
    std::vector<std::string> notes;  // what is doubtful, one line each: a magnetic heading
};

// Reads it from a JPEG, PNG or TIFF, told by content; no pixel is decoded. Errors (failed): a file that
// cannot be read or is none of these; one without EXIF; EXIF without a position, or with one that is none.
Result<PhotographView> photograph_view(const std::string& path);

}  // namespace oro
