#include "apps/window/search.h"

#include <cstdio>
#include <utility>

#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/search/gazetteer.h"
#include "apps/window/motion.h"
#include "core/earth/ellipsoid.h"
#include "core/terrain/ground.h"

namespace oro {
namespace {

// A place with a height in the ground: the eye is over it.
std::string message_of_jump(const Place& place, const Camera& there) {
    if (!place.height_m) return "Enter stands on it, Backspace goes back";
    const double lifted_m = there.eye.h_m - *place.height_m;
    if (!(lifted_m > 0.0)) return "Backspace goes back";
    char text[100];
    std::snprintf(text, sizeof text, "the ground there is higher: the eye is lifted by %.1f m, ", lifted_m);
    return text + std::string("Backspace goes back");
}

// The text stays, to be mended.
void refuse(Viewer& viewer, const Error& why) {
    viewer.search.is_open = viewer.search.takes_focus = true;
    viewer.search.error = why.where.empty() ? why.what : why.line();
    viewer.message = viewer.search.error;
    say(false, viewer.message);
}

Camera camera_of_eye(const Camera& shown, const Place& place, const BookmarkedEye& eye) {
    Camera there = shown;
    there.eye = {place.lat_deg, place.lon_deg, eye.h_m};
    there.attitude = {eye.heading_deg, eye.pitch_deg, eye.roll_deg};
    there.vertical_fov_deg = eye.vertical_fov_deg;
    return there;
}

// A point is marked until another jump; a cell fills the picture, and needs no mark.
void mark_place(Viewer& viewer, const Place& place) {
    viewer.jumped_to.reset();
    if (place.cell) return;
    const auto ground_m =
        ground_h_m(field_below(viewer), place.lat_deg, place.lon_deg, viewer.view.exaggeration);
    if (ground_m) viewer.jumped_to = ecef_from_geodetic({place.lat_deg, place.lon_deg, *ground_m});
}

// Where a target is looked at from. Errors: no data there.
Result<Camera> camera_to(Viewer& viewer, const SearchTarget& target) {
    const Camera& shown = viewer.view.camera;
    if (target.action == SearchAction::view && target.eye) {
        viewer.jumps.moved();
        return camera_of_eye(shown, target.place, *target.eye);
    }
    const std::string name = target.name.empty() ? viewer.search.text : target.name;
    ORO_TRY(const Camera there,
            viewer.jumps.to(shown, target.place, viewer.region, viewer.view.exaggeration, name));
    mark_place(viewer, target.place);
    if (target.action != SearchAction::stand) return there;
    ORO_TRY(const auto standing, viewer.jumps.stand(there, viewer.region, viewer.view.exaggeration));
    return standing.value_or(there);
}

void take_bookmarks(Viewer& viewer, const std::vector<Bookmark>& all) {
    viewer.bookmarks = all;
    viewer.index.set_bookmarks(all);
    find_matches(viewer);
}

}  // namespace

void index_points(Viewer& viewer) {
    std::vector<SearchPlace> places;
    if (const auto& read = viewer.view.vectors_read) {
        for (const auto* const files : {&read->names, &read->overlay})
            for (const VectorFile& file : *files)
                for (SearchPlace& place : places_of(file, viewer.view.vectors.names_field))
                    places.push_back(std::move(place));
    }
    viewer.index.set_points(NameTable(std::move(places)));
}

void fill_search(Viewer& viewer) {
    const auto bookmarks = read_bookmarks();
    if (bookmarks.ok()) {
        take_bookmarks(viewer, bookmarks->all);
        for (const std::string& note : bookmarks->notes) tell(viewer, note);
    }
    index_points(viewer);
    auto crs = search_crs(viewer.options.coordinates, viewer.region);
    if (crs.ok())
        viewer.index.set_crs(std::move(*crs));
    else
        tell(viewer, crs.error());
}

void take_gazetteers(Viewer& viewer) {
    if (!viewer.is_shown) return;
    if (!viewer.reads_gazetteers && !viewer.options.gazetteers.empty())
        viewer.gazetteers = std::make_unique<GazetteerReading>(viewer.options.gazetteers);
    viewer.reads_gazetteers = true;
    if (!viewer.gazetteers || !viewer.gazetteers->ready()) return;
    GazetteerNames read = viewer.gazetteers->wait();
    viewer.gazetteers.reset();
    for (const Error& why : read.errors) tell(viewer, why);
    for (const std::string& note : read.notes) say(viewer.options.quiet, "note: " + note);
    viewer.index.set_gazetteer(std::move(read.names));
    find_matches(viewer);
}

void find_matches(Viewer& viewer) {
    constexpr std::size_t most_matches = 8;
    viewer.search.chosen.reset();
    viewer.search.matches = viewer.index.matches(viewer.search.text, most_matches);
}

void keep_bookmark(Viewer& viewer) {
    const Camera& camera = viewer.view.camera;
    Bookmark bookmark;
    bookmark.name = viewer.bookmark_name;
    bookmark.lat_deg = camera.eye.lat_deg;
    bookmark.lon_deg = camera.eye.lon_deg;
    bookmark.eye = BookmarkedEye{camera.eye.h_m, camera.attitude.heading_deg, camera.attitude.pitch_deg,
                                 camera.attitude.roll_deg, camera.vertical_fov_deg};
    const auto kept = add_bookmark(bookmark);
    if (!kept.ok()) return tell(viewer, kept.error());
    for (const std::string& note : kept->notes) tell(viewer, note);
    take_bookmarks(viewer, kept->all);
    tell(viewer, "kept this view as " + bookmark.name);
    viewer.bookmark_name.clear();
}

void drop_bookmark(Viewer& viewer, const std::string& name) {
    const auto kept = remove_bookmark(name);
    if (!kept.ok()) return tell(viewer, kept.error());
    take_bookmarks(viewer, kept->all);
}

void go_to_bookmark(Viewer& viewer, const Bookmark& bookmark) {
    SearchMatch match;
    match.place = {bookmark.name, bookmark.lat_deg, bookmark.lon_deg, {}, PlaceClass::other, 0.0};
    match.source = NameSource::bookmark;
    match.eye = bookmark.eye;
    go_to(viewer, target_of(match));
}

void go_to(Viewer& viewer, const SearchTarget& target) {
    viewer.jumps.stay();
    const auto there = camera_to(viewer, target);
    if (!there.ok()) return refuse(viewer, there.error());
    viewer.search.is_open = false;
    viewer.search.text.clear();
    viewer.search.chosen.reset();
    const bool stands = target.action == SearchAction::stand || target.action == SearchAction::view;
    fly_to(viewer, *there, stands ? "Backspace goes back" : message_of_jump(target.place, *there));
}

void search(Viewer& viewer) {
    SearchField& field = viewer.search;
    field.error.clear();
    if (field.text.find_first_not_of(" \t") == std::string::npos) {
        field.is_open = false;
        return;
    }
    if (field.chosen && *field.chosen < field.matches.size())
        return go_to(viewer, target_of(field.matches[*field.chosen]));
    const auto target = viewer.index.resolve(field.text);
    if (!target.ok()) {
        viewer.jumps.stay();
        return refuse(viewer, target.error());
    }
    go_to(viewer, *target);
}

}  // namespace oro
