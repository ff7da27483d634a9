// Pictures taken of what a window shows.
#pragma once

#include "apps/window/viewer.h"
#include "apps/window/window_start.h"

namespace oro {

// Shows a scene of the region that the viewer has. Where it is coarse, finer levels are measured from now on.
void take_scene(Viewer& viewer, OpenedScene opened);
// A sun by time stands elsewhere over every place.
void follow_sun(Viewer& viewer);
// Draws what a camera needs of the meshes, where they are drawn by clusters. Errors: the device.
Result<void> choose_meshes(Viewer& viewer, const Camera& camera);
// Goes on without waiting towards what the eye needs of the meshes. True: they are drawn now, or what is
// drawn already is what it needs. Errors: the device.
Result<bool> follow_with_meshes(Viewer& viewer);
// The measured levels become a scene that is not shown yet; waits for them where they are not ready.
Result<void> begin_finer_scene(Viewer& viewer);
// The scene that came is the one that is shown.
void show_finer_scene(Viewer& viewer);
// Writes a picture of the view into the working folder: the bytes that shot draws of it. Waits for full
// detail. What goes wrong with the file is told; errors: those of the device, of text and of posts.
Result<void> take_picture(Viewer& viewer);
// The same of another size, of more samples, or as another kind of file; the angle of view stays upright.
Result<void> take_picture(Viewer& viewer, const PictureChoice& choice);
// Lines for a shell that draw the picture that is asked for of this view: its view as a file, and shot. The
// bytes are those that take_picture() writes, but for the time in them.
std::string command_line_of(const View& view, const PictureChoice& choice);

}  // namespace oro
