// Where a picture was taken from, as other programs read it.
#include "apps/output/pose_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace oro {
namespace {

void expect_quaternion(const Attitude& attitude, const std::array<double, 4>& xyzw) {
    const std::array<double, 4> found = geopose_quaternion(attitude);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_NEAR(found[i], xyzw[i], 1e-15) << "component " << i << " of " << attitude.heading_deg;
}

// By hand. The camera's axes are x ahead, y left, z up, those of the place x east, y north, z up.
// Facing east and level they are the same: no rotation, (0, 0, 0, 1).
// Facing north, ahead is +y and left is -x: a turn by +90 degrees about z, (0, 0, sin 45, cos 45).
// Facing south: by -90 degrees, (0, 0, -sin 45, cos 45). Facing west: by 180 degrees, (0, 0, 1, 0).
// Straight down with the picture's top to the north: ahead (0, 0, -1), up (0, 1, 0), left = up x ahead =
// (-1, 0, 0). These are the columns of the rotation, whose trace is 0: w = 1/2 and, by the differences of
// what lies across the diagonal over 4 w, x = (0 - 1) / 2, y = (0 + 1) / 2, z = (0 + 1) / 2.
// Facing east with the right side down by 90 degrees: +90 about x, (sin 45, 0, 0, cos 45).
TEST(GeoPoses, OfPlainDirections) {
    const double half = std::sqrt(0.5);
    expect_quaternion({90.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0});
    expect_quaternion({0.0, 0.0, 0.0}, {0.0, 0.0, half, half});
    expect_quaternion({180.0, 0.0, 0.0}, {0.0, 0.0, -half, half});
    expect_quaternion({0.0, -90.0, 0.0}, {-0.5, 0.5, 0.5, 0.5});
    expect_quaternion({90.0, 0.0, 90.0}, {half, 0.0, 0.0, half});
    const std::array<double, 4> west = geopose_quaternion({270.0, 0.0, 0.0});
    EXPECT_NEAR(std::abs(west[2]), 1.0, 1e-15);
    EXPECT_NEAR(west[3], 0.0, 1e-15);
}

// The rotation turns ahead, left and up to where the camera itself has them.
TEST(GeoPoses, AreTheCamerasRotation) {
    std::mt19937 random(31);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        Camera camera;
        camera.eye = {180.0 * share(random) - 90.0, 360.0 * share(random) - 180.0, 100.0};
        camera.attitude = {360.0 * share(random), 180.0 * share(random) - 90.0,
                           360.0 * share(random) - 180.0};
        const auto [x, y, z, w] = geopose_quaternion(camera.attitude);
        EXPECT_GE(w, 0.0);
        const glm::dmat3 ecef_from_camera =
            ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg) * glm::mat3_cast(glm::dquat(w, x, y, z));
        const glm::dmat3 view = camera.view_from_ecef();
        EXPECT_LT(glm::length(view * ecef_from_camera[0] - glm::dvec3(0.0, 0.0, -1.0)), 1e-12) << "seed 31";
        EXPECT_LT(glm::length(view * ecef_from_camera[1] - glm::dvec3(-1.0, 0.0, 0.0)), 1e-12) << "seed 31";
        EXPECT_LT(glm::length(view * ecef_from_camera[2] - glm::dvec3(0.0, 1.0, 0.0)), 1e-12) << "seed 31";
    }
}

TEST(GeoPoses, HaveTheFieldsOfTheStandard) {
    Camera camera;
    camera.eye = {46.5, 188.0, 1234.5};
    camera.attitude = {90.0, 0.0, 0.0};
    const auto pose = nlohmann::json::parse(geopose_json(camera));
    EXPECT_EQ(pose, nlohmann::json::parse(R"({"position": {"lat": 46.5, "lon": -172.0, "h": 1234.5},
                                              "quaternion": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}})"));
}

// By hand: the map's axes are x to its right, y to its top. With north at its top they are east and north: no
// rotation. With east at its top x is south and y is east: a turn by -90 degrees about z, (0, 0, -sin 45,
// cos 45). West at its top: +90. 1.5056108 degrees, as EPSG:2056 has at 46.5 N, 9.5 E: (0, 0, -sin 0.7528054,
// cos 0.7528054) = (0, 0, -0.013138555, 0.999913685).
TEST(GeoPoses, OfMapsAreTurnsAboutTheVertical) {
    const double half = std::sqrt(0.5);
    const auto expect_turn = [](double up_azimuth_deg, const std::array<double, 4>& xyzw) {
        const std::array<double, 4> found = map_geopose_quaternion(up_azimuth_deg);
        for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found[i], xyzw[i], 1e-9) << up_azimuth_deg;
    };
    expect_turn(0.0, {0.0, 0.0, 0.0, 1.0});
    expect_turn(90.0, {0.0, 0.0, -half, half});
    expect_turn(-90.0, {0.0, 0.0, half, half});
    expect_turn(270.0, {0.0, 0.0, half, half});
    expect_turn(1.5056108, {0.0, 0.0, -0.013138555, 0.999913685});
    const auto pose = nlohmann::json::parse(map_geopose_json({46.5, 9.5, 0.0, 25.0}, 1234.5));
    EXPECT_EQ(pose["position"], nlohmann::json::parse(R"({"lat": 46.5, "lon": 9.5, "h": 1234.5})"));
    EXPECT_EQ(pose["quaternion"]["w"], 1.0);
}

// A map of a whole zone's width in UTM says how far between its corners it is off; a small one does not.
TEST(GeoPoses, AndOverlaysOfMapsStandBesideThem) {
    View view;
    view.map = MapFrame{"EPSG:32632", {400000.0, 25.0, 0.0, 5300000.0, 0.0, -25.0}, 4000, 4000};
    const PoseFacts facts{.ground_h_m = 700.0};
    const auto large = pose_texts("x/m.png", {true, true}, view, facts);
    ASSERT_TRUE(large.ok()) << large.error().line();
    ASSERT_EQ(large->size(), 2U);
    EXPECT_EQ((*large)[0].file, "x/m.kml");
    EXPECT_NE((*large)[0].text.find("<GroundOverlay>"), std::string::npos);
    EXPECT_EQ((*large)[0].note,
              "x/m.kml lays the map by its four corners: between them it is up to 8.7 pixels off (with --crs "
              "EPSG:4326 it is not)");
    EXPECT_EQ(nlohmann::json::parse((*large)[1].text)["position"]["h"], 700.0);
    view.map->width_px = view.map->height_px = 1200;
    const auto small = pose_texts("x/m.png", {true, false}, view, facts);
    ASSERT_TRUE(small.ok()) << small.error().line();
    EXPECT_EQ((*small)[0].note, "");
}

// A picture twice as wide as high, 90 degrees from bottom to top: tan 45 = 1, so its sides are at atan 2 =
// 63.434949 degrees. With a strip as high as the picture its bottom is at atan 3 = 71.565051 degrees.
TEST(PhotoOverlays, StandWhereThePictureWasTaken) {
    View view;
    view.camera.eye = {46.5, 8.25, 1050.0};
    view.camera.attitude = {205.0, -4.0, 3.0};
    view.camera.vertical_fov_deg = 90.0;
    view.camera.width_px = 200;
    view.camera.height_px = 100;
    view.time_utc_s = 0;
    const std::string kml = photo_overlay_kml(view, {.N_m = 50.0}, "a&b \xC3\xA9.png");
    for (const char* part :
         {"<longitude>8.250000000</longitude><latitude>46.500000000</latitude>",
          "<altitude>1000.000000000</altitude>", "<heading>205.000000000</heading>",
          "<tilt>86.000000000</tilt><roll>3.000000000</roll><altitudeMode>absolute</altitudeMode>",
          "<when>1970-01-01T00:00:00Z</when>", "<href>a%26b%20%C3%A9.png</href>",
          "<name>a&amp;b \xC3\xA9.png</name>", "<leftFov>-63.434948823</leftFov>",
          "<rightFov>63.434948823</rightFov><bottomFov>-45.000000000</bottomFov>",
          "<topFov>45.000000000</topFov>", "<shape>rectangle</shape>",
          "<coordinates>8.250000000,46.500000000,1000.000000</coordinates>"})
        EXPECT_NE(kml.find(part), std::string::npos) << part << " in " << kml;
    view.legend_px = 100;
    EXPECT_NE(photo_overlay_kml(view, {.N_m = 50.0}, "a.png").find("<bottomFov>-71.565051177</bottomFov>"),
              std::string::npos);
}

// A quarter of all around in 800 pixels: 800 / (pi / 2) = 509.296 pixels a radian. 200 rows above level end
// at atan(200 / 509.296) = 21.439890502 degrees, 300 below it at atan(300 / 509.296) = 30.500153392.
TEST(PhotoOverlays, OfPanoramasAreCylinders) {
    View view;
    view.camera.eye = {46.5, 8.25, 1050.0};
    view.camera.attitude = {345.0, 0.0, 0.0};
    view.camera.vertical_fov_deg = 30.0;
    view.camera.width_px = 800;
    view.camera.height_px = 500;
    view.panorama = PanoramaFrame{300.0, 90.0, -30.0, 20.0, true};
    const PoseFacts facts{.N_m = 50.0, .attribution = "Survey & Co", .above_level_px = 200.0};
    const std::string kml = photo_overlay_kml(view, facts, "p.png");
    for (const char* part :
         {"<name>p.png</name>\n  <description>Survey &amp; Co</description>\n  <Camera>",
          "<altitude>1000.000000000</altitude>", "<heading>345.000000000</heading>",
          "<tilt>90.000000000</tilt><roll>0.000000000</roll><altitudeMode>absolute</altitudeMode>",
          "<leftFov>-45.000000000</leftFov><rightFov>45.000000000</rightFov>",
          "<bottomFov>-30.500153392</bottomFov><topFov>21.439890502</topFov><near>10.000000000</near>",
          "<shape>cylinder</shape>"})
        EXPECT_NE(kml.find(part), std::string::npos) << part << " in " << kml;
    view.panorama->sweep_deg = 360.0;
    EXPECT_NE(photo_overlay_kml(view, facts, "p.png")
                  .find("<leftFov>-180.000000000</leftFov><rightFov>180.000000000</rightFov>"),
              std::string::npos);
}

TEST(PhotoOverlays, AreNamedAfterThePicture) {
    EXPECT_EQ(pose_paths("x/p.png", {true, true}), (std::vector<std::string>{"x/p.kml", "x/p.geopose.json"}));
    EXPECT_EQ(pose_paths("x/p.jpg", {true, false}), std::vector<std::string>{"x/p.jpg.kml"});
    EXPECT_TRUE(pose_paths("x/p.jpg", {}).empty());
}

}  // namespace
}  // namespace oro
