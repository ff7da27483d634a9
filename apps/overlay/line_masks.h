// Lines as pixels.
#pragma once

#include <glm/vec2.hpp>
#include <map>
#include <utility>
#include <vector>

#include "apps/styles/colours.h"
#include "apps/text/inked_rows.h"

namespace oro {

[[nodiscard]] inline InkedText::Colour ink_of(const ColourCodes& colour) {
    return {static_cast<std::uint8_t>(colour.red), static_cast<std::uint8_t>(colour.green),
            static_cast<std::uint8_t>(colour.blue)};
}

// What lines, or areas, of one colour cover of a picture, smooth at their edges, in squares that do not touch
// each other: a pixel that several lines cross is covered as the widest of them covers it.
class LineMask {
  public:
    LineMask(int width_px, int height_px) : width_px_(width_px), height_px_(height_px) {}

    // A line from place to place, round at its ends. Below a pixel of width it becomes fainter.
    void add(const std::vector<glm::dvec2>& places_px, double line_width_px);
    // A pixel of the picture is covered by so much of 255, or by what already does so more.
    void cover(int x_px, int y_px, std::uint8_t share);
    // The squares that have something, as texts of one colour; the mask is empty then.
    void give(const InkedText::Colour& colour, std::vector<InkedText>& inked);

  private:
    void add_piece(glm::dvec2 from, glm::dvec2 to, double half_px, double strength);
    std::uint8_t& at(int x, int y);

    int width_px_;
    int height_px_;
    std::map<std::pair<int, int>, TextMask> squares_;  // row, column
    std::pair<int, int> last_{-1, -1};
    TextMask* last_square_{};
};

}  // namespace oro
