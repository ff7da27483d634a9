#include "apps/overlay/overlay_in_view.h"

#include <glm/geometric.hpp>
#include <map>
#include <optional>

#include "apps/options/view_limits.h"
#include "apps/overlay/line_masks.h"
#include "apps/styles/colours.h"
#include "apps/vectors/named_points.h"
#include "core/base/elapsed.h"

namespace oro {
namespace {

Stroke stroke_of(const VectorLayer& layer, const VectorShape& shape, const VectorChoices& choices) {
    Stroke stroke{ink_of(choices.overlay_colour), choices.overlay_width_px};
    if (const auto colour = colour_from(std::string(layer.text(shape, "stroke"))))
        stroke.colour = ink_of(*colour);
    const auto width_px = metres_from(layer.text(shape, "stroke-width"));  // a number
    if (width_px && view_limits::overlay_width_px.hold(*width_px)) stroke.width_px = *width_px;
    return stroke;
}

double length_px(const std::vector<glm::dvec2>& places_px) {
    double all_px = 0.0;
    for (std::size_t i = 0; i + 1 < places_px.size(); ++i)
        all_px += glm::length(places_px[i + 1] - places_px[i]);
    return all_px;
}

}  // namespace

OverlayShapes overlay_shapes(const View& view) {
    OverlayShapes all;
    for (const VectorFile& file : view.vectors_read->overlay) {
        for (const VectorLayer& layer : file.layers) {
            for (const VectorShape& shape : layer.shapes) {
                if (shape.kind == VectorKind::point) continue;
                all.lines += shape.paths.size();
                all.shapes.push_back(&shape);
                all.strokes.push_back(stroke_of(layer, shape, view.vectors));
            }
        }
    }
    return all;
}

OverlayInView overlay_in_view(const View& view, const TrueGround& ground, const PointsInView& in_view,
                              double finer) {
    const auto start = Clock::now();
    OverlayInView overlay;
    const OverlayShapes all = overlay_shapes(view);
    overlay.lines = all.lines;
    const Camera& camera = view.camera;
    const double margin_px = view_limits::overlay_width_px.high;
    std::vector<InkedText::Colour> order;
    std::map<InkedText::Colour, LineMask> masks;
    for (const SeenLine& line : seen_lines(all.shapes, ground, in_view, camera, margin_px)) {
        const Stroke& stroke = all.strokes[line.shape];
        const auto [mask, is_new] =
            masks.try_emplace(stroke.colour, LineMask(camera.width_px, camera.height_px));
        if (is_new) order.push_back(stroke.colour);
        mask->second.add(line.places_px, finer * stroke.width_px);
        overlay.seen_px += length_px(line.places_px);
    }
    for (const InkedText::Colour& colour : order) masks.at(colour).give(colour, overlay.inked);
    overlay.seconds = seconds_since(start);
    return overlay;
}

}  // namespace oro
