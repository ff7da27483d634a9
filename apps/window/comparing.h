// The difference of the sources of a window's two views, found beside it and laid over the first one's
// ground.
#pragma once

#include <memory>
#include <optional>

#include "apps/window/background_work.h"
#include "apps/window/source_difference.h"

namespace oro {

struct Viewer;

// What is being found, and what was found last.
struct Comparing {
    std::unique_ptr<BackgroundWork<SourceDifference>> work{};
    std::optional<SourceDifference> found{};
    bool is_shown{true};
};

// Begins to compare the sources of both views; nothing where they have the same.
void compare_sources(Viewer& viewer);
// Gives it up; what was found before stays.
void stop_comparing(Viewer& viewer);
// Takes what was found, once it is there, and lays it over the ground. Errors: the device, images.
Result<void> take_difference(Viewer& viewer);
// Lays it over the ground, or takes it off. Errors: likewise.
Result<void> show_difference(Viewer& viewer, bool is_shown);
// Ends what is being found and forgets what was. Errors: likewise.
Result<void> forget_difference(Viewer& viewer);
// Writes it as a GeoTIFF into the working folder. What goes wrong is told.
void save_difference(Viewer& viewer);

}  // namespace oro
