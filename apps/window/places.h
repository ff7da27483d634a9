// How the eye of a window goes to places, and what it is told of them.
#pragma once

#include <string>

#include "apps/window/viewer.h"

namespace oro {

// Enter after a jump: on the place; once more, on what is higher near it.
void stand(Viewer& viewer);
// Tells what the picture that is shown has at a point: prints a line, and opens the panel about it.
Result<void> pick(Viewer& viewer, glm::dvec2 point_px);

}  // namespace oro
