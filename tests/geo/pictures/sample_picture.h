// A small picture with every tag, and what tests do with pictures.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "geo/pictures/picture.h"

namespace oro::test {

inline constexpr int sample_width = 120;
inline constexpr int sample_height = 75;

// The Eiger from Grindelwald-First, in the afternoon of 2024-06-07.
inline Geotags sample_tags() {
    Geotags tags;
    tags.lat_deg = 46.659123456789;
    tags.lon_deg = 8.053987654321;
    tags.H_m = 2467.1234;
    tags.h_m = 2517.8034;
    tags.N_m = 50.68;
    tags.geoid = "EGM96 (egm96_15.gtx)";
    tags.heading_deg = 200.12345;
    tags.pitch_deg = -5.25;
    tags.roll_deg = 0.125;
    tags.vertical_fov_deg = 40;
    tags.width_px = sample_width;
    tags.height_px = sample_height;
    tags.time_utc_s = 1717763696;  // 2024-06-07T12:34:56Z
    tags.destination = DestinationTag{46.577654321, 8.005123456, 202.4567, 9876.543};
    tags.attribution = "USGS & NASA <public domain>, \u00a9 \"none\"";
    tags.software = "Orograph 0.1.0";
    tags.view_json = R"({"at":"46.66,8.05","style":"<\"a\" & 'b'>","name":"Mönch ⛰ \\u0007"})";
    return tags;
}

// A gradient in all three channels, or noise that no encoder makes small.
inline std::vector<std::uint8_t> sample_row(int row, int width = sample_width, bool noise = false) {
    std::vector<std::uint8_t> rgb;
    std::uint32_t state = static_cast<std::uint32_t>(row) * 2654435761U + 1;
    for (int column = 0; column < width; ++column) {
        if (noise) {
            for (int i = 0; i < 3; ++i) {
                state = state * 1664525U + 1013904223U;
                rgb.push_back(static_cast<std::uint8_t>(state >> 24));
            }
            continue;
        }
        rgb.push_back(static_cast<std::uint8_t>(2 * column));
        rgb.push_back(static_cast<std::uint8_t>(3 * row));
        rgb.push_back(static_cast<std::uint8_t>(255 - column - row));
    }
    return rgb;
}

inline Result<void> write_sample(const std::string& path, const Geotags& tags, bool overwrite = false,
                                 bool noise = false) {
    ORO_TRY(auto picture, create_picture(path, tags, overwrite));
    for (int row = 0; row < tags.height_px; ++row)
        ORO_CHECK(picture->write_row(sample_row(row, tags.width_px, noise)));
    return picture->finish();
}

inline std::string content(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

inline std::vector<std::string> names_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace oro::test
