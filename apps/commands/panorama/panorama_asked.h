// What the options of a panorama ask for.
#pragma once

#include "apps/commands/panorama/panorama_drawing.h"
#include "apps/options/options.h"

namespace oro {

// Errors (usage): no place, and options of views that say nothing of a panorama, or something that it says in
// another way.
Result<void> check_panorama_view(const PanoramaOptions& options);
// Errors (usage): a sector, elevations or a width that cannot be.
Result<AskedFrame> asked_frame(const PanoramaOptions& options);
// Light bends where nothing is said: over the distances of a panorama it counts.
ViewOptions view_options_of(const PanoramaOptions& options);

}  // namespace oro
