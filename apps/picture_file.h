// A view drawn into a file with its geotags, and the view put beside it. Used by shot and by the viewer.
#pragma once

#include "apps/picking.h"
#include "apps/view.h"
#include "geo/picture.h"
#include "render/picture_renderer.h"

namespace oro {

// A picture's file, the view beside it, and the picture of its errors, which --verify asks for.
struct PictureFiles {
    std::string picture;
    std::string view;
    std::string error;
};
PictureFiles picture_files(const std::string& picture);

// All that a picture of a view says of itself; `middle` is what it sees there.
Geotags geotags_of(const View& view, const Region& region, const std::optional<SeenPlace>& middle);

// Draws and writes both files, each whole or not at all. The written view names the way of drawing that
// --pipeline auto came to. Errors: those of the files and of the device; any
// message of the validation layer, where it is on.
Result<PictureReport> write_picture(const PictureFiles& files, bool overwrite, const View& view,
                                    const Region& region, const std::optional<SeenPlace>& middle,
                                    const Gpu& gpu, Scene& scene, const gpu::FrameStyle& style,
                                    const RenderProgress& progress);

}  // namespace oro
