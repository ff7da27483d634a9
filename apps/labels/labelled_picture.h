// A view's picture with what is written on it.
#pragma once

#include <vector>

#include "apps/labels/line_labels.h"
#include "apps/names/names_in_view.h"
#include "apps/overlay/overlay_in_view.h"
#include "apps/view/style.h"
#include "apps/view/view.h"

namespace oro {

// Draws a view's picture as render_picture() does, and writes the heights of its contour lines on it where
// the style has them, the lines of its vector files and the names of their points. All of them are found
// before anything is drawn, so that rows go on as they come. Where a name stands there is no label. Errors:
// those of render_picture(), of pages, and of text.
struct LabelledPicture {
    PictureReport report;
    std::vector<LineLabel> labels;  // from the top down
    NamesInView names;
    OverlayInView overlay;
};
Result<LabelledPicture> render_labelled(const Gpu& gpu, Scene& scene, const View& view,
                                        const HeightField& field, const Style& style, RasterPath path,
                                        const RowSink& sink, const RenderProgress& progress);

// What a view's picture is drawn with.
PictureOptions picture_options(const View& view, RasterPath path);

}  // namespace oro
