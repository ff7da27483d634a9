// A film's keys, changed one at a time, and as a tour of KML.
#include "apps/film/film_keys.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "apps/commands/film/tour_keys.h"
#include "apps/film/tour_kml.h"
#include "tests/support/made_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

Camera camera_at(double lat_deg, double heading_deg) {
    Camera camera;
    camera.eye = {lat_deg, 7.5, 1234.5};
    camera.attitude = {heading_deg, -10.0, 3.0};
    camera.vertical_fov_deg = 50.0;
    return camera;
}

std::vector<CameraKey> three_keys() {
    std::vector<CameraKey> keys;
    add_key(keys, camera_at(46.1, 10.0), 5.0);
    add_key(keys, camera_at(46.2, 20.0), 5.0);
    add_key(keys, camera_at(46.3, 30.0), 2.5);
    return keys;
}

std::vector<double> times_of(const std::vector<CameraKey>& keys) {
    std::vector<double> times;
    for (const CameraKey& key : keys) times.push_back(key.time_s);
    return times;
}
std::vector<double> headings_of(const std::vector<CameraKey>& keys) {
    std::vector<double> headings;
    for (const CameraKey& key : keys) headings.push_back(key.attitude.heading_deg);
    return headings;
}

TEST(FilmKeys, AreAddedOneAfterTheOther) {
    std::vector<CameraKey> keys = three_keys();
    EXPECT_EQ(times_of(keys), (std::vector<double>{0.0, 5.0, 7.5}));
    EXPECT_EQ(keys[1].eye.lat_deg, 46.2);
    EXPECT_EQ(keys[1].eye.h_m, 1234.5);
    EXPECT_EQ(keys[1].attitude.pitch_deg, -10.0);
    EXPECT_EQ(keys[1].vertical_fov_deg, 50.0);
    // Never at the same time.
    add_key(keys, camera_at(46.4, 40.0), 0.0);
    EXPECT_EQ(keys.back().time_s, 7.51);
    EXPECT_EQ(CameraPath(keys).at(5.0).eye.lat_deg, 46.2);
}

TEST(FilmKeys, ChangePlacesAndKeepTheTimesOfThese) {
    std::vector<CameraKey> keys = three_keys();
    keys[0].time_utc_s = 60;
    swap_with_next(keys, 0);
    EXPECT_EQ(headings_of(keys), (std::vector<double>{20.0, 10.0, 30.0}));
    EXPECT_EQ(times_of(keys), (std::vector<double>{0.0, 5.0, 7.5}));
    EXPECT_EQ(keys[0].time_utc_s, 60);
    EXPECT_FALSE(keys[1].time_utc_s);
    swap_with_next(keys, 2);
    EXPECT_EQ(headings_of(keys), (std::vector<double>{20.0, 10.0, 30.0})) << "nothing is after the last";
    remove_key(keys, 1);
    EXPECT_EQ(headings_of(keys), (std::vector<double>{20.0, 30.0}));
    EXPECT_EQ(times_of(keys), (std::vector<double>{0.0, 7.5}));
}

TEST(FilmKeys, TakeTheKeysAfterThemAlong) {
    std::vector<CameraKey> keys = three_keys();
    set_key_time(keys, 1, 8.0);
    EXPECT_EQ(times_of(keys), (std::vector<double>{0.0, 8.0, 10.5}));
    set_key_time(keys, 2, 1.0);
    EXPECT_EQ(times_of(keys), (std::vector<double>{0.0, 8.0, 8.01})) << "not before the one before it";
    set_key_time(keys, 0, -2.0);
    EXPECT_EQ(keys[0].time_s, -2.0);
    EXPECT_EQ(keys[1].time_s, 6.0);
}

TEST(FilmKeys, AreReadAgainFromTheirTour) {
    const std::filesystem::path file = test::scratch_folder() / "tour.kml";
    std::vector<CameraKey> keys = three_keys();
    keys[1].time_utc_s = 1'782'000'000;
    std::ofstream(file) << keys_to_kml(keys, "up & down", [](double, double) { return 47.25; });
    const auto stops = read_kml_tour(file.string());
    ASSERT_TRUE(stops.ok()) << stops.error().line();
    ASSERT_EQ(stops->size(), 3U);
    Region region{std::vector<RegionGrid>(1)};
    HeightField& field = region.grids[0].field;
    field = test::made_field(47.0, 7.0, 120.0, 121, 121, [](double, double) { return 500.0F; });
    field.undulation.lat = {1.0, 47.0, 0, -1, 2};
    field.undulation.lon = {1.0, 7.0, 0, +1, 2};
    field.undulation.N_m = {47.25F, 47.25F, 47.25F, 47.25F};
    const auto read = keys_of_tour(*stops, 50.0, region, 1.0, "tour.kml");
    ASSERT_TRUE(read.ok()) << read.error().line();
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const CameraKey &one = keys[i], &again = (*read)[i];
        EXPECT_NEAR(again.time_s, one.time_s, 2e-6);
        EXPECT_NEAR(again.eye.lat_deg, one.eye.lat_deg, 1e-9);
        EXPECT_NEAR(again.eye.lon_deg, one.eye.lon_deg, 1e-9);
        EXPECT_NEAR(again.eye.h_m, one.eye.h_m, 2e-6);
        EXPECT_NEAR(again.attitude.heading_deg, one.attitude.heading_deg, 1e-9);
        EXPECT_NEAR(again.attitude.pitch_deg, one.attitude.pitch_deg, 2e-9);
        EXPECT_NEAR(again.attitude.roll_deg, one.attitude.roll_deg, 1e-9);
        EXPECT_EQ(again.time_utc_s, one.time_utc_s);
    }
}

}  // namespace
}  // namespace oro
