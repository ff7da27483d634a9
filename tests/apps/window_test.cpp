// The window on a virtual display: a scripted person flies, jumps, takes a picture and leaves.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "core/light/sun_position.h"
#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;

// What the window's state says of the eye.
struct State {
    double lat_deg{}, lon_deg{}, H_m{}, heading_deg{};
    bool read{false};
};

std::map<std::string, State> states_of(const std::string& session) {
    std::map<std::string, State> states;
    std::istringstream lines(session);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t colon = line.find(": "), bar = line.find("  |  ");
        if (colon == std::string::npos) continue;
        const std::string text = line.substr(bar == std::string::npos ? colon + 2 : bar + 5);
        State state;
        state.read = std::sscanf(text.c_str(), "%lf° %lf°  %lf m above sea level  heading %lf",
                                 &state.lat_deg, &state.lon_deg, &state.H_m, &state.heading_deg) == 4;
        states[line.substr(0, colon)] = state;
    }
    return states;
}

// What the viewer prints of a place that was clicked at.
struct Picked {
    double lat_deg{}, lon_deg{}, H_m{}, h_m{}, distance_m{}, bearing_deg{};
    int row{}, column{};
    std::string source;
};

std::optional<Picked> picked_of(const std::string& line) {
    Picked place;
    std::array<char, 100> source{};
    const int read = std::sscanf(line.c_str(),
                                 "%lf° %lf°  %lf m above sea level (%lf m above the ellipsoid)  %lf m away  "
                                 "bearing %lf°  cell in row %d, column %d "
                                 "of the posts  from %99s",
                                 &place.lat_deg, &place.lon_deg, &place.H_m, &place.h_m, &place.distance_m,
                                 &place.bearing_deg, &place.row, &place.column, source.data());
    if (read != 9) return std::nullopt;
    place.source = source.data();
    return place;
}

// The same ground is under the cursor before a drag and after it: half a pixel of 240 that show 45 degrees,
// on ground that is seen from 5 degrees up or more.
void expect_held(const std::string& before, const std::string& after) {
    const std::optional<Picked> held = picked_of(before), moved = picked_of(after);
    ASSERT_TRUE(held && moved) << before << "\n" << after;
    const double most_deg = held->distance_m * 0.5 * 0.00345 / 0.087 / 111'000.0;
    EXPECT_NEAR(held->lat_deg, moved->lat_deg, most_deg);
    EXPECT_NEAR(held->lon_deg, moved->lon_deg, most_deg / std::cos(held->lat_deg * std::numbers::pi / 180.0));
}

// Clicks at the sky, at what a drag holds before and after it, at the middle of what is looked at, and at the
// picture's middle: what they tell, and that they move nothing.
void expect_picked(const fs::path& folder, const json& destination) {
    std::istringstream lines(oro::test::bytes_of(folder / "picked.txt"));
    std::string sky, held, moved, aimed, ground, more;
    std::getline(lines, sky);
    std::getline(lines, held);
    std::getline(lines, moved);
    expect_held(held, moved);
    std::getline(lines, aimed);
    std::getline(lines, ground);
    EXPECT_FALSE(std::getline(lines, more)) << more;
    EXPECT_EQ(sky, "no terrain at this point: it shows sky, or a place without data");
    // Half a pixel beside it, 10 km away, on ground that is seen from 20 degrees up: some 50 m.
    const std::optional<Picked> aim = picked_of(aimed);
    ASSERT_TRUE(aim) << aimed;
    EXPECT_NEAR(aim->lat_deg, 36.5, 0.002);
    EXPECT_NEAR(aim->lon_deg, -84.3, 0.002);
    const std::optional<Picked> place = picked_of(ground);
    ASSERT_TRUE(place) << ground;
    ASSERT_TRUE(destination.is_object()) << destination;
    const auto said = [&](const char* name) { return destination.at(name).get<double>(); };
    // The same sight line: half of the last digit printed.
    EXPECT_NEAR(place->lat_deg, said("lat_deg"), 0.51e-6);
    EXPECT_NEAR(place->lon_deg, said("lon_deg"), 0.51e-6);
    EXPECT_NEAR(place->H_m, said("H_m"), 0.0051);
    EXPECT_NEAR(place->h_m, said("h_m"), 0.0051);
    EXPECT_NEAR(place->distance_m, said("seen_distance_m"), 0.0051);
    EXPECT_NEAR(place->bearing_deg, said("bearing_deg"), 0.0051);
    EXPECT_EQ(json({{"row", place->row}, {"column", place->column}}), destination.at("cell"));
    EXPECT_EQ(place->source, "jacksboro.tif");
    EXPECT_TRUE(destination.at("source").get<std::string>().ends_with("/jacksboro.tif")) << destination;
}

json object_of(const oro::test::Outcome& outcome) {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return json::parse(outcome.out, nullptr, false);
}

// The sun by time is that of the place where the picture was taken, not of where the flight began.
void expect_sun_of_there(const json& reported) {
    const json &sun = reported.at("sun"), &eye = reported.at("eye");
    const oro::SunPosition there_then = oro::sun_position(
        1782072000.0, {eye.at("lat_deg").get<double>(), eye.at("lon_deg").get<double>(), 0.0});
    EXPECT_EQ(sun.at("time"), "2026-06-21T16:00-04:00");
    EXPECT_NEAR(sun.at("azimuth_deg").get<double>(), there_then.azimuth_deg, 1e-6);
    EXPECT_NEAR(sun.at("elevation_deg").get<double>(), there_then.elevation_deg, 0.001);
}

void expect_same_eye(const State& one, const State& other) {
    EXPECT_EQ(one.lat_deg, other.lat_deg);
    EXPECT_EQ(one.lon_deg, other.lon_deg);
    EXPECT_EQ(one.H_m, other.H_m);
    EXPECT_EQ(one.heading_deg, other.heading_deg);
}

// A place without data moves nothing; one with data is looked at, then stood on; two steps back are where it
// began.
void expect_jumps(std::map<std::string, State>& at) {
    expect_same_eye(at["nowhere"], at["risen"]);
    EXPECT_GT(std::hypot(at["shown"].lat_deg - 36.5, at["shown"].lon_deg + 84.3), 0.01) << "from a side";
    EXPECT_NEAR(at["stood"].lat_deg, 36.5, 1e-6);
    EXPECT_NEAR(at["stood"].lon_deg, -84.3, 1e-6);
    expect_same_eye(at["unstood"], at["shown"]);
    expect_same_eye(at["returned"], at["risen"]);
    EXPECT_NEAR(at["jumped"].lat_deg, 36.5, 1e-6) << "Enter twice";
    EXPECT_NEAR(at["jumped"].lon_deg, -84.3, 1e-6);
}

TEST(Window, FliesJumpsTakesAPictureAndLeaves) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string data = (oro::test::bundled_data() / "jacksboro.tif").string();
    oro::test::Circumstances there;
    there.folder = folder;
    there.environment = {"SCREEN_SIZE=800x600", "OROGRAPH_VALIDATION=1", "SOURCE_DATE_EPOCH=1767225600"};
    const auto session =
        oro::test::run_program({OROGRAPH_ON_DISPLAY, OROGRAPH_WINDOW_SESSION, OROGRAPH_PROGRAM, data}, there);
    ASSERT_EQ(session.exit_code, 0) << session.out << session.err;
    auto at = states_of(session.out);
    for (const char* stop : {"start", "sky", "forward", "turned", "dragged", "risen", "nowhere", "shown",
                             "aimed", "stood", "unstood", "returned", "jumped", "sunk", "pictured", "picked"})
        ASSERT_TRUE(at[stop].read) << stop << " in\n" << session.out;

    EXPECT_NEAR(at["start"].lat_deg, 36.6, 1e-6);
    EXPECT_NEAR(at["start"].lon_deg, -84.2, 1e-6);
    EXPECT_EQ(at["sky"].lat_deg, at["start"].lat_deg);
    EXPECT_EQ(at["sky"].heading_deg, at["start"].heading_deg);
    // W goes where the eye looks: north and east in the proportion of heading 30, give or take the state's
    // digits.
    const double north = at["forward"].lat_deg - at["start"].lat_deg;
    const double east =
        (at["forward"].lon_deg - at["start"].lon_deg) * std::cos(36.6 * std::numbers::pi / 180.0);
    EXPECT_GT(north, 0.0);
    EXPECT_NEAR(std::atan2(east, north) * 180.0 / std::numbers::pi, 30.0, 1.0);
    EXPECT_GT(at["turned"].heading_deg, at["forward"].heading_deg);
    EXPECT_GT(at["risen"].H_m, at["turned"].H_m);
    expect_jumps(at);
    EXPECT_LT(at["sunk"].H_m, at["jumped"].H_m);

    // It never goes below the ground.
    const json ground =
        object_of(oro::test::run_orograph({"shot", data, "--at", "36.5,-84.3", "--above", "0", "--size",
                                           "16x16", "--out", folder / "ground.png", "--json", "-q"}));
    EXPECT_GE(at["sunk"].H_m, ground["eye"]["H_m"].get<double>() - 0.05);  // the state has one decimal

    fs::path picture;
    for (const std::string& name : oro::test::names_in(folder)) {
        if (name.rfind("orograph-", 0) == 0 && name.ends_with(".png")) picture = folder / name;
    }
    ASSERT_FALSE(picture.empty()) << session.out;
    EXPECT_EQ(picture.filename(), "orograph-2026-01-01T000000Z.png")
        << "SOURCE_DATE_EPOCH stands in for the clock";
    const json tags = object_of(oro::test::run_program({"exiftool", "-n", "-j", picture})).at(0);
    EXPECT_NEAR(tags["GPSLatitude"].get<double>(), 36.5, 1e-7);
    EXPECT_NEAR(tags["GPSLongitude"].get<double>(), -84.3, 1e-7);
    EXPECT_NEAR(tags["GPSAltitude"].get<double>(), at["pictured"].H_m, 0.06);
    EXPECT_EQ(tags["ImageWidth"], 400);
    EXPECT_EQ(tags["ImageHeight"], 200);
    const auto again =
        oro::test::run_orograph({"shot", "--view", picture, "--out", folder / "again.png", "--json", "-q"});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    expect_picked(folder, object_of(again).at("destination"));
    expect_sun_of_there(object_of(again));
    EXPECT_TRUE(oro::test::bytes_of(folder / "again.png") == oro::test::bytes_of(picture));
}

// No device of today draws a picture so wide in one piece.
TEST(Window, ASizeThatTheDeviceCannotDrawIsRefused) {
    const auto outcome = oro::test::run_program({OROGRAPH_ON_DISPLAY, OROGRAPH_PROGRAM, "view",
                                                 (oro::test::bundled_data() / "jacksboro.tif").string(), "-q",
                                                 "--size", "65500x200"});
    oro::test::expect_refusal(outcome, 2, {"--size", "65500x200", "pixels a side"});
}

// Measuring the levels of four tiles takes a while: something coarser is there before.
TEST(Window, ShowsACoarsePictureWhileLevelsAreMeasured) {
    const fs::path folder = oro::test::scratch_folder();
    std::string heights(std::size_t{2} * 1201 * 1201, '\0');
    for (std::size_t i = 0; i < heights.size(); i += 2) heights[i] = static_cast<char>((i / 200) % 4);
    for (const char* name : {"N10E020.hgt", "N10E021.hgt", "N11E020.hgt", "N11E021.hgt"})
        std::ofstream(folder / name, std::ios::binary) << heights;
    oro::test::Circumstances there;
    there.environment = {"WAYLAND_DISPLAY"};
    const std::string session =
        "\"$1\" view \"$2\" --style default --size 320x200 --at 11,21 --above 3000 2>said.txt & viewer=$!; "
        "for try in $(seq 600); do grep -q 'full detail' said.txt && break; sleep 0.1; done; "
        "kill $viewer; wait $viewer; cat said.txt";
    const auto outcome = oro::test::run_program(
        {OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + session, "sh", OROGRAPH_PROGRAM, folder}, there);
    const std::size_t first = outcome.out.find("orograph: first picture, coarse, after ");
    const std::size_t full = outcome.out.find("orograph: full detail after ");
    ASSERT_NE(first, std::string::npos) << outcome.out << outcome.err;
    ASSERT_NE(full, std::string::npos) << outcome.out << outcome.err;
    EXPECT_LT(first, full);
}

// Pixels of a screen that look like a colour, give or take a code. dump: an X window dump of 32 bits a pixel:
// 25 words of 4 bytes, the highest first, of which word 0 is the header's size, 4 and 5 the picture's, 7 the
// order of a pixel's bytes, 12 the bytes of a row, 19 the colours of 12 bytes that follow (X11/XWDFile.h).
std::size_t pixels_like(const std::string& dump, const std::array<int, 3>& rgb) {
    const auto byte = [&](std::size_t at) { return std::size_t{static_cast<unsigned char>(dump.at(at))}; };
    const auto word = [&](std::size_t i) {
        return byte(4 * i) << 24U | byte(4 * i + 1) << 16U | byte(4 * i + 2) << 8U | byte(4 * i + 3);
    };
    const std::size_t first = word(0) + 12 * word(19), row_bytes = word(12);
    const bool blue_first = word(7) == 0;
    std::size_t count = 0;
    for (std::size_t y = 0; y < word(5); ++y)
        for (std::size_t x = 0; x < word(4); ++x) {
            const std::size_t at = first + y * row_bytes + 4 * x;
            bool alike = true;
            for (std::size_t c = 0; c < 3; ++c)
                alike = alike &&
                        std::abs(static_cast<int>(byte(at + (blue_first ? 2 - c : c + 1))) - rgb[c]) <= 1;
            count += alike ? 1U : 0U;
        }
    return count;
}

// Whether two dumps of a screen have the same pixels in some of its rows.
bool has_same_rows(const std::string& one, const std::string& other, std::size_t from, std::size_t to) {
    const auto word = [&](std::size_t i) {
        std::size_t value = 0;
        for (std::size_t byte = 0; byte < 4; ++byte)
            value = value << 8U | static_cast<unsigned char>(one.at(4 * i + byte));
        return value;
    };
    const std::size_t first = word(0) + 12 * word(19), row_bytes = word(12);
    return one.size() == other.size() && one.compare(first + from * row_bytes, (to - from) * row_bytes, other,
                                                     first + from * row_bytes, (to - from) * row_bytes) == 0;
}

// What a window shows while no ground is there is the sheet that says so; the first picture is one of ground.
// A screen that is just being written is not judged.
TEST(Window, LoadingLooksLikeLoading) {
    const fs::path folder = oro::test::scratch_folder();
    oro::test::Circumstances there;
    there.environment = {"WAYLAND_DISPLAY"};
    const std::string session =
        "\"$1\" view \"$3\" --style default --size 320x240 2>said.txt & viewer=$!; "
        "for try in $(seq 3000); do cp \"$SCREEN_FILE\" now.xwd; grep -q 'first picture' said.txt && break; "
        "sleep 0.005; cp \"$SCREEN_FILE\" again.xwd; cmp -s now.xwd again.xwd || continue; "
        "cmp -s now.xwd last.xwd || cp now.xwd shot-$try.xwd; mv now.xwd last.xwd; sleep 0.02; done; "
        "sleep 0.3; cp \"$SCREEN_FILE\" end.xwd; kill $viewer; wait $viewer; cat said.txt";
    const auto outcome = oro::test::run_program({OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + session,
                                                 "sh", OROGRAPH_PROGRAM, folder, oro::test::bundled()},
                                                there);
    const std::string end = oro::test::bytes_of(folder / "end.xwd");
    ASSERT_GT(end.size(), 640U * 480U * 4U) << outcome.out << outcome.err;
    constexpr std::array<int, 3> paper{236, 236, 232}, panel{43, 46, 50}, black{0, 0, 0};
    EXPECT_LT(pixels_like(end, paper), 1000U) << "ground, after: " << outcome.out;
    std::size_t sheets = 0;
    for (const std::string& name : oro::test::names_in(folder)) {
        if (!name.starts_with("shot-")) continue;
        const std::string screen = oro::test::bytes_of(folder / name);
        // A bar may lie over it.
        const std::size_t of_sheet = pixels_like(screen, paper) + pixels_like(screen, panel);
        sheets += of_sheet > 60'000 ? 1U : 0U;
        // The picture itself may be there before its line is; what is told above and below it comes later.
        EXPECT_TRUE(of_sheet > 60'000 || pixels_like(screen, black) > 300'000 ||
                    has_same_rows(screen, end, 70, 200))
            << name;
    }
    EXPECT_GE(sheets, 1U) << outcome.out;
}

// A region that takes long to read has a window with a bar meanwhile, which its user may leave.
TEST(Window, IsLeftWhileItsRegionIsRead) {
    const auto himalaya = oro::test::real_data("himalaya");
    if (!himalaya) GTEST_SKIP() << "no real data";
    const fs::path folder = oro::test::scratch_folder();
    oro::test::Circumstances there;
    there.environment = {"WAYLAND_DISPLAY"};
    const std::string session =
        "\"$1\" view \"$3\" --style default --size 320x240 2>said.txt & viewer=$!; "
        "for try in $(seq 3000); do xdotool search --onlyvisible --name Orograph >/dev/null 2>&1 && break; "
        "sleep 0.005; done; sleep 0.1; xdotool search --name Orograph windowfocus key ctrl+q; wait $viewer; "
        "echo ended $?; cat said.txt";
    const auto outcome = oro::test::run_program(
        {OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + session, "sh", OROGRAPH_PROGRAM, folder, *himalaya},
        there);
    EXPECT_NE(outcome.out.find("ended 0"), std::string::npos) << outcome.out << outcome.err;
    EXPECT_EQ(outcome.out.find("error"), std::string::npos) << outcome.out;
}

// What another window covered, or what was put away, is there again without a key being touched; so it is
// after the window has become larger.
TEST(Window, IsShownAgainWhereItWasLost) {
    const fs::path folder = oro::test::scratch_folder();
    oro::test::Circumstances there;
    there.environment = {"WAYLAND_DISPLAY"};
    const std::string session =
        "\"$1\" view \"$3\" --style default --size 320x240 2>said.txt & viewer=$!; "
        "for try in $(seq 600); do grep -q 'full detail\\|first picture after' said.txt && break; sleep 0.1; "
        "done; "
        "window=$(xdotool search --onlyvisible --pid $viewer | head -n 1); "
        "sleep 1; cp \"$SCREEN_FILE\" before.xwd; "
        "xdotool windowunmap --sync $window; sleep 0.5; cp \"$SCREEN_FILE\" gone.xwd; "
        "xdotool windowmap --sync $window; sleep 1; cp \"$SCREEN_FILE\" after.xwd; "
        "xdotool windowsize --sync $window 400 300; sleep 2; cp \"$SCREEN_FILE\" larger.xwd; "
        "kill $viewer; wait $viewer; cat said.txt";
    const auto outcome = oro::test::run_program({OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + session,
                                                 "sh", OROGRAPH_PROGRAM, folder, oro::test::bundled()},
                                                there);
    const std::string before = oro::test::bytes_of(folder / "before.xwd");
    ASSERT_GT(before.size(), 640U * 480U * 4U) << outcome.out << outcome.err;
    constexpr std::array<int, 3> black{0, 0, 0};
    constexpr std::size_t screen_px = 640 * 480;
    EXPECT_LT(pixels_like(before, black), screen_px - 320 * 240 + 100) << outcome.out;
    EXPECT_EQ(pixels_like(oro::test::bytes_of(folder / "gone.xwd"), black), screen_px);
    EXPECT_TRUE(oro::test::bytes_of(folder / "after.xwd") == before);
    EXPECT_LT(pixels_like(oro::test::bytes_of(folder / "larger.xwd"), black), screen_px - 400 * 300 + 200);
}

// Rows of red, green and blue of the screen's upper left corner.
std::vector<png_byte> corner_of(const std::string& dump, std::size_t width, std::size_t height) {
    const auto word = [&](std::size_t i) {
        std::size_t value = 0;
        for (std::size_t byte = 0; byte < 4; ++byte)
            value = value << 8U | static_cast<unsigned char>(dump.at(4 * i + byte));
        return value;
    };
    const std::size_t first = word(0) + 12 * word(19), row_bytes = word(12);
    const bool blue_first = word(7) == 0;
    std::vector<png_byte> rgb;
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
            for (std::size_t c = 0; c < 3; ++c)
                rgb.push_back(static_cast<png_byte>(
                    dump.at(first + y * row_bytes + 4 * x + (blue_first ? 2 - c : c + 1))));
    return rgb;
}

// Tab takes away all that lies over it; what is left has come to the screen without being changed or scaled.
TEST(Window, WithoutItsPanelsShowsThePictureThatItWrites) {
    const fs::path folder = oro::test::scratch_folder();
    oro::test::Circumstances there;
    there.environment = {"WAYLAND_DISPLAY", "SOURCE_DATE_EPOCH=1767225600", "OROGRAPH_VALIDATION=1"};
    const std::string session =
        "\"$1\" view \"$3\" --style default --size 320x240 --at 36.53,-84.35 --above 900 --kml --geopose "
        "--stac 2>said.txt & "
        "viewer=$!; "
        "for try in $(seq 600); do grep -q 'full detail\\|first picture after' said.txt && break; sleep 0.1; "
        "done; "
        "window=$(xdotool search --onlyvisible --pid $viewer | head -n 1); "
        "xdotool windowfocus --sync $window; sleep 1; cp \"$SCREEN_FILE\" with.xwd; "
        "xdotool key Tab; sleep 1; cp \"$SCREEN_FILE\" without.xwd; xdotool key p; "
        "for try in $(seq 300); do grep -q 'wrote ' said.txt && break; sleep 0.1; done; "
        "xdotool key ctrl+q; wait $viewer; cat said.txt";
    const auto outcome = oro::test::run_program({OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + session,
                                                 "sh", OROGRAPH_PROGRAM, folder, oro::test::bundled()},
                                                there);
    const std::string with = oro::test::bytes_of(folder / "with.xwd");
    const std::string without = oro::test::bytes_of(folder / "without.xwd");
    ASSERT_GT(without.size(), 640U * 480U * 4U) << outcome.out << outcome.err;
    const oro::test::Pixels picture = oro::test::pixels_of(folder / "orograph-2026-01-01T000000Z.png");
    ASSERT_EQ(picture.width, 320U) << outcome.out;
    ASSERT_EQ(picture.height, 240U);
    EXPECT_TRUE(corner_of(without, 320, 240) == picture.rgb);
    EXPECT_FALSE(corner_of(with, 320, 240) == picture.rgb) << "nothing lay over it";
    // What its pictures have beside them is what shot writes of them.
    for (const std::string ending : {".kml", ".geopose.json", ".stac.json"})
        fs::rename(folder / ("orograph-2026-01-01T000000Z" + ending), folder / ("window" + ending));
    const auto again = oro::test::run_orograph(
        {"shot", "--view", folder / "orograph-2026-01-01T000000Z.png", "--kml", "--geopose", "--stac", "-q"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    for (const std::string ending : {".kml", ".geopose.json", ".stac.json"})
        EXPECT_EQ(oro::test::bytes_of(folder / ("window" + ending)),
                  oro::test::bytes_of(folder / ("orograph-2026-01-01T000000Z" + ending)));
}

// In the window, in its corner; of a picture by P, below it.
TEST(Window, FramesThatAreExplainedHaveALegend) {
    const fs::path folder = oro::test::scratch_folder();
    oro::test::Circumstances there;
    there.environment = {"WAYLAND_DISPLAY", "SOURCE_DATE_EPOCH=1767225600"};
    const std::string session =
        "\"$1\" view \"$3\" --style default --size 320x240 --at 36.53,-84.35 --above 900 --show overdraw "
        "2>said.txt & viewer=$!; "
        "for try in $(seq 600); do grep -q 'first picture' said.txt && break; sleep 0.1; done; "
        "sleep 1; cp \"$SCREEN_FILE\" screen.xwd; "
        "window=$(xdotool search --onlyvisible --pid $viewer | head -n 1); "
        "xdotool windowfocus --sync $window; xdotool key p; "
        "for try in $(seq 300); do grep -q 'wrote ' said.txt && break; sleep 0.1; done; "
        "kill $viewer; wait $viewer; cat said.txt";
    const auto outcome = oro::test::run_program({OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + session,
                                                 "sh", OROGRAPH_PROGRAM, folder, oro::test::bundled()},
                                                there);
    const std::string screen = oro::test::bytes_of(folder / "screen.xwd");
    ASSERT_GT(screen.size(), 640U * 480U * 4U) << outcome.out << outcome.err;
    EXPECT_GT(pixels_like(screen, {250, 248, 242}), 2000U) << "paper";
    // Squares of 12 px, of one triangle in a pixel, of two, ... and of more than 16.
    const std::array<std::array<int, 3>, 6> squares{
        {{46, 77, 133}, {51, 143, 153}, {115, 186, 107}, {237, 209, 84}, {237, 133, 51}, {199, 46, 56}}};
    for (const auto& square : squares) EXPECT_GE(pixels_like(screen, square), 144U) << square[0];
    const fs::path picture = folder / "orograph-2026-01-01T000000Z.png";
    ASSERT_TRUE(fs::exists(picture)) << outcome.out;
    const json view = json::parse(oro::test::view_in(picture), nullptr, false);
    EXPECT_EQ(view.value("show", ""), "overdraw");
    EXPECT_GT(view.value("legend_px", 0), 100) << view;
}

// As large as the last window was, with the panels that were open, where no option says it.
TEST(Window, IsAsItWasLeft) {
    const fs::path folder = oro::test::scratch_folder(), settings = folder / "config/orograph/window.json";
    fs::create_directories(settings.parent_path());
    std::ofstream(settings) << R"({"width_px": 300, "height_px": 200, "panels": {"statistics": true}})";
    oro::test::Circumstances there;
    there.environment = {"WAYLAND_DISPLAY", "XDG_CONFIG_HOME=" + (folder / "config").string()};
    const std::string session =
        "\"$1\" view \"$3\" --style default --at 36.53,-84.35 --above 900 2>said.txt & viewer=$!; "
        "for try in $(seq 600); do grep -q 'first picture' said.txt && break; sleep 0.1; done; "
        "window=$(xdotool search --onlyvisible --pid $viewer | head -n 1); "
        "xdotool getwindowgeometry $window; xdotool windowsize --sync $window 310 220; sleep 1; "
        "xdotool windowfocus --sync $window; xdotool key ctrl+q; wait $viewer; cat said.txt";
    const auto outcome = oro::test::run_program({OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + session,
                                                 "sh", OROGRAPH_PROGRAM, folder, oro::test::bundled()},
                                                there);
    EXPECT_NE(outcome.out.find("Geometry: 300x200"), std::string::npos) << outcome.out << outcome.err;
    const json kept = json::parse(oro::test::bytes_of(settings), nullptr, false);
    EXPECT_EQ(kept.value("width_px", 0), 310) << kept;
    EXPECT_EQ(kept.value("height_px", 0), 220);
    EXPECT_TRUE(kept.at("panels").value("statistics", false));
    EXPECT_FALSE(kept.at("panels").value("layers", true));
}

TEST(Window, SaysWhatChangedSinceThePicture) {
    const fs::path folder = oro::test::scratch_folder();
    const auto write_tile = [&](char height) {
        std::ofstream(folder / "N10E020.hgt", std::ios::binary)
            << std::string(std::size_t{2} * 1201 * 1201, height);
    };
    write_tile(1);
    const fs::path picture = folder / "p.png";
    const auto drawn =
        oro::test::run_orograph({"shot", folder / "N10E020.hgt", "--at", "10.5,20.5", "--above", "900",
                                 "--size", "160x90", "--out", picture, "-q"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    write_tile(2);
    const std::string session =
        "\"$1\" view --view p.png 2>said.txt & viewer=$!; "
        "for try in $(seq 600); do grep -q 'first picture' said.txt && break; sleep 0.1; done; "
        "kill $viewer; wait $viewer; cat said.txt";
    oro::test::Circumstances there;
    there.environment = {"WAYLAND_DISPLAY"};
    const auto outcome = oro::test::run_program(
        {OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + session, "sh", OROGRAPH_PROGRAM, folder}, there);
    EXPECT_NE(
        outcome.out.find("orograph: note: N10E020.hgt: its heights are others than those that p.png was "
                         "drawn from\n"),
        std::string::npos)
        << outcome.out << outcome.err;
}

}  // namespace
