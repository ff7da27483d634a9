// Views as JSON, and back.
#include <algorithm>
#include <cctype>
#include <ctime>
#include <nlohmann/json.hpp>

#include "apps/accuracy.h"
#include "apps/json_fields.h"
#include "apps/json_text.h"
#include "apps/model_names.h"
#include "apps/view.h"
#include "geo/letter_case.h"
#include "geo/picture.h"
#include "geo/raster_source.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

constexpr int view_format = 1;
// The years 0 to 9999, as many as a picture's tags can tell.
constexpr std::int64_t first_second = -62167219200, last_second = 253402300799;

Error not_a_view(const std::string& where, const std::string& reason) {
    return {ErrorKind::failed, where, "holds no view that can be read: " + reason};
}

BoundingBox read_box(const nlohmann::json& json) {
    const nlohmann::json& corners = json_array(json, "bbox", 4);
    const auto angle = [&](std::size_t i, double limit) {
        return json_number({{"bbox", corners[i]}}, "bbox", -limit, limit);
    };
    const BoundingBox box{angle(0, 180), angle(1, 90), angle(2, 180), angle(3, 90)};
    if (!(box.south_deg < box.north_deg) || box.west_deg == box.east_deg) throw JsonFault{"'bbox' is empty"};
    return box;
}

// Of a named choice; views of before there was it have none, and keep what `value` is.
template <class Choice, class Named>
void read_choice(const nlohmann::json& json, const char* name, Named named, Choice& value) {
    if (!json.contains(name)) return;
    Result<Choice> found = named(json_string(json, name));
    if (!found.ok()) throw JsonFault{"'" + std::string(name) + "' " + found.error().what};
    value = *found;
}

void read_models(const nlohmann::json& json, View& view) {
    read_choice(json, "earth", earth_named, view.model.earth);
    read_choice(json, "precision", precision_named, view.model.precision);
    read_choice(json, "geoid", geoid_named, view.has_geoid);
    read_choice(json, "heights", heights_named, view.heights);
    if (json.contains("refraction")) view.model.refraction_k = json_number(json, "refraction", -1.0, 0.9);
}

// What the parser of options would have refused must not come in by a file.
View read_fields(const nlohmann::json& json) {
    View view;
    view.region.paths = json_strings(json, "sources");
    if (view.region.paths.empty()) throw JsonFault{"it names no elevation data"};
    if (!json_field(json, "bbox").is_null()) view.region.box = read_box(json);
    view.region.height_unit = json_string(json, "height_unit");
    if (!view.region.height_unit.empty() && !metres_in(view.region.height_unit))
        throw JsonFault{"'height_unit' is '" + view.region.height_unit + "', none of m, ft, us-ft, cm"};
    view.region.fill_voids = json_flag(json, "fill_voids");
    view.region.strict_datum = json_flag(json, "strict_datum");
    const auto& eye = json_field(json, "eye");
    view.camera.eye = {json_number(eye, "lat_deg", -90, 90), json_number(eye, "lon_deg", -180, 180),
                       json_number(eye, "h_m", -7e6, 2e9)};
    view.camera.attitude = {json_number(json, "heading_deg", -360, 360),
                            json_number(json, "pitch_deg", -90, 90),
                            json_number(json, "roll_deg", -180, 180)};
    view.camera.vertical_fov_deg = json_number(json, "fov_deg", 0.05, 120);
    const nlohmann::json& size = json_array(json, "size_px", 2);
    view.camera.width_px = static_cast<int>(json_whole({{"size_px", size[0]}}, "size_px", 1, 65500));
    view.camera.height_px = static_cast<int>(json_whole({{"size_px", size[1]}}, "size_px", 1, 65500));
    view.samples = static_cast<int>(json_whole(json, "samples", 1, 64));
    view.exaggeration = json_number(json, "exaggeration", 0.01, 100);
    if (const auto& sun = json_field(json, "sun"); !sun.is_null())
        view.sun = SunDirection{json_number(sun, "azimuth_deg", -1e9, 1e9),
                                json_number(sun, "elevation_deg", -90, 90)};
    view.style = json_string(json, "style");
    // Views of before there was a choice have none.
    if (json.contains("pipeline")) view.pipeline = json_string(json, "pipeline");
    if (view.pipeline != "auto" && view.pipeline != "mesh" && view.pipeline != "compute")
        throw JsonFault{"'pipeline' is '" + view.pipeline + "', none of auto, mesh, compute"};
    // Nor have they a tau: they were drawn at full resolution.
    view.tau_px = json.contains("tau_px") ? json_number(json, "tau_px", 0, 1000) : 0.0;
    read_models(json, view);
    // The bundle's name alone: what it stood for is in the fields themselves, which somebody may have
    // changed.
    if (json.contains("accuracy")) view.accuracy = json_string(json, "accuracy");
    if (!view.accuracy.empty() && !accuracy_bundle(view.accuracy).ok())
        throw JsonFault{"'accuracy' is '" + view.accuracy + "', none of draft, balanced, survey"};
    forget_other_bundle(view);
    view.time_utc_s = json_whole(json, "time_utc_s", first_second, last_second);
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

std::string view_to_json(const View& view, bool pretty) {
    ordered_json json;
    json["orograph_view"] = view_format;
    json["sources"] = view.region.paths;
    json["bbox"] = nullptr;
    if (const auto& box = view.region.box)
        json["bbox"] = {box->west_deg, box->south_deg, box->east_deg, box->north_deg};
    json["height_unit"] = view.region.height_unit;
    json["fill_voids"] = view.region.fill_voids;
    json["strict_datum"] = view.region.strict_datum;
    const Camera& camera = view.camera;
    json["eye"] = {{"lat_deg", camera.eye.lat_deg}, {"lon_deg", camera.eye.lon_deg}, {"h_m", camera.eye.h_m}};
    json["heading_deg"] = camera.attitude.heading_deg;
    json["pitch_deg"] = camera.attitude.pitch_deg;
    json["roll_deg"] = camera.attitude.roll_deg;
    json["fov_deg"] = camera.vertical_fov_deg;
    json["size_px"] = {camera.width_px, camera.height_px};
    json["samples"] = view.samples;
    json["exaggeration"] = view.exaggeration;
    json["sun"] = nullptr;
    if (view.sun)
        json["sun"] = {{"azimuth_deg", view.sun->azimuth_deg}, {"elevation_deg", view.sun->elevation_deg}};
    json["style"] = view.style;
    json["pipeline"] = view.pipeline;
    json["tau_px"] = view.tau_px;
    json["accuracy"] = view.accuracy;
    json.update(models_json(view));
    json["time_utc_s"] = view.time_utc_s;
    json["time"] = time_text(view.time_utc_s);
    return json_text(json, pretty);
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
    ORO_TRY(const std::string text, ending == ".json" ? read_text_file(path) : read_view_json(path));
    return view_from_json(text, path);
}

}  // namespace oro
