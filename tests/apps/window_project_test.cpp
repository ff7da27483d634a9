// Projects of the window on a virtual display: saved, opened again, and what is none.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;

oro::test::Outcome on_display(const fs::path& folder, const std::string& script) {
    oro::test::Circumstances there;
    there.environment = {"WAYLAND_DISPLAY",
                         "SOURCE_DATE_EPOCH=1767225600",
                         "OROGRAPH_TRACE_WINDOW=1",
                         "OROGRAPH_VALIDATION=1",
                         "XDG_CONFIG_HOME=" + (folder / "config").string(),
                         "XDG_STATE_HOME=" + (folder / "state").string()};
    return oro::test::run_program(
        {OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + script, "sh", OROGRAPH_PROGRAM, folder}, there);
}

// Waits until the window's state has a pattern, and then for its window.
const std::string waits =
    "says() { for try in $(seq 300); do grep -q \"$1\" said.txt && return; sleep 0.1; done; "
    "echo \"no $1\"; cat said.txt; }; "
    "comes() { says 'first picture'; window=$(xdotool search --onlyvisible --pid $viewer | head -n 1); "
    "xdotool windowfocus --sync $window; sleep 1; }; ";

TEST(WindowProjects, AreSavedAndOpenedAgain) {
    const fs::path folder = oro::test::scratch_folder();
    fs::create_directory(folder / "data");
    fs::copy_file(oro::test::bundled_data() / "jacksboro.tif", folder / "data" / "jacksboro.tif");
    std::ofstream(folder / "line.geojson")
        << R"({"type": "Feature", "properties": {}, "geometry": {"type": "LineString",
              "coordinates": [[-84.3, 36.5], [-84.2, 36.6]]}})";
    const auto outcome = on_display(
        folder,
        waits +
            "\"$1\" view data/jacksboro.tif --style contours --overlay line.geojson --size 320x240 --at "
            "36.53,-84.35 --above 900 --heading 77 2>said.txt & viewer=$!; comes; "
            "xdotool key ctrl+s; sleep 1; xdotool key Return; says 'saved project.json'; "
            // Saved once, it is saved there again.
            "xdotool key ctrl+s; sleep 1; xdotool key ctrl+q; wait $viewer; "
            "\"$1\" view project.json 2>said.txt & viewer=$!; comes; says 'heading 77'; "
            "xdotool key p; says 'wrote '; xdotool key ctrl+q; wait $viewer; echo ended $?");
    EXPECT_TRUE(outcome.out.ends_with("ended 0\n")) << outcome.out << outcome.err;
    const json project = json::parse(oro::test::bytes_of(folder / "project.json"), nullptr, false);
    ASSERT_TRUE(project.is_object()) << outcome.out << outcome.err;
    EXPECT_EQ(project.value("orograph_project", 0), 1);
    const json view = project.value("view", json());
    EXPECT_EQ(view.value("style", ""), "contours");
    EXPECT_EQ(view["sources"], json::array({"data/jacksboro.tif"}));
    EXPECT_EQ(project["layers"]["overlay"], json::array({"line.geojson"}));
    // The window that was opened with it shows the same.
    const json shown =
        json::parse(oro::test::view_in(folder / "orograph-2026-01-01T000000Z.png"), nullptr, false);
    ASSERT_TRUE(shown.is_object()) << outcome.out;
    for (const char* const field :
         {"eye", "heading_deg", "pitch_deg", "fov_deg", "style", "overlay", "tau_px"})
        EXPECT_EQ(shown[field], view[field]) << field;
}

// A raster of codes colours the ground, in a style that shows it; the project holds it.
TEST(WindowProjects, HoldLandCoverThatWasOpened) {
    const fs::path folder = oro::test::scratch_folder();
    std::ofstream grid(folder / "cover.asc");
    grid << "ncols 20\nnrows 20\nxllcorner -84.5\nyllcorner 36.4\ncellsize 0.02\n";
    // Of WorldCover alone: no other table has all of them.
    for (int i = 0; i < 400; ++i) grid << std::array{10, 20, 30, 40, 60, 80, 95, 100}[i % 8] << ' ';
    grid.close();
    const auto made = oro::test::run_program({"gdal_translate", "-q", "-ot", "Byte", "-a_srs", "EPSG:4326",
                                              folder / "cover.asc", folder / "cover.tif"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    fs::copy_file(oro::test::bundled_data() / "jacksboro.tif", folder / "jacksboro.tif");
    const auto outcome = on_display(
        folder, waits +
                    "\"$1\" view jacksboro.tif --size 320x240 2>said.txt & viewer=$!; comes; "
                    "xdotool key ctrl+o; sleep 1; xdotool type cover.tif; xdotool key Return; "
                    "says 'cover.tif colours the ground'; xdotool key ctrl+s; sleep 1; xdotool key Return; "
                    "says 'saved project.json'; xdotool key ctrl+q; wait $viewer; echo ended $?");
    EXPECT_TRUE(outcome.out.ends_with("ended 0\n")) << outcome.out << outcome.err;
    const json project = json::parse(oro::test::bytes_of(folder / "project.json"), nullptr, false);
    ASSERT_TRUE(project.is_object()) << outcome.out << outcome.err;
    EXPECT_EQ(project["layers"]["landcover"], json::array({"cover.tif"}));
    EXPECT_EQ(project["view"]["landcover"]["files"], json::array({"cover.tif"}));
    EXPECT_EQ(project["view"].value("style", ""), "natural");
}

TEST(WindowProjects, WhatIsNoneEndsInOneLine) {
    const fs::path folder = oro::test::scratch_folder();
    std::ofstream(folder / "newer.json") << R"({"orograph_project": 9})";
    std::ofstream(folder / "damaged.json") << R"({"orograph_project": 1, "view": )";
    const auto outcome = on_display(
        folder, "\"$1\" view newer.json 2>&1; echo ended $?; \"$1\" view damaged.json 2>&1; echo ended $?");
    EXPECT_NE(outcome.out.find("newer.json: holds no project that can be read: its format is 9, this program "
                               "reads 1\nended 1\n"),
              std::string::npos)
        << outcome.out << outcome.err;
    EXPECT_NE(outcome.out.find("damaged.json: holds no project that can be read: "), std::string::npos)
        << outcome.out;
}

}  // namespace
