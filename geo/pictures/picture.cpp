#include "geo/pictures/picture.h"

#include <cassert>
#include <string_view>
#include <utility>

#include "geo/pictures/geotags_xmp.h"
#include "geo/pictures/picture_formats.h"

namespace oro {

EncodedPicture::EncodedPicture(PictureParts parts) : parts_(std::move(parts)) {}

void EncodedPicture::note(const std::string& what) {
    if (!fault_) fault_ = Error{ErrorKind::failed, parts_.path, what};
}

bool EncodedPicture::put(const void* bytes, std::size_t count) {
    if (fault_) return false;
    const Result<void> written = parts_.file.write(bytes, count);
    if (!written.ok()) fault_ = written.error();
    return written.ok();
}

Error EncodedPicture::fail() {
    note("the encoder failed");
    release();
    { const WholeFile abandoned = std::move(parts_.file); }
    return *fault_;
}

Result<void> EncodedPicture::write_row(std::span<const std::uint8_t> rgb) {
    if (fault_) return *fault_;
    const bool fits =
        rgb.size() == static_cast<std::size_t>(parts_.width_px) * static_cast<std::size_t>(parts_.channels) &&
        rows_ < parts_.height_px && !finished_;
    if (!fits) {
        note("a row too many, or one that is not as wide as the picture");
        return fail();
    }
    if (!encode_row(rgb.data())) return fail();
    ++rows_;
    return {};
}

Result<WholeFile> EncodedPicture::finished_file() {
    if (fault_) return *fault_;
    assert(!finished_);
    if (rows_ != parts_.height_px) {
        note("was given " + std::to_string(rows_) + " of " + std::to_string(parts_.height_px) + " rows");
        return fail();
    }
    if (!end()) return fail();
    release();
    if (fault_) return fail();
    finished_ = true;
    return std::move(parts_.file);
}

Result<void> EncodedPicture::finish() {
    ORO_TRY(WholeFile file, finished_file());
    const Result<void> committed = file.commit();
    if (!committed.ok()) fault_ = committed.error();
    return committed;
}

Result<PictureFormat> picture_format(const std::string& path) {
    const std::size_t name = path.find_last_of('/') + 1;  // npos + 1 == 0
    const std::size_t dot = path.find_last_of('.');
    std::string ending = dot == std::string::npos || dot < name ? "" : path.substr(dot + 1);
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (ending == "png") return PictureFormat::png;
    if (ending == "jpg" || ending == "jpeg") return PictureFormat::jpeg;
    if (ending == "tif" || ending == "tiff") return PictureFormat::tiff;
    return Error{ErrorKind::usage, path, "a picture's name ends in .png, .jpg, .jpeg, .tif or .tiff"};
}

int map_channels(const std::string& path) {
    const auto format = picture_format(path);
    return format.ok() && *format == PictureFormat::jpeg ? 3 : 4;
}

namespace {

Result<std::unique_ptr<PictureWriter>> create(const std::string& path, const Geotags& tags,
                                              const MapFrame* map, bool overwrite) {
    ORO_TRY(const PictureFormat format, picture_format(path));
    if (tags.width_px < 1 || tags.height_px < 1)
        return Error{ErrorKind::usage, path,
                     "a picture of " + std::to_string(tags.width_px) + "x" + std::to_string(tags.height_px) +
                         " pixels cannot be written"};
    ORO_TRY(ExifFields exif, exif_fields(tags));
    ORO_TRY(std::string xmp, xmp_packet(tags, format));
    std::optional<GeoTiffTags> place;
    if (map && format == PictureFormat::tiff) {
        ORO_TRY(place, geotiff_tags(*map));
    }
    ORO_TRY(WholeFile file, WholeFile::create(path, overwrite));
    PictureParts parts{std::move(file),
                       path,
                       tags.width_px,
                       tags.height_px + tags.strip_px,
                       std::move(exif),
                       std::move(xmp),
                       map ? map_channels(path) : 3,
                       std::move(place)};
    switch (format) {
        case PictureFormat::png:
            return create_png(std::move(parts));
        case PictureFormat::jpeg:
            return create_jpeg(std::move(parts));
        case PictureFormat::tiff:
            break;
    }
    return create_tiff(std::move(parts));
}

}  // namespace

Result<std::unique_ptr<PictureWriter>> create_picture(const std::string& path, const Geotags& tags,
                                                      bool overwrite) {
    return create(path, tags, nullptr, overwrite);
}

Result<std::unique_ptr<PictureWriter>> create_map(const std::string& path, const Geotags& tags,
                                                  const MapFrame& map, bool overwrite) {
    return create(path, tags, &map, overwrite);
}

}  // namespace oro
