#include "apps/window/projects.h"

#include <algorithm>
#include <utility>

#include "apps/eye/standpoint.h"
#include "apps/window/measuring.h"
#include "apps/window/search.h"
#include "apps/window/viewer.h"
#include "geo/files/letter_case.h"
#include "geo/files/whole_file.h"

namespace oro {
namespace {

std::vector<Bookmark> bookmarks_in_region(const Region& region) {
    std::vector<Bookmark> found;
    const auto bookmarks = read_bookmarks();
    // A user without a folder for it has none.
    if (!bookmarks.ok()) return found;
    for (const Bookmark& one : bookmarks->all)
        if (holds(grid_at(region, one.lat_deg, one.lon_deg).field.grid, one.lat_deg, one.lon_deg))
            found.push_back(one);
    return found;
}

void add_bookmarks(Viewer& viewer, const std::vector<Bookmark>& bookmarks) {
    if (bookmarks.empty()) return;
    const auto known = read_bookmarks();
    if (!known.ok()) return tell(viewer, known.error());
    for (const Bookmark& one : bookmarks) {
        if (std::ranges::find(known->all, one.name, &Bookmark::name) != known->all.end()) continue;
        if (const auto added = add_bookmark(one); !added.ok()) return tell(viewer, added.error());
    }
}

// All of the one list, and those of the other that it has not.
std::vector<std::string> joined_files(std::vector<std::string> files, const std::vector<std::string>& more) {
    for (const std::string& file : more)
        if (std::ranges::find(files, file) == files.end()) files.push_back(file);
    return files;
}

}  // namespace

Result<std::optional<Project>> project_named_by(WindowOptions& options) {
    std::optional<Project> named;
    const std::vector<std::string>& paths = options.region.paths;
    if (!options.view_file.empty() || paths.size() != 1 || !is_project(paths.front())) return named;
    ORO_TRY(named, read_project(paths.front()));
    options.view_file = paths.front();
    options.region.paths.clear();
    if (options.gazetteers.empty()) options.gazetteers = named->gazetteers;
    options.no_paths = options.no_paths || !named->tells_paths;
    return named;
}

Project project_of(const Viewer& viewer) {
    Project project;
    project.view = view_alone(viewer);
    const VectorChoices& shown = viewer.view.vectors;
    const VectorChoices known = viewer.vectors_known.value_or(shown);
    project.names = joined_files(known.names, shown.names);
    project.overlay = joined_files(known.overlay, shown.overlay);
    project.images = joined_files(viewer.images_known, viewer.view.drape);
    project.cover = joined_files(viewer.cover_known, viewer.view.cover_choice.files);
    project.gazetteers = viewer.options.gazetteers;
    project.tells_paths = viewer.view.tells_paths;
    project.bookmarks = bookmarks_in_region(viewer.region);
    for (const CameraKey& key : viewer.film.keys) project.film.push_back({key, HeightAbove::ellipsoid});
    project.measured = viewer.measuring.found.places;
    if (const auto& asked = viewer.looking.choice)
        project.viewshed =
            ProjectViewshed{asked->place, asked->above_m, asked->target_m, asked->radius_km, asked->bends};
    return project;
}

Result<void> take_project(Viewer& viewer, const Project& project, const std::string& file) {
    viewer.project_file = viewer.own_project = file;
    VectorChoices known = viewer.view.vectors;
    known.names = joined_files(project.names, known.names);
    known.overlay = joined_files(project.overlay, known.overlay);
    viewer.vectors_known = std::move(known);
    viewer.images_known = joined_files(project.images, viewer.view.drape);
    viewer.cover_known = joined_files(project.cover, viewer.view.cover_choice.files);
    auto keys = eyes_over_region(project.film, viewer.region, viewer.view.exaggeration, file);
    if (keys.ok())
        viewer.film.keys = std::move(*keys);
    else
        tell(viewer, keys.error());
    if (const auto& asked = project.viewshed)
        viewer.looking.choice =
            SeenAroundChoice{asked->place, asked->above_m, asked->target_m, asked->radius_km, asked->bends};
    add_bookmarks(viewer, project.bookmarks);
    fill_search(viewer);
    return project.measured.empty() ? Result<void>() : measure_places(viewer, project.measured);
}

void save_project(Viewer& viewer) {
    std::string& file = viewer.project_file;
    if (!lower_case(file).ends_with(".json")) file += ".json";
    const auto text = project_to_json(project_of(viewer), file);
    if (!text.ok()) return tell(viewer, text.error());
    const Result<void> written = write_whole_file(file, *text, file == viewer.own_project);
    if (!written.ok()) return tell(viewer, written.error());
    viewer.own_project = file;
    viewer.panels.project = false;
    tell(viewer, "saved " + file);
}

void save_or_ask(Viewer& viewer) {
    if (viewer.own_project.empty()) return viewer.panels.open(&Panels::project);
    viewer.project_file = viewer.own_project;
    save_project(viewer);
}

}  // namespace oro
