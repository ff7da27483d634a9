// What colours stand for, in words: squares of the colours, each with its name, below a title. A legend below
// a picture has them.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "apps/legend/colour_key.h"
#include "apps/legend/strip.h"

namespace oro {

inline constexpr StripColour legend_paper{250, 248, 242}, legend_ink{38, 40, 44}, legend_quiet{110, 112, 116};

// Words on lines of so many pixels at most; what does not fit on one goes on, indented by nothing. Errors:
// those of TextFace.
Result<std::vector<std::string>> wrapped(const TextFace& face, const std::vector<std::string>& lines,
                                         double size_px, double width_px);

// Where a key's title and names stand, on as many lines as they need.
struct PlacedNames {
    glm::dvec2 at_px{};  // top left corner
    double em_px{};
    std::vector<std::string> title;      // in lines
    std::vector<glm::dvec2> squares_px;  // their top left corners, in the names' order
    double right_px{}, bottom_px{};      // where the last of them ends
};
// No farther to the right than `right_px`, if a name alone is not wider. Errors: those of TextFace.
Result<PlacedNames> place_names(const TextFace& face, const ColourKey& key, glm::dvec2 at_px, double right_px,
                                double em_px);
Result<void> draw_names(Strip& strip, const TextFace& face, const ColourKey& key, const PlacedNames& placed);

}  // namespace oro
