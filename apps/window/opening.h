// Files that a window's user opens while it is there: by dropping them on it, or from a panel.
#pragma once

#include <string>
#include <vector>

#include "apps/window/viewer.h"

namespace oro {

// Opens what the paths name. Vector files (GPX, KML, GeoJSON, GeoPackage, shapefiles, CSV ...) and images lie
// over the ground that is shown; a picture that carries a view moves the eye to where it was taken; the keys
// of a camera's path are the film; all others together are read in the background as the region that is shown
// next, and a project as it was saved. What cannot be opened is told, and what is shown stays. Errors: the
// device.
Result<void> open_paths(Viewer& viewer, const std::vector<std::string>& paths);
// Shows the region that was read in the background, once it is there, with the style, the detail, the air,
// the names, lines and images that are shown now. One that cannot be shown is told. Errors: the device.
Result<void> take_opened(Viewer& viewer);
// Puts paths at the head of what was opened last (apps/settings/recent_files.h), for the panel of files.
void remember_opened(Viewer& viewer, const std::vector<std::string>& paths);

}  // namespace oro
