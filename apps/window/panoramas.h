// The panorama of a place, drawn beside a window and shown in it.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "apps/window/background_work.h"
#include "apps/window/panorama_from_place.h"
#include "render/window.h"

namespace oro {

struct Viewer;

// What its user asks, what is being drawn, and what was drawn last.
struct PanoramaAround {
    std::optional<PanoramaChoice> choice{};
    std::unique_ptr<BackgroundWork<DrawnPanorama>> work{};
    std::optional<DrawnPanorama> drawn{};
    bool is_shown{};
    double zoom{1.0};  // 1: its height is that of the window, or its own where that is less
    double middle_x{0.5}, middle_y{0.5};  // what of it is in the window's middle: shares of its sides
    // What the window shows of it, and which part that is.
    const Image* picture{};
    SheetPart part{};
};

// Begins to draw as the choice says, in place of what was drawn before.
void draw_panorama_around(Viewer& viewer);
void stop_panorama(Viewer& viewer);
// Takes what was drawn, once it is there.
void take_panorama(Viewer& viewer);
// Writes it into the working folder, as the command does. What goes wrong is told. ending: ".png", ".svg"
void save_panorama(Viewer& viewer, const std::string& ending);

// Whether it stands in the place of the ground.
bool shows_panorama(const Viewer& viewer);
// How many pixels of the window one of the sheet takes now.
double panorama_scale(const Viewer& viewer);
// Its part that the window has room for. Errors: the device.
Result<std::optional<WindowPicture>> panorama_to_show(Viewer& viewer);

}  // namespace oro
