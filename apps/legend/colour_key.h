// What the colours of a style mean, as a scale.
#pragma once

#include <string>
#include <vector>

#include "apps/legend/shown_ground.h"
#include "apps/legend/strip.h"
#include "apps/view/style.h"
#include "apps/view/view.h"

namespace oro {

enum class KeyShape { none, bar, wheel, names };
struct ColourKey {
    KeyShape shape{KeyShape::none};
    std::string title;
    double low{}, high{};       // at the bar's ends: metres of H, or degrees
    std::vector<double> ticks;  // round ones between them
    const char* unit{""};

    // The style's colour of a value.
    [[nodiscard]] StripColour colour(double value) const;

    std::vector<gpu::TintStop> stops;
    bool codes{};
    struct Named {
        StripColour colour;
        std::string name;
    };
    std::vector<Named> names;  // of KeyShape::names
};
// By the heights of the region, or all slopes; what grows by nature by the snow line at the eye's or the
// map's latitude. None where a style has one colour alone,
// or colours that nobody tells apart between the region's lowest and highest ground. Of a view that shows its
// own making (--show), what that has: `every` is 1, or which posts alone are drawn, every so many-th along
// rows and columns. `shown`: what of land cover and of a rule's ground to name, and whether images hide all
// of it; null: not known, all that files and the rule may have is named.
ColourKey colour_key(const View& view, const Region& region, const Style& style, int every = 1,
                     const ShownGround* shown = nullptr);

}  // namespace oro
