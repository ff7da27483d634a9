#include "apps/output/pose_files.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "apps/output/relative_reference.h"
#include "apps/output/stac_item.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/xml_escape.h"
#include "core/earth/rotation.h"
#include "geo/files/foreign_text.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

constexpr double photo_distance_m = 10.0;

// An element with a number, exact to 1e-9.
std::string element(const char* name, double value) {
    char text[120];
    std::snprintf(text, sizeof text, "<%s>%.9f</%s>", name, value, name);
    return text;
}

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

}  // namespace

std::array<double, 4> geopose_quaternion(const Attitude& attitude) {
    glm::dquat turn = rotation_about(90.0 - attitude.heading_deg, {0.0, 0.0, 1.0}) *
                      rotation_about(-attitude.pitch_deg, {0.0, 1.0, 0.0}) *
                      rotation_about(attitude.roll_deg, {1.0, 0.0, 0.0});
    if (turn.w < 0.0) turn = -turn;
    return {turn.x, turn.y, turn.z, turn.w};
}

std::string geopose_json(const Camera& camera) {
    const auto [x, y, z, w] = geopose_quaternion(camera.attitude);
    return json_text(json_object("position",
                                 json_object("lat", camera.eye.lat_deg, "lon",
                                             normalised_lon_deg(camera.eye.lon_deg), "h", camera.eye.h_m),
                                 "quaternion", json_object("x", x, "y", y, "z", z, "w", w)),
                     true) +
           "\n";
}

std::string photo_overlay_kml(const View& view, double N_m, const std::string& picture_name) {
    const Camera& camera = view.camera;
    const glm::dvec2 half = camera.half_fov_tangent();
    const auto angle_deg = [](double tangent) { return deg_from_radians(Radians{std::atan(tangent)}); };
    // The strip below the picture is a part of its file, and would lie on the same plane.
    const double bottom = half.y * (1.0 + 2.0 * view.legend_px / camera.height_px);
    const double H_m = camera.eye.h_m - N_m, lon_deg = normalised_lon_deg(camera.eye.lon_deg);
    char place[120];
    std::snprintf(place, sizeof place, "%.9f,%.9f,%.6f", lon_deg, camera.eye.lat_deg, H_m);
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\">\n"
           "<PhotoOverlay>\n  <name>" +
           xml_escaped(foreign_text(picture_name)) + "</name>\n  <Camera>" + element("longitude", lon_deg) +
           element("latitude", camera.eye.lat_deg) + element("altitude", H_m) +
           element("heading", camera.attitude.heading_deg) +
           element("tilt", camera.attitude.pitch_deg + 90.0) + element("roll", camera.attitude.roll_deg) +
           "<altitudeMode>absolute</altitudeMode></Camera>\n  <TimeStamp><when>" +
           time_text(view.time_utc_s) + "</when></TimeStamp>\n  <Icon><href>" + reference_to(picture_name) +
           "</href></Icon>\n  <ViewVolume>" + element("leftFov", -angle_deg(half.x)) +
           element("rightFov", angle_deg(half.x)) + element("bottomFov", -angle_deg(bottom)) +
           element("topFov", angle_deg(half.y)) + element("near", photo_distance_m) +
           "</ViewVolume>\n  <Point><altitudeMode>absolute</altitudeMode><coordinates>" + place +
           "</coordinates></Point>\n  <shape>rectangle</shape>\n</PhotoOverlay>\n</kml>\n";
}

std::vector<std::string> pose_paths(const std::string& picture, PoseChoice choice) {
    std::vector<std::string> paths;
    if (choice.kml) paths.push_back(beside(picture, ".kml"));
    if (choice.geopose) paths.push_back(beside(picture, ".geopose.json"));
    if (choice.stac) paths.push_back(beside(picture, ".stac.json"));
    return paths;
}

std::vector<PoseText> pose_texts(const std::string& picture, PoseChoice choice, const View& view,
                                 double N_m) {
    std::vector<PoseText> texts;
    if (choice.kml)
        texts.push_back(
            {beside(picture, ".kml"), photo_overlay_kml(view, N_m, fs::path(picture).filename().string())});
    if (choice.geopose) texts.push_back({beside(picture, ".geopose.json"), geopose_json(view.camera)});
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
