#include "core/earth/place_framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace oro {
namespace {

Camera square_of_ninety_degrees() {
    Camera camera;
    camera.vertical_fov_deg = 90.0;
    camera.width_px = camera.height_px = 101;
    return camera;
}

// The angle between the middle of a camera's picture and a place, in radians.
double off_middle_rad(const Camera& camera, const Geodetic& place) {
    const glm::dvec3 towards = glm::normalize(ecef_from_geodetic(place).m - camera.eye_ecef().m);
    const glm::dvec3 middle = camera.ecef_direction_at({0.5 * camera.width_px, 0.5 * camera.height_px});
    return glm::length(glm::cross(towards, middle));
}

TEST(PlaceFraming, TriesTheUsualSideFirstThenOthersThenSteeper) {
    AskedLine asked;
    asked.usual_heading_deg = 205.0;
    const std::vector<LineOfSight> lines = lines_to_try(asked);
    ASSERT_EQ(lines.size(), 32U);  // 8 sides from 20, 40, 60 and 85 degrees up
    EXPECT_EQ(lines[0].heading_deg, 205.0);
    EXPECT_EQ(lines[0].pitch_deg, -20.0);
    EXPECT_EQ(lines[1].heading_deg, 250.0);
    EXPECT_EQ(lines[2].heading_deg, 160.0);
    EXPECT_EQ(lines[7].heading_deg, 25.0);
    EXPECT_EQ(lines[8].pitch_deg, -40.0);
    EXPECT_EQ(lines[31].pitch_deg, -85.0);
}

TEST(PlaceFraming, TriesNothingElseThanWhatIsAsked) {
    AskedLine asked;
    asked.heading_deg = 90.0;
    for (const LineOfSight& line : lines_to_try(asked)) EXPECT_EQ(line.heading_deg, 90.0);
    asked.pitch_deg = 5.0;
    const std::vector<LineOfSight> lines = lines_to_try(asked);
    ASSERT_EQ(lines.size(), 1U);
    EXPECT_EQ(lines[0].pitch_deg, 5.0);
}

// Half of 90 degrees: a ball of 1,000 m touches the sides from 1,000 m / sin 45 degrees = 1,414.2136 m away.
TEST(PlaceFraming, APlaceIsInTheVeryMiddleAndItsBallFillsThePicture) {
    const Geodetic place{46.5, 8.0, 3000.0};
    for (const LineOfSight line : {LineOfSight{0.0, -20.0}, {205.0, -40.0}, {90.0, -85.0}, {10.0, 30.0}}) {
        const Camera there = camera_on_place(square_of_ninety_degrees(), place, line, 1000.0, 0.0);
        EXPECT_LT(off_middle_rad(there, place), 1e-8) << line.heading_deg << ' ' << line.pitch_deg;
        EXPECT_NEAR(glm::length(there.eye_ecef().m - ecef_from_geodetic(place).m), 1414.2136, 1e-3);
        // 1.4 km away north is turned by 0.01 degree at most, down by 0.013.
        EXPECT_NEAR(there.attitude.pitch_deg, line.pitch_deg, 0.02);
        if (line.pitch_deg > -75.0) {
            EXPECT_NEAR(there.attitude.heading_deg, line.heading_deg, 0.02);
        }
        EXPECT_NEAR(there.eye.h_m - place.h_m, -1414.2136 * std::sin(radians_from_deg(line.pitch_deg).rad),
                    0.2);
    }
}

TEST(PlaceFraming, TheNarrowerSideDecidesAndRollStays) {
    const Geodetic place{-33.0, 151.0, 10.0};
    Camera narrow = square_of_ninety_degrees();
    narrow.width_px = 51;  // tan of half the angle across: 51 / 101
    narrow.attitude.roll_deg = 12.0;
    const Camera there = camera_on_place(narrow, place, {45.0, -20.0}, 100.0, 0.0);
    EXPECT_NEAR(glm::length(there.eye_ecef().m - ecef_from_geodetic(place).m),
                100.0 / std::sin(std::atan(51.0 / 101.0)), 1e-6);
    EXPECT_EQ(there.attitude.roll_deg, 12.0);
    EXPECT_EQ(there.width_px, 51);
}

// A wall 200 m high, 1 km south of the place: at 20 degrees the line passes 364 m over its foot, with 53 m of
// room asked for; at 10 degrees 176 m, which is too low.
TEST(PlaceFraming, GroundBetweenHidesAPlace) {
    const Geodetic place{46.5, 8.0, 0.0};
    const double km_deg = 1000.0 / 111'170.0;  // of latitude there
    const GroundHeightAt wall = [&](double lat_deg, double) -> std::optional<double> {
        return lat_deg < place.lat_deg - km_deg && lat_deg > place.lat_deg - 1.3 * km_deg ? 200.0 : 0.0;
    };
    const auto eye = [&](double heading_deg, double pitch_deg) {
        return camera_on_place(square_of_ninety_degrees(), place, {heading_deg, pitch_deg}, 2000.0, 0.0).eye;
    };
    EXPECT_TRUE(is_line_free(eye(0.0, -20.0), place, 10.0, wall));
    EXPECT_FALSE(is_line_free(eye(0.0, -10.0), place, 10.0, wall));
    EXPECT_TRUE(is_line_free(eye(180.0, -10.0), place, 10.0, wall)) << "from the north";
    // The line rises by 3.5 % and 5 % are asked for.
    EXPECT_FALSE(is_line_free(eye(180.0, -2.0), place, 10.0, wall));
    const GroundHeightAt nothing = [](double, double) -> std::optional<double> { return std::nullopt; };
    EXPECT_TRUE(is_line_free(eye(0.0, -1.0), place, 10.0, nothing)) << "what has no data hides nothing";
}

// A turn of a picture from straight above is a heading, and the roll is the user's alone.
TEST(PlaceFraming, StraightDownTheTurnIsTheHeading) {
    Camera camera = square_of_ninety_degrees();
    camera.attitude.roll_deg = 12.0;
    const Geodetic place{46.5, 8.0, 3000.0};
    const Camera over = camera_on_place(camera, place, {200.0, -90.0}, 1000.0, 0.0);
    EXPECT_EQ(over.attitude.heading_deg, 200.0);
    EXPECT_EQ(over.attitude.pitch_deg, -90.0);
    EXPECT_EQ(over.attitude.roll_deg, 12.0);
    EXPECT_LT(off_middle_rad(over, place), 1e-8);
    const Camera steep = camera_on_place(camera, place, {200.0, -85.0}, 1000.0, 0.0);
    EXPECT_NEAR(steep.attitude.heading_deg, 200.0, 0.02);
    EXPECT_EQ(steep.attitude.roll_deg, 12.0);

    // Four corners of a square of a degree, of which the middle is not the highest.
    std::vector<Ecef> corners;
    for (const double lat_deg : {46.0, 47.0})
        for (const double lon_deg : {7.5, 8.5})
            corners.push_back(ecef_from_geodetic({lat_deg, lon_deg, lat_deg > 46.5 ? 4000.0 : 0.0}));
    const Camera all = camera_on_points(camera, place, 70'000.0, {200.0, -90.0}, corners, 0.05);
    EXPECT_EQ(all.attitude.heading_deg, 200.0);
    EXPECT_EQ(all.attitude.pitch_deg, -90.0);
    EXPECT_EQ(all.attitude.roll_deg, 12.0);
    double farthest = 0.0;
    for (const Ecef& corner : corners) {
        const glm::dvec3 at = all.view_from_ecef() * (corner.m - all.eye_ecef().m);
        EXPECT_LT(at.z, 0.0);
        farthest = std::max({farthest, std::abs(at.x / at.z), std::abs(at.y / at.z)});
    }
    EXPECT_NEAR(farthest, 0.9, 1e-6);  // of the tangent of half of 90 degrees
}

// Looking down, heading and roll turn a picture by their sum; looking up, by their difference.
TEST(PlaceFraming, TheWholeTurnOfASteepPicture) {
    EXPECT_EQ(picture_top_deg({0.0, -89.0, -160.0}, 0.0), 200.0);
    EXPECT_EQ(picture_top_deg({0.0, -89.0, -148.0}, 12.0), 200.0);
    EXPECT_EQ(picture_top_deg({0.0, 89.0, 160.0}, 0.0), 200.0);
    EXPECT_EQ(picture_top_deg({30.0, -40.0, 50.0}, 0.0), 30.0);
}

TEST(PlaceFraming, ForegroundWithoutDataCounts) {
    const Geodetic place{46.5, 8.0, 0.0};
    const Camera camera = camera_on_place(square_of_ninety_degrees(), place, {0.0, -60.0}, 1000.0, 0.0);
    const auto share = [&](double south_of_deg) {
        return foreground_share(camera, place, [&](double lat_deg, double) -> std::optional<double> {
            return lat_deg < south_of_deg ? std::nullopt : std::optional(0.0);
        });
    };
    EXPECT_EQ(share(40.0), 1.0);
    EXPECT_EQ(share(46.5), 0.0) << "all of the lower half is south of the place";
}

}  // namespace
}  // namespace oro
