// Text on a picture that comes row by row.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "apps/text/text_face.h"
#include "core/base/result.h"

namespace oro {

// Text, and what colours it has. Under the halo the picture has the halo's colour; without one the colour of
// what is around, as far as that does not look like the ink: a line of the ink's colour is interrupted, and
// the ground goes on.
struct InkedText {
    using Colour = std::array<std::uint8_t, 3>;  // sRGB
    TextMask mask;
    Colour ink{};
    std::optional<Colour> halo;
};

// Takes a picture's rows from the top down, width * 3 bytes of sRGB, and hands them on with texts on them,
// mixed as codes.
class InkedRows {
  public:
    using Sink = std::function<Result<void>(std::span<const std::uint8_t> rgb)>;
    using Colour = InkedText::Colour;
    // `texts` do not touch each other.
    InkedRows(int width_px, int height_px, std::vector<InkedText> texts, Sink sink);

    // The next row. Errors: the sink's.
    Result<void> take(std::span<const std::uint8_t> rgb);

  private:
    [[nodiscard]] Colour around(int x_px, int y_px, const Colour& ink) const;
    void draw(const InkedText& inked);
    Result<void> hand_on(int end_row);

    int width_px_;
    int height_px_;
    std::vector<InkedText> texts_;  // those that end first come first
    std::vector<int> first_rows_;   // that these, and those after them, need
    Sink sink_;
    std::size_t drawn_{};                         // texts
    int first_row_{};                             // of those that are kept
    std::deque<std::vector<std::uint8_t>> rows_;  // not handed on yet
};

}  // namespace oro
