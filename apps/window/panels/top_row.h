// How the top row of a window is divided between the search field, the buttons or their menu, and the
// compass.
#pragma once

#include <algorithm>

namespace oro {

// Widths are in pixels of a screen at scale 1.
struct TopRow {
    float field_width;  // of the search field's text
    float buttons_x;    // left side of the buttons, or of the menu that stands for them
};

// Of a window of a width: the field gives way where the menu's button would reach under the compass.
constexpr TopRow top_row(float window_width) {
    constexpr float widest = 270.0F, narrowest = 60.0F, beside_field = 40.0F, menu = 42.0F, compass = 62.0F;
    const float field = std::clamp(window_width - beside_field - menu - compass, narrowest, widest);
    return {field, field + beside_field};
}

}  // namespace oro
