#include "apps/commands/sight/profile_text.h"

#include <cmath>
#include <cstdio>

#include "apps/report/json_text.h"

namespace oro {
namespace {

// A comma before each; what a top is on in quotation marks.
std::string top_fields(const ProfileRoof& top) {
    if (!top.is_there) return ",,,";
    char heights[80];
    std::snprintf(heights, sizeof heights, ",%.3f,%.3f,\"", top.H_m, top.h_m);
    std::string text = heights;
    for (const char c : top.on) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
}

}  // namespace

std::string profile_csv(const Profile& profile) {
    const bool has_roofs = !profile.roofs.empty();
    std::string text =
        std::string("distance_m,lat_deg,lon_deg,H_m,h_m") + (has_roofs ? ",top_H_m,top_h_m,on\n" : "\n");
    char line[160];
    for (std::size_t i = 0; i < profile.points.size(); ++i) {
        const ProfilePoint& point = profile.points[i];
        std::snprintf(line, sizeof line, "%.4f,%.9f,%.9f,", point.along_m, point.lat_deg, point.lon_deg);
        text += line;
        if (point.has_ground) {
            std::snprintf(line, sizeof line, "%.3f,%.3f", point.H_m, point.h_m);
            text += line;
        } else {
            text += ",";
        }
        if (has_roofs) text += top_fields(profile.roofs[i]);
        text += "\n";
    }
    return text;
}

namespace {

using nlohmann::ordered_json;

// The line in parts: RFC 7946, 3.1.9 wants it cut at the 180th meridian, where one part ends at 180 and the
// next begins at -180, or the other way round.
struct LineParts {
    ordered_json places = ordered_json::array(), distances = ordered_json::array(),
                 heights = ordered_json::array(), roofs = ordered_json::array();

    void begin() {
        for (ordered_json* const list : {&places, &distances, &heights, &roofs})
            list->push_back(ordered_json::array());
    }
    void add(const ProfilePoint& point, double lon_deg, std::optional<double> top_H_m = {});
    // Ends a part and begins the next where it crosses the meridian.
    void cross(const ProfilePoint& from, const ProfilePoint& crossing, const ProfilePoint& to) {
        if (std::abs(from.lon_deg) != 180.0) add(crossing, std::copysign(180.0, from.lon_deg));
        begin();
        if (std::abs(to.lon_deg) != 180.0) add(crossing, std::copysign(180.0, to.lon_deg));
    }
    // A line has two places or more.
    void drop_single_places() {
        for (std::size_t i = places.size(); i-- > 0;) {
            if (places[i].size() > 1) continue;
            for (ordered_json* const list : {&places, &distances, &heights, &roofs}) list->erase(i);
        }
    }
};

// Decimals that say as much as there is to say.
double rounded(double value, double steps) {
    return std::round(value * steps) / steps;
}

void LineParts::add(const ProfilePoint& point, double lon_deg, std::optional<double> top_H_m) {
    places.back().push_back({rounded(lon_deg, 1e9), rounded(point.lat_deg, 1e9), rounded(point.h_m, 1e3)});
    distances.back().push_back(rounded(point.along_m, 1e4));
    heights.back().push_back(rounded(point.H_m, 1e3));
    roofs.back().push_back(top_H_m ? ordered_json(rounded(*top_H_m, 1e3)) : ordered_json(nullptr));
}

}  // namespace

std::string profile_geojson(const Profile& profile) {
    LineParts parts;
    const ProfilePoint* before = nullptr;
    auto crossing = profile.crossings.begin();
    for (std::size_t i = 0; i < profile.points.size(); ++i) {
        const ProfilePoint& point = profile.points[i];
        if (!point.has_ground) {
            before = nullptr;
            continue;
        }
        if (before != nullptr && crossing != profile.crossings.end() && crossing->after + 1 == i) {
            if (crossing->point.has_ground)
                parts.cross(*before, crossing->point, point);
            else
                parts.begin();
            ++crossing;
        } else if (before == nullptr) {
            parts.begin();
        }
        before = &point;
        const bool has_top = !profile.roofs.empty() && profile.roofs[i].is_there;
        parts.add(point, point.lon_deg, has_top ? std::optional(profile.roofs[i].H_m) : std::nullopt);
    }
    parts.drop_single_places();
    ordered_json feature = ordered_json::object();
    feature["type"] = "Feature";
    feature["properties"] = profile_json(profile);
    feature["properties"]["distance_m"] = parts.distances;
    feature["properties"]["H_m"] = parts.heights;
    if (!profile.roofs.empty()) feature["properties"]["top_H_m"] = parts.roofs;
    feature["geometry"]["type"] = "MultiLineString";
    feature["geometry"]["coordinates"] = parts.places;
    return json_text(feature, false) + "\n";
}

std::string profile_file_text(const Profile& profile, const std::string& name) {
    if (name.ends_with(".csv")) return profile_csv(profile);
    return name.ends_with(".svg") ? profile_svg(profile) : profile_geojson(profile);
}

}  // namespace oro
