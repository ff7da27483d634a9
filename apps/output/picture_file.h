// A view drawn into a file with its geotags, which hold the view. Used by shot and by the viewer.
#pragma once

#include <span>

#include "apps/drawing/picking.h"
#include "apps/labels/labelled_picture.h"
#include "apps/view/view.h"
#include "geo/pictures/picture.h"
#include "render/frame/picture_renderer.h"

namespace oro {

// A picture's file, and the picture of its errors, which --verify asks for: p.error.png of p.png,
// p.jpg.error.png of p.jpg.
struct PictureFiles {
    std::string picture;
    std::string error;
    std::string paths_start_at;  // the picture whose folder the view's paths start from: this one
};
PictureFiles picture_files(const std::string& picture);

// All that a picture of a view says of itself, with the view as that picture carries it; `middle` is what it
// sees there.
Geotags geotags_of(const View& view, const Region& region, const std::optional<SeenPlace>& middle);

// A picture that is whole and has no name yet.
struct DrawnPicture {
    PictureReport report;
    std::vector<LineLabel> labels;
    NamesInView names;
    OverlayInView overlay;
    WholeFile file;
    std::optional<Fingerprints> fingerprints;  // those in it
};

// Draws a picture that is to be `files.picture`, with `strip` below it: view.legend_px rows. The view in it
// names the way of drawing that --pipeline auto came to. `ground` is the region's, with the view's
// exaggeration. `also` gets each row, too. Errors: a view that could
// not be opened again, those of the file and of the device; any message of the validation layer, where it is
// on.
Result<DrawnPicture> draw_picture(const PictureFiles& files, bool overwrite, const View& view,
                                  const Region& region, const RegionGround& ground,
                                  const std::optional<SeenPlace>& middle, const Gpu& gpu, Scene& scene,
                                  const Style& style, std::span<const std::uint8_t> strip,
                                  const RenderProgress& progress, const RowSink& also = {});

// That a picture that was drawn is what its view asks for. Errors: pages or images of it that the GPU had no
// memory for; any message of the validation layer, where it is on.
Result<void> check_drawn(const Gpu& gpu, Scene& scene, const PictureReport& report);

}  // namespace oro
