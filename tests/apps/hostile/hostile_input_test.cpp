// Input that lies, interruptions, and streams that are not there: faults once found by feeding the program
// whatever is hostile.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::usage;
using oro::test::Words;
using oro::test::write_bytes;

class HostileInput : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();

    // shot of the bundled region into the folder.
    Outcome shoot(const Words& more, const std::string& out = "p.png") const {
        Words words{"shot", bundled(), "--size", "64x48", "-q", "--out", (folder / out).string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_orograph(words);
    }
};

TEST_F(HostileInput, FoldersInThePlaceOfFiles) {
    const fs::path view = folder / "view.json";
    fs::create_directory(view);
    expect_refusal(run_orograph({"shot", "--view", view, "--out", folder / "p.png"}), failed, {view});
    expect_refusal(shoot({"--style", view}), failed, {view});
    expect_refusal(shoot({"--style", folder}), failed, {folder});
    EXPECT_EQ(names_in(folder), Words{"view.json"});
}

TEST_F(HostileInput, NamesWithControlCharactersStayInTheLine) {
    const fs::path tile = folder / "N46\nE008\x1b[2J.hgt";
    write_bytes(tile, "");
    expect_refusal(run_orograph({"info", tile}), failed, {"N46?E008?[2J.hgt"});
    expect_refusal(shoot({"--style", "no\nsuch"}), usage, {"no?such"});
}

TEST_F(HostileInput, StandardOutputThatIsFullOrClosed) {
    for (const Words& words : {Words{"info", bundled()}, Words{"info", bundled(), "--json"}, Words{"doctor"},
                               Words{"--help"}, Words{"--version"}}) {
        SCOPED_TRACE(words.front());
        for (const char* where : {">/dev/full", ">&-"}) {
            Words shell{"sh", "-c", std::string("exec \"$@\" ") + where, "sh", OROGRAPH_PROGRAM};
            shell.insert(shell.end(), words.begin(), words.end());
            const bool full = std::string(where) == ">/dev/full";
            expect_refusal(run_program(shell), failed,
                           {"standard output", full ? "No space left on device" : "Bad file descriptor"});
        }
    }
}

// 141 is how shells tell of SIGPIPE: `orograph info | head` is nobody's mistake.
TEST_F(HostileInput, AReaderThatHasReadEnough) {
    for (const Words& words :
         {Words{"info", bundled()}, Words{"info", bundled(), "--json"}, Words{"shot", "--help"}}) {
        SCOPED_TRACE(words.front());
        Words shell{"bash", "-c", R"({ sleep 0.2; "$@"; } | true; echo "${PIPESTATUS[0]}")", "bash",
                    OROGRAPH_PROGRAM};
        shell.insert(shell.end(), words.begin(), words.end());
        const Outcome outcome = run_program(shell);
        EXPECT_EQ(outcome.out, "141\n");
        EXPECT_EQ(outcome.err, "");
    }
}

// A closed standard error must not become the picture's file, with messages in it.
TEST_F(HostileInput, ClosedStandardError) {
    const Outcome open = run_orograph(
        {"shot", bundled(), "--size", "64x48", "--time", "2026-11-21T09:00:00Z", "--out", folder / "a.png"});
    ASSERT_EQ(open.exit_code, 0) << open.err;
    const Outcome closed = run_program({"sh", "-c", "exec \"$@\" <&- >&- 2>&-", "sh", OROGRAPH_PROGRAM,
                                        "shot", bundled(), "--style", "default", "--size", "64x48", "--time",
                                        "2026-11-21T09:00:00Z", "--out", (folder / "b.png").string()});
    EXPECT_EQ(closed.exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "b.png"), bytes_of(folder / "a.png"));
}

// The signal comes while the picture, which would take minutes, is drawn.
TEST_F(HostileInput, AnInterruptedPictureLeavesNothing) {
    const std::vector<std::pair<std::string, std::string>> endings{
        {"INT", "p.png"},  {"TERM", "p.jpg"}, {"HUP", "p.tif"},  {"QUIT", "p.png"}, {"PIPE", "p.png"},
        {"ALRM", "p.jpg"}, {"USR1", "p.tif"}, {"XCPU", "p.png"}, {"KILL", "p.png"}};
    for (const auto& [signal, name] : endings) {
        SCOPED_TRACE(signal + " " + name);
        const fs::path there = oro::test::scratch_folder();
        write_bytes(there / name, "mine");
        write_bytes(there / "p.json", "mine, too");
        // Waits for the file that is written, with or without a name, then sends the signal to the program.
        const std::string session = R"(
                signal=$1 there=$2; shift 2
                env --default-signal "$@" & child=$!
                until ls -l /proc/$child/fd 2>/dev/null | grep -qF "$there"; do
                    kill -0 $child 2>/dev/null || exit 97
                    sleep 0.1
                done
                sleep 0.3; kill -s $signal $child; wait $child; exit $?)";
        const Outcome outcome = run_program({"bash", "-c", session, "bash", signal, there, OROGRAPH_PROGRAM,
                                             "shot", bundled(), "--style", "default", "--size", "30000x30000",
                                             "--overwrite", "-q", "--out", there / name});
        EXPECT_GT(outcome.exit_code, 128) << outcome.err;
        EXPECT_EQ(bytes_of(there / name), "mine");
        EXPECT_EQ(bytes_of(there / "p.json"), "mine, too");
        EXPECT_EQ(names_in(there).size(), 2U);
    }
}

TEST_F(HostileInput, OverwriteSparesWhatThePictureIsMadeFrom) {
    const fs::path terrain = folder / "terrain.tif", style = folder / "style.json";
    fs::copy_file(bundled(), terrain);
    fs::copy_file(oro::test::bundled_data() / "styles" / "haze.json", style);
    const std::string terrain_before = bytes_of(terrain), style_before = bytes_of(style);
    fs::create_symlink("terrain.tif", folder / "link.tif");
    const auto over = [&](const fs::path& out) {
        return run_orograph(
            {"shot", terrain, "--style", style, "--size", "64x48", "-q", "--overwrite", "--out", out});
    };
    expect_refusal(over(terrain), usage, {"--out", terrain});
    expect_refusal(over(folder / "link.tif"), usage, {"--out", terrain});
    // A view is in its picture: no file beside it is touched, whatever it is.
    EXPECT_EQ(over(folder / "style.png").exit_code, 0);
    EXPECT_EQ(bytes_of(terrain), terrain_before);
    EXPECT_EQ(bytes_of(style), style_before);
}

TEST_F(HostileInput, TimesThatNoCalendarHas) {
    for (const char* time : {"2026-02-30T00:00:00Z", "2025-02-29T00:00:00Z", "2026-11-21T09:00:60Z",
                             "2026-1-2T3:4:5Z", "2026-11-21T24:00:00Z"})
        expect_refusal(shoot({"--time", time}), usage, {"--time", time});
    EXPECT_EQ(names_in(folder), Words{});
}

TEST_F(HostileInput, CommandThatIsNone) {
    expect_refusal(run_orograph({"sho", bundled()}), usage, {"sho"});
}

TEST_F(HostileInput, ViewsWithNumbersThatWouldBeBent) {
    ASSERT_EQ(shoot({}).exit_code, 0);
    const auto view = nlohmann::json::parse(oro::test::view_in(folder / "p.png"));
    const auto with = [&](const char* name, const nlohmann::json& value) {
        auto changed = view;
        changed[name] = value;
        return changed;
    };
    const std::vector<std::pair<const char*, nlohmann::json>> bent{
        {"size_px", {4294967296 + 64, 48}},
        {"size_px", {64.5, 48}},
        {"size_px", {64}},
        {"samples", 4294967297},
        {"samples", 1.5},
        {"samples", true},
        {"time_utc_s", 1e300},
        {"time_utc_s", 18446744073709551615U},
        {"exaggeration", true},
        {"bbox", {-84.3, 36.5, -84.2, 200}},
        {"bbox", {-84.3, 36.7, -84.2, 36.5}},
        {"bbox", {-84.3, 36.5, -84.2, 36.6, 5}},
        {"height_unit", "parsec"},
        {"source_crs", "EPSG:999999"},
        {"source_vertical", "EPSG:2056"},
        {"sources", {bundled() + std::string("\0junk", 5)}},
        {"sources", bundled()},
        {"eye", {{"lat_deg", 36.6}, {"lon_deg", -84.2}}},
        {"style", nullptr}};
    for (const auto& [name, value] : bent) {
        SCOPED_TRACE(std::string(name) + " " + value.dump());
        const fs::path file = folder / "bent.json";
        write_bytes(file, with(name, value).dump());
        expect_refusal(run_orograph({"shot", "--view", file, "--out", folder / "q.png"}), failed,
                       {file, std::string(name) == "eye" ? "h_m" : name});
    }
}

TEST_F(HostileInput, StylesWithNumbersThatNoFloatHolds) {
    const auto style = nlohmann::json::parse(bytes_of(oro::test::bundled_data() / "styles" / "haze.json"));
    const auto refused = [&](const nlohmann::json& changed, const char* name) {
        const fs::path file = folder / "style.json";
        write_bytes(file, changed.dump());
        expect_refusal(shoot({"--style", file}), failed, {file, name});
    };
    auto high = style;
    high["tints"].back()["H_m"] = 1e300;
    refused(high, "H_m");
    auto sunny = style;
    sunny["sun"]["elevation_deg"] = 500;
    refused(sunny, "elevation_deg");
    auto clear = style;
    clear.erase("haze");
    refused(clear, "haze");
    refused(nlohmann::json::array(), "tints");
}

// Found before anything is read or drawn, not after.
TEST_F(HostileInput, OutIsCheckedFirst) {
    fs::create_directory(folder / "p.error.png");
    Words words{"shot", folder / "no-terrain.tif", "--overwrite", "--verify", "--out", folder / "p.png"};
    expect_refusal(run_orograph(words), failed, {folder / "p.error.png", "is a folder"});
}

}  // namespace
