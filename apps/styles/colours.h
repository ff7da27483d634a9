// Colours as styles write them, turned into what the GPU gets.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "shaders/shared.h"

namespace oro {

// An sRGB colour, each 0 to 255, as a file has it.
struct ColourCodes {
    int red{};
    int green{};
    int blue{};
    bool operator==(const ColourCodes&) const = default;
};

// Codes from 0 to 1.
inline gpu::vec3 unit_codes(const ColourCodes& colour) {
    return gpu::vec3(colour.red, colour.green, colour.blue) / 255.0F;
}

// Linear light. Source: IEC 61966-2-1:1999, 5.2.
inline gpu::vec3 linear_light(const ColourCodes& colour) {
    const auto linear = [](int value) {
        const double encoded = value / 255.0;
        return static_cast<float>(encoded <= 0.04045 ? encoded / 12.92
                                                     : std::pow((encoded + 0.055) / 1.055, 2.4));
    };
    return {linear(colour.red), linear(colour.green), linear(colour.blue)};
}

// "#e2252b"; nothing of what is none.
std::optional<ColourCodes> colour_from(const std::string& text);
std::string colour_text(const ColourCodes& colour);

}  // namespace oro
