// A map with heights on its contour lines.
#pragma once

#include <vector>

#include "apps/labels/line_labels.h"
#include "apps/maps/ortho_map.h"

namespace oro {

struct LabelledMap {
    PictureReport report;
    std::vector<LineLabel> labels;  // from the top down
};

// Draws a map as draw_map() does, and writes heights on every fifth contour line where the style has such
// labels, as on pictures (line_labels()); where there is no ground the map stays transparent. Without labels
// the same rows as draw_map(). Errors: those of draw_map() and of text.
Result<LabelledMap> draw_labelled_map(const Gpu& gpu, Scene& scene, const View& view,
                                      const TrueGround& ground, const Style& style, RasterPath path,
                                      const MapRowSink& sink, const RenderProgress& progress);

}  // namespace oro
