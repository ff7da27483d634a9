#include "apps/commands/sight/profile_text.h"

#include <cstdio>

#include "apps/commands/sight/profile_roofs.h"
#include "apps/eye/standpoint.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

std::string extreme_text(const char* name, const Profile& profile, const std::optional<std::size_t>& number) {
    if (!number) return "";
    const ProfilePoint& point = profile.points[*number];
    char text[160];
    std::snprintf(text, sizeof text, "%s H %.1f m at %.6f %.6f, %.3f km along\n", name, point.H_m,
                  point.lat_deg, point.lon_deg, point.along_m / 1000.0);
    return text;
}

ordered_json point_json(const ProfilePoint& point) {
    ordered_json json =
        json_object("distance_m", point.along_m, "lat_deg", point.lat_deg, "lon_deg", point.lon_deg);
    for (const char* name : {"H_m", "h_m"}) json[name] = nullptr;
    if (point.has_ground) json["H_m"] = point.H_m;
    if (point.has_ground) json["h_m"] = point.h_m;
    return json;
}

}  // namespace

std::string ends_text(const Profile& profile) {
    const LatLon &from = profile.line.places.front(), &to = profile.line.places.back();
    return place_name(from.lat_deg, from.lon_deg) + " to " + place_name(to.lat_deg, to.lon_deg);
}

std::string profile_text(const Profile& profile) {
    char text[200];
    std::snprintf(text, sizeof text, ", %.3f m over the ellipsoid, %s\n", profile.length_m(),
                  counted(profile.line.places.size(), "place", "places").c_str());
    std::string lines = "Line: " + ends_text(profile) + text;
    lines += "Heights at " + counted(profile.points.size(), "place", "places") + "\n";
    const auto top = highest_top(profile);
    if (!profile.sums.highest && !top) return lines + "No data along the line\n";
    lines += extreme_text("Begin: ", profile,
                          profile.points.front().has_ground ? std::optional<std::size_t>(0) : std::nullopt);
    lines += extreme_text(
        "End:   ", profile,
        profile.points.back().has_ground ? std::optional(profile.points.size() - 1) : std::nullopt);
    lines += extreme_text("Highest:", profile, profile.sums.highest);
    lines += extreme_text("Lowest: ", profile, profile.sums.lowest);
    std::snprintf(text, sizeof text, "Ascent: %.1f m, descent: %.1f m, in rises and falls of %g m or more\n",
                  profile.sums.climbed_m, profile.sums.went_down_m, profile.sums.climb_threshold_m);
    lines += text;
    std::snprintf(text, sizeof text, "Every rise: %.1f m, every fall: %.1f m\n", profile.sums.ascent_m,
                  profile.sums.descent_m);
    lines += text;
    if (top) {
        std::snprintf(text, sizeof text,
                      "Over meshes: %.1f m of the line; highest top H %.2f m, %.3f km along",
                      over_meshes_m(profile), profile.roofs[*top].H_m, profile.points[*top].along_m / 1000.0);
        lines += text + (", " + profile.roofs[*top].on) + "\n";
    } else if (!profile.roofs.empty()) {
        lines += "No mesh under the line\n";
    }
    if (profile.sums.without_data_m > 0.0) {
        std::snprintf(text, sizeof text, "Without %s: %.3f km, left out of all sums\n",
                      profile.roofs.empty() ? "data" : "terrain", profile.sums.without_data_m / 1000.0);
        lines += text;
    }
    return lines;
}

ordered_json profile_json(const Profile& profile) {
    ordered_json json = json_object("length_m", profile.length_m(), "places", profile.line.places.size(),
                                    "points", profile.points.size());
    json["begin"] = point_json(profile.points.front());
    json["end"] = point_json(profile.points.back());
    for (const char* name : {"highest", "lowest"}) json[name] = nullptr;
    if (profile.sums.highest) json["highest"] = point_json(profile.points[*profile.sums.highest]);
    if (profile.sums.lowest) json["lowest"] = point_json(profile.points[*profile.sums.lowest]);
    json["ascent_m"] = profile.sums.ascent_m;
    json["descent_m"] = profile.sums.descent_m;
    json["over_threshold"] = json_object("threshold_m", profile.sums.climb_threshold_m, "ascent_m",
                                         profile.sums.climbed_m, "descent_m", profile.sums.went_down_m);
    json["without_data_m"] = profile.sums.without_data_m;
    if (profile.roofs.empty()) return json;
    ordered_json& roofs = json["roofs"] = json_object("over_m", over_meshes_m(profile));
    roofs["highest"] = nullptr;
    if (const auto top = highest_top(profile)) {
        const ProfilePoint& point = profile.points[*top];
        roofs["highest"] = json_object("distance_m", point.along_m, "lat_deg", point.lat_deg, "lon_deg",
                                       point.lon_deg, "H_m", profile.roofs[*top].H_m, "h_m",
                                       profile.roofs[*top].h_m, "on", profile.roofs[*top].on);
    }
    return json;
}

}  // namespace oro
