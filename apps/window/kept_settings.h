// What a window keeps from one run to the next (apps/settings/window_settings.h).
#pragma once

#include "apps/window/viewer.h"

namespace oro {

// Which panels are open, by the names that the file of settings has for them; those that come and go with
// what the user does are not among them.
std::map<std::string, bool> panels_by_name(const Panels& panels);
// Opens those that are named so; names of other versions of the program are passed over.
Panels panels_of_names(const std::map<std::string, bool>& names);

// The settings of the user, and what is to be said of them; the defaults where there is no folder for them.
WindowSettings settings_of_user(std::vector<std::string>& notes);
// The options with the size that the window had last, where they name none and no view.
WindowOptions with_kept_size(const WindowOptions& options, const WindowSettings& settings);
// Keeps what is set now; its size where no option said it, and where it is not the whole screen. What cannot
// be written is told.
void keep_settings(Viewer& viewer);

}  // namespace oro
