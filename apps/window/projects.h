// A window's work, saved as a project and opened again.
#pragma once

#include <optional>

#include "apps/project/project_file.h"

namespace oro {

struct Viewer;

// A command line that names a project, and nothing else to look at, is one that names its view. Gives the
// project, whose view open_flight() takes; nothing where it names none. Errors: those of read_project().
Result<std::optional<Project>> project_named_by(WindowOptions& options);

// What a window would save: its view, what is loaded, the film, the measured line, and those of the user's
// bookmarks that lie in the region.
Project project_of(const Viewer& viewer);
// Takes what a project has beside its view, whose region is shown. Bookmarks of other names than the user has
// become the user's. What cannot be taken is told. Errors: posts.
Result<void> take_project(Viewer& viewer, const Project& project, const std::string& file);

// Saves to the file that viewer.project_file names. What goes wrong is told.
void save_project(Viewer& viewer);
// Saves to where the project is from, or asks for a name.
void save_or_ask(Viewer& viewer);

}  // namespace oro
