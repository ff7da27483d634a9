// A window's work as one JSON file: the view, what is loaded, places and a film.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/film/written_keys.h"
#include "apps/settings/bookmarks.h"
#include "apps/view/view.h"
#include "geo/places/geodesic.h"

namespace oro {

// A place that was looked around from.
struct ProjectViewshed {
    LatLon place;
    double above_m{};
    double target_m{};
    double radius_km{};
    bool bends{true};
};

struct Project {
    View view;                            // with all data, styles and layers that are shown
    std::vector<std::string> names;       // files of names that are loaded, shown or not
    std::vector<std::string> overlay;     // of lines and areas, likewise
    std::vector<std::string> images;      // over the ground, likewise
    std::vector<std::string> cover;       // of land cover, likewise
    std::vector<std::string> gazetteers;  // in which places are found by name
    bool tells_paths{true};               // its pictures do
    std::vector<Bookmark> bookmarks;
    std::vector<WrittenKey> film;
    std::vector<LatLon> measured;  // the line that was measured
    std::optional<ProjectViewshed> viewshed;
};

// The project as text for a file of that name:
//     {"orograph_project": 1, "view": {"orograph_view": 1, ...}, "layers": {...}, "bookmarks": [...],
//      "film": {"orograph_path": 1, ...}, "measured": [[46.5, 8.0], ...], "viewshed": {...}}
// Paths start from the file's folder where they share one with it (view_as_written_in()). Errors: the file
// system cannot tell where a path leads; a view that could not be opened again.
Result<std::string> project_to_json(const Project& project, const std::string& file);
// The other way; `file` is where the text is from, and errors call it. Paths then lead there from the working
// folder. Errors: no project, a newer one, or what is missing or wrong in it.
Result<Project> project_from_json(const std::string& text, const std::string& file);

// Whether a file is a .json that says it is a project, whole or not; or a camera's path alone. False where it
// cannot be read.
bool is_project(const std::string& file);
bool is_camera_path(const std::string& file);
// Errors: those of reading, and of project_from_json().
Result<Project> read_project(const std::string& file);

}  // namespace oro
