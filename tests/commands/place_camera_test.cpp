// What a picture of a place shows: all of a cell; any other place in its middle, with nothing before it.
#include "apps/view/place_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "apps/eye/standpoint.h"
#include "apps/report/summit_words.h"
#include "apps/view/overview.h"
#include "apps/window/jump.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/ground.h"
#include "tests/support/made_terrain.h"

namespace oro {
namespace {

Camera wide() {
    Camera camera;
    camera.width_px = 160;
    camera.height_px = 90;
    return camera;
}

Region region_of(HeightField field) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field = std::move(field);
    return region;
}

// Two degrees of hills of up to 1,000 m, 120 posts a degree: cells N46E007 and N46E008.
Region two_cells() {
    return region_of(test::made_field(47.0, 7.0, 120.0, 121, 241, [](double lat, double lon) {
        return static_cast<float>(500.0 + 500.0 * std::sin(40.0 * lat) * std::cos(30.0 * lon));
    }));
}

Place place_of(const char* text) {
    return parse_place(text).value();
}

Camera shown(const Region& region, const char* text, const AskedLine& asked = {}) {
    const auto camera = camera_showing(wide(), place_of(text), asked, region, 1.0, text);
    EXPECT_TRUE(camera.ok()) << camera.error().line();
    return camera.ok() ? *camera : Camera();
}

// Where a post is on the picture: within -1 and 1 across and up.
glm::dvec2 on_picture(const Camera& camera, const glm::dvec3& ecef) {
    const glm::dvec3 at = camera.view_from_ecef() * (ecef - camera.eye_ecef().m);
    EXPECT_LT(at.z, 0.0);
    return glm::dvec2(at) / (-at.z * camera.half_fov_tangent());
}

TEST(CameraShowing, FramesACellAsAnOverviewOfItAlone) {
    const Region both = two_cells();
    const Camera camera = shown(both, "N46E008");
    glm::dvec2 low(9.0), high(-9.0);
    for (int row = 0; row < 121; ++row) {
        for (int column = 120; column < 241; ++column) {
            const glm::dvec2 at = on_picture(camera, post_ecef(both.grids[0].field, row, column, 1.0).m);
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
    }
    // A margin of 5 % of each side, touched on two opposite ones.
    EXPECT_GT(std::min(low.x, low.y), -0.9001);
    EXPECT_LT(std::max(high.x, high.y), 0.9001);
    EXPECT_GT(std::max(std::min(-low.x, high.x), std::min(-low.y, high.y)), 0.899);

    const Region east = region_of(test::made_field(47.0, 8.0, 120.0, 121, 121, [](double lat, double lon) {
        return static_cast<float>(500.0 + 500.0 * std::sin(40.0 * lat) * std::cos(30.0 * lon));
    }));
    View alone;
    alone.camera = wide();
    ViewOptions options;
    options.vertical_fov_deg = 45.0;
    ASSERT_TRUE(see_whole_region(alone, options, east).ok());
    EXPECT_NEAR(camera.eye.lat_deg, alone.camera.eye.lat_deg, 1e-9);
    EXPECT_NEAR(camera.eye.lon_deg, alone.camera.eye.lon_deg, 1e-9);
    EXPECT_NEAR(camera.eye.h_m, alone.camera.eye.h_m, 1e-3);
    EXPECT_NEAR(camera.attitude.pitch_deg, alone.camera.attitude.pitch_deg, 1e-9);
}

TEST(CameraShowing, OtherCellsAreFramedTooWhereTheyAreLargeEnough) {
    const Region region = two_cells();
    EXPECT_TRUE(is_framed(place_of("u0m"), region)) << "a geohash of 1.4 degrees";
    EXPECT_TRUE(is_framed(place_of("32TMS"), region)) << "100 km";
    EXPECT_FALSE(is_framed(place_of("32TMS2200058000"), region)) << "a square metre is a place";
    EXPECT_FALSE(is_framed(place_of("46.5,7.5"), region));
    const Camera camera = shown(region, "u0m");
    EXPECT_GT(camera.eye.h_m, 50'000.0);
}

// Ground of 46.5 N, on a slope to the north of 45 degrees that ends on a crest 2,000 m higher to the south.
Region northern_face() {
    return region_of(test::made_field(46.6, 7.9, 1200.0, 241, 241, [](double lat, double) {
        const double south_m = (46.5 - lat) * 111'170.0;
        return static_cast<float>(std::clamp(south_m, -2000.0, 2000.0));
    }));
}

TEST(CameraShowing, LooksAtAPlaceFromASideThatSeesIt) {
    const Region face = northern_face();
    const Geodetic place{46.5, 8.0, *ground_h_m(face.grids[0].field, 46.5, 8.0)};
    const Camera camera = shown(face, "46.5,8.0");
    EXPECT_LT(glm::length(on_picture(camera, ecef_from_geodetic(place).m)), 1e-9) << "in the middle";
    // From 20 degrees up and the south the crest hides it; from the east it does not.
    EXPECT_NEAR(camera.attitude.pitch_deg, -20.0, 0.2);
    EXPECT_GT(camera.attitude.heading_deg, 80.0);
    EXPECT_LT(camera.attitude.heading_deg, 280.0);
    const auto ground = [&](double lat_deg, double lon_deg) {
        return ground_h_m(face.grids[0].field, lat_deg, lon_deg);
    };
    EXPECT_TRUE(is_line_free(camera.eye, place, 10.0, ground));
    // 40 posts of 92.8 m around it, 5 % of margin: 3,711 m / sin(atan(0.9 tan 22.5 degrees)).
    EXPECT_NEAR(glm::length(camera.eye_ecef().m - ecef_from_geodetic(place).m), 10'612.0, 15.0);
}

TEST(CameraShowing, KeepsTheAskedSideWithMoreHeight) {
    AskedLine asked;
    asked.heading_deg = 0.0;
    const Camera camera = shown(northern_face(), "46.5,8.0", asked);
    EXPECT_NEAR(camera.attitude.heading_deg, 0.0, 0.1);
    EXPECT_NEAR(camera.attitude.pitch_deg, -60.0, 0.2) << "40 degrees graze the face";
    asked.pitch_deg = -20.0;
    const auto refused =
        camera_showing(wide(), place_of("46.5,8.0"), asked, northern_face(), 1.0, "--at 46.5,8.0");
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::usage);
    EXPECT_NE(refused.error().line().find("--above METRES"), std::string::npos) << refused.error().line();
}

TEST(CameraShowing, RefusesPlacesWithoutData) {
    for (const char* text : {"10,10", "N10E010"}) {
        const auto none = camera_showing(wide(), place_of(text), {}, two_cells(), 1.0, text);
        ASSERT_FALSE(none.ok()) << text;
        EXPECT_EQ(none.error().kind, ErrorKind::no_data);
        EXPECT_NE(none.error().line().find("no elevation data"), std::string::npos);
    }
}

// The tile of N46E008 shares its outer posts with its eight neighbours, which have no other ground.
TEST(CameraShowing, ACellBesideTheDataHasNone) {
    const Region tile =
        region_of(test::made_field(47.0, 8.0, 120.0, 121, 121, [](double, double) { return 500.0F; }));
    for (const char* text :
         {"N47E007", "N47E008", "N47E009", "N46E007", "N46E009", "N45E007", "N45E008", "N45E009"}) {
        const auto none = camera_showing(wide(), place_of(text), {}, tile, 1.0, text);
        ASSERT_FALSE(none.ok()) << text;
        EXPECT_EQ(none.error().kind, ErrorKind::no_data);
        EXPECT_NE(none.error().line().find("no elevation data in this cell"), std::string::npos) << text;
    }
    shown(tile, "N46E008");
}

// 10 posts (0.9 km) from the southern edge: from the south the eye and all of the foreground would be beyond
// it.
TEST(CameraShowing, LooksOverGroundBesideTheEdgeOfTheData) {
    const Region plain =
        region_of(test::made_field(46.6, 7.9, 1200.0, 241, 361, [](double, double) { return 500.0F; }));
    const Camera camera = shown(plain, "46.408333,8.05");
    EXPECT_GT(camera.eye.lat_deg, 46.408333);
    EXPECT_NEAR(camera.attitude.pitch_deg, -20.0, 0.2);
    const Geodetic place{46.408333, 8.05, 500.0};
    EXPECT_GT(foreground_share(camera, place,
                               [&](double lat_deg, double lon_deg) {
                                   return ground_h_m(plain.grids[0].field, lat_deg, lon_deg);
                               }),
              0.88);
}

// 21 posts a side, 20 steps of 92.6 m along a meridian, 63.9 m along the parallel of 46.5 degrees: the half
// of the shorter one is 639 m.
TEST(CameraShowing, ASmallRegionIsAllThatIsShown) {
    const Region small =
        region_of(test::made_field(46.5, 8.0, 1200.0, 21, 21, [](double, double) { return 500.0F; }));
    const Geodetic place{46.4916, 8.0083, 500.0};
    const Camera camera = shown(small, "46.4916,8.0083");
    // 638.6 m / sin(atan(0.9 tan 22.5 degrees)).
    EXPECT_NEAR(glm::length(camera.eye_ecef().m - ecef_from_geodetic(place).m), 1826.0, 10.0);
}

TEST(CameraShowing, SaysWhyALineFromBelowSeesNothing) {
    AskedLine asked;
    asked.pitch_deg = 20.0;
    const auto refused =
        camera_showing(wide(), place_of("46.5,7.5"), asked, two_cells(), 1.0, "--at 46.5,7.5");
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::usage);
    EXPECT_EQ(refused.error().line(),
              "--at 46.5,7.5: with a --pitch above 0 the eye would be below the place, and ground is between "
              "them: give one below 0, or --above METRES to stand there");
}

// Level ground at 100 m, over a geoid that leans by 1 m a degree: the ellipsoid's heights differ, those above
// sea level do not.
TEST(MovedToSummit, ComparesHeightsAboveSeaLevel) {
    HeightField level = test::made_field(47.0, 8.0, 100.0, 101, 101, [](double, double) { return 100.0F; });
    level.undulation.lat = {1.0, 47.0, 0, -1, 2};
    level.undulation.lon = {1.0, 8.0, 0, +1, 2};
    level.undulation.N_m = {51.0F, 51.0F, 50.0F, 50.0F};
    Region region = region_of(std::move(level));
    const MovedToSummit moved = moved_to_summit({46.503, 8.503, 0.0}, region, 1.0);
    EXPECT_EQ(moved.moved_m, 0.0);
    EXPECT_EQ(moved.to.lat_deg, 46.503);
    EXPECT_EQ(moved.higher_m, 0.0);
    // 4 cm are no summit, 6 cm are.
    region.grids[0].field.H_m[49 * 101 + 50] = 100.04F;
    EXPECT_EQ(moved_to_summit({46.5, 8.5, 0.0}, region, 1.0).moved_m, 0.0);
    region.grids[0].field.H_m[49 * 101 + 50] = 100.06F;
    const MovedToSummit higher = moved_to_summit({46.5, 8.5, 0.0}, region, 1.0);
    EXPECT_NEAR(higher.to.lat_deg, 46.51, 1e-9);
    ASSERT_TRUE(higher.higher_m);
    EXPECT_NEAR(*higher.higher_m, 0.06, 1e-4);
    EXPECT_FALSE(higher.goes_on_rising);
}

TEST(MovedToSummit, APlaceWithoutGroundHasNoDifference) {
    HeightField holed = test::made_field(47.0, 8.0, 100.0, 101, 101, [](double, double) { return 100.0F; });
    holed.H_m[50 * 101 + 50] = void_height_m;
    const Region region = region_of(std::move(holed));
    for (const Geodetic& place : {Geodetic{46.5, 8.5, 0.0}, Geodetic{47.005, 8.5, 0.0}}) {
        const MovedToSummit moved = moved_to_summit(place, region, 1.0);
        EXPECT_GT(moved.moved_m, 0.0);
        EXPECT_FALSE(moved.higher_m) << place.lat_deg;
        EXPECT_NEAR(moved.H_m, 100.0, 1e-6);
        const std::string words = summit_words("the eye stands", moved);
        EXPECT_NE(words.find("(the place itself has no height)"), std::string::npos) << words;
        EXPECT_TRUE(summit_json(moved).at("higher_m").is_null());
    }
}

TEST(Jumps, GoThereAndStand) {
    const Region region = two_cells();
    Camera start = wide();
    start.eye = {46.123456789, 7.3, 94'321.0123};
    start.attitude = {205.125, -31.7, 0.0};
    Jumps jumps;
    EXPECT_FALSE(jumps.stand(start, region, 1.0).value()) << "nothing to stand on";
    const Camera framed = jumps.to(start, place_of("N46E008"), region, 1.0).value();
    EXPECT_NEAR(framed.attitude.heading_deg, 205.1, 1.0) << "from the side that it looked from";
    const auto standing = jumps.stand(framed, region, 1.0).value();
    ASSERT_TRUE(standing);
    EXPECT_EQ(standing->eye.lat_deg, 46.5);
    EXPECT_EQ(standing->eye.lon_deg, 8.5);
    EXPECT_NEAR(standing->eye.h_m, *ground_h_m(region.grids[0].field, 46.5, 8.5) + 2.0, 1e-9);
    EXPECT_EQ(standing->attitude.pitch_deg, 0.0);
}

TEST(Jumps, StayWhereThereIsNoData) {
    const Region region = two_cells();
    Camera start = wide();
    start.eye = {46.5, 7.5, 3000.0};
    Jumps jumps;
    EXPECT_FALSE(jumps.to(start, place_of("0,0"), region, 1.0).ok());
    // A place with a height of its own is where the eye goes.
    const Camera there = jumps.to(start, place_of("geo:46.5,8.5,5000"), region, 1.0).value();
    EXPECT_EQ(there.eye.h_m, 5000.0);
    EXPECT_EQ(there.eye.lon_deg, 8.5);
    jumps.moved();
    EXPECT_FALSE(jumps.stand(there, region, 1.0).value());
}

// From straight above, where framing turned the picture by its roll.
TEST(Jumps, KeepTheUsersRollAndTheTurnOfThePicture) {
    const Region region = two_cells();
    Camera start = wide();
    start.eye = {46.5, 7.5, 90'000.0};
    start.attitude = {0.0, -89.95, -160.0};
    EXPECT_EQ(users_roll_deg(start, std::nullopt), 0.0);
    EXPECT_EQ(users_roll_deg(start, 7.0), 7.0);
    EXPECT_EQ(users_roll_deg(Camera{{}, {0.0, -20.0, 5.0}}, std::nullopt), 5.0);
    Jumps jumps(0.0);
    const Camera there = jumps.to(start, place_of("N46E008"), region, 1.0).value();
    EXPECT_NEAR(there.attitude.heading_deg, 200.0, 1.0);
    EXPECT_EQ(there.attitude.roll_deg, 0.0);
    const auto standing = jumps.stand(there, region, 1.0).value();
    ASSERT_TRUE(standing);
    EXPECT_EQ(standing->attitude.roll_deg, 0.0);
    Jumps rolled(12.0);
    start.attitude.roll_deg = -148.0;
    EXPECT_EQ(rolled.to(start, place_of("46.5,8.5"), region, 1.0).value().attitude.roll_deg, 12.0);
}

TEST(Jumps, LookFromTheSameSideJumpAfterJump) {
    const Region plain =
        region_of(test::made_field(47.0, 7.0, 120.0, 121, 241, [](double, double) { return 500.0F; }));
    Camera camera = wide();
    camera.eye = {46.5, 7.5, 90'000.0};
    camera.attitude = {40.0, -30.0, 0.0};
    Jumps jumps;
    const Camera first = jumps.to(camera, place_of("46.5,8.0"), plain, 1.0).value();
    camera = first;
    for (int i = 0; i < 20; ++i) camera = jumps.to(camera, place_of("46.5,8.0"), plain, 1.0).value();
    EXPECT_EQ(camera.attitude.heading_deg, first.attitude.heading_deg);
}

TEST(Jumps, StandOnNothingAfterAFailure) {
    const Region region = two_cells();
    Camera start = wide();
    start.eye = {46.5, 7.5, 3000.0};
    Jumps jumps;
    const Camera there = jumps.to(start, place_of("46.5,8.0"), region, 1.0).value();
    const auto failed = jumps.to(there, place_of("N10E010"), region, 1.0, "N10E010");
    ASSERT_FALSE(failed.ok());
    EXPECT_TRUE(failed.error().line().starts_with("N10E010: no elevation data in this cell"))
        << failed.error().line();
    EXPECT_FALSE(jumps.stand(there, region, 1.0).value());
}

// A cone of 30 m a post; its top is one row to the north of the place.
TEST(Jumps, StandOnTheHighestPostNearOnceMore) {
    const Region cone = region_of(test::made_field(47.0, 8.0, 1200.0, 241, 241, [](double lat, double lon) {
        return static_cast<float>(2000.0 - 30.0 * 1200.0 * std::hypot(lat - 46.9, lon - 8.1));
    }));
    Camera start = wide();
    start.eye = {46.9, 8.1, 9000.0};
    Jumps jumps;
    const Camera shown = jumps.to(start, place_of("46.899166666667,8.1"), cone, 1.0).value();
    EXPECT_FALSE(jumps.higher());
    const auto standing = jumps.stand(shown, cone, 1.0).value();
    ASSERT_TRUE(standing);
    EXPECT_NEAR(standing->eye.h_m, 1972.0, 0.1);
    ASSERT_TRUE(jumps.higher());
    EXPECT_EQ(wall_words(*jumps.higher()), "a post 93 m away is 30.0 m higher");
    const auto summit = jumps.stand(*standing, cone, 1.0).value();
    ASSERT_TRUE(summit);
    EXPECT_NEAR(summit->eye.lat_deg, 46.9, 1e-9);
    EXPECT_NEAR(summit->eye.h_m, 2002.0, 0.1);
    EXPECT_FALSE(jumps.stand(*summit, cone, 1.0).value()) << "it stands there";
}

}  // namespace
}  // namespace oro
