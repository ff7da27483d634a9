// A panorama as a sheet of paper: the scene, and the lines and text around and over it, before they become
// pixels or SVG.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/text/inked_rows.h"

namespace oro {

using SheetColour = InkedText::Colour;

// Places are pixels from the sheet's top left corner.
struct SheetLine {
    glm::dvec2 from_px;
    glm::dvec2 to_px;
    double width_px{1.0};
    SheetColour colour{};
};

struct SheetText {
    enum class Anchor { begin, middle, end };
    std::string text;
    glm::dvec2 at_px;  // its beginning, middle or end, at half the height of its capitals
    Anchor anchor{Anchor::middle};
    double angle_deg{};  // of its base line, clockwise: -90 is upwards
    double size_px{};    // of the em
    double length_px{};
    SheetColour ink{};
    std::optional<SheetColour> halo;  // around the letters, on the scene
    std::string kind;                 // what it is: "name", "azimuth", ...
};

struct Sheet {
    int width_px{};
    int height_px{};
    int scene_top_px{};  // the scene's first row
    int scene_rows_px{};
    SheetColour paper{};
    std::vector<SheetLine> lines;  // under the text
    std::vector<SheetText> texts;
};

// How far halos reach, of the em.
inline constexpr double sheet_halo_share = 0.17;

// Half way along a text.
glm::dvec2 middle_px(const SheetText& text);

// Its lines, and its text that goes over them, as pixels. Errors: those of text.
std::vector<InkedText> inked_lines(const Sheet& sheet);
Result<std::vector<InkedText>> inked_texts(const Sheet& sheet, const TextFace& face);

// The sheet as SVG: the scene as a PNG within, lines and text as such. `title` and `description` are told by
// viewers. Errors: text that is no UTF-8; those of the encoder.
Result<std::string> sheet_svg(const Sheet& sheet, std::span<const std::uint8_t> scene_rgb,
                              const std::string& title, const std::string& description);

}  // namespace oro
