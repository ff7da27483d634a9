#include "apps/output/pose_files.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "apps/eye/standpoint.h"
#include "apps/output/ground_overlay.h"
#include "apps/output/kml_element.h"
#include "apps/output/relative_reference.h"
#include "apps/output/stac_item.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/region_json.h"
#include "core/earth/rotation.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

constexpr double photo_distance_m = 10.0;

std::string beside(const std::string& picture, const char* ending) {
    const fs::path path(picture);
    return (path.extension() == ".png" ? fs::path(path).replace_extension() : path).string() + ending;
}

// The item of a picture, and of what lies beside it.
std::string stac_item_of(const std::string& picture, PoseChoice choice, const View& view) {
    const auto name_of = [](const std::string& file) { return fs::path(file).filename().string(); };
    std::vector<StacAsset> assets{
        {"picture", name_of(picture), picture_media_type(picture, view.map.has_value()), "visual"}};
    if (choice.kml)
        assets.push_back(
            {"kml", name_of(beside(picture, ".kml")), "application/vnd.google-earth.kml+xml", "metadata"});
    if (choice.geopose)
        assets.push_back(
            {"geopose", name_of(beside(picture, ".geopose.json")), "application/json", "metadata"});
    return stac_item_json(view, name_of(picture), assets);
}

// Where a picture ends, in angles from its middle, and what it lies on.
struct OverlayBorders {
    double right_deg{};  // as far to the left
    double bottom_deg{};
    double top_deg{};
    const char* shape{};
};

double angle_deg(double tangent) {
    return deg_from_radians(Radians{std::atan(tangent)});
}

// The strip below a picture is a part of its file, and would lie on the same plane; so do the rulers and
// names around a panorama on its cylinder.
OverlayBorders borders_of(const View& view, double above_level_px) {
    const Camera& camera = view.camera;
    if (!view.panorama) {
        const glm::dvec2 half = camera.half_fov_tangent();
        const double bottom = half.y * (1.0 + 2.0 * view.legend_px / camera.height_px);
        return {angle_deg(half.x), -angle_deg(bottom), angle_deg(half.y), "rectangle"};
    }
    const double sweep_deg = view.panorama->sweep_deg,
                 px_per_rad = camera.width_px / radians_from_deg(sweep_deg).rad;
    return {0.5 * sweep_deg, -angle_deg((camera.height_px - above_level_px) / px_per_rad),
            angle_deg(above_level_px / px_per_rad), "cylinder"};
}

std::string geopose_text(double lat_deg, double lon_deg, double h_m, const std::array<double, 4>& xyzw) {
    const auto [x, y, z, w] = xyzw;
    return json_text(json_object("position", json_object("lat", lat_deg, "lon", lon_deg, "h", h_m),
                                 "quaternion", json_object("x", x, "y", y, "z", z, "w", w)),
                     true) +
           "\n";
}

Result<PoseText> kml_text(const std::string& picture, const View& view, const PoseFacts& facts) {
    const std::string name = fs::path(picture).filename().string(), file = beside(picture, ".kml");
    if (!view.map) return PoseText{file, photo_overlay_kml(view, facts, name)};
    ORO_TRY(GroundOverlay overlay, ground_overlay(*view.map, view.legend_px, name, facts.attribution));
    PoseText text{file, std::move(overlay.kml)};
    if (overlay.off_px >= 1.0) {
        char note[160];
        std::snprintf(note, sizeof note,
                      " lays the map by its four corners: between them it is up to %.1f pixels off (with "
                      "--crs EPSG:4326 it is not)",
                      overlay.off_px);
        text.note = file + note;
    }
    return text;
}

Result<PoseText> geopose_of(const std::string& picture, const View& view, const PoseFacts& facts) {
    const std::string file = beside(picture, ".geopose.json");
    if (!view.map) return PoseText{file, geopose_json(view.camera)};
    ORO_TRY(const MapMiddle middle, map_middle(*view.map));
    return PoseText{file, map_geopose_json(middle, facts.ground_h_m)};
}

}  // namespace

PoseFacts pose_facts(const View& view, const Region& region) {
    const Geodetic& eye = view.camera.eye;
    PoseFacts facts;
    facts.N_m = grid_at(region, eye.lat_deg, eye.lon_deg).field.undulation.at_m(eye.lat_deg, eye.lon_deg);
    facts.attribution = attribution_of(region);
    return facts;
}

std::array<double, 4> geopose_quaternion(const Attitude& attitude) {
    glm::dquat turn = rotation_about(90.0 - attitude.heading_deg, {0.0, 0.0, 1.0}) *
                      rotation_about(-attitude.pitch_deg, {0.0, 1.0, 0.0}) *
                      rotation_about(attitude.roll_deg, {1.0, 0.0, 0.0});
    if (turn.w < 0.0) turn = -turn;
    return {turn.x, turn.y, turn.z, turn.w};
}

std::string geopose_json(const Camera& camera) {
    return geopose_text(camera.eye.lat_deg, normalised_lon_deg(camera.eye.lon_deg), camera.eye.h_m,
                        geopose_quaternion(camera.attitude));
}

std::array<double, 4> map_geopose_quaternion(double up_azimuth_deg) {
    glm::dquat turn = rotation_about(-up_azimuth_deg, {0.0, 0.0, 1.0});
    if (turn.w < 0.0) turn = -turn;
    return {0.0, 0.0, turn.z + 0.0, turn.w};  // no -0
}

std::string map_geopose_json(const MapMiddle& middle, double h_m) {
    return geopose_text(middle.lat_deg, middle.lon_deg, h_m, map_geopose_quaternion(middle.up_azimuth_deg));
}

std::string photo_overlay_kml(const View& view, const PoseFacts& facts, const std::string& picture_name) {
    const Camera& camera = view.camera;
    const OverlayBorders borders = borders_of(view, facts.above_level_px);
    const double H_m = camera.eye.h_m - facts.N_m, lon_deg = normalised_lon_deg(camera.eye.lon_deg);
    char place[120];
    std::snprintf(place, sizeof place, "%.9f,%.9f,%.6f", lon_deg, camera.eye.lat_deg, H_m);
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n"
           "<PhotoOverlay>\n" +
           kml_name_and_description(picture_name, facts.attribution) + "  <Camera>" +
           kml_element("longitude", lon_deg) + kml_element("latitude", camera.eye.lat_deg) +
           kml_element("altitude", H_m) + kml_element("heading", camera.attitude.heading_deg) +
           kml_element("tilt", camera.attitude.pitch_deg + 90.0) +
           kml_element("roll", camera.attitude.roll_deg) +
           "<altitudeMode>absolute</altitudeMode></Camera>\n  <TimeStamp><when>" +
           time_text(view.time_utc_s) + "</when></TimeStamp>\n  <Icon><href>" + reference_to(picture_name) +
           "</href></Icon>\n  <ViewVolume>" + kml_element("leftFov", -borders.right_deg) +
           kml_element("rightFov", borders.right_deg) + kml_element("bottomFov", borders.bottom_deg) +
           kml_element("topFov", borders.top_deg) + kml_element("near", photo_distance_m) +
           "</ViewVolume>\n  <Point><altitudeMode>absolute</altitudeMode><coordinates>" + place +
           "</coordinates></Point>\n  <shape>" + borders.shape + "</shape>\n</PhotoOverlay>\n</kml>\n";
}

std::vector<std::string> pose_paths(const std::string& picture, PoseChoice choice) {
    std::vector<std::string> paths;
    if (choice.kml) paths.push_back(beside(picture, ".kml"));
    if (choice.geopose) paths.push_back(beside(picture, ".geopose.json"));
    if (choice.stac) paths.push_back(beside(picture, ".stac.json"));
    return paths;
}

Result<std::vector<PoseText>> pose_texts(const std::string& picture, PoseChoice choice, const View& view,
                                         const PoseFacts& facts) {
    std::vector<PoseText> texts;
    if (choice.kml) {
        ORO_TRY(PoseText text, kml_text(picture, view, facts));
        texts.push_back(std::move(text));
    }
    if (choice.geopose) {
        ORO_TRY(PoseText text, geopose_of(picture, view, facts));
        texts.push_back(std::move(text));
    }
    if (choice.stac) texts.push_back({beside(picture, ".stac.json"), stac_item_of(picture, choice, view)});
    return texts;
}

Result<std::vector<WholeFile>> pose_files(const std::vector<PoseText>& texts, bool overwrite) {
    std::vector<WholeFile> files;
    for (const PoseText& one : texts) {
        ORO_TRY(WholeFile file, WholeFile::create(one.file, overwrite));
        ORO_CHECK(file.write(one.text.data(), one.text.size()));
        files.push_back(std::move(file));
    }
    return files;
}

}  // namespace oro
