// Views as JSON, and back.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <ctime>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "apps/json_text.h"
#include "apps/view.h"
#include "geo/picture.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

constexpr int view_format = 1;

Error not_a_view(const std::string& where, const std::string& reason) {
    return {ErrorKind::failed, where, "holds no view that can be read: " + reason};
}

bool in_range(double value, double low, double high) {
    return value >= low && value <= high;
}

// What the parser of options would have refused must not come in by a file.
std::string first_fault(const View& view) {
    const Camera& camera = view.camera;
    if (view.region.paths.empty()) return "it names no elevation data";
    if (!in_range(camera.eye.lat_deg, -90, 90) || !in_range(camera.eye.lon_deg, -180, 180))
        return "the eye is not on the Earth";
    if (!in_range(camera.eye.h_m, -7e6, 2e9)) return "the eye's height is out of range";
    if (!in_range(camera.attitude.heading_deg, -360, 360) || !in_range(camera.attitude.pitch_deg, -90, 90) ||
        !in_range(camera.attitude.roll_deg, -180, 180))
        return "heading, pitch or roll is out of range";
    if (!in_range(camera.vertical_fov_deg, 0.05, 120)) return "fov is not between 0.05 and 120";
    if (!in_range(camera.width_px, 1, 65500) || !in_range(camera.height_px, 1, 65500))
        return "the size is out of range";
    if (!in_range(view.samples, 1, 64)) return "samples is not between 1 and 64";
    if (!in_range(view.exaggeration, 0.01, 100)) return "exaggeration is not between 0.01 and 100";
    if (view.sun && !(std::isfinite(view.sun->azimuth_deg) && in_range(view.sun->elevation_deg, -90, 90)))
        return "the sun is out of range";
    return {};
}

View read_fields(const nlohmann::json& json) {
    View view;
    view.region.paths = json.at("sources").get<std::vector<std::string>>();
    if (const auto& box = json.at("bbox"); !box.is_null())
        view.region.box = BoundingBox{box.at(0), box.at(1), box.at(2), box.at(3)};
    view.region.height_unit = json.at("height_unit");
    view.region.fill_voids = json.at("fill_voids");
    view.region.strict_datum = json.at("strict_datum");
    const auto& eye = json.at("eye");
    view.camera.eye = {eye.at("lat_deg"), eye.at("lon_deg"), eye.at("h_m")};
    view.camera.attitude = {json.at("heading_deg"), json.at("pitch_deg"), json.at("roll_deg")};
    view.camera.vertical_fov_deg = json.at("fov_deg");
    view.camera.width_px = json.at("size_px").at(0);
    view.camera.height_px = json.at("size_px").at(1);
    view.samples = json.at("samples");
    view.exaggeration = json.at("exaggeration");
    if (const auto& sun = json.at("sun"); !sun.is_null())
        view.sun = SunDirection{sun.at("azimuth_deg"), sun.at("elevation_deg")};
    view.style = json.at("style");
    view.time_utc_s = json.at("time_utc_s");
    return view;
}

Result<std::string> read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return Error{ErrorKind::failed, path, "cannot be read"};
    return std::string(std::istreambuf_iterator<char>(file), {});
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
    json["time_utc_s"] = view.time_utc_s;
    json["time"] = time_text(view.time_utc_s);
    return json_text(json, pretty);
}

Result<View> view_from_json(const std::string& text, const std::string& where) {
    try {
        const nlohmann::json json = nlohmann::json::parse(text);
        if (!json.is_object() || !json.contains("orograph_view"))
            return not_a_view(where, "no orograph_view in it");
        if (json["orograph_view"] != view_format)
            return not_a_view(where, "its format is " + json["orograph_view"].dump() +
                                         ", this program reads " + std::to_string(view_format));
        View view = read_fields(json);
        if (const std::string fault = first_fault(view); !fault.empty()) return not_a_view(where, fault);
        return view;
    } catch (const nlohmann::json::exception& e) {
        return not_a_view(where, e.what());
    }
}

Result<View> read_view(const std::string& path) {
    const std::size_t dot = path.find_last_of('.');
    std::string ending = dot == std::string::npos ? "" : path.substr(dot);
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    ORO_TRY(const std::string text, ending == ".json" ? read_text(path) : read_view_json(path));
    return view_from_json(text, path);
}

}  // namespace oro
