#include "apps/panorama/sheet.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "apps/overlay/line_masks.h"
#include "apps/text/text_face.h"

namespace oro {

glm::dvec2 middle_px(const SheetText& text) {
    if (text.anchor == SheetText::Anchor::middle) return text.at_px;
    const double radians = text.angle_deg * std::numbers::pi / 180.0,
                 half_px = 0.5 * text.length_px * (text.anchor == SheetText::Anchor::begin ? 1.0 : -1.0);
    return text.at_px + half_px * glm::dvec2(std::cos(radians), std::sin(radians));
}

std::vector<InkedText> inked_lines(const Sheet& sheet) {
    // By colour, in the order in which colours first come: what comes later goes over it.
    std::vector<std::pair<SheetColour, LineMask>> masks;
    for (const SheetLine& line : sheet.lines) {
        auto mask = std::ranges::find(masks, line.colour, &std::pair<SheetColour, LineMask>::first);
        if (mask == masks.end())
            mask = masks.insert(mask, {line.colour, LineMask(sheet.width_px, sheet.height_px)});
        mask->second.add({line.from_px, line.to_px}, line.width_px);
    }
    std::vector<InkedText> all;
    for (auto& [colour, mask] : masks) mask.give(colour, all);
    return all;
}

Result<std::vector<InkedText>> inked_texts(const Sheet& sheet, const TextFace& face) {
    std::vector<InkedText> all;
    for (const SheetText& text : sheet.texts) {
        const double halo_px = text.halo ? sheet_halo_share * text.size_px : 0.0;
        ORO_TRY(TextMask mask,
                face.mask(text.text, {middle_px(text), text.angle_deg, text.size_px, halo_px}));
        all.push_back({std::move(mask), text.ink, text.halo ? text.halo : sheet.paper});
    }
    return all;
}

}  // namespace oro
