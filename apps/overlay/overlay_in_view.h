// What a view's --overlay files put on its picture.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/overlay/seen_lines.h"
#include "apps/text/inked_rows.h"
#include "apps/view/view.h"

namespace oro {

struct OverlayInView {
    std::vector<InkedText> inked;  // those of one colour do not touch each other; the first are drawn first
    std::size_t lines{};           // lines and rings that the files have
    std::vector<InkedText> areas;  // what polygons fill, below all lines
    double seen_px{};              // length of what is seen of them on the picture
    double seconds{};
};

// Lines and the rings of polygons. A feature's fields `stroke` (#rrggbb) and `stroke-width` (pixels) win over
// the view's colour and width, as in simplestyle. `in_view` is of the view's own camera and model. `finer`:
// so many times as wide are lines drawn, on a picture that is to become so much smaller.
OverlayInView overlay_in_view(const View& view, const TrueGround& ground, const PointsInView& in_view,
                              double finer = 1.0);

}  // namespace oro
