// A picture in memory with letters on it: legends.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace oro {

using Rgb = std::array<std::uint8_t, 3>;  // sRGB

// Rows from the top, 3 bytes a pixel. What is drawn beyond its edges is cut off.
class Canvas {
  public:
    Canvas(int width_px, int height_px, const Rgb& background);

    [[nodiscard]] int width_px() const { return width_px_; }
    [[nodiscard]] int height_px() const { return height_px_; }
    [[nodiscard]] const std::vector<std::uint8_t>& rgb() const { return rgb_; }

    void set(int x, int y, const Rgb& colour);
    void fill(int x, int y, int width, int height, const Rgb& colour);
    // Letters of 5 x 9 dots, `scale` pixels each, in cells of 6 x 9 with (x, y) at the top left, two dots
    // of them below the line: a to z, 0 to 9 and . , : % - + / < > = ( ). Others are blank.
    void write(int x, int y, std::string_view text, const Rgb& colour, int scale);
    // Whether no letter of it would be blank but spaces.
    static bool can_write(std::string_view text);
    static int text_width_px(std::string_view text, int scale);
    static constexpr int text_height_dots = 9;

  private:
    int width_px_;
    int height_px_;
    std::vector<std::uint8_t> rgb_;
};

}  // namespace oro
