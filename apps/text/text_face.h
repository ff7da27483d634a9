// Text as pixels: measured, turned to any angle, smooth at its edges, with a halo around it.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// 0 to 255, row by row.
struct TextMask {
    int x_px{};  // of its first pixel; may be outside the picture
    int y_px{};
    int width_px{};
    int height_px{};
    std::vector<std::uint8_t> ink;
    std::vector<std::uint8_t> halo;  // the letters' own pixels, too
};

// Adds a mask, moved to the right and down, to another. What covers a pixel twice covers it as the larger
// does; what lies beyond the other's rectangle is left out.
void merge(const TextMask& from, int right_px, int down_px, TextMask& to);

// Where text stands in a picture and how large it is.
struct TextPlace {
    glm::dvec2 middle_px;  // half way along it, at half the height of its capitals; from the top left corner
    double angle_deg{};    // of its base line: clockwise, 0 to the right
    double size_px{12.0};  // of the em, above 0; capitals have 0.73 of it
    double halo_px{};      // how far the halo goes beyond the letters; 0: none
};

// The font that pictures are written in. The same text at the same place has the same pixels on every machine
// (with one version of FreeType): shapes are not fitted to the pixels' grid. Not for several threads at a
// time: what was shaped and drawn once is kept.
//     ORO_TRY(const TextFace face, TextFace::open());
//     ORO_TRY(const TextMask mask, face.mask("Eiger", {{320.0, 100.0}, -12.5, 14.0, 2.0}));
class TextFace {
  public:
    // Errors: no memory.
    static Result<TextFace> open();

    // How long a text is, from where its first letter begins to where the next one would. Text is UTF-8, in
    // any script and direction (shaping.h); a letter that the font does not have is a box: it has Latin,
    // Greek, Cyrillic, Arabic, Hebrew, Armenian and Georgian, and no Chinese, Japanese, Korean, Thai or
    // scripts of India. Errors: text that is no UTF-8; no memory.
    [[nodiscard]] Result<double> width_px(const std::string& text, double size_px) const;
    // Adds level text to a mask, the angle counts for nothing: letters stand on whole pixels and on quarters
    // of them along the line, so that each is drawn once however often it is asked for. What lies beyond the
    // mask is left out. Errors: likewise.
    Result<void> add_level(const std::string& text, const TextPlace& place, TextMask& mask) const;
    // Whether the font has all of its letters. Errors: likewise.
    [[nodiscard]] Result<bool> has_all(const std::string& text) const;
    // Errors: likewise.
    [[nodiscard]] Result<TextMask> mask(const std::string& text, const TextPlace& place) const;

  private:
    struct Parts;
    struct Letter;
    [[nodiscard]] Result<const Letter*> letter(std::uint32_t glyph, int quarters,
                                               const TextPlace& place) const;
    struct Ending {
        void operator()(Parts* parts) const;
    };
    explicit TextFace(std::unique_ptr<Parts, Ending> parts) : parts_(std::move(parts)) {}
    std::unique_ptr<Parts, Ending> parts_;
};

}  // namespace oro
