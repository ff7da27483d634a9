// What a view's --overlay files put on its picture.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/overlay/seen_lines.h"
#include "apps/text/inked_rows.h"
#include "apps/view/view.h"

namespace oro {

// How a line is drawn.
struct Stroke {
    InkedText::Colour colour;
    double width_px;
};
// Lines and the rings of polygons, of all files. A feature's fields `stroke` (#rrggbb) and `stroke-width`
// (pixels) win over the view's colour and width, as in simplestyle.
struct OverlayShapes {
    std::vector<const VectorShape*> shapes;  // the view's
    std::vector<Stroke> strokes;             // one each
    std::size_t lines{};                     // and rings
};
OverlayShapes overlay_shapes(const View& view);

struct OverlayInView {
    std::vector<InkedText> inked;  // those of one colour do not touch each other; the first are drawn first
    std::size_t lines{};           // lines and rings that the files have
    std::vector<InkedText> areas;  // what polygons fill, below all lines
    double seen_px{};              // length of what is seen of them on the picture
    double seconds{};
};

// `in_view` is of the view's own camera and model. `finer`:
// so many times as wide are lines drawn, on a picture that is to become so much smaller.
OverlayInView overlay_in_view(const View& view, const TrueGround& ground, const PointsInView& in_view,
                              double finer = 1.0);

}  // namespace oro
