// PNGs as other programs leave them: other pixels under the same tags, other tags over the same pixels.
#pragma once

#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/apps/picture_pixels.h"

namespace oro::test {

struct PngChunk {
    std::string type, data;
};

inline std::vector<PngChunk> chunks_of(const std::string& png) {
    std::vector<PngChunk> chunks;
    for (std::size_t at = 8; at + 12 <= png.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(png[at + i]);
        chunks.push_back({png.substr(at + 4, 4), png.substr(at + 8, length)});
        at += length + 12;
    }
    return chunks;
}

inline std::string png_of(const std::vector<PngChunk>& chunks) {
    std::string png = "\x89PNG\r\n\x1a\n";
    const auto put = [&](std::uint32_t number) {
        for (int shift = 24; shift >= 0; shift -= 8) png += static_cast<char>(number >> shift & 255U);
    };
    for (const PngChunk& chunk : chunks) {
        const std::string summed = chunk.type + chunk.data;
        put(static_cast<std::uint32_t>(chunk.data.size()));
        png += summed;
        put(static_cast<std::uint32_t>(
            crc32(0, reinterpret_cast<const Bytef*>(summed.data()), static_cast<uInt>(summed.size()))));
    }
    return png;
}

// The tags say `now` wherever they said `was`, which they must.
inline std::string with_tags(const std::string& png, const std::string& was, const std::string& now) {
    if (was.empty()) return png;  // whoever looked for it has said so
    std::vector<PngChunk> chunks = chunks_of(png);
    bool found = false;
    for (PngChunk& chunk : chunks) {
        if (chunk.type != "iTXt") continue;
        for (std::size_t at = 0; (at = chunk.data.find(was, at)) != std::string::npos; at += now.size()) {
            chunk.data.replace(at, was.size(), now);
            found = true;
        }
    }
    EXPECT_TRUE(found) << was;
    return png_of(chunks);
}

// The same tags over these pixels, written by another encoder's settings.
inline std::string with_pixels(const std::string& png, const Pixels& pixels) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = pixels.width;
    image.height = pixels.height;
    image.format = PNG_FORMAT_RGB;
    image.flags = PNG_IMAGE_FLAG_FAST;
    png_alloc_size_t size = 0;
    png_image_write_to_memory(&image, nullptr, &size, 0, pixels.rgb.data(), 0, nullptr);
    std::string other(size, '\0');
    EXPECT_NE(png_image_write_to_memory(&image, other.data(), &size, 0, pixels.rgb.data(), 0, nullptr), 0);
    std::vector<PngChunk> chunks;
    for (const PngChunk& chunk : chunks_of(png)) {
        if (chunk.type == "IDAT" || chunk.type == "IEND") continue;
        chunks.push_back(chunk);
    }
    for (const PngChunk& chunk : chunks_of(other.substr(0, size))) {
        if (chunk.type == "IDAT" || chunk.type == "IEND") chunks.push_back(chunk);
    }
    return png_of(chunks);
}

// A part of a text, from one mark to behind another.
inline std::string part_of(const std::string& text, const std::string& from, const std::string& to) {
    const std::size_t start = text.find(from), end = text.find(to, start);
    EXPECT_LT(start, text.size()) << from;
    EXPECT_LT(end, text.size()) << to;
    return start < end && end < text.size() ? text.substr(start, end + to.size() - start) : "";
}

}  // namespace oro::test
