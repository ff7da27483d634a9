// What a window does in the background.
#pragma once

#include "apps/window/viewer.h"

namespace oro {

// Whether some is under way.
bool has_work(const Viewer& viewer);
// Takes what is done: once a turn. Errors: the device, images.
Result<void> take_finished_work(Viewer& viewer);

}  // namespace oro
