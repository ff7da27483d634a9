// From text to the letters of a font, in the order and at the places in which they stand: accents on their
// letters, Arabic letters joined, from right to left where the script runs so.
#pragma once

#include <hb.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// A glyph of the font, and how far it stands from the text's beginning, in ems; y up.
struct ShapedLetter {
    std::uint32_t glyph{};
    double x_em{};
    double y_em{};
};
struct ShapedText {
    std::vector<ShapedLetter> letters;
    double width_em{};
    bool is_whole{true};  // the font has all of its letters
};

struct FontEnding {
    void operator()(hb_font_t* font) const { hb_font_destroy(font); }
};
using ShapingFont = std::unique_ptr<hb_font_t, FontEnding>;

// A font's file in memory, which outlives what is made of it.
ShapingFont shaping_font(const unsigned char* file, unsigned long bytes);

// One line of text. Parts of it that are written in scripts of different directions follow each other in the
// direction of the first; figures run from left to right. Errors: text that is no UTF-8.
Result<ShapedText> shaped(hb_font_t* font, const std::string& text);

}  // namespace oro
