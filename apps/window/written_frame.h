// A window's frame with what is written over pictures: names, lines, labels.
#pragma once

#include "apps/labels/labelled_picture.h"
#include "render/frame/frame_renderer.h"

namespace oro {

// Writes over the last frame that the renderer drew, which was of this view and as large as its camera's
// picture, what a picture of the view has written over it. Errors: those of find_writing(), and of the
// device.
Result<void> write_over_frame(const Gpu& gpu, Scene& scene, const View& view, const TrueGround& ground,
                              const Style& style, RasterPath path, FrameRenderer& renderer);

}  // namespace oro
