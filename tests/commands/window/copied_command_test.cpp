// The lines that the window's panel of pictures copies: a shell that is given them draws the picture.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "apps/commands/commands.h"
#include "apps/output/picture_file.h"
#include "apps/window/pictures.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// A picture of a view with text in quotes, which a shell must not touch.
ShotOptions picture_in(const fs::path& folder) {
    const fs::path points = folder / "it's \"here\" $HOME.geojson";
    std::ofstream(points) << R"({"type": "FeatureCollection", "features": [{"type": "Feature",
        "properties": {"name": "The Miner's %d \\n $HOME `Rest`"},
        "geometry": {"type": "Point", "coordinates": [-84.25, 36.55]}}]})";
    ShotOptions options;
    options.region.paths = {(test::bundled_data() / "jacksboro.tif").string()};
    options.view.at = "36.6,-84.2";
    options.view.above_m = 400.0;
    options.view.heading_deg = 200.0;
    options.view.size = "160x120";
    options.view.names = {points.string()};
    options.view.time = "2026-06-21T10:00:00Z";
    options.out = (folder / "first.png").string();
    options.quiet = true;
    return options;
}

TEST(CopiedCommand, DrawsThePictureToTheByte) {
    const fs::path folder = test::scratch_folder();
    const ShotOptions first = picture_in(folder);
    const Result<void> drawn = run_shot(first);
    ASSERT_TRUE(drawn.ok()) << drawn.error().line();
    const auto text = read_view_json(first.out);
    ASSERT_TRUE(text.ok()) << text.error().line();
    const auto view = view_from_json(*text, first.out);
    ASSERT_TRUE(view.ok()) << view.error().line();
    const std::string lines =
        command_line_of(*view, {view->camera.width_px, view->camera.height_px, view->samples, ".png", {}});
    EXPECT_NE(command_line_of(*view, {64, 48, 1, ".png", {.kml = true, .geopose = true, .stac = true}})
                  .find("picture.png --kml --geopose --stac\n"),
              std::string::npos);
    // Of the program's line the shell is asked what words it is.
    const std::string script = "cd \"$1\"; orograph() { printf '%s\\n' \"$@\" >words.txt; }\n" + lines;
    std::ofstream(folder / "script.sh") << script;
    ASSERT_EQ(std::system(("sh '" + (folder / "script.sh").string() + "' '" + folder.string() + "'").c_str()),
              0);
    ASSERT_EQ(bytes_of(folder / "words.txt"), "shot\n--view\nview.json\n--out\npicture.png\n") << lines;
    ShotOptions again;
    again.view_file = (folder / "view.json").string();
    again.view_files = {again.view_file};
    again.out = (folder / "picture.png").string();
    again.quiet = true;
    const Result<void> redrawn = run_shot(again);
    ASSERT_TRUE(redrawn.ok()) << redrawn.error().line();
    EXPECT_TRUE(bytes_of(again.out) == bytes_of(first.out));
}

}  // namespace
}  // namespace oro
