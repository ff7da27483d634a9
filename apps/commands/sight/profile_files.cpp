#include "apps/commands/sight/profile_text.h"

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

// The line in parts: RFC 7946, 3.1.9 wants it cut at the 180th meridian, where one part ends at 180 and the
// next begins at -180, or the other way round.
struct LineParts {
    ordered_json places = ordered_json::array(), distances = ordered_json::array(),
                 heights = ordered_json::array();

    void begin() {
        for (ordered_json* const list : {&places, &distances, &heights})
            list->push_back(ordered_json::array());
    }
    void add(const ProfilePoint& point, double lon_deg);
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
            for (ordered_json* const list : {&places, &distances, &heights}) list->erase(i);
        }
    }
};

// Decimals that say as much as there is to say.
double rounded(double value, double steps) {
    return std::round(value * steps) / steps;
}

void LineParts::add(const ProfilePoint& point, double lon_deg) {
    places.back().push_back({rounded(lon_deg, 1e9), rounded(point.lat_deg, 1e9), rounded(point.h_m, 1e3)});
    distances.back().push_back(rounded(point.along_m, 1e4));
    heights.back().push_back(rounded(point.H_m, 1e3));
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
        parts.add(point, point.lon_deg);
    }
    parts.drop_single_places();
    ordered_json feature = ordered_json::object();
    feature["type"] = "Feature";
    feature["properties"] = profile_json(profile);
    feature["properties"]["distance_m"] = parts.distances;
    feature["properties"]["H_m"] = parts.heights;
    feature["geometry"]["type"] = "MultiLineString";
    feature["geometry"]["coordinates"] = parts.places;
    return json_text(feature, false) + "\n";
}

std::string profile_file_text(const Profile& profile, const std::string& name) {
    if (name.ends_with(".csv")) return profile_csv(profile);
    return name.ends_with(".svg") ? profile_svg(profile) : profile_geojson(profile);
}

}  // namespace oro
