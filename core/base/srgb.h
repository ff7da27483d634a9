// Codes of sRGB and the light that they stand for.
#pragma once

#include <cmath>

namespace oro {

// Both from 0 to 1. Source: IEC 61966-2-1:1999, 5.2.
inline double light_of_srgb(double code) {
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}
inline double srgb_of_light(double light) {
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055;
}

}  // namespace oro
