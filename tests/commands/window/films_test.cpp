// Films that a window makes: lines that are followed, and the command that draws the keys.
#include "apps/window/films.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/view/view_words.h"
#include "tests/support/made_terrain.h"

namespace oro {
namespace {

// Level at 500 m, N = 0, from 46 to 47 N and 7 to 8 E.
Region level_region() {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field =
        test::made_field(47.0, 7.0, 120.0, 121, 121, [](double, double) { return 500.0F; });
    return region;
}

TEST(Films, SomebodyFollowsALineAtEyeHeight) {
    const auto line = line_along("46.5,7.5; 46.5,7.52", std::nullopt);
    ASSERT_TRUE(line.ok()) << line.error().line();
    const auto keys = keys_of_walk(*line, {10.0, 60.0}, level_region(), 1.0, 40.0);
    ASSERT_TRUE(keys.ok()) << keys.error().line();
    const CameraPath path(*keys);
    EXPECT_NEAR(path.duration_s(), line->distances_m.back() / 10.0, 1e-9);
    for (const double time_s : {0.0, 11.0, 77.0, path.duration_s()}) {
        const CameraKey key = path.at(time_s);
        EXPECT_NEAR(key.eye.h_m, 501.7, 0.01);
        EXPECT_EQ(key.vertical_fov_deg, 40.0);
        // 1.7 m down to what is 60 m ahead.
        EXPECT_NEAR(key.attitude.pitch_deg, -std::atan2(1.7, 60.0) * 57.29577951308232, 0.05);
        EXPECT_NEAR(key.attitude.heading_deg, 90.0, 0.1);
    }
    EXPECT_FALSE(keys_of_walk(*line, {0.0, 60.0}, level_region(), 1.0, 40.0).ok());
    EXPECT_FALSE(keys_of_walk(*line, {10.0, 0.0}, level_region(), 1.0, 40.0).ok());
    EXPECT_FALSE(keys_of_walk(*line, {10.0, 60.0, 1.0}, level_region(), 1.0, 40.0).ok());
    const auto higher = keys_of_walk(*line, {10.0, 60.0, 50.0}, level_region(), 1.0, 40.0);
    ASSERT_TRUE(higher.ok()) << higher.error().line();
    EXPECT_NEAR(CameraPath(*higher).at(11.0).eye.h_m, 550.0, 0.01);
}

TEST(Films, TheCommandHasTheDataAndTheLooks) {
    View view;
    view.region.paths = {"my data/N46E008.hgt"};
    view.camera.width_px = 960;
    view.camera.height_px = 540;
    EXPECT_EQ(film_command("flight.json", view),
              "orograph film flight.json 'my data/N46E008.hgt' --size 960x540 --out flight-frames\n");
    view.style = "contours";
    view.tau_px = 0.5;
    view.exaggeration = 1.5;
    view.shadows = false;
    view.vectors.overlay = {"it's a track.gpx"};
    view.region.box = BoundingBox{8.0, 46.0, 8.5, 46.25};
    view.sun = SunDirection{0.0, 0.0, SunTime{"2026-06-21T05:30+02:00", 1'782'012'600}};
    EXPECT_EQ(film_command("a/tour.kml", view),
              "orograph film a/tour.kml 'my data/N46E008.hgt' --bbox 8,46,8.5,46.25 --size 960x540 --style "
              "contours --overlay 'it'\\''s a track.gpx' --sun-time 2026-06-21T05:30+02:00 --shadows off "
              "--exaggeration 1.5 --tau 0.5 --out tour-frames\n");
}

// A view whose options are given anew is the same, but for its eye and its sun's direction.
TEST(Films, TheWordsOfAViewMakeItAgain) {
    View view;
    view.region.paths = {"data.tif"};
    view.camera.width_px = 640;
    view.camera.height_px = 360;
    view.style = "plain";
    view.samples = 4;
    view.exaggeration = 2.0;
    view.tau_px = 0.25;
    view.sea = Sea::low;
    view.rim = Rim::none;
    view.edges = Edges::steps;
    view.visibility_km = 80.5;
    view.shadows = true;
    view.sky_openness = false;
    view.model.earth = Earth::sphere;
    view.model.air = standard_air;
    view.sun = SunDirection{315.0, 45.0};
    view.vectors.names = {"a.geojson"};
    view.vectors.names_field = "nom";
    const auto again = view_without_eye(look_options_of(view), view.region);
    ASSERT_TRUE(again.ok()) << again.error().line();
    view.sea_asked = again->sea_asked;
    view.rim_asked = again->rim_asked;
    view.time_utc_s = again->time_utc_s;
    EXPECT_EQ(view_to_json(view, true), view_to_json(*again, true));
}

}  // namespace
}  // namespace oro
