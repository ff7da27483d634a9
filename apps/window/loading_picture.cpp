#include "apps/window/loading_picture.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "apps/legend/strip.h"
#include "apps/text/text_face.h"

namespace oro {

Result<std::vector<std::uint8_t>> loading_picture(int width_px, int height_px) {
    constexpr StripColour paper{236, 236, 232}, ink{96, 96, 92};
    const std::string words = "loading the ground";
    Strip sheet(width_px, height_px, paper);
    ORO_TRY(const TextFace face, TextFace::open());
    constexpr double largest_px = 20.0, widest_share = 0.8;
    ORO_TRY(const double long_px, face.width_px(words, largest_px));
    const double size_px = largest_px * std::min(1.0, widest_share * width_px / long_px);
    ORO_CHECK(sheet.write(face, words, {0.5 * width_px, 0.5 * height_px}, size_px, ink, Strip::From::middle));
    const std::vector<std::uint8_t>& rgb = sheet.rgb();
    std::vector<std::uint8_t> rgba(rgb.size() / 3 * 4, 255);
    for (std::size_t i = 0; i < rgb.size() / 3; ++i)
        std::copy_n(rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                    rgba.begin() + static_cast<std::ptrdiff_t>(4 * i));
    return rgba;
}

}  // namespace oro
