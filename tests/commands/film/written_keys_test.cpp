// Keys of a camera's path in files, which frames are drawn, and flights along tracks and tours.
#include "apps/film/written_keys.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "apps/commands/film/tour_keys.h"
#include "apps/commands/film/track_keys.h"
#include "apps/film/frame_range.h"
#include "tests/support/made_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

// A plain at 500 m from 46 to 47 N and 7 to 8 E, N = 0.
Region plain() {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field =
        test::made_field(47.0, 7.0, 120.0, 121, 121, [](double, double) { return 500.0F; });
    return region;
}

std::string fault_of(const std::string& text) {
    const auto keys = keys_from_json(text, "p.json", 45.0);
    EXPECT_FALSE(keys.ok()) << text;
    return keys.ok() ? "" : keys.error().line();
}

const std::string first_key = R"({"time_s": 0, "eye": {"lat_deg": 46.5, "lon_deg": 7.5, "above_m": 100}})";

TEST(WrittenKeys, CountHeightsFromWhatTheySay) {
    const auto keys = keys_from_json(
        R"({"orograph_path": 1, "keys": [)" + first_key +
            R"(, {"time_s": 1.5, "eye": {"lat_deg": 46.5, "lon_deg": 7.5, "H_m": 100}, "heading_deg": -90,
                 "pitch_deg": -10, "roll_deg": 5, "fov_deg": 60, "utc": "1970-01-01T00:01:00Z"},
               {"time_s": 2, "eye": {"lat_deg": 46.5, "lon_deg": 7.5, "h_m": 77}}]})",
        "p.json", 33.0);
    ASSERT_TRUE(keys.ok()) << keys.error().line();
    const auto placed = eyes_over_region(*keys, plain(), 2.0, "p.json");
    ASSERT_TRUE(placed.ok()) << placed.error().line();
    ASSERT_EQ(placed->size(), 3U);
    // Exaggerated twice, the plain is at 1,000 m.
    EXPECT_NEAR((*placed)[0].eye.h_m, 1100.0, 0.001);
    EXPECT_EQ((*placed)[0].vertical_fov_deg, 33.0);
    EXPECT_NEAR((*placed)[1].eye.h_m, 100.0, 1e-9);
    EXPECT_EQ((*placed)[1].attitude.heading_deg, 270.0);
    EXPECT_EQ((*placed)[1].time_utc_s, 60);
    EXPECT_EQ((*placed)[2].eye.h_m, 77.0);
    // Written, they are read as they are.
    const auto again = keys_from_json(keys_to_json(*placed), "q.json", 1.0);
    ASSERT_TRUE(again.ok()) << again.error().line();
    for (std::size_t i = 0; i < placed->size(); ++i) {
        EXPECT_EQ((*again)[i].heights, HeightAbove::ellipsoid);
        EXPECT_EQ((*again)[i].key.eye.h_m, (*placed)[i].eye.h_m);
        EXPECT_EQ((*again)[i].key.time_utc_s, (*placed)[i].time_utc_s);
        EXPECT_EQ((*again)[i].key.vertical_fov_deg, (*placed)[i].vertical_fov_deg);
    }
}

TEST(WrittenKeys, TellWhatIsWrongInThem) {
    const std::string is_none = "p.json: holds no camera path that can be read: ";
    EXPECT_EQ(fault_of("{}"), is_none + "no orograph_path in it");
    EXPECT_EQ(fault_of(R"({"orograph_path": 2, "keys": []})"),
              is_none + "its format is 2, this program reads 1");
    EXPECT_EQ(fault_of(R"({"orograph_path": 1, "keys": []})"),
              is_none + "'keys' must be a list of 1 to 1000000");
    EXPECT_EQ(fault_of(R"({"orograph_path": 1, "keys": [)" + first_key + "," + first_key + "]}"),
              is_none + "key 2: 'time_s' must be later than that of the key before");
    EXPECT_EQ(
        fault_of(R"({"orograph_path": 1, "keys": [{"time_s": 0, "eye": {"lat_deg": 1, "lon_deg": 2}}]})"),
        is_none + "key 1: 'eye' needs one of h_m, H_m and above_m");
    const auto beside =
        keys_from_json(R"({"orograph_path": 1, "keys": [{"time_s": 0, "eye": {"lat_deg": 10, "lon_deg": 7.5,
                          "above_m": 1}}]})",
                       "p.json", 45.0);
    ASSERT_TRUE(beside.ok());
    const auto placed = eyes_over_region(*beside, plain(), 1.0, "p.json");
    ASSERT_FALSE(placed.ok());
    EXPECT_EQ(placed.error().kind, ErrorKind::no_data);
}

TEST(FrameRanges, AreCountedFromOne) {
    EXPECT_EQ(frame_count(1.0, 4.0).value(), 5);
    EXPECT_EQ(frame_count(1.0 / 3.0, 30.0).value(), 11);
    EXPECT_EQ(frame_count(0.0, 30.0).value(), 1);
    EXPECT_FALSE(frame_count(1e6, 1000.0).ok());
    EXPECT_EQ(frame_name(12, ".png"), "frame-000012.png");
    const FrameRange all = frame_range("", "", 7).value();
    EXPECT_TRUE(all.holds(1) && all.holds(7) && !all.holds(8) && !all.holds(0));
    const FrameRange part = frame_range("3:", "2/3", 9).value();
    for (std::int64_t frame = 1; frame <= 9; ++frame)
        EXPECT_EQ(part.holds(frame), frame == 5 || frame == 8) << frame;
    for (const char* text : {"3", "0:2", "4:3", "1:10", "a:b", "-1:3", "1:2:3"})
        EXPECT_FALSE(frame_range(text, "", 9).ok()) << text;
    for (const char* text : {"3", "0/2", "3/2", "1/0", "/", "1/", "a/b"})
        EXPECT_FALSE(frame_range("", text, 9).ok()) << text;
}

// Each frame is in one part, whatever the number of parts.
TEST(FrameRanges, PartsAreAWholeTogether) {
    for (std::int64_t shards = 1; shards <= 5; ++shards) {
        for (std::int64_t frame = 1; frame <= 23; ++frame) {
            int drawn_by = 0;
            for (std::int64_t shard = 1; shard <= shards; ++shard)
                drawn_by += frame_range("", std::to_string(shard) + "/" + std::to_string(shards), 23)
                                    .value()
                                    .holds(frame)
                                ? 1
                                : 0;
            EXPECT_EQ(drawn_by, 1) << frame << " of " << shards;
        }
    }
}

std::string written(const char* name, const std::string& text) {
    const auto file = test::scratch_folder() / name;
    std::ofstream(file) << text;
    return file.string();
}

// Along a meridian over a plain: the eye is 150 m over it, and looks down at what is 500 m ahead: by
// atan(150 / 500) = 16.70 degrees, northwards, to the end.
TEST(TrackKeys, LookAheadOverThePlain) {
    const std::string file = written("t.gpx",
                                     R"(<gpx version="1.1"><trk><trkseg><trkpt lat="46.40" lon="7.5"/>
                                        <trkpt lat="46.45" lon="7.5"/></trkseg></trk></gpx>)");
    const LineAlong line = line_of_file("FLIGHT", file, std::nullopt).value();
    FilmOptions options;
    options.speed_m_s = 100.0;
    const double length_m = line.distances_m.back();
    const TrackFlight flight = track_flight(options, length_m).value();
    EXPECT_NEAR(flight.duration_s, length_m / 100.0, 1e-9);
    const auto keys = keys_along_track(line, flight, plain(), 1.0);
    ASSERT_TRUE(keys.ok()) << keys.error().line();
    EXPECT_EQ(keys->front().time_s, 0.0);
    EXPECT_NEAR(keys->back().time_s, flight.duration_s, 1e-9);
    EXPECT_NEAR(keys->front().eye.lat_deg, 46.40, 1e-9);
    EXPECT_NEAR(keys->back().eye.lat_deg, 46.45, 1e-9);
    for (const CameraKey& key : *keys) {
        EXPECT_NEAR(key.eye.h_m, 650.0, 0.01);
        EXPECT_NEAR(std::remainder(key.attitude.heading_deg, 360.0), 0.0, 1e-6);
        EXPECT_NEAR(key.attitude.pitch_deg, -16.70, 0.01);
    }
    // 10 seconds of 100 m each.
    options.look_ahead = "10s";
    EXPECT_NEAR(track_flight(options, length_m)->look_ahead_m, 1000.0, 1e-9);
    options.look_ahead = "250m";
    EXPECT_EQ(track_flight(options, length_m)->look_ahead_m, 250.0);
    options.look_ahead = "far";
    EXPECT_FALSE(track_flight(options, length_m).ok());
}

// Northwards up a slope of 1 in 2, or down one: at its end a camera looks on level ground beyond the upper
// end, atan(150 / 500) = 16.70 degrees down as over the plain, and down the slope beyond the lower one.
TEST(TrackKeys, EndLookingAtGroundAndNotAtTheSky) {
    const std::string file = written("s.gpx",
                                     R"(<gpx version="1.1"><trk><trkseg><trkpt lat="46.40" lon="7.5"/>
                                        <trkpt lat="46.45" lon="7.5"/></trkseg></trk></gpx>)");
    const LineAlong line = line_of_file("FLIGHT", file, std::nullopt).value();
    const auto last_pitch_deg = [&](double rise) {
        Region slope = plain();
        slope.grids[0].field = test::made_field(47.0, 7.0, 120.0, 121, 121, [&](double lat, double) {
            return static_cast<float>(3000.0 + rise * 111180.0 * (lat - 46.4));
        });
        return keys_along_track(line, TrackFlight{}, slope, 1.0).value().back().attitude.pitch_deg;
    };
    EXPECT_NEAR(last_pitch_deg(0.5), -16.70, 0.1);
    EXPECT_LT(last_pitch_deg(-0.5), -30.0);
}

// A corner is cut by the smoothing, and stays where there is none.
TEST(TrackKeys, AreSmoothAtCorners) {
    const std::string file = written("c.gpx",
                                     R"(<gpx version="1.1"><trk><trkseg><trkpt lat="46.40" lon="7.5"/>
                                        <trkpt lat="46.45" lon="7.5"/><trkpt lat="46.45" lon="7.6"/>
                                        </trkseg></trk></gpx>)");
    const LineAlong line = line_of_file("FLIGHT", file, std::nullopt).value();
    const auto sharpest_deg = [&](double smoothing_m) {
        TrackFlight flight;
        flight.smoothing_m = smoothing_m;
        const auto keys = keys_along_track(line, flight, plain(), 1.0).value();
        double most_deg = 0.0;
        for (std::size_t i = 1; i + 1 < keys.size(); ++i) {
            const auto bearing = [&](std::size_t k) {
                return geodesic_between(keys[k].eye.lat_deg, keys[k].eye.lon_deg, keys[k + 1].eye.lat_deg,
                                        keys[k + 1].eye.lon_deg)
                    .bearing_deg;
            };
            most_deg = std::max(most_deg, std::abs(std::remainder(bearing(i) - bearing(i - 1), 360.0)));
        }
        return most_deg;
    };
    EXPECT_GT(sharpest_deg(0.0), 40.0);
    EXPECT_LT(sharpest_deg(1000.0), 20.0);
}

// A LookAt 45 degrees tilted, heading east, 1,000 m from a place on the plain: the eye is 707.1 m west of it
// and 707.1 m over it, and looks down by 45 degrees. A Camera tilted by 90 is level.
TEST(TourKeys, AreCamerasAndLooks) {
    const std::string file = written("tour.kml", R"(<kml xmlns="http://www.opengis.net/kml/2.2"
        xmlns:gx="http://www.google.com/kml/ext/2.2"><gx:Tour><gx:Playlist>
        <gx:FlyTo><gx:duration>9</gx:duration><LookAt><longitude>7.5</longitude><latitude>46.5</latitude>
        <heading>90</heading><tilt>45</tilt><range>1000</range></LookAt></gx:FlyTo>
        <gx:Wait><gx:duration>2</gx:duration></gx:Wait>
        <gx:FlyTo><gx:duration>3</gx:duration><Camera><longitude>7.6</longitude><latitude>46.5</latitude>
        <altitude>1200</altitude><heading>180</heading><tilt>90</tilt><roll>10</roll>
        <altitudeMode>absolute</altitudeMode>
        <gx:TimeStamp><when>1970-01-02T00:00:00Z</when></gx:TimeStamp></Camera></gx:FlyTo>
        </gx:Playlist></gx:Tour></kml>)");
    const auto stops = read_kml_tour(file);
    ASSERT_TRUE(stops.ok()) << stops.error().line();
    ASSERT_EQ(stops->size(), 3U);
    const auto keys = keys_of_tour(*stops, 40.0, plain(), 1.0, file);
    ASSERT_TRUE(keys.ok()) << keys.error().line();
    const CameraKey &look = (*keys)[0], &waited = (*keys)[1], &camera = (*keys)[2];
    EXPECT_EQ(look.time_s, 0.0);
    EXPECT_EQ(waited.time_s, 2.0);
    EXPECT_EQ(camera.time_s, 5.0);
    // 707.1 m; the Earth bends by 0.04 m below a level line of that length.
    EXPECT_NEAR(look.eye.h_m, 500.0 + 707.107, 0.05);
    EXPECT_NEAR(geodesic_between(look.eye.lat_deg, look.eye.lon_deg, 46.5, 7.5).distance_m, 707.107, 0.2);
    EXPECT_NEAR(look.attitude.heading_deg, 90.0, 0.01);
    EXPECT_NEAR(look.attitude.pitch_deg, -45.0, 0.01);
    EXPECT_EQ(waited.eye.h_m, look.eye.h_m);
    EXPECT_EQ(camera.eye.h_m, 1200.0);
    EXPECT_EQ(camera.attitude.heading_deg, 180.0);
    EXPECT_EQ(camera.attitude.pitch_deg, 0.0);
    EXPECT_EQ(camera.attitude.roll_deg, 10.0);
    EXPECT_EQ(camera.vertical_fov_deg, 40.0);
    EXPECT_EQ(camera.time_utc_s, 86400);
}

TEST(TourKeys, TellWhereATourIsWrong) {
    const std::string file = written("bad.kml",
                                     "<kml>\n<Tour><Playlist><FlyTo>\n<LookAt><latitude>north</latitude>"
                                     "</LookAt></FlyTo></Playlist></Tour></kml>");
    const auto stops = read_kml_tour(file);
    ASSERT_FALSE(stops.ok());
    EXPECT_EQ(stops.error().what, "line 3: 'latitude' is 'north', no number that it may be");
    const std::string none = written("none.kml", "<kml><Document/></kml>");
    ASSERT_TRUE(read_kml_tour(none).ok());
    EXPECT_TRUE(read_kml_tour(none)->empty());
}

}  // namespace
}  // namespace oro
