#include "apps/project/project_file.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "apps/options/view_limits.h"
#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/view/view_paths.h"
#include "core/base/file_there.h"
#include "geo/files/letter_case.h"
#include "geo/files/text_encoding.h"

namespace oro {
namespace {

namespace limits = view_limits;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr int project_format = 1;
constexpr std::size_t most_layer_files = 1000, most_measured = 100'000;
constexpr Limits over_ground_m{0.0, 1.0e6}, looking_radius_km{0.001, 1.0e4};

Error not_a_project(const std::string& file, const std::string& reason) {
    return {ErrorKind::failed, file, "holds no project that can be read: " + reason};
}

// Files as a view has them, so that their paths are written and read as those of a view are.
View as_view(const std::vector<std::string>& names, const std::vector<std::string>& overlay,
             const std::vector<std::string>& images, const std::vector<std::string>& cover) {
    View view;
    view.vectors.names = names;
    view.vectors.overlay = overlay;
    view.drape = images;
    view.cover_choice.files = cover;
    return view;
}

ordered_json paths_json(const std::vector<std::string>& paths) {
    ordered_json list = ordered_json::array();
    for (const std::string& path : paths) list.push_back(path_json(path));
    return list;
}

std::vector<std::string> paths_in(const json& from, const char* name) {
    std::vector<std::string> paths;
    if (!from.contains(name)) return paths;
    const json& list = json_field(from, name);
    if (!list.is_array() || list.size() > most_layer_files)
        throw JsonFault{"'" + std::string(name) + "' must be a list of at most " +
                        std::to_string(most_layer_files)};
    for (const json& path : list) paths.push_back(path_from(json_object<json>(name, path), name));
    return paths;
}

Result<ordered_json> layers_json(const Project& project, const std::string& file) {
    ORO_TRY(const View layers,
            view_as_written_in(as_view(project.names, project.overlay, project.images, project.cover), file));
    ORO_TRY(const View gazetteers, view_as_written_in(as_view(project.gazetteers, {}, {}, {}), file));
    return json_object("names", paths_json(layers.vectors.names), "overlay",
                       paths_json(layers.vectors.overlay), "images", paths_json(layers.drape), "landcover",
                       paths_json(layers.cover_choice.files), "gazetteers",
                       paths_json(gazetteers.vectors.names));
}

LatLon place_in(const json& pair) {
    const json as_field = json_object<json>("place", pair);
    const json& numbers = json_array(as_field, "place", 2);
    return {json_number(json_object<json>("lat_deg", numbers[0]), "lat_deg", limits::lat_deg.low,
                        limits::lat_deg.high),
            json_number(json_object<json>("lon_deg", numbers[1]), "lon_deg", limits::lon_deg.low,
                        limits::lon_deg.high)};
}

std::vector<LatLon> measured_in(const json& from) {
    std::vector<LatLon> places;
    if (!from.contains("measured")) return places;
    const json& list = json_field(from, "measured");
    if (!list.is_array() || list.size() > most_measured)
        throw JsonFault{"'measured' must be a list of places"};
    for (const json& place : list) places.push_back(place_in(place));
    return places;
}

std::vector<Bookmark> bookmarks_in(const json& from) {
    std::vector<Bookmark> bookmarks;
    if (!from.contains("bookmarks")) return bookmarks;
    const json& list = json_field(from, "bookmarks");
    if (!list.is_array() || list.size() > most_bookmarks)
        throw JsonFault{"'bookmarks' must be a list of at most " + std::to_string(most_bookmarks)};
    for (const json& one : list) bookmarks.push_back(bookmark_from_json(one));
    return bookmarks;
}

ordered_json viewshed_json(const ProjectViewshed& asked) {
    return json_object("place", json_list(asked.place.lat_deg, asked.place.lon_deg), "above_m", asked.above_m,
                       "target_m", asked.target_m, "radius_km", asked.radius_km, "bends", asked.bends);
}

std::optional<ProjectViewshed> viewshed_in(const json& from) {
    if (!from.contains("viewshed")) return std::nullopt;
    const json& asked = json_field(from, "viewshed");
    const auto number = [&](const char* name, const Limits& within) {
        return json_number(asked, name, within.low, within.high);
    };
    return ProjectViewshed{place_in(json_field(asked, "place")), number("above_m", over_ground_m),
                           number("target_m", over_ground_m), number("radius_km", looking_radius_km),
                           json_flag(asked, "bends")};
}

// All but the view and the film, which are texts of their own.
void read_rest(const json& from, Project& project) {
    const json& layers = json_field(from, "layers");
    if (!layers.is_object()) throw JsonFault{"'layers' must be an object of lists"};
    project.names = paths_in(layers, "names");
    project.overlay = paths_in(layers, "overlay");
    project.images = paths_in(layers, "images");
    project.cover = paths_in(layers, "landcover");
    project.gazetteers = paths_in(layers, "gazetteers");
    project.tells_paths = json_flag(from, "tells_paths");
    project.bookmarks = bookmarks_in(from);
    project.measured = measured_in(from);
    project.viewshed = viewshed_in(from);
}

// From the project's folder to the working folder.
Result<void> lead_layers(const std::string& file, Project& project) {
    View layers = as_view(project.names, project.overlay, project.images, project.cover);
    View gazetteers = as_view(project.gazetteers, {}, {}, {});
    layers.paths_from_own_file = gazetteers.paths_from_own_file = project.view.paths_from_own_file;
    ORO_CHECK(lead_from_working_folder(layers, file));
    ORO_CHECK(lead_from_working_folder(gazetteers, file));
    project.names = layers.vectors.names;
    project.overlay = layers.vectors.overlay;
    project.images = layers.drape;
    project.cover = layers.cover_choice.files;
    project.gazetteers = gazetteers.vectors.names;
    return lead_from_working_folder(project.view, file);
}

// A .json that holds it.
bool holds_word(const std::string& file, const char* word) {
    if (!lower_case(file).ends_with(".json")) return false;
    const auto there = is_there(file);
    if (!there.ok() || !*there) return false;
    const Result<std::string> text = read_own_text_file(file);
    return text.ok() && text->find(word) != std::string::npos;
}

}  // namespace

Result<std::string> project_to_json(const Project& project, const std::string& file) {
    View with_paths = project.view;
    // A project without paths is none.
    with_paths.tells_paths = true;
    ORO_TRY(const View view, view_as_written_in(with_paths, file));
    ORO_CHECK(check_view_opens(view, file));
    ordered_json all = json_object("orograph_project", project_format);
    all["view"] = ordered_json::parse(view_to_json(view, false));
    ORO_TRY(all["layers"], layers_json(project, file));
    all["tells_paths"] = project.tells_paths;
    all["bookmarks"] = ordered_json::array();
    for (const Bookmark& bookmark : project.bookmarks)
        all["bookmarks"].push_back(ordered_json(bookmark_to_json(bookmark)));
    if (!project.film.empty()) {
        std::vector<CameraKey> keys;
        for (const WrittenKey& written : project.film) keys.push_back(written.key);
        all["film"] = ordered_json::parse(keys_to_json(keys));
    }
    if (!project.measured.empty()) {
        all["measured"] = ordered_json::array();
        for (const LatLon& place : project.measured)
            all["measured"].push_back(json_list(place.lat_deg, place.lon_deg));
    }
    if (project.viewshed) all["viewshed"] = viewshed_json(*project.viewshed);
    return json_text(all, true) + "\n";
}

Result<Project> project_from_json(const std::string& text, const std::string& file) {
    try {
        const json all = parsed_json(text);
        if (!all.is_object() || !all.contains("orograph_project"))
            return not_a_project(file, "no orograph_project in it");
        if (all["orograph_project"] != project_format)
            return not_a_project(file, "its format is " + all["orograph_project"].dump() +
                                           ", this program reads " + std::to_string(project_format));
        Project project;
        ORO_TRY(project.view, view_from_json(json_field(all, "view").dump(), file));
        if (all.contains("film")) {
            ORO_TRY(project.film, keys_from_json(json_field(all, "film").dump(), file,
                                                 project.view.camera.vertical_fov_deg));
        }
        read_rest(all, project);
        ORO_CHECK(lead_layers(file, project));
        project.view.read_from = file;
        return project;
    } catch (const JsonFault& fault) {
        return not_a_project(file, fault.what);
    } catch (const json::exception& e) {
        return not_a_project(file, e.what());
    }
}

bool is_project(const std::string& file) {
    return holds_word(file, "\"orograph_project\"");
}

bool is_camera_path(const std::string& file) {
    return holds_word(file, "\"orograph_path\"") && !is_project(file);
}

Result<Project> read_project(const std::string& file) {
    // The window writes over it: it is no input that must stay.
    ORO_TRY(std::string bytes, read_own_text_file(file));
    const auto text = utf8_text(std::move(bytes));
    if (!text.ok()) return Error{text.error().kind, file, text.error().what};
    return project_from_json(*text, file);
}

}  // namespace oro
