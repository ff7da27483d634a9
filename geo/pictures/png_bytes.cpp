#include "geo/pictures/png_bytes.h"

#include <png.h>

#include <cassert>

#include "geo/files/whole_file.h"

namespace oro {

Result<std::vector<std::uint8_t>> png_bytes(std::span<const std::uint8_t> rgb, int width_px, int height_px) {
    assert(rgb.size() ==
           std::size_t{3} * static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width_px);
    image.height = static_cast<png_uint_32>(height_px);
    image.format = PNG_FORMAT_RGB;
    const auto fault = [&] { return Error{ErrorKind::failed, "PNG", image.message}; };
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::vector<std::uint8_t> bytes(size);
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb.data(), 0, nullptr)) return fault();
    bytes.resize(size);
    return bytes;
}

Result<void> write_png(const std::string& path, std::span<const std::uint8_t> rgb, int width_px,
                       int height_px, bool overwrite) {
    ORO_TRY(WholeFile file, WholeFile::create(path, overwrite));
    ORO_TRY(const std::vector<std::uint8_t> bytes, png_bytes(rgb, width_px, height_px));
    ORO_CHECK(file.write(bytes.data(), bytes.size()));
    return file.commit();
}

}  // namespace oro
