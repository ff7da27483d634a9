// The pixels of a PNG, without what it says of itself.
#pragma once

#include <png.h>

#include <filesystem>
#include <vector>

namespace oro::test {

struct Pixels {
    png_uint_32 width{}, height{};
    std::vector<png_byte> rgb;
};

// Width 0 when the file cannot be read.
inline Pixels pixels_of(const std::filesystem::path& file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    Pixels pixels;
    if (!png_image_begin_read_from_file(&image, file.c_str())) return pixels;
    image.format = PNG_FORMAT_RGB;
    pixels.rgb.resize(PNG_IMAGE_SIZE(image));
    if (!png_image_finish_read(&image, nullptr, pixels.rgb.data(), 0, nullptr)) return {};
    pixels.width = image.width;
    pixels.height = image.height;
    return pixels;
}

}  // namespace oro::test
