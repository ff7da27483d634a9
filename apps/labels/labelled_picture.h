// A view's picture with what is written on it.
#pragma once

#include <vector>

#include "apps/labels/line_labels.h"
#include "apps/names/names_in_view.h"
#include "apps/overlay/overlay_in_view.h"
#include "apps/view/style.h"
#include "apps/view/view.h"

namespace oro {

// What is written over a view's picture: the heights of its contour lines where the style has them, the lines
// of its vector files and the names of their points, and the graticule. Where a name stands there is no
// label.
struct ViewWriting {
    std::vector<LineLabel> labels;  // from the top down
    NamesInView names;
    OverlayInView overlay;
    std::vector<InkedText> texts;  // labels and names as pixels

    [[nodiscard]] bool is_empty() const {
        return texts.empty() && overlay.inked.empty() && overlay.areas.empty();
    }
};
// Whether a view can have any.
[[nodiscard]] bool has_writing(const View& view, const Style& style);

// The heights on the contour lines of a style, where they are seen, and as pixels; none where a name stands.
// Errors: those of text.
Result<std::vector<LineLabel>> add_line_labels(const TextFace& face, const SeenHeights& seen,
                                               const Style& style, const std::vector<NameLabel>& names,
                                               std::vector<InkedText>& texts);

// Finds it. ground: of the view's region with its exaggeration, for the sight lines to what is named. Errors:
// those of pages, of the device, and of text.
Result<ViewWriting> find_writing(const Gpu& gpu, Scene& scene, const View& view, const TrueGround& ground,
                                 const Style& style, RasterPath path);

// A sink for a picture's rows (width * 3 bytes of sRGB, from the top down) that hands them on to `sink` with
// the writing over them; areas and lines first, then what is written over these.
RowSink written_rows(ViewWriting& writing, const Camera& camera, const RowSink& sink);

// Draws a view's picture as render_picture() does, with its writing, which is found before anything is drawn,
// so that rows go on as they come. Errors: those of render_picture() and of find_writing().
struct LabelledPicture {
    PictureReport report;
    std::vector<LineLabel> labels;  // from the top down
    NamesInView names;
    OverlayInView overlay;
};
Result<LabelledPicture> render_labelled(const Gpu& gpu, Scene& scene, const View& view,
                                        const TrueGround& ground, const Style& style, RasterPath path,
                                        const RowSink& sink, const RenderProgress& progress);

// What a view's picture is drawn with.
PictureOptions picture_options(const View& view, RasterPath path);

}  // namespace oro
