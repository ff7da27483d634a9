// A strip of paper that a legend is drawn on: shapes with smooth edges, colours, and text.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "apps/text/text_face.h"

namespace oro {

using StripColour = std::array<std::uint8_t, 3>;  // sRGB

class Strip {
  public:
    Strip(int width_px, int height_px, const StripColour& paper);

    [[nodiscard]] const std::vector<std::uint8_t>& rgb() const { return rgb_; }
    // All pixels of a rectangle, each coloured by its place in it (0 to 1 across and down).
    void fill(glm::dvec2 corner_px, glm::dvec2 size_px,
              const std::function<StripColour(glm::dvec2 share)>& colour);
    void fill(glm::dvec2 corner_px, glm::dvec2 size_px, const StripColour& colour);
    // What is inside a shape, told for each place; 4 x 4 places a pixel within the rectangle.
    void paint(glm::dvec2 corner_px, glm::dvec2 size_px, const std::function<bool(glm::dvec2 at_px)>& inside,
               const StripColour& colour);
    // Text that begins at `left_base_px`, or is centred on it. Errors: those of TextFace.
    enum class From { left, middle };
    Result<void> write(const TextFace& face, const std::string& text, glm::dvec2 base_px, double size_px,
                       const StripColour& ink, From from = From::left);

  private:
    void mix(int x, int y, const StripColour& colour, double share);

    int width_px_, height_px_;
    std::vector<std::uint8_t> rgb_;
};

}  // namespace oro
