// Colours as styles write them, turned into what the GPU gets.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "core/base/srgb.h"
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

// Linear light.
inline gpu::vec3 linear_light(const ColourCodes& colour) {
    const auto linear = [](int value) { return static_cast<float>(light_of_srgb(value / 255.0)); };
    return {linear(colour.red), linear(colour.green), linear(colour.blue)};
}

// "#e2252b"; nothing of what is none.
std::optional<ColourCodes> colour_from(const std::string& text);
std::string colour_text(const ColourCodes& colour);

}  // namespace oro
