// Views as JSON, and back.
#include <array>
#include <ctime>
#include <nlohmann/json.hpp>

#include "apps/fingerprints/fingerprints.h"
#include "apps/options/view_limits.h"
#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/option_words.h"
#include "apps/view/accuracy.h"
#include "apps/view/mesh_request.h"
#include "apps/view/model_names.h"
#include "apps/view/style.h"
#include "apps/view/view.h"
#include "apps/view/view_option_table.h"
#include "apps/view/view_paths.h"
#include "core/light/utc_time.h"
#include "geo/files/letter_case.h"
#include "geo/files/text_encoding.h"
#include "geo/meshes/mesh_look.h"
#include "geo/pictures/picture.h"
#include "geo/sources/raster_source.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

namespace limits = view_limits;

constexpr int view_format = 1;
constexpr const char* own_file = "this file";

Error not_a_view(const std::string& where, const std::string& reason) {
    return {ErrorKind::failed, where, "holds no view that can be read: " + reason};
}

// An element of a list, as a field of the list's name: that is what a fault tells of.
nlohmann::json as_field(const char* name, const nlohmann::json& element) {
    return json_object<nlohmann::json>(name, element);
}

double number(const nlohmann::json& json, const char* name, const Limits& limits) {
    return json_number(json, name, limits.low, limits.high);
}

std::int64_t whole(const nlohmann::json& json, const char* name, const Limits& limits) {
    return json_whole(json, name, static_cast<std::int64_t>(limits.low),
                      static_cast<std::int64_t>(limits.high));
}

BoundingBox read_box(const nlohmann::json& json) {
    const nlohmann::json& corners = json_array(json, "bbox", 4);
    const auto angle = [&](std::size_t i, double limit) {
        return json_number(as_field("bbox", corners[i]), "bbox", -limit, limit);
    };
    const BoundingBox box{angle(0, 180), angle(1, 90), angle(2, 180), angle(3, 90)};
    if (!(box.south_deg < box.north_deg) || box.west_deg == box.east_deg) throw JsonFault{"'bbox' is empty"};
    return box;
}

// Of a named choice; views of before there was it have none, and keep what `value` is.
template <class Choice, std::size_t count>
void read_choice(const nlohmann::json& json, const char* name, const Names<Choice, count>& names,
                 Choice& value) {
    if (json.contains(name)) value = choice_in(json, name, names);
}

void read_air(const nlohmann::json& json, Air& air) {
    if (!json.contains("refraction")) return;
    air.k = number(json, "refraction", limits::refraction_k);
    // Views of before --refraction was the same at all heights do not say which air they have: theirs bent
    // light less where the eye was higher.
    air.law = AirLaw::standard;
    read_choice(json, "air", air_law_names, air.law);
    if (air.k == 0.0) air.law = AirLaw::constant;
}

void read_sources(const nlohmann::json& json, View& view) {
    const nlohmann::json& sources = json_field(json, "sources");
    if (!sources.is_array())
        throw JsonFault{"'sources' must be a list, and is " + std::string(sources.type_name())};
    for (const nlohmann::json& source : sources)
        view.region.paths.push_back(path_from(as_field("sources", source), "sources"));
    view.tells_paths = !view.region.paths.empty();
    // Views of before pictures told where paths start have them from the working folder.
    if (!json.contains("paths_from")) return;
    if (json_string(json, "paths_from") != own_file)
        throw JsonFault{"'paths_from' is not '" + std::string(own_file) + "'"};
    view.paths_from_own_file = true;
}

// Views of before there was any have none.
std::vector<std::string> rasters_from(const nlohmann::json& object, const char* name) {
    const nlohmann::json& files = json_field(object, "files");
    if (!files.is_array() || files.empty() || files.size() > most_images)
        throw JsonFault{"'files' of '" + std::string(name) + "' must be a list of 1 to " +
                        std::to_string(most_images)};
    std::vector<std::string> paths;
    for (const nlohmann::json& file : files) paths.push_back(path_from(as_field("files", file), "files"));
    return paths;
}
void read_meshes(const nlohmann::json& json, MeshRequest& request) {
    if (!json.contains("meshes")) return;
    const nlohmann::json& meshes = json_field(json, "meshes");
    request.files = rasters_from(meshes, "meshes");
    if (meshes.contains("crs")) request.crs = json_string(meshes, "crs");
    if (meshes.contains("lod")) request.lod = json_string(meshes, "lod");
    if (is_no_lod(request.lod))
        throw JsonFault{"'lod' of 'meshes' is '" + request.lod + "', no level of detail"};
    if (meshes.contains("building_height")) request.building_height = json_string(meshes, "building_height");
    if (meshes.contains("building_base")) request.building_base = json_string(meshes, "building_base");
    if (meshes.contains("cut_under")) request.cut_under = json_flag(meshes, "cut_under");
    if (meshes.contains("look")) request.look = json_string(meshes, "look");
    if (!request.look.empty() && !is_mesh_look(request.look))
        throw JsonFault{"'look' of 'meshes' is '" + request.look + "', none of ground, built, plain"};
    if (meshes.contains("crease_deg")) request.crease_deg = number(meshes, "crease_deg", limits::crease_deg);
    if (!meshes.contains("unit")) return;
    request.unit = json_string(meshes, "unit");
    if (!metres_in(request.unit))
        throw JsonFault{"'unit' of 'meshes' is '" + request.unit + "', none of m, ft, us-ft, cm, dm, mm"};
}
void read_drape(const nlohmann::json& json, View& view) {
    if (!json.contains("drape")) return;
    const nlohmann::json& drape = json_field(json, "drape");
    view.drape = rasters_from(drape, "drape");
    view.drape_opacity = number(drape, "opacity", limits::drape_opacity);
    read_choice(drape, "values", image_value_names, view.drape_values);
}

// Likewise.
void read_cover(const nlohmann::json& json, View& view) {
    if (!json.contains("landcover")) return;
    const nlohmann::json& cover = json_field(json, "landcover");
    view.cover_choice.files = rasters_from(cover, "landcover");
    view.cover_choice.table = path_from(cover, "table");
}

// Likewise.
void read_canopy(const nlohmann::json& json, View& view) {
    if (!json.contains("canopy")) return;
    const nlohmann::json& canopy = json_field(json, "canopy");
    CanopyChoice& choice = view.canopy_choice;
    choice.by_class = json_string(canopy, "from") == "class";
    if (choice.by_class && view.cover_choice.files.empty())
        throw JsonFault{"'canopy' is of classes, and there is no 'landcover'"};
    if (!choice.by_class) {
        const nlohmann::json& files = json_field(canopy, "files");
        if (!files.is_array() || files.empty() || files.size() > most_images)
            throw JsonFault{"'files' of 'canopy' must be a list of 1 to " + std::to_string(most_images)};
        for (const nlohmann::json& file : files)
            choice.files.push_back(path_from(as_field("files", file), "files"));
    }
    if (canopy.contains("held")) choice.held = json_number(canopy, "held", 0.0, 1.0);
}

// Likewise.
void read_detail(const nlohmann::json& json, View& view) {
    if (!json.contains("detail")) return;
    const nlohmann::json& detail = json_field(json, "detail");
    DetailChoice choice;
    choice.halvings = static_cast<int>(json_whole(detail, "halvings", 1, most_halvings));
    if (detail.contains("radius_km"))
        choice.radius_km = json_number(detail, "radius_km", least_detail_km, most_detail_km);
    if (detail.contains("lat_deg"))
        choice.middle = DetailMiddle{number(detail, "lat_deg", limits::lat_deg),
                                     number(detail, "lon_deg", limits::lon_deg)};
    view.detail = choice;
}

ordered_json detail_choice_json(const DetailChoice& choice) {
    ordered_json json = json_object("halvings", choice.halvings);
    if (choice.radius_km) json["radius_km"] = *choice.radius_km;
    if (choice.middle) {
        json["lat_deg"] = choice.middle->lat_deg;
        json["lon_deg"] = choice.middle->lon_deg;
    }
    return json;
}

ordered_json canopy_choice_json(const CanopyChoice& choice) {
    ordered_json json = json_object("from", choice.by_class ? "class" : "file");
    if (!choice.by_class) {
        json["files"] = ordered_json::array();
        for (const std::string& file : choice.files) json["files"].push_back(path_json(file));
    }
    if (choice.held) json["held"] = *choice.held;
    return json;
}

ordered_json cover_json(const CoverChoice& choice) {
    ordered_json files = ordered_json::array();
    for (const std::string& file : choice.files) files.push_back(path_json(file));
    return json_object("files", std::move(files), "table", path_json(choice.table));
}

ordered_json meshes_json(const MeshRequest& meshes) {
    ordered_json files = ordered_json::array();
    for (const std::string& file : meshes.files) files.push_back(path_json(file));
    ordered_json json = json_object("files", std::move(files));
    if (!meshes.crs.empty()) json["crs"] = meshes.crs;
    if (!meshes.unit.empty()) json["unit"] = meshes.unit;
    if (!meshes.lod.empty()) json["lod"] = meshes.lod;
    if (!meshes.building_height.empty()) json["building_height"] = meshes.building_height;
    if (!meshes.building_base.empty()) json["building_base"] = meshes.building_base;
    if (!meshes.look.empty()) json["look"] = meshes.look;
    if (meshes.cut_under) json["cut_under"] = true;
    if (meshes.crease_deg) json["crease_deg"] = *meshes.crease_deg;
    return json;
}

ordered_json drape_json(const View& view) {
    ordered_json json = ordered_json::object();
    json["files"] = ordered_json::array();
    for (const std::string& file : view.drape) json["files"].push_back(path_json(file));
    json["opacity"] = view.drape_opacity;
    if (view.drape_values != ImageValues::by_file)
        json["values"] = name_in(image_value_names, view.drape_values);
    return json;
}

void read_camera(const nlohmann::json& json, Camera& camera) {
    const auto& eye = json_field(json, "eye");
    camera.eye = {number(eye, "lat_deg", limits::lat_deg), number(eye, "lon_deg", limits::lon_deg),
                  number(eye, "h_m", limits::eye_h_m)};
    const nlohmann::json& size = json_array(json, "size_px", 2);
    camera.width_px = static_cast<int>(whole(as_field("size_px", size[0]), "size_px", limits::side_px));
    camera.height_px = static_cast<int>(whole(as_field("size_px", size[1]), "size_px", limits::side_px));
}

// Of maps alone; as large as the camera.
void read_map(const nlohmann::json& json, View& view) {
    if (!json.contains("map")) return;
    const nlohmann::json& map = json_field(json, "map");
    MapFrame frame{json_string(map, "crs"), {}, view.camera.width_px, view.camera.height_px};
    if (map_crs_name(frame.crs).empty()) throw JsonFault{"'crs' of 'map' is no CRS that PROJ knows"};
    constexpr double most = 1.0e12;
    const nlohmann::json& transform = json_array(map, "crs_from_pixel", 6);
    for (std::size_t i = 0; i < 6; ++i)
        frame.crs_from_pixel[i] =
            json_number(as_field("crs_from_pixel", transform[i]), "crs_from_pixel", -most, most);
    const auto& m = frame.crs_from_pixel;
    if (m[1] * m[5] - m[2] * m[4] == 0.0) throw JsonFault{"'crs_from_pixel' is no map from pixels to places"};
    view.map = frame;
}

ordered_json map_json(const MapFrame& map) {
    ordered_json json = json_object("crs", map.crs);
    json["crs_from_pixel"] = map.crs_from_pixel;
    return json;
}

// Views on a plane have none.
std::optional<PanoramaFrame> read_panorama(const nlohmann::json& json) {
    if (!json.contains("panorama")) return std::nullopt;
    const nlohmann::json& panorama = json_field(json, "panorama");
    const PanoramaFrame frame{
        number(panorama, "from_deg", limits::azimuth_deg), number(panorama, "sweep_deg", limits::sweep_deg),
        number(panorama, "low_deg", limits::elevation_deg),
        number(panorama, "high_deg", limits::elevation_deg), json_flag(panorama, "ridges")};
    if (!(frame.high_deg - frame.low_deg >= limits::least_elevations_deg))
        throw JsonFault{"'panorama' is empty"};
    return frame;
}

ordered_json panorama_json(const PanoramaFrame& frame) {
    return json_object("from_deg", frame.from_deg, "sweep_deg", frame.sweep_deg, "low_deg", frame.low_deg,
                       "high_deg", frame.high_deg, "ridges", frame.ridges);
}

SunDirection read_sun(const nlohmann::json& json) {
    SunDirection sun{number(json, "azimuth_deg", limits::sun_azimuth_deg),
                     number(json, "elevation_deg", limits::sun_elevation_deg)};
    // Where a direction was asked for there is none.
    if (!json.contains("time")) return sun;
    const std::string text = json_string(json, "time");
    const Result<std::int64_t> utc_s = utc_time_from(text);
    if (!utc_s.ok()) throw JsonFault{"the sun's 'time' is '" + text + "', which " + utc_s.error().what};
    sun.time = SunTime{text, *utc_s};
    // Views of before have none.
    sun.is_usual = json.contains("usual") && json_flag(json, "usual");
    return sun;
}

ordered_json sun_json(const SunDirection& sun) {
    ordered_json json = json_object("azimuth_deg", sun.azimuth_deg, "elevation_deg", sun.elevation_deg);
    if (sun.time) json["time"] = sun.time->text;
    if (sun.is_usual) json["usual"] = true;
    return json;
}

// How the sources are to be read, and which part of them.
void read_region(const nlohmann::json& json, RegionRequest& region) {
    if (!json_field(json, "bbox").is_null()) region.box = read_box(json);
    region.height_unit = json_string(json, "height_unit");
    if (!region.height_unit.empty() && !metres_in(region.height_unit))
        throw JsonFault{"'height_unit' is '" + region.height_unit + "', none of m, ft, us-ft, cm, dm, mm"};
    // Where nothing was told there is none.
    if (json.contains("source_crs")) region.source_crs = json_string(json, "source_crs");
    if (const auto fault = fault_of_source_crs(region.source_crs)) throw JsonFault{"'source_crs' " + *fault};
    if (json.contains("source_vertical")) region.source_vertical = json_string(json, "source_vertical");
    if (const auto fault = fault_of_source_vertical(region.source_vertical))
        throw JsonFault{"'source_vertical' " + *fault};
    region.fill_voids = json_flag(json, "fill_voids");
    region.strict_datum = json_flag(json, "strict_datum");
}

// Of the options: what the table says, and what is made of several fields.
void read_settings(const nlohmann::json& json, View& view) {
    // Views of before there were labels were drawn without, those of before there was a tau at full
    // resolution. Only what was drawn by clusters says so; all else is drawn again by blocks.
    view.labels = false;
    view.tau_px = 0.0;
    view.mesh = "grid";
    for (const ViewOption& option : view_option_table())
        if (option.read) option.read(json, view);
    if (const auto& sun = json_field(json, "sun"); !sun.is_null()) view.sun = read_sun(sun);
    view.style = present_name(path_from(json, "style"));
    read_drape(json, view);
    read_cover(json, view);
    read_canopy(json, view);
    read_detail(json, view);
    view.vectors = vectors_from(json);
    read_choice(json, "labels", label_switch_names, view.labels);
    read_air(json, view.model.air);
    // The bundle's name alone: what it stood for is in the fields themselves, which somebody may have
    // changed.
    if (json.contains("accuracy")) view.accuracy = json_string(json, "accuracy");
    if (!view.accuracy.empty() && !accuracy_bundle(view.accuracy).ok())
        throw JsonFault{"'accuracy' is '" + view.accuracy + "', none of " + listed(accuracy_words())};
    forget_other_bundle(view);
}

// What the parser of options would have refused must not come in by a file.
View read_fields(const nlohmann::json& json) {
    View view;
    read_sources(json, view);
    read_region(json, view.region);
    // Views of before posts were kept say nothing of it, and were drawn from resampled ones.
    view.own_posts = json.contains("own_posts") && json_flag(json, "own_posts");
    view.region.resample = !view.own_posts;
    if (json.contains("order")) {
        if (json_string(json, "order") != "listed") throw JsonFault{"'order' is not 'listed'"};
        view.region.listed_first = true;
    }
    if (json.contains("feather_m")) view.region.feather_m = number(json, "feather_m", limits::feather_m);
    read_meshes(json, view.region.meshes);
    view.several_grids = json.contains("several_grids") && json_flag(json, "several_grids");
    read_camera(json, view.camera);
    read_map(json, view);
    if (json.contains("legend_px")) {
        view.legend_px = static_cast<int>(whole(json, "legend_px", limits::side_px));
        view.legend = true;
    }
    view.panorama = read_panorama(json);
    read_settings(json, view);
    view.time_utc_s = whole(json, "time_utc_s", limits::time_utc_s);
    // Views of before there were any have none.
    if (json.contains("fingerprints"))
        view.fingerprints = fingerprints_from(json_field(json, "fingerprints"));
    return view;
}

}  // namespace

std::string time_text(std::int64_t time_utc_s) {
    const std::time_t time = time_utc_s;
    std::tm parts{};
    gmtime_r(&time, &parts);
    char text[40];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

namespace {

// The keys of settings in the order that views have had them in since the first. Those that are not listed
// follow in the order of the table.
constexpr std::array keys_in_order{"samples",      "exaggeration", "sun",     "visibility_km", "style",
                                   "sea",          "rim",          "drape",   "landcover",     "canopy",
                                   "detail",       "names",        "overlay", "names_field",   "shadows",
                                   "sky_openness", "labels",       "show",    "edges",         "pipeline",
                                   "mesh",         "mesh_level",   "tau_px",  "accuracy",      "earth",
                                   "geoid",        "refraction",   "air",     "precision",     "heights"};

void move_field(ordered_json& from, const char* key, ordered_json& to) {
    const auto found = from.find(key);
    if (found == from.end()) return;
    to[key] = std::move(*found);
    from.erase(found);
}

// Of the options but the eye's: what the table says, and what is made of several fields.
ordered_json settings_json(const View& view) {
    ordered_json json = ordered_json::object();
    for (const ViewOption& option : view_option_table())
        if (option.put && !is_of_eye(option)) option.put(view, json);
    json["sun"] = nullptr;
    if (view.sun) json["sun"] = sun_json(*view.sun);
    json["style"] = path_json(view.style);
    if (!view.drape.empty()) json["drape"] = drape_json(view);
    if (!view.cover_choice.files.empty()) json["landcover"] = cover_json(view.cover_choice);
    if (view.canopy_choice.asked()) json["canopy"] = canopy_choice_json(view.canopy_choice);
    if (view.detail) json["detail"] = detail_choice_json(*view.detail);
    put_vectors(view.vectors, json);
    json["labels"] = name_in(label_switch_names, view.labels);
    json["accuracy"] = view.accuracy;
    json["refraction"] = view.model.air.k;
    json["air"] = name_in(air_law_names, view.model.air.law);
    return json;
}

ordered_json begun_with_region(const View& view) {
    ordered_json json = ordered_json::object();
    json["orograph_view"] = view_format;
    if (view.paths_from_own_file) json["paths_from"] = own_file;
    json["sources"] = ordered_json::array();
    for (const std::string& path : view.region.paths) json["sources"].push_back(path_json(path));
    json["bbox"] = nullptr;
    if (const auto& box = view.region.box)
        json["bbox"] = json_list(box->west_deg, box->south_deg, box->east_deg, box->north_deg);
    json["height_unit"] = view.region.height_unit;
    if (!view.region.source_crs.empty()) json["source_crs"] = view.region.source_crs;
    if (!view.region.source_vertical.empty()) json["source_vertical"] = view.region.source_vertical;
    json["fill_voids"] = view.region.fill_voids;
    if (view.own_posts) json["own_posts"] = true;
    if (view.several_grids) json["several_grids"] = true;
    if (view.region.listed_first) json["order"] = "listed";
    if (view.region.feather_m > 0.0) json["feather_m"] = view.region.feather_m;
    if (!view.region.meshes.files.empty()) json["meshes"] = meshes_json(view.region.meshes);
    json["strict_datum"] = view.region.strict_datum;
    return json;
}

}  // namespace

nlohmann::ordered_json models_json(const View& view) {
    ordered_json settings = settings_json(view), models = ordered_json::object();
    for (const char* const key : {"earth", "geoid", "refraction", "air", "precision", "heights"})
        move_field(settings, key, models);
    return models;
}

std::string view_to_json(const View& view, bool pretty) {
    ordered_json json = begun_with_region(view);
    const Camera& camera = view.camera;
    json["eye"] =
        json_object("lat_deg", camera.eye.lat_deg, "lon_deg", camera.eye.lon_deg, "h_m", camera.eye.h_m);
    for (const ViewOption& option : view_option_table())
        if (option.put && is_of_eye(option)) option.put(view, json);
    json["size_px"] = json_list(camera.width_px, camera.height_px);
    if (view.map) json["map"] = map_json(*view.map);
    if (view.legend) json["legend_px"] = view.legend_px;
    if (view.panorama) json["panorama"] = panorama_json(*view.panorama);
    ordered_json settings = settings_json(view);
    for (const char* const key : keys_in_order) move_field(settings, key, json);
    json.update(settings);
    json["time_utc_s"] = view.time_utc_s;
    json["time"] = time_text(view.time_utc_s);
    if (view.fingerprints) json["fingerprints"] = fingerprints_json(*view.fingerprints);
    return json_text(json, pretty);
}

bool asks_for_same_region(const View& one, const View& other) {
    const auto region_of = [](View view) {
        view.paths_from_own_file = false;
        return json_text(begun_with_region(view), false);
    };
    // What is still is of the land cover's classes.
    const auto is_detailed_alike = [&] {
        return one.detail == other.detail && (!one.detail || one.cover_choice == other.cover_choice);
    };
    // Heights of classes are those of the land cover's files and table.
    const auto is_raised_alike = [&] {
        return one.canopy_choice == other.canopy_choice &&
               (!one.canopy_choice.by_class || one.cover_choice == other.cover_choice);
    };
    return one.has_geoid == other.has_geoid && is_raised_alike() && is_detailed_alike() &&
           region_of(one) == region_of(other);
}

Result<View> view_from_json(const std::string& text, const std::string& where) {
    try {
        const nlohmann::json json = parsed_json(text);
        if (!json.is_object() || !json.contains("orograph_view"))
            return not_a_view(where, "no orograph_view in it");
        if (json["orograph_view"] != view_format)
            return not_a_view(where, "its format is " + json["orograph_view"].dump() +
                                         ", this program reads " + std::to_string(view_format));
        return read_fields(json);
    } catch (const JsonFault& fault) {
        return not_a_view(where, fault.what);
    } catch (const nlohmann::json::exception& e) {
        return not_a_view(where, e.what());
    }
}

Result<View> read_view(const std::string& path) {
    const std::size_t dot = path.find_last_of('.');
    const std::string ending = dot == std::string::npos ? "" : lower_case(path.substr(dot));
    ORO_TRY(std::string bytes, ending == ".json" ? read_text_file(path) : read_view_json(path));
    const auto text = utf8_text(std::move(bytes));
    if (!text.ok()) return Error{text.error().kind, path, text.error().what};
    ORO_TRY(View view, view_from_json(*text, path));
    ORO_CHECK(lead_from_working_folder(view, path));
    view.read_from = path;
    return view;
}

Result<void> check_view_opens(const View& view, const std::string& where) {
    const std::string text = view_to_json(view, false);
    const Result<View> again = view_from_json(text, where);
    if (!again.ok())
        return Error{ErrorKind::failed, where,
                     "would carry a view that cannot be opened again: " + again.error().what};
    if (view_to_json(*again, false) != text)
        return Error{ErrorKind::failed, where, "would carry a view that is another when it is opened again"};
    return {};
}

}  // namespace oro
