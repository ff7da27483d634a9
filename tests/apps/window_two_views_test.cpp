// Two views in the window on a virtual display: side by side, with a line, and one again.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/comb_mesh.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;

// Some columns of the screen's first rows, four bytes a pixel as they are in a dump (X11/XWDFile.h): words of
// four bytes, the highest first, of which word 0 is the header's size, 12 the bytes of a row, 19 the colours
// of 12 bytes that follow.
std::string columns_of(const std::string& dump, std::size_t from, std::size_t end, std::size_t row_count) {
    const auto word = [&](std::size_t i) {
        std::size_t value = 0;
        for (std::size_t byte = 0; byte < 4; ++byte)
            value = value << 8U | static_cast<unsigned char>(dump.at(4 * i + byte));
        return value;
    };
    const std::size_t first = word(0) + 12 * word(19), row_bytes = word(12);
    std::string bytes;
    for (std::size_t row = 0; row < row_count; ++row)
        bytes += dump.substr(first + row * row_bytes + 4 * from, 4 * (end - from));
    return bytes;
}

// Waits until nothing is prepared or loaded, and the screen has been the same for two seconds; then keeps it.
const std::string rests_words =
    "rests() { same=0; for try in $(seq 300); do sleep 0.2; now=$(cksum <\"$SCREEN_FILE\"); "
    "if [ \"$now\" = \"$last\" ] && ! grep '^state' said.txt | tail -n 1 | grep -Eq "
    "'loading|preparing|moving'; then same=$((same + 1)); else same=0; fi; last=$now; "
    "[ $same -lt 10 ] || break; done; cp \"$SCREEN_FILE\" $1.xwd; }; "
    "for try in $(seq 600); do grep -q 'full detail\\|first picture after' said.txt && break; sleep 0.1; "
    "done; "
    "window=$(xdotool search --onlyvisible --pid $viewer | head -n 1); ";
// In which nothing differs: each half shows the same, and a line parts one picture from itself.
TEST(WindowTwoViews, ThatAreTheSameShowTheSame) {
    const fs::path folder = oro::test::scratch_folder();
    oro::test::Circumstances there;
    there.environment = {"WAYLAND_DISPLAY", "OROGRAPH_TRACE_WINDOW=1", "OROGRAPH_VALIDATION=1",
                         "XDG_CONFIG_HOME=" + (folder / "config").string(),
                         "XDG_STATE_HOME=" + (folder / "state").string()};
    const std::string session =
        "\"$1\" view \"$3\" --style default --size 320x240 --at 36.53,-84.35 --above 900 2>said.txt & "
        "viewer=$!; " +
        rests_words +
        "xdotool windowfocus --sync $window; xdotool key Tab; rests one; "
        "xdotool key 2; for try in $(seq 300); do grep -q 'preparing the second' said.txt && break; sleep "
        "0.1; done; rests sides; "
        "xdotool key 2; sleep 1; rests line; xdotool key 2; sleep 1; rests again; "
        // A drag in the second half turns both.
        "xdotool key 2; sleep 2; rests sides; xdotool mousemove --window $window 240 150; sleep 0.3; "
        "xdotool mousedown 3; xdotool mousemove_relative 30 10; sleep 0.3; "
        "xdotool mousemove_relative 30 10; sleep 0.3; xdotool mouseup 3; "
        "xdotool mousemove --window $window 500 400; rests turned; "
        "xdotool key Tab; rests panels; xdotool key ctrl+q; wait $viewer; echo ended $?; cat said.txt";
    const auto outcome = oro::test::run_program({OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + session,
                                                 "sh", OROGRAPH_PROGRAM, folder, oro::test::bundled()},
                                                there);
    EXPECT_NE(outcome.out.find("ended 0\n"), std::string::npos) << outcome.out << outcome.err;
    const auto shown = [&](const char* name, std::size_t from, std::size_t end) {
        const std::string dump = oro::test::bytes_of(folder / name);
        return dump.size() > 640U * 480U * 4U ? columns_of(dump, from, end, 240) : "";
    };
    const std::string one = shown("one.xwd", 0, 320);
    ASSERT_FALSE(one.empty()) << outcome.out << outcome.err;
    EXPECT_FALSE(shown("sides.xwd", 0, 320) == one) << outcome.out;
    EXPECT_TRUE(shown("sides.xwd", 0, 160) == shown("sides.xwd", 160, 320)) << outcome.out;
    EXPECT_TRUE(shown("line.xwd", 0, 320) == one) << outcome.out;
    EXPECT_TRUE(shown("again.xwd", 0, 320) == one) << outcome.out;
    EXPECT_FALSE(shown("turned.xwd", 0, 160) == shown("sides.xwd", 0, 160)) << outcome.out;
    EXPECT_TRUE(shown("turned.xwd", 0, 160) == shown("turned.xwd", 160, 320)) << outcome.out;
    EXPECT_FALSE(shown("panels.xwd", 0, 320) == shown("turned.xwd", 0, 320)) << outcome.out;
}

// Where meshes are drawn by clusters, both views draw the same of them.
TEST(WindowTwoViews, ShowMeshesByTheSameClusters) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string region = (folder / "comb.oro").string();
    const auto baked = oro::test::bake_comb(folder / "comb.obj", region);
    ASSERT_EQ(baked.exit_code, 0) << baked.err;
    oro::test::Circumstances there;
    there.environment = {"WAYLAND_DISPLAY", "OROGRAPH_TRACE_WINDOW=1", "OROGRAPH_VALIDATION=1",
                         "XDG_CONFIG_HOME=" + (folder / "config").string(),
                         "XDG_STATE_HOME=" + (folder / "state").string()};
    const std::string session =
        "\"$1\" view \"$3\" --mesh clusters --style default --size 320x240 --at 36.6046,-84.19 --altitude "
        "640 "
        "--heading 90 --pitch 0 2>said.txt & viewer=$!; " +
        rests_words +
        "xdotool windowfocus --sync $window; xdotool key Tab; xdotool key 2; "
        "for try in $(seq 300); do grep -q 'preparing the second' said.txt && break; sleep 0.1; done; "
        "rests sides; xdotool keydown w; sleep 2; xdotool keyup w; sleep 1; rests nearer; "
        "xdotool key ctrl+q; wait $viewer; echo ended $?; cat said.txt";
    const auto outcome = oro::test::run_program(
        {OROGRAPH_ON_DISPLAY, "sh", "-c", "cd \"$2\"; " + session, "sh", OROGRAPH_PROGRAM, folder, region},
        there);
    EXPECT_NE(outcome.out.find("ended 0\n"), std::string::npos) << outcome.out << outcome.err;
    for (const char* name : {"sides.xwd", "nearer.xwd"}) {
        const std::string dump = oro::test::bytes_of(folder / name);
        ASSERT_GT(dump.size(), 640U * 480U * 4U) << outcome.out << outcome.err;
        EXPECT_TRUE(columns_of(dump, 0, 160, 240) == columns_of(dump, 160, 320, 240)) << name;
    }
}

}  // namespace
