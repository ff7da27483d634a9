// A film: each frame is the picture that shot writes of the same camera, and a film that was stopped goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::view_in;
using oro::test::Words;
using oro::test::write_bytes;

// One second over the bundled region: five frames at four a second, whose third is a key.
const std::string flight = R"({"orograph_path": 1, "keys": [
  {"time_s": 0, "eye": {"lat_deg": 36.6, "lon_deg": -84.2, "h_m": 900}, "heading_deg": 350, "pitch_deg": -10},
  {"time_s": 0.5, "eye": {"lat_deg": 36.58, "lon_deg": -84.21, "h_m": 800.5}, "heading_deg": 20.25,
   "pitch_deg": -12.5, "fov_deg": 60},
  {"time_s": 1, "eye": {"lat_deg": 36.56, "lon_deg": -84.2, "h_m": 850}, "heading_deg": 60, "pitch_deg": -8}
]})";
const Words small{"--size", "64x48", "--fps", "4"};
const Words at_nine{"--time", "2026-11-21T09:00:00Z"};
const Words five{"frame-000001.png", "frame-000002.png", "frame-000003.png", "frame-000004.png",
                 "frame-000005.png"};

class Film : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const fs::path path = folder / "flight.json";
    const fs::path out = folder / "frames";

    void SetUp() override { write_bytes(path, flight); }
    [[nodiscard]] Outcome film(const Words& more, const fs::path& to, const Circumstances& how = {}) const {
        return run_orograph(joined({"film", path, bundled(), "--out", to}, joined(small, more)), how);
    }
    // The bytes of all frames in a folder, in their order.
    static std::vector<std::string> bytes_in(const fs::path& frames) {
        std::vector<std::string> all;
        for (const std::string& name : names_in(frames)) all.push_back(bytes_of(frames / name));
        return all;
    }
};

TEST_F(Film, FramesAreThePicturesOfShot) {
    const Outcome filmed = film(joined(at_nine, {"--json"}), out);
    ASSERT_EQ(filmed.exit_code, 0) << filmed.err;
    const json said = json::parse(filmed.out);
    EXPECT_EQ(said["frames"]["of_the_film"], 5);
    EXPECT_EQ(said["frames"]["drawn"], 5);
    EXPECT_EQ(said["scenes"], 1);
    EXPECT_EQ(names_in(out), five);
    // By the view in each frame.
    for (const std::string& name : five) {
        const fs::path again = out / ("again-" + name);
        const Outcome shot = run_orograph({"shot", "--view", out / name, "--out", again, "-q"});
        ASSERT_EQ(shot.exit_code, 0) << shot.err;
        EXPECT_TRUE(bytes_of(again) == bytes_of(out / name)) << name;
        fs::remove(again);
    }
    // And by the options of the key that frame 3 is.
    const fs::path shot = out / "shot.png";
    const Outcome outcome = run_orograph(
        joined({"shot", bundled(), "--out", shot, "--at", "geo:36.58,-84.21,800.5", "--heading", "20.25",
                "--pitch", "-12.5", "--fov", "60", "--size", "64x48", "--time", "2026-11-21T09:00:00Z", "-q"},
               {}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(bytes_of(shot) == bytes_of(out / "frame-000003.png"));
}

// Each frame is named as shot names it. A word where no frame has a name.
TEST_F(Film, FramesHaveNamesAsShotPutsThem) {
    const fs::path names = folder / "names.geojson", elsewhere = folder / "elsewhere.geojson",
                   bare = folder / "bare", named = folder / "named", again = named / "again.png";
    const auto points_at = [](const std::string& lon_lat) {
        return R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"name":"Hill"},)"
               R"("geometry":{"type":"Point","coordinates":[)" +
               lon_lat + "]}}]}";
    };
    write_bytes(names, points_at("-84.205,36.62"));
    write_bytes(elsewhere, points_at("8,46"));
    const Words larger = joined(at_nine, {"--size", "320x240", "--fps", "1"});
    const auto filmed = [&](const Words& more, const fs::path& to) {
        const Outcome outcome =
            run_orograph(joined(joined({"film", path, bundled(), "--out", to}, larger), more));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome;
    };
    filmed({"-q"}, bare);
    const Outcome with = filmed({"--names", names}, named);
    EXPECT_FALSE(oro::test::says(with.err, "none shows")) << with.err;
    EXPECT_TRUE(bytes_of(named / "frame-000001.png") != bytes_of(bare / "frame-000001.png"));
    const Outcome shot =
        run_orograph({"shot", "--view", named / "frame-000001.png", "--out", again, "--json"});
    ASSERT_EQ(shot.exit_code, 0) << shot.err;
    EXPECT_EQ(json::parse(shot.out)["names"]["named"][0]["name"], "Hill");
    EXPECT_TRUE(bytes_of(again) == bytes_of(named / "frame-000001.png"));
    const Outcome none = filmed({"--names", elsewhere}, folder / "none");
    EXPECT_TRUE(oro::test::says(none.err, "of the names none shows in the frames that were drawn"))
        << none.err;
}

// Light by the clock of each frame.
TEST_F(Film, FramesHaveTheirOwnSun) {
    const Outcome filmed = film(joined(at_nine, {"--sun-time", "view"}), out);
    ASSERT_EQ(filmed.exit_code, 0) << filmed.err;
    const fs::path again = folder / "frame.png";
    const Outcome shot =
        run_orograph({"shot", bundled(), "--out", out / "shot.png", "--at", "geo:36.58,-84.21,800.5",
                      "--heading", "20.25", "--pitch", "-12.5", "--fov", "60", "--size", "64x48", "--time",
                      "2026-11-21T09:00:00Z", "--sun-time", "view", "-q"});
    ASSERT_EQ(shot.exit_code, 0) << shot.err;
    EXPECT_TRUE(bytes_of(out / "shot.png") == bytes_of(out / "frame-000003.png"));
}

// The clock of the path: a minute in each quarter of a second, here; places from the keys.
TEST_F(Film, EachFrameTellsItsOwnPlaceAndTime) {
    write_bytes(path, R"({"orograph_path": 1, "keys": [
      {"time_s": 0, "eye": {"lat_deg": 36.6, "lon_deg": -84.2, "h_m": 900}, "utc": "2026-06-21T10:00:00Z"},
      {"time_s": 1, "eye": {"lat_deg": 36.6, "lon_deg": -84.2, "h_m": 1000}, "utc": "2026-06-21T10:04:00Z"}]})");
    ASSERT_EQ(film({"-q"}, out).exit_code, 0);
    const Outcome asked =
        oro::test::run_program({"exiftool", "-n", "-j", "-GPSLatitude", "-GPSLongitude", "-EllipsoidalHeight",
                                "-GPSTimeStamp", "-GPSDateStamp", "-fileOrder", "FileName", out});
    ASSERT_EQ(asked.exit_code, 0) << asked.err;
    const json list = json::parse(asked.out);
    ASSERT_EQ(list.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        const std::string time = "10:0" + std::to_string(i) + ":00";
        EXPECT_NEAR(list[i]["GPSLatitude"].get<double>(), 36.6, 1e-7);
        EXPECT_NEAR(list[i]["EllipsoidalHeight"].get<double>(), 900.0 + 25.0 * static_cast<double>(i), 1e-6);
        EXPECT_EQ(list[i]["GPSTimeStamp"], time);
        EXPECT_EQ(list[i]["GPSDateStamp"], "2026:06:21");
    }
}

TEST_F(Film, GoesOnWhereItStopped) {
    ASSERT_EQ(film(joined(at_nine, {"-q"}), out).exit_code, 0);
    const auto whole = bytes_in(out);
    // Without --time the frames that are there tell it.
    fs::remove(out / five[1]);
    fs::remove(out / five[4]);
    const auto kept = fs::last_write_time(out / five[0]);
    const Outcome again = film({"--json", "-q"}, out);
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(json::parse(again.out)["frames"]["drawn"], 2);
    EXPECT_EQ(json::parse(again.out)["frames"]["kept"], 3);
    EXPECT_TRUE(bytes_in(out) == whole);
    EXPECT_EQ(fs::last_write_time(out / five[0]), kept);
}

TEST_F(Film, ReplacesNoOtherFrames) {
    ASSERT_EQ(film(joined(at_nine, {"-q"}), out).exit_code, 0);
    const auto whole = bytes_in(out);
    // Another film, and a frame that lost its end.
    expect_refusal(film(joined(at_nine, {"--exaggeration", "2", "-q"}), out), oro::test::failed,
                   {"frame-000001.png", "is no whole frame of this film", "--overwrite"});
    EXPECT_TRUE(bytes_in(out) == whole);
    write_bytes(out / five[3], whole[3].substr(0, whole[3].size() / 2));
    expect_refusal(film(joined(at_nine, {"-q"}), out), oro::test::failed,
                   {"frame-000004.png", "is no whole frame"});
    const Outcome mended = film(joined(at_nine, {"--overwrite", "--json", "-q"}), out);
    ASSERT_EQ(mended.exit_code, 0) << mended.err;
    EXPECT_EQ(json::parse(mended.out)["frames"]["drawn"], 1);
    EXPECT_TRUE(bytes_in(out) == whole);
}

TEST_F(Film, PartsAreTheWholeTogether) {
    ASSERT_EQ(film(joined(at_nine, {"-q"}), out).exit_code, 0);
    const fs::path parts = folder / "parts";
    ASSERT_EQ(film(joined(at_nine, {"--shard", "2/2", "-q"}), parts).exit_code, 0);
    EXPECT_EQ(names_in(parts), (Words{five[1], five[3]}));
    ASSERT_EQ(film(joined(at_nine, {"--frames", ":3", "-q"}), parts).exit_code, 0);
    ASSERT_EQ(film(joined(at_nine, {"--frames", "5:5", "-q"}), parts).exit_code, 0);
    EXPECT_TRUE(bytes_in(parts) == bytes_in(out));
    expect_refusal(film({"--shard", "1/2", "-q"}, folder / "new"), oro::test::usage,
                   {"--time", "is missing"});
    EXPECT_FALSE(fs::exists(folder / "new"));
}

// Beside each frame, and again where they are gone; shot writes the same.
TEST_F(Film, FramesHaveTheirPosesBesideThem) {
    const Words poses = joined(at_nine, {"--kml", "--geopose", "--stac", "--frames", "3:3", "-q"});
    ASSERT_EQ(film(poses, out).exit_code, 0);
    const Words all{"frame-000003.geopose.json", "frame-000003.kml", "frame-000003.png",
                    "frame-000003.stac.json"};
    EXPECT_EQ(names_in(out), all);
    const json pose = json::parse(bytes_of(out / all[0]));
    EXPECT_EQ(pose["position"], json::parse(R"({"lat": 36.58, "lon": -84.21, "h": 800.5})"));
    const json item = json::parse(bytes_of(out / all[3]));
    EXPECT_EQ(item["geometry"]["coordinates"], json::parse("[-84.21, 36.58, 800.5]"));
    EXPECT_EQ(item["assets"]["geopose"]["href"], "./frame-000003.geopose.json");
    const std::string kml = bytes_of(out / all[1]);
    EXPECT_NE(kml.find("<href>frame-000003.png</href>"), std::string::npos) << kml;
    fs::remove(out / all[1]);
    ASSERT_EQ(film(poses, out).exit_code, 0);
    EXPECT_EQ(bytes_of(out / all[1]), kml);
    write_bytes(out / all[1], "mine");
    expect_refusal(film(poses, out), oro::test::failed, {"frame-000003.kml", "is there already"});
    EXPECT_EQ(bytes_of(out / all[1]), "mine");
    fs::create_directory(folder / "shot");
    const fs::path shot = folder / "shot" / "frame-000003.png";
    ASSERT_EQ(
        run_orograph({"shot", "--view", out / all[2], "--out", shot, "--kml", "--geopose", "--stac", "-q"})
            .exit_code,
        0);
    EXPECT_EQ(bytes_of(folder / "shot" / all[0]), bytes_of(out / all[0]));
    EXPECT_EQ(bytes_of(folder / "shot" / all[1]), kml);
    EXPECT_EQ(bytes_of(folder / "shot" / all[3]), bytes_of(out / all[3]));
    // A map has an item, too.
    const Words map{"shot",       bundled(), "--ortho",
                    "--size",     "64x48",   "--crs",
                    "EPSG:32616", "--out",   (folder / "n.png").string()};
    ASSERT_EQ(run_orograph(joined(map, {"--stac", "-q"})).exit_code, 0);
    EXPECT_EQ(json::parse(bytes_of(folder / "n.stac.json"))["properties"]["proj:epsg"], 32616);
}

// A track becomes keys, and these draw the same film.
TEST_F(Film, TracksAndTheirKeysAreOneFilm) {
    const fs::path track = folder / "track.gpx";
    write_bytes(track, R"(<gpx version="1.1"><trk><trkseg><trkpt lat="36.6" lon="-84.2"/>
                          <trkpt lat="36.58" lon="-84.21"/></trkseg></trk></gpx>)");
    const fs::path keys = folder / "keys.json";
    const Outcome written = run_orograph({"film", track, bundled(), "--duration", "1", "--above", "200",
                                          "--look-ahead", "800", "--write-path", keys, "-q"});
    ASSERT_EQ(written.exit_code, 0) << written.err;
    const Words again{"film", track, bundled(), "--above", "200", "--write-path", keys, "--json", "-q"};
    const Outcome same = run_orograph(joined(again, {"--duration", "1", "--look-ahead", "800"}));
    ASSERT_EQ(same.exit_code, 0) << "a film that goes on has its path already: " << same.err;
    EXPECT_NE(same.out.find("\"duration_s\": 1"), std::string::npos) << same.out;
    expect_refusal(run_orograph(joined(again, {"--duration", "2"})), oro::test::failed,
                   {"keys.json", "is there already, and tells another path"});
    expect_refusal(run_orograph(joined(again, {"--speed", "1000000", "--overwrite"})), oro::test::usage,
                   {"--speed", "the film's length must be between 0.1 and 1000000 seconds"});
    const Words how{"--size", "64x48", "--fps", "2", "--time", "2026-11-21T09:00:00Z", "-q"};
    ASSERT_EQ(run_orograph(joined({"film", track, bundled(), "--duration", "1", "--above", "200",
                                   "--look-ahead", "800", "--out", folder / "a"},
                                  how))
                  .exit_code,
              0);
    ASSERT_EQ(run_orograph(joined({"film", keys, bundled(), "--out", folder / "b"}, how)).exit_code, 0);
    EXPECT_EQ(names_in(folder / "a"), (Words{five[0], five[1], five[2]}));
    EXPECT_TRUE(bytes_in(folder / "a") == bytes_in(folder / "b"));
}

TEST_F(Film, RefusesWhatCannotBe) {
    expect_refusal(run_orograph({"film", path, bundled()}), oro::test::usage, {"--out", "is missing"});
    expect_refusal(run_orograph({"film"}), oro::test::usage, {"FLIGHT: is missing"});
    expect_refusal(film({"--frames", "6:9", "-q"}, out), oro::test::usage, {"--frames 6:9", "frames 1 to 5"});
    expect_refusal(film({"--above", "3"}, out), oro::test::usage, {"--above", "is for tracks"});
    expect_refusal(film({}, folder / "p.png"), oro::test::usage, {"--out", "is a picture"});
    write_bytes(path, "{}");
    expect_refusal(film({}, out), oro::test::failed, {"flight.json", "no orograph_path in it"});
    EXPECT_FALSE(fs::exists(out));
}

// A program that stands for ffmpeg: it writes down what it was asked for, and makes the file of it.
class FilmMovie : public Film {
  protected:
    const fs::path programs = oro::test::scratch_folder();
    const fs::path movie = folder / "film.mp4";

    void take(const std::string& script) const {
        write_bytes(programs / "ffmpeg", "#!/bin/sh\n" + script);
        fs::permissions(programs / "ffmpeg", fs::perms::owner_all);
    }
    [[nodiscard]] Circumstances with_it() const {
        Circumstances how;
        how.environment = {"PATH=" + programs.string() + ":/usr/bin:/bin"};
        return how;
    }
};

TEST_F(FilmMovie, IsMadeByFfmpeg) {
    take("for last; do :; done; echo \"$@\" >\"$last\"; ls >>\"$last\"\n");
    const Outcome filmed = film(joined(at_nine, {"-q"}), movie, with_it());
    ASSERT_EQ(filmed.exit_code, 0) << filmed.err;
    const std::string made = bytes_of(movie);
    for (const char* words : {"-framerate 4 ", "-i frame-%06d.png", "-frames:v 5 ", "frame-000005.png"})
        EXPECT_NE(made.find(words), std::string::npos) << words << " in " << made;
    EXPECT_EQ(names_in(folder), (Words{"film.mp4", "flight.json"}));
    expect_refusal(film(at_nine, movie, with_it()), oro::test::failed, {"film.mp4", "is there already"});
}

TEST_F(FilmMovie, ThatFailsLeavesItsFrames) {
    take("echo first >&2; echo no such codec >&2; exit 3\n");
    expect_refusal(film(joined(at_nine, {"-q"}), movie, with_it()), oro::test::failed,
                   {"ffmpeg", "exit code 3", "no such codec"});
    EXPECT_FALSE(fs::exists(movie));
    EXPECT_EQ(names_in(folder / "film.mp4.frames"), five);
    take("for last; do :; done; echo made >\"$last\"\n");
    const Outcome again = film({"--json", "-q"}, movie, with_it());
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(json::parse(again.out)["frames"]["kept"], 5);
    EXPECT_EQ(bytes_of(movie), "made\n");
}

TEST_F(FilmMovie, WithoutFfmpegIsRefusedBeforeAnythingIsDrawn) {
    Circumstances none;
    none.environment = {"PATH=" + programs.string()};
    expect_refusal(film(at_nine, movie, none), oro::test::usage, {"needs ffmpeg", "name a folder"});
    expect_refusal(film(joined(at_nine, {"--shard", "1/2"}), movie, none), oro::test::usage, {"--shard"});
    EXPECT_EQ(names_in(folder), Words{"flight.json"});
}

// Killed again and again, at any moment, a film of 24 frames comes to its end with the bytes of one go, and
// no other file is left.
TEST_F(Film, KilledAgainAndAgainItHasTheSameBytes) {
    const Words fast = joined(at_nine, {"--fps", "23", "-q"});
    const auto run = [&](const fs::path& to, const Circumstances& how = {}) {
        return run_orograph(joined({"film", path, bundled(), "--out", to, "--size", "64x48"}, fast), how);
    };
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(run(out).exit_code, 0);
    const double whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const fs::path broken = folder / "broken";
    int killed = 0;
    for (int i = 0; i < 40; ++i) {
        Circumstances how;
        how.signal = i % 4 == 3 ? SIGINT : SIGKILL;
        how.signal_after_s = whole_s * (0.3 + 0.1 * (i % 6));
        const Outcome outcome = run(broken, how);
        if (outcome.exit_code == 0) break;
        ASSERT_EQ(outcome.exit_code, 128 + how.signal) << outcome.err;
        ++killed;
    }
    EXPECT_GE(killed, 1);
    const Outcome last = run(broken);
    ASSERT_EQ(last.exit_code, 0) << last.err;
    std::printf("killed %d times\n", killed);
    EXPECT_EQ(names_in(broken).size(), 24U);
    EXPECT_TRUE(bytes_in(broken) == bytes_in(out));
}

}  // namespace
