// Films and maps that are drawn from the window itself, on a virtual display.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;

// A film of two keys 0.2 s apart at 25 frames a second, then a map of what is seen.
const std::string film_session =
    "says() { for try in $(seq 600); do grep -q \"$1\" said.txt && return; sleep 0.1; done; "
    "echo \"no $1\"; cat said.txt; }; "
    "clicks() { xdotool mousemove --window $window $1 $2; sleep 0.4; xdotool click 1; sleep 0.7; }; "
    "types() { xdotool key ctrl+a; xdotool type --delay 30 $1; xdotool key Return; sleep 0.3; }; "
    "\"$1\" view jacksboro.tif --style default --size 960x540 2>said.txt & viewer=$!; says 'full detail'; "
    "window=$(xdotool search --onlyvisible --pid $viewer | head -n 1); "
    "xdotool windowfocus --sync $window; sleep 1; "
    "clicks 511 27; clicks 150 95; types 0.2; clicks 70 95; xdotool mousemove --window $window 700 300 click "
    "4; "
    "sleep 2; clicks 70 95; clicks 70 195; says 'wrote .*film'; "
    "xdotool key Escape; sleep 0.5; clicks 618 27; sleep 1; clicks 528 400; says 'wrote .*map.tif'; "
    "xdotool key ctrl+q; wait $viewer; echo ended $?";

TEST(WindowFilms, AndMapsAreDrawnBesideTheWindow) {
    const fs::path folder = oro::test::scratch_folder();
    fs::copy_file(oro::test::bundled_data() / "jacksboro.tif", folder / "jacksboro.tif");
    oro::test::Circumstances there;
    there.environment = {"SCREEN_SIZE=960x540",
                         "WAYLAND_DISPLAY",
                         "PATH=/usr/local/sbin:/usr/sbin:/sbin:/usr/bin:/bin",
                         "OROGRAPH_TRACE_WINDOW=1",
                         "XDG_CONFIG_HOME=" + (folder / "config").string(),
                         "XDG_STATE_HOME=" + (folder / "state").string()};
    const auto outcome = oro::test::run_program(
        {OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + film_session, "sh", OROGRAPH_PROGRAM, folder},
        there);
    EXPECT_TRUE(outcome.out.ends_with("ended 0\n")) << outcome.out << outcome.err;
    const auto names = oro::test::names_in(folder);
    const auto with = [&](const std::string& ending) {
        const auto found =
            std::ranges::find_if(names, [&](const std::string& name) { return name.ends_with(ending); });
        return found == names.end() ? fs::path() : folder / *found;
    };
    EXPECT_FALSE(with("-film.json").empty()) << outcome.out;
    // Where ffmpeg is there the frames are in a folder beside the movie until it is whole.
    const bool is_movie = !with("-film.mp4").empty();
    const fs::path frames = is_movie ? with("-film.mp4.frames") : with("-film-frames");
    if (!is_movie) {
        ASSERT_FALSE(frames.empty()) << outcome.out;
        const auto drawn = oro::test::names_in(frames);
        EXPECT_EQ(std::ranges::count_if(drawn, [](const auto& name) { return name.ends_with(".png"); }), 6);
    }
    const fs::path map = with("-map.tif");
    ASSERT_FALSE(map.empty()) << outcome.out;
    // Nothing of it but a whole GeoTIFF, and its world file, have these names.
    EXPECT_GT(fs::file_size(map), 1000U);
    EXPECT_FALSE(with("-map.tfw").empty()) << outcome.out;
}

}  // namespace
