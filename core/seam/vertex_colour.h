// The colour of a mesh's vertex, as its file states it.
#pragma once

#include <array>
#include <cstdint>

namespace oro {

struct VertexColour {
    std::uint8_t red{}, green{}, blue{};  // codes of sRGB
    std::uint8_t is_stated{};             // 0: the file has none for this vertex; else 1

    bool operator==(const VertexColour&) const = default;
};

// From linear light, 0 to 1; what lies beyond is cut.
VertexColour colour_of_light(const std::array<double, 3>& light);
// Linear light, 0 to 1, of one that is stated.
std::array<double, 3> light_of_colour(VertexColour colour);
// The one between two, in linear light: share 0 is the first. Not stated where one of them is not.
VertexColour colour_between(VertexColour first, VertexColour second, double share);

}  // namespace oro
