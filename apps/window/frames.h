// The pictures of the ground that a window shows one after the other.
#pragma once

#include "apps/window/viewer.h"

namespace oro {

// Measured levels take the place of coarse ones once they are there.
Result<void> refine(Viewer& viewer, bool& changed);
// Draws with what is on the GPU; what is missing comes in the background and is drawn when it is there. True
// where a picture was drawn, or while the eye moves, is being drawn: what it tells is taken one frame later.
// `changed`: whether one is wanted, and afterwards, whether another one is.
Result<bool> draw_frame(Viewer& viewer, bool& changed);
// Whether a plan lacks what advance() may yet bring; lacks_memory: pages that it lacks do not fit on the GPU.
bool lacks_what_may_come(const FramePlan& plan, bool lacks_memory);
// Whether it was found just now that nothing more fits on the GPU; known: whether it was before, and is now.
bool lacks_memory_now(const Scene& scene, bool& known);
// Waits for frames that are under way and takes what they tell, until so many are left.
Result<void> take_reports(Viewer& viewer, std::size_t left);
// Waits for all of them, and until nothing at all is under way: before what they use is given up, and before
// what they tell is to be known.
Result<void> finish_frames(Viewer& viewer);
// What is to be shown now: the picture that was drawn last, whatever its size, or a sheet that says that
// ground comes. Nothing while the window is minimised.
Result<std::optional<WindowPicture>> picture_to_show(Viewer& viewer);
// Told of each time that it was shown.
void say_what_is_shown(Viewer& viewer);
// All of a camera's picture.
Tile whole_tile(const Camera& camera);
// The same camera with so many times as many pixels a side, at least one.
Camera scaled_camera(const Camera& camera, double scale);
// A style as a frame at a step of detail has it.
gpu::FrameStyle style_at(gpu::FrameStyle style, const DetailStep& step);
// Has a scene's plans hold what a style asks for; trees where they are drawn at the step alone. The fields of
// shadows stay through a motion, so that they need not come again after it.
void require_fields(Scene& scene, const gpu::FrameStyle& style, const DetailStep& step);
// A renderer that draws what the view and its style ask for now.
Result<FrameRenderer> renderer_for(const Gpu& gpu, const View& view, const Style& style, RasterPath path,
                                   VkExtent2D extent);

}  // namespace oro
