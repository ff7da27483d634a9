#include "core/seam/vertex_colour.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/base/srgb.h"

namespace oro {

VertexColour colour_of_light(const std::array<double, 3>& light) {
    std::array<std::uint8_t, 3> codes{};
    for (std::size_t i = 0; i < codes.size(); ++i)
        codes[i] = static_cast<std::uint8_t>(
            std::lround(255.0 * srgb_of_light(std::isnan(light[i]) ? 0.0 : std::clamp(light[i], 0.0, 1.0))));
    return {codes[0], codes[1], codes[2], 1};
}

std::array<double, 3> light_of_colour(VertexColour colour) {
    return {light_of_srgb(colour.red / 255.0), light_of_srgb(colour.green / 255.0),
            light_of_srgb(colour.blue / 255.0)};
}

VertexColour colour_between(VertexColour first, VertexColour second, double share) {
    if (first.is_stated == 0 || second.is_stated == 0) return {};
    std::array<double, 3> light = light_of_colour(first);
    const std::array<double, 3> other = light_of_colour(second);
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = std::lerp(light[i], other[i], share);
    return colour_of_light(light);
}

}  // namespace oro
