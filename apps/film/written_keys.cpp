#include "apps/film/written_keys.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "apps/eye/standpoint.h"
#include "apps/options/view_limits.h"
#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "core/earth/rotation.h"
#include "core/light/utc_time.h"
#include "core/terrain/ground.h"

namespace oro {
namespace {

namespace limits = view_limits;
using nlohmann::json;
using nlohmann::ordered_json;

constexpr int path_format = 1;
constexpr double longest_film_s = 1e7;
constexpr std::array<std::pair<const char*, HeightAbove>, 3> height_names{
    {{"h_m", HeightAbove::ellipsoid}, {"H_m", HeightAbove::sea_level}, {"above_m", HeightAbove::ground}}};

double number_or(const json& from, const char* name, double usual, double low, double high) {
    return from.contains(name) ? json_number(from, name, low, high) : usual;
}

void read_eye(const json& eye, WrittenKey& written) {
    Geodetic& at = written.key.eye;
    at.lat_deg = json_number(eye, "lat_deg", limits::lat_deg.low, limits::lat_deg.high);
    at.lon_deg = json_number(eye, "lon_deg", limits::lon_deg.low, limits::lon_deg.high);
    int given = 0;
    for (const auto& [name, heights] : height_names) {
        if (!eye.contains(name)) continue;
        at.h_m = json_number(eye, name, limits::eye_h_m.low, limits::eye_h_m.high);
        written.heights = heights;
        ++given;
    }
    if (given != 1) throw JsonFault{"'eye' needs one of h_m, H_m and above_m"};
}

WrittenKey read_key(const json& from, double usual_fov_deg) {
    WrittenKey written;
    CameraKey& key = written.key;
    key.time_s = json_number(from, "time_s", -longest_film_s, longest_film_s);
    read_eye(json_field(from, "eye"), written);
    key.attitude.heading_deg = number_or(from, "heading_deg", 0.0, -360.0, 360.0);
    key.attitude.heading_deg = turned_to_circle_deg(key.attitude.heading_deg);
    key.attitude.pitch_deg = number_or(from, "pitch_deg", 0.0, -90.0, 90.0);
    key.attitude.roll_deg = number_or(from, "roll_deg", 0.0, -180.0, 180.0);
    key.vertical_fov_deg =
        number_or(from, "fov_deg", usual_fov_deg, limits::fov_deg.low, limits::fov_deg.high);
    if (!from.contains("utc")) return written;
    const std::string text = json_string(from, "utc");
    const Result<std::int64_t> utc_s = utc_time_from(text);
    if (!utc_s.ok()) throw JsonFault{"'utc' is '" + text + "', which " + utc_s.error().what};
    key.time_utc_s = *utc_s;
    return written;
}

Error not_a_path(const std::string& where, const std::string& reason) {
    return {ErrorKind::failed, where, "holds no camera path that can be read: " + reason};
}

std::vector<WrittenKey> read_keys(const json& from, double usual_fov_deg) {
    const json& list = json_field(from, "keys");
    if (!list.is_array() || list.empty() || list.size() > most_keys)
        throw JsonFault{"'keys' must be a list of 1 to " + std::to_string(most_keys)};
    std::vector<WrittenKey> keys;
    for (const json& one : list) {
        const std::string number = "key " + std::to_string(keys.size() + 1) + ": ";
        try {
            keys.push_back(read_key(one, usual_fov_deg));
        } catch (const JsonFault& fault) {
            throw JsonFault{number + fault.what};
        }
        if (keys.size() > 1 && !(keys.back().key.time_s > keys[keys.size() - 2].key.time_s))
            throw JsonFault{number + "'time_s' must be later than that of the key before"};
    }
    return keys;
}

}  // namespace

Result<std::vector<WrittenKey>> keys_from_json(const std::string& text, const std::string& where,
                                               double usual_fov_deg) {
    try {
        const json all = parsed_json(text);
        if (!all.is_object() || !all.contains("orograph_path"))
            return not_a_path(where, "no orograph_path in it");
        if (all["orograph_path"] != path_format)
            return not_a_path(where, "its format is " + all["orograph_path"].dump() +
                                         ", this program reads " + std::to_string(path_format));
        return read_keys(all, usual_fov_deg);
    } catch (const JsonFault& fault) {
        return not_a_path(where, fault.what);
    } catch (const json::exception& e) {
        return not_a_path(where, e.what());
    }
}

std::string keys_to_json(const std::vector<CameraKey>& keys) {
    ordered_json list = ordered_json::array();
    for (const CameraKey& key : keys) {
        ordered_json one = json_object(
            "time_s", key.time_s, "eye",
            json_object("lat_deg", key.eye.lat_deg, "lon_deg", key.eye.lon_deg, "h_m", key.eye.h_m),
            "heading_deg", key.attitude.heading_deg, "pitch_deg", key.attitude.pitch_deg, "roll_deg",
            key.attitude.roll_deg, "fov_deg", key.vertical_fov_deg);
        if (key.time_utc_s) one["utc"] = time_text(*key.time_utc_s);
        list.push_back(std::move(one));
    }
    return json_text(json_object("orograph_path", path_format, "keys", std::move(list)), true) + "\n";
}

Result<double> h_over_region(const Geodetic& written, HeightAbove heights, const Region& region,
                             double exaggeration, const std::string& where) {
    const double lat_deg = written.lat_deg, lon_deg = written.lon_deg;
    const HeightField& field = grid_at(region, lat_deg, lon_deg).field;
    if (heights == HeightAbove::ellipsoid) return written.h_m;
    if (heights == HeightAbove::sea_level) return written.h_m + field.undulation.at_m(lat_deg, lon_deg);
    const auto ground = ground_h_m(field, lat_deg, lon_deg, exaggeration);
    ORO_CHECK(field.health());
    if (ground) return written.h_m + *ground;
    return Error{ErrorKind::no_data, where,
                 "no elevation data at " + place_name(lat_deg, lon_deg) + ", over whose ground it passes" +
                     where_data_are(field.grid, lat_deg, lon_deg)};
}

Result<std::vector<CameraKey>> eyes_over_region(const std::vector<WrittenKey>& keys, const Region& region,
                                                double exaggeration, const std::string& where) {
    std::vector<CameraKey> placed;
    for (const WrittenKey& written : keys) {
        CameraKey key = written.key;
        ORO_TRY(key.eye.h_m, h_over_region(key.eye, written.heights, region, exaggeration, where));
        placed.push_back(key);
    }
    ORO_CHECK(check_keys(placed, where));
    return placed;
}

Result<void> check_keys(const std::vector<CameraKey>& keys, const std::string& where) {
    char text[160];
    for (const CameraKey& key : keys) {
        if (!limits::eye_h_m.hold(key.eye.h_m)) {
            std::snprintf(text, sizeof text, "an eye would be at h %g m, not between %g and %g", key.eye.h_m,
                          limits::eye_h_m.low, limits::eye_h_m.high);
            return Error{ErrorKind::usage, where, text};
        }
        if (!(std::abs(key.time_s) <= longest_film_s)) {
            std::snprintf(text, sizeof text, "a film would last %g s, more than %g s", key.time_s,
                          longest_film_s);
            return Error{ErrorKind::usage, where, text};
        }
    }
    return {};
}

}  // namespace oro
