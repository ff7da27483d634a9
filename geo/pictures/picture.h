// Pictures that know where they were taken from: writing PNG, JPEG and TIFF with geotags, and reading back
// the view.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/base/result.h"
#include "geo/files/whole_file.h"
#include "geo/rasters/map_frame.h"

namespace oro {

// Where the picture's centre ray meets the ground.
struct DestinationTag {
    double lat_deg{};
    double lon_deg{};
    double bearing_deg{};  // true, from the eye, [0, 360)
    double distance_m{};   // along the ellipsoid (geodesic), as GPSDestDistance wants it
};

// What a picture says of a panorama on a cylinder. Rows count from the picture's top.
struct PanoramaTag {
    double sweep_deg{};  // from its left border to its right one
    int level_row_px{};  // the level line is this row's upper border
    int first_row_px{};  // of the scene itself: names stand above it, rulers below
    int scene_rows_px{};
};

// What a picture says about itself. Heights: H above the geoid, h above the ellipsoid, h = H + N.
struct Geotags {
    double lat_deg{};
    double lon_deg{};
    double H_m{};
    double h_m{};
    double N_m{};
    std::string geoid;
    double heading_deg{};  // true, [0, 360)
    double pitch_deg{};
    double roll_deg{};
    double vertical_fov_deg{};
    int width_px{};
    int height_px{};
    int strip_px{};                // what else is below it: rows of the file beyond height_px
    std::int64_t time_utc_s{};  // since 1970-01-01T00:00:00Z
    std::optional<DestinationTag> destination;
    std::optional<PanoramaTag> panorama;  // then it has no focal length; heading: of its middle
    std::string attribution;
    std::string software;   // "Orograph 0.1.0"
    std::string view_json;  // the whole view: what `--view FILE.png` reads back
};

enum class PictureFormat { png, jpeg, tiff };
// From the file name's ending (.png, .jpg, .jpeg, .tif, .tiff; any case). Usage error for others.
Result<PictureFormat> picture_format(const std::string& path);

// Takes a picture row by row and puts it on disk whole or not at all: the file appears under its name when
// finish() has returned without error; before, and after any error or destruction, there is no trace of it.
class PictureWriter {
  public:
    virtual ~PictureWriter() = default;
    // The next row, width * 3 bytes, sRGB; of a map map_channels() bytes a pixel.
    virtual Result<void> write_row(std::span<const std::uint8_t> row) = 0;
    // After the last row: closes, syncs and renames.
    virtual Result<void> finish() = 0;
    // After the last row, instead of finish(): the whole picture, which has no name yet.
    virtual Result<WholeFile> finished_file() = 0;
};

// Errors: a name or size that the format cannot have (usage; a JPEG is at most 65500 pixels wide and high);
// tags that are not finite, out of range or no UTF-8; a view_json of more than some 65,000 bytes in a JPEG;
// the folder is missing or not writable; the disk is full (then or at any later call); the file is there and
// overwrite is false. Rows are encoded as they come: memory holds a few rows, whatever the height. Same tags
// and rows give the same bytes. What the tags round to is said in geo/pictures/geotags_exif.h; XMP holds
// heights and angles unrounded.
Result<std::unique_ptr<PictureWriter>> create_picture(const std::string& path, const Geotags& tags,
                                                      bool overwrite);

// Creates the picture of a map: a TIFF is a GeoTIFF. Errors: a CRS that a GeoTIFF cannot hold (usage), too.
Result<std::unique_ptr<PictureWriter>> create_map(const std::string& path, const Geotags& tags,
                                                  const MapFrame& map, bool overwrite);
// Bytes of a map's pixel: red, green, blue and opacity; a JPEG has no opacity.
int map_channels(const std::string& path);

// Puts `now` in the place of `was`, which has as many bytes, in the view of a picture that is whole and has
// no name yet: for what is known only when the last row is. `was` stands in the view, once, and neither holds
// what XML writes otherwise. Errors: the file's.
Result<void> replace_in_view(WholeFile& picture, const std::string& path, const std::string& was,
                             const std::string& now);

// The view_json that a picture of ours carries (PNG, JPEG or TIFF, told by content); an error for files
// without one.
Result<std::string> read_view_json(const std::string& path);

}  // namespace oro
