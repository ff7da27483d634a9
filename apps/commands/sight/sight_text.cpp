#include "apps/commands/sight/sight_text.h"

#include <cstdio>
#include <filesystem>

#include "apps/cover/canopy_words.h"
#include "apps/report/feature_words.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "apps/report/summit_words.h"
#include "apps/view/model_names.h"
#include "core/base/one_line.h"

namespace oro {
namespace {

using nlohmann::ordered_json;

template <class... Values>
std::string printed(const char* format, Values... values) {
    char text[240];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

std::string cover_text(const std::string& cover) {
    return cover.empty() ? "" : ", " + cover;
}

std::string end_text(const char* name, const Geodetic& point, const std::string& cover,
                     const std::optional<double>& canopy_m, const SightGround& ground) {
    std::string text =
        printed("%s %.6f %.6f, H %.1f m", name, point.lat_deg, point.lon_deg, ground.H_m(point));
    if (const auto above_m = ground.above_m(point)) text += printed(", %.1f m above the ground", *above_m);
    if (canopy_m)
        text += printed(ground.in_canopy_m(point) ? ", in a canopy of %.1f m" : ", over a canopy of %.1f m",
                        *canopy_m);
    return text + cover_text(cover) + "\n";
}

// "8.43 km", "312 m"
std::string distance_text(double distance_m) {
    return distance_m < 1000.0 ? printed("%.0f m", distance_m) : printed("%.2f km", distance_m / 1000.0);
}

std::string ground_text(const Geodetic& point, double distance_m, const SightGround& ground) {
    return printed("%.6f %.6f, H %.1f m, ", point.lat_deg, point.lon_deg, ground.H_m(point)) +
           distance_text(distance_m) + " away";
}

double distance_m(const SightReport& report, const Geodetic& point) {
    return geodesic_between(report.from.lat_deg, report.from.lon_deg, point.lat_deg, point.lon_deg)
        .distance_m;
}

std::string file_name_of(const PlacedMesh& mesh) {
    return one_line(std::filesystem::path(mesh.path).filename().string());
}

std::string feature_of_obstacle(const SightHit& hit, const SightGround& ground) {
    const MeshFeature* const feature = ground.grids->feature(hit);
    return feature == nullptr ? "" : ", " + words_of(*feature);
}

// Nothing stands so high over its place.
constexpr double most_higher_m = 9000.0;
// What is so near the eye hides what is far by a height that says nothing of the target, from so much on.
constexpr double before_eye_m = 30.0, much_higher_m = 100.0;

// Whether it helps to know how much higher the target would have to be.
bool tells_target(const SightReport& report) {
    const auto& higher_m = report.target_clearance_deficit_m;
    if (!higher_m || *higher_m > most_higher_m) return false;
    return report.obstacle_distance_m >= before_eye_m || *higher_m <= much_higher_m;
}

// "Hidden: the target would have to be 8.21 m higher, or the eye 2.12 m", "Hidden by ground 5 m in front of
// the eye: the eye would have to be 8.66 m higher"
std::string missed_text(const SightReport& report) {
    std::string text = "Hidden";
    const bool of_target = tells_target(report);
    if (of_target)
        text += printed(": the target would have to be %.2f m higher", *report.target_clearance_deficit_m);
    else if (report.obstacle_distance_m > 0.0)
        text += std::string(" by ") +
                (report.obstacle_canopy_m    ? "canopy "
                 : report.obstacle->mesh > 0 ? "a mesh "
                                             : "ground ") +
                distance_text(report.obstacle_distance_m) + " in front of the eye";
    if (report.eye_clearance_deficit_m)
        text += printed(of_target ? ", or the eye %.2f m" : ": the eye would have to be %.2f m higher",
                        *report.eye_clearance_deficit_m);
    return text;
}

std::string hidden_text(const SightReport& report, const SightGround& ground) {
    std::string text = missed_text(report) + "\nFirst obstacle: ";
    if (report.obstacle_canopy_m)
        text += printed("canopy, %.1f m over the ground, at ", *report.obstacle_canopy_m);
    else if (report.obstacle->mesh > 0)
        text += "a mesh, " + file_name_of(ground.grids->mesh(report.obstacle->mesh)) +
                feature_of_obstacle(*report.obstacle, ground) + ", at ";
    else if (ground.canopy)
        text += "the ground at ";
    return text + ground_text(report.obstacle->point, report.obstacle_distance_m, ground) +
           cover_text(report.obstacle_cover) + "\n";
}

ordered_json or_null(const std::optional<double>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json end_json(const Geodetic& point, const std::string& cover, const std::optional<double>& canopy_m,
                      const SightGround& ground) {
    ordered_json json = point_json(ground, point);
    json["above_ground_m"] = or_null(ground.above_m(point));
    if (!cover.empty()) json["cover"] = cover;
    if (ground.canopy) json["canopy_m"] = or_null(canopy_m);
    return json;
}

}  // namespace

std::string sight_text(const SightReport& report, const SightGround& ground) {
    std::string text = end_text("From:", report.from, report.from_cover, report.from_canopy_m, ground);
    if (report.moved) text += "Summit: " + summit_words("the eye stands", *report.moved) + "\n";
    text += end_text("To:  ", report.to, report.to_cover, report.to_canopy_m, ground);
    if (report.target_moved)
        text += "Summit: " + summit_words("the target stands", *report.target_moved) + "\n";
    text += report.obstacle ? hidden_text(report, ground) : "Visible\n";
    if (report.line.without_data_m < report.slant_m)
        text += printed(ground.region.meshes ? "Least clearance of the terrain: %.2f m, over "
                                             : "Least clearance: %.2f m, over ",
                        report.line.clearance_m) +
                ground_text(report.line.ground, distance_m(report, report.line.ground), ground) + "\n";
    text += printed("Distance: %.3f m over the ellipsoid, %.3f m straight\n", report.path.distance_m,
                    report.slant_m);
    text += printed("Direction: azimuth %.4f degrees, elevation %.4f degrees\n", report.path.bearing_deg,
                    report.elevation_deg);
    text += "Light: " + light_words(report.air, report.from.h_m) + "\n";
    return ground.canopy ? text + canopy_words(*ground.canopy->map, ground.canopy->region) + "\n" : text;
}

ordered_json sight_json(const SightReport& report, const SightGround& ground) {
    ordered_json json = json_object("visible", !report.obstacle);
    json["from"] = end_json(report.from, report.from_cover, report.from_canopy_m, ground);
    if (report.moved) json["on_summit"] = summit_json(*report.moved);
    json["to"] = end_json(report.to, report.to_cover, report.to_canopy_m, ground);
    if (report.target_moved) json["target_on_summit"] = summit_json(*report.target_moved);
    json["target_missed_by_m"] =
        report.obstacle ? or_null(report.target_clearance_deficit_m) : ordered_json(0.0);
    json["eye_missed_by_m"] = report.obstacle ? or_null(report.eye_clearance_deficit_m) : ordered_json(0.0);
    json["obstacle"] = nullptr;
    if (report.obstacle) {
        ordered_json& obstacle = json["obstacle"] = point_json(ground, report.obstacle->point);
        obstacle["distance_m"] = report.obstacle_distance_m;
        obstacle["slant_m"] = report.obstacle->distance_m;
        if (report.obstacle->mesh > 0) obstacle["mesh"] = ground.grids->mesh(report.obstacle->mesh).path;
        if (const MeshFeature* const feature = ground.grids->feature(*report.obstacle))
            obstacle["feature"] = feature_json(*feature);
        if (!report.obstacle_cover.empty()) obstacle["cover"] = report.obstacle_cover;
        if (ground.canopy) {
            obstacle["is"] = report.obstacle_canopy_m ? "canopy" : "ground";
            obstacle["canopy_m"] = or_null(report.obstacle_canopy_m);
        }
    }
    json["clearance"] = nullptr;
    if (report.line.without_data_m < report.slant_m) {
        json["clearance"] = json_object("least_m", report.line.clearance_m);
        json["clearance"]["ground"] = point_json(ground, report.line.ground);
        json["clearance"]["distance_m"] = distance_m(report, report.line.ground);
    }
    json["distance_m"] = report.path.distance_m;
    json["azimuth_deg"] = report.path.bearing_deg;
    json["elevation_deg"] = report.elevation_deg;
    json["slant_m"] = report.slant_m;
    json["without_data_m"] = report.line.without_data_m;
    json["light"] = light_json(report.air, report.from.h_m);
    if (ground.canopy) json["canopy"] = canopy_json(*ground.canopy->map, ground.canopy->region);
    return json;
}

}  // namespace oro
