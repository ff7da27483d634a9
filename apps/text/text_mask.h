// What text covers of the pixels of a rectangle.
#pragma once

#include <cstdint>
#include <vector>

namespace oro {

// 0 to 255, row by row.
struct TextMask {
    int x_px{};  // of its first pixel; may be outside the picture
    int y_px{};
    int width_px{};
    int height_px{};
    std::vector<std::uint8_t> ink;
    std::vector<std::uint8_t> halo;  // the letters' own pixels, too
};

// Adds a mask, moved to the right and down, to another. What covers a pixel twice covers it as the larger
// does; what lies beyond the other's rectangle is left out.
void merge(const TextMask& from, int right_px, int down_px, TextMask& to);

}  // namespace oro
