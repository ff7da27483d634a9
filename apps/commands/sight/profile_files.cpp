#include "apps/commands/sight/profile_files.h"

#include <cmath>
#include <cstdio>

#include "apps/report/json_text.h"

namespace oro {

std::string profile_csv(const Profile& profile) {
    std::string text = "distance_m,lat_deg,lon_deg,H_m,h_m\n";
    char line[160];
    for (const ProfilePoint& point : profile.points) {
        std::snprintf(line, sizeof line, "%.4f,%.9f,%.9f,", point.along_m, point.lat_deg, point.lon_deg);
        text += line;
        if (point.has_ground) {
            std::snprintf(line, sizeof line, "%.3f,%.3f", point.H_m, point.h_m);
            text += line;
        } else {
            text += ",";
        }
        text += "\n";
    }
    return text;
}

namespace {

using nlohmann::ordered_json;

// Decimals that say as much as there is to say.
double rounded(double value, double steps) {
    return std::round(value * steps) / steps;
}

}  // namespace

std::string profile_geojson(const Profile& profile) {
    ordered_json parts = ordered_json::array(), distances = ordered_json::array(),
                 heights = ordered_json::array();
    const ProfilePoint* before = nullptr;
    for (const ProfilePoint& point : profile.points) {
        if (!point.has_ground) {
            before = nullptr;
            continue;
        }
        if (!before || std::abs(point.lon_deg - before->lon_deg) > 180.0) {
            for (ordered_json* const list : {&parts, &distances, &heights})
                list->push_back(ordered_json::array());
        }
        before = &point;
        parts.back().push_back(
            {rounded(point.lon_deg, 1e9), rounded(point.lat_deg, 1e9), rounded(point.h_m, 1e3)});
        distances.back().push_back(rounded(point.along_m, 1e4));
        heights.back().push_back(rounded(point.H_m, 1e3));
    }
    // A line has two places or more.
    for (std::size_t i = parts.size(); i-- > 0;) {
        if (parts[i].size() > 1) continue;
        for (ordered_json* const list : {&parts, &distances, &heights}) list->erase(i);
    }
    ordered_json feature = ordered_json::object();
    feature["type"] = "Feature";
    feature["properties"] = profile_json(profile);
    feature["properties"]["distance_m"] = distances;
    feature["properties"]["H_m"] = heights;
    feature["geometry"]["type"] = "MultiLineString";
    feature["geometry"]["coordinates"] = parts;
    return json_text(feature, false) + "\n";
}

}  // namespace oro
