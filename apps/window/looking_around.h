// What is seen from a place, as a tint over the ground of a window.
#pragma once

#include <memory>
#include <optional>

#include "apps/window/background_work.h"
#include "apps/window/seen_around.h"
#include "render/scene/scene.h"

namespace oro {

struct Viewer;

// What its user asks, what is being found out, and what was found last.
struct LookingAround {
    std::optional<SeenAroundChoice> choice{};
    std::unique_ptr<BackgroundWork<SeenAround>> work{};
    std::optional<SeenAround> found{};
    bool is_shown{true};
};

// Begins to look around as the choice says, in place of what was looked at before.
void look_around(Viewer& viewer);
// Gives it up; what was found before stays.
void stop_looking_around(Viewer& viewer);
// Takes what was found, once it is there, and lays it over the ground. Errors: the device, images.
Result<void> take_seen_around(Viewer& viewer);
// Lays the tint over the ground, or takes it off. Errors: likewise.
Result<void> show_seen_around(Viewer& viewer, bool is_shown);
// Forgets what was found. Errors: likewise.
Result<void> forget_seen_around(Viewer& viewer);
// Writes the command's GeoTIFF into the working folder. What goes wrong is told.
void save_seen_around(Viewer& viewer);

// Whether there is a tint, and it is shown: of what is seen, or of how two sources differ.
bool is_tinted(const Viewer& viewer);
// Leaves all tints out of the ground, or lays the one that is shown over it again. Errors: the device,
// images.
Result<void> leave_tints_out(Viewer& viewer, bool left_out);
// Lays the view's images over a scene anew, and the tint over them; of two tints that of the difference.
// Errors: the device, images.
Result<void> lay_over_ground(Viewer& viewer, Scene& scene);
// The same over the scenes that are there: the one that is shown, and the one that comes.
Result<void> lay_over_ground(Viewer& viewer);

}  // namespace oro
