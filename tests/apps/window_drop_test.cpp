// Files that are dropped on the window of a virtual display.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;

#ifdef OROGRAPH_XDND_DROP
// A line whose name has a space and letters of other alphabets, a picture that was taken elsewhere, what is
// no data, and other data than those that are shown.
TEST(WindowDrop, OpensWhatIsDropped) {
    const fs::path folder = oro::test::scratch_folder();
    fs::copy_file(oro::test::bundled_data() / "jacksboro.tif", folder / "jacksboro.tif");
    std::ofstream(folder / "way to \u0160ir\u00e1.geojson")
        << R"({"type": "LineString", "coordinates": [[-84.3, 36.5], [-84.2, 36.6]]})";
    std::ofstream(folder / "N36W085.hgt") << "no posts";
    oro::test::Circumstances there;
    there.environment = {"WAYLAND_DISPLAY", "OROGRAPH_TRACE_WINDOW=1",
                         "XDG_CONFIG_HOME=" + (folder / "config").string(),
                         "XDG_STATE_HOME=" + (folder / "state").string()};
    const std::string script =
        "says() { for try in $(seq 300); do grep -q \"$1\" said.txt && return; sleep 0.1; done; "
        "echo \"no $1\"; cat said.txt; };"
        "\"$1\" shot jacksboro.tif --at 36.53,-84.35 --above 900 --heading 77 --size 64x48 --quiet --out "
        "there.png; "
        "cp jacksboro.tif other.tif; "
        "\"$1\" view jacksboro.tif --size 320x240 2>said.txt & viewer=$!; drop=$3; "
        "drops() { \"$drop\" $window \"$PWD/$1\" || echo \"$1 was not taken\"; }; says 'first picture'; "
        "window=$(xdotool search --onlyvisible --pid $viewer | head -n 1); sleep 1; "
        "drops 'way to \u0160ir\u00e1.geojson'; says 'ir.*geojson'; drops there.png; says 'heading 77'; "
        "drops N36W085.hgt; says 'N36W085.hgt: '; drops other.tif; says 'other.tif'; "
        "xdotool windowfocus --sync $window key ctrl+q; wait $viewer; echo ended $?";
    const auto outcome = oro::test::run_program({OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + script,
                                                 "sh", OROGRAPH_PROGRAM, folder, OROGRAPH_XDND_DROP},
                                                there);
    EXPECT_EQ(outcome.out, "ended 0\n") << outcome.err;
}
#endif

}  // namespace
