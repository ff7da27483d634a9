// The panorama that a window draws of a place, against the command panorama.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "apps/commands/commands.h"
#include "apps/window/panorama_from_place.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

constexpr const char* places =
    R"({"type": "FeatureCollection", "features": [
  {"type": "Feature", "properties": {"name": "North"},
   "geometry": {"type": "Point", "coordinates": [-84.21, 36.58]}},
  {"type": "Feature", "properties": {"name": "East"},
   "geometry": {"type": "Point", "coordinates": [-84.12, 36.52]}}]})";

RegionOptions bundled_tile() {
    RegionOptions region;
    region.paths = {(test::bundled_data() / "jacksboro.tif").string()};
    return region;
}

TEST(PanoramaFromPlace, IsTheCommands) {
    setenv("SOURCE_DATE_EPOCH", "1767225600", 1);
    const fs::path folder = test::scratch_folder();
    const std::string names = (folder / "places.geojson").string();
    std::ofstream(names) << places;
    // What the window shows: from elsewhere, without refraction.
    ViewOptions shown_options;
    shown_options.at = "36.6,-84.3";
    shown_options.above_m = 500.0;
    shown_options.names = {names};
    shown_options.size = "320x200";
    View shown;
    Region region;
    const auto opened = open_view(
        "", shown_options, bundled_tile(), [](double, const std::string&) {}, shown, region);
    ASSERT_TRUE(opened.ok()) << opened.error().line();
    const auto cuts = cut_regions(region);
    ASSERT_TRUE(cuts.ok());
    const PanoramaChoice choice{{36.512345678, -84.212345678}, 40.0, 720, true};
    const auto view = panorama_view(shown, choice, region);
    ASSERT_TRUE(view.ok()) << view.error().line();
    AskedFrame asked;
    asked.width_px = choice.width_px;
    double last_share = 0.0;
    const auto drawn = drawn_panorama(*view, asked, region, *cuts, {{}, true, {}},
                                      [&](double share, const std::string&) { last_share = share; });
    ASSERT_TRUE(drawn.ok()) << drawn.error().line();
    EXPECT_EQ(last_share, 1.0);
    EXPECT_EQ(drawn->rgb.size(),
              std::size_t{3} * 720 * static_cast<std::size_t>(drawn->laid.sheet.height_px));
    const std::string own = (folder / "own.png").string(), by_command = (folder / "command.png").string();
    const Result<void> written = write_drawn_panorama(own, *drawn, region);
    ASSERT_TRUE(written.ok()) << written.error().line();

    PanoramaOptions options;
    options.region = bundled_tile();
    options.view.at = "36.512345678,-84.212345678";
    options.view.above_m = choice.above_m;
    options.view.names = {names};
    options.width_px = choice.width_px;
    options.out = by_command;
    options.quiet = true;
    const Result<void> ran = run_panorama(options);
    ASSERT_TRUE(ran.ok()) << ran.error().line();
    const auto one = read_view(own), other = read_view(by_command);
    ASSERT_TRUE(one.ok() && other.ok());
    ASSERT_TRUE(one->fingerprints && other->fingerprints);
    EXPECT_NE(one->fingerprints->pixels, 0U);
    EXPECT_EQ(one->fingerprints->pixels, other->fingerprints->pixels);
    // All else that they tell is the same, too.
    EXPECT_EQ(view_to_json(*one, true), view_to_json(*other, true));
    unsetenv("SOURCE_DATE_EPOCH");
}

TEST(PanoramaFromPlace, StopsWhenItIsAsked) {
    ViewOptions options;
    options.at = "36.5,-84.2";
    options.above_m = 2.0;
    View shown;
    Region region;
    ASSERT_TRUE(open_view(
                    "", options, bundled_tile(), [](double, const std::string&) {}, shown, region)
                    .ok());
    const auto cuts = cut_regions(region);
    ASSERT_TRUE(cuts.ok());
    const auto view = panorama_view(shown, {{36.5, -84.2}, 2.0, 720, true}, region);
    ASSERT_TRUE(view.ok());
    std::stop_source stop;
    stop.request_stop();
    EXPECT_FALSE(drawn_panorama(*view, {}, region, *cuts, {{}, true, stop.get_token()},
                                [](double, const std::string&) {})
                     .ok());
    EXPECT_EQ(panorama_view(shown, {{0.0, 0.0}, 2.0, 720, true}, region).error().kind, ErrorKind::no_data);
}

}  // namespace
}  // namespace oro
