// What goes wrong in the outside world: one clear line, the exit code, nothing lost.
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <string_view>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::names_in;
using oro::test::no_data;
using oro::test::no_device;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::usage;
using oro::test::Words;
using oro::test::write_bytes;

constexpr std::size_t srtm3_bytes = 2U * 1201 * 1201;

class BadInput : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();

    fs::path file(const std::string& name, const std::string& bytes) const {
        write_bytes(folder / name, bytes);
        return folder / name;
    }
    // shot of a path, which must leave nothing behind.
    Outcome shoot(const std::string& path, const Words& more = {},
                  const Circumstances& circumstances = {}) const {
        const fs::path out = oro::test::scratch_folder();
        Words words{"shot", path, "--size", "64x48", "--out", (out / "p.png").string(), "-q"};
        words.insert(words.end(), more.begin(), more.end());
        Outcome outcome = run_orograph(words, circumstances);
        EXPECT_EQ(names_in(out), Words{}) << "left behind";
        return outcome;
    }
};

TEST_F(BadInput, TruncatedHgt) {
    const auto tile = file("N46E008.hgt", std::string(srtm3_bytes - 5000, '\1'));
    expect_refusal(shoot(tile), failed, {tile, std::to_string(srtm3_bytes - 5000)});
    expect_refusal(run_orograph({"info", tile}), failed, {tile});
}

TEST_F(BadInput, EmptyHgt) {
    const auto tile = file("N46E008.hgt", "");
    expect_refusal(shoot(tile), failed, {tile, "empty"});
}

TEST_F(BadInput, OddSizedHgt) {
    const auto tile = file("N46E008.hgt", std::string(srtm3_bytes + 1, '\1'));
    expect_refusal(shoot(tile), failed, {tile, std::to_string(srtm3_bytes + 1)});
}

TEST_F(BadInput, MisnamedHgt) {
    const std::string bytes(srtm3_bytes, '\1');
    const auto nameless = file("mountains.hgt", bytes);
    expect_refusal(shoot(nameless), failed, {nameless});
    const auto beyond = file("N95E008.hgt", bytes);
    expect_refusal(shoot(beyond), failed, {beyond});
}

TEST_F(BadInput, FolderWithoutData) {
    file("notes.txt", "no terrain here\n");
    expect_refusal(shoot(folder), no_data, {folder});
}

TEST_F(BadInput, PathThatIsNotThere) {
    expect_refusal(shoot(folder / "nothing.tif"), failed, {"nothing.tif"});
}

TEST_F(BadInput, UnreadableFile) {
    ASSERT_TRUE(oro::test::permissions_bind()) << "this process cannot be made to heed permissions";
    Circumstances bound;
    bound.bound_by_permissions = true;
    const auto tile = file("N46E008.hgt", std::string(srtm3_bytes, '\1'));
    const auto picture = folder / "locked.tif";
    fs::copy_file(bundled(), picture);
    for (const fs::path& locked : {fs::path(tile), picture}) {
        fs::permissions(locked, fs::perms::none);
        expect_refusal(shoot(locked, {}, bound), failed, {locked, "ermission"});
    }
}

TEST_F(BadInput, TextFileCalledTif) {
    const auto text = file("notes.tif", "This is a shopping list.\nBread\nCheese\n");
    expect_refusal(shoot(text), failed, {text});
}

TEST_F(BadInput, TruncatedTif) {
    const auto half = file("half.tif", bytes_of(bundled()).substr(0, 60000));
    expect_refusal(shoot(half), failed, {half});
}

TEST_F(BadInput, UnknownCrs) {
    const auto grid =
        file("grid.asc", "ncols 3\nnrows 2\nxllcorner 8\nyllcorner 46\ncellsize 0.5\n1 2 3\n4 5 6\n");
    expect_refusal(shoot(grid), failed, {grid, "coordinate reference system"});
}

TEST_F(BadInput, BoundingBoxes) {
    for (const char* box : {"-84.3,36.7,-84.2,36.5", "nan,36.5,-84.2,36.6", "-84.3,-inf,-84.2,36.6",
                            "-84.3,36.5,-84.2", "-84.3,36.5,-84.2,36.6,7", "-84.3,36.5,-84.3,36.6",
                            "-84.3,36.5,-84.2,96", "west,south,east,north", ""})
        expect_refusal(shoot(bundled(), {"--bbox", box}), usage, {"box"});
    for (const char* tile : {"N46", "N46E008:", "X46E008", "N96E008"})
        expect_refusal(shoot(bundled(), {"--tile", tile}), usage, {tile});
}

TEST_F(BadInput, NoDataInTheRegion) {
    expect_refusal(shoot(bundled(), {"--bbox", "7,46,8,47"}), no_data, {});
    expect_refusal(shoot(bundled(), {"--tile", "S10E100"}), no_data, {});
    expect_refusal(shoot(bundled(), {"--at", "46.5,8.0", "--above", "100"}), no_data, {"46.5"});
}

TEST_F(BadInput, Sizes) {
    for (const char* size :
         {"0x0", "0x48", "64x0", "-64x48", "1000000x1000000", "64", "64x", "axb", "64x48x3", "1e2x48"})
        expect_refusal(
            run_orograph({"shot", bundled(), "--size", size, "--out", (folder / "p.png").string()}), usage,
            {"size", size});
    EXPECT_EQ(names_in(folder), Words{});
}

TEST_F(BadInput, ViewsThatMeanNothing) {
    const std::vector<Words> views{{"--at", "100.5,46.5"},
                                   {"--at", "the Eiger"},
                                   {"--at", "36.6,-84.2", "--above", "nan"},
                                   {"--at", "36.6,-84.2", "--above", "3", "--altitude", "3"},
                                   {"--at", "36.6,-84.2", "--fov", "0"},
                                   {"--at", "36.6,-84.2", "--fov", "180"},
                                   {"--at", "36.6,-84.2", "--pitch", "91"},
                                   {"--at", "36.6,-84.2", "--heading", "north"},
                                   {"--sun", "315"},
                                   {"--sun", "315,100"},
                                   {"--exaggeration", "0"},
                                   {"--exaggeration", "-1"},
                                   {"--samples", "0"},
                                   {"--samples", "1000000"},
                                   {"--style", "no-such-style"},
                                   {"--time", "yesterday"}};
    for (const Words& view : views) {
        SCOPED_TRACE(view[view.size() - 2] + " " + view.back());
        expect_refusal(shoot(bundled(), view), usage, {});
    }
    expect_refusal(shoot(bundled(), {"--at", "100.5,46.5"}), usage, {"swapped"});
}

TEST_F(BadInput, CommandLines) {
    EXPECT_EQ(run_orograph({}).exit_code, usage);
    expect_refusal(run_orograph({"fly"}), usage, {});
    expect_refusal(run_orograph({"shot", "--nonsense"}), usage, {});
    expect_refusal(run_orograph({"shot", "--out", (folder / "p.png").string()}), usage, {"PATH"});
    expect_refusal(run_orograph({"shot", bundled()}), usage, {"--out"});
    expect_refusal(run_orograph({"shot", bundled(), "--out", (folder / "p.bmp").string()}), usage, {".bmp"});
    expect_refusal(run_orograph({"info"}), usage, {"PATH"});
    EXPECT_EQ(names_in(folder), Words{});
}

TEST_F(BadInput, NamesOfStyles) {
    expect_refusal(shoot(bundled(), {"--style", "pretty"}), usage,
                   {"--style pretty: no style is called 'pretty'; there is: natural"});
}

TEST_F(BadInput, Styles) {
    const auto no_json = file("a.json", "{ \"name\": ");
    expect_refusal(shoot(bundled(), {"--style", "plain", "--visibility", "50"}), usage,
                   {"--visibility: is for styles with air; plain has none"});
    expect_refusal(shoot(bundled(), {"--style", "natural", "--visibility", "300"}), usage,
                   {"--visibility 300: must be between 0.05 and 288"});
    expect_refusal(shoot(bundled(), {"--style", "default", "--sea", "low"}), usage,
                   {"--sea low: is for styles with water; haze has none"});
    expect_refusal(shoot(bundled(), {"--style", "plain", "--sea", "voids"}), usage,
                   {"--sea voids: is for styles with water; plain has none"});
    expect_refusal(shoot(bundled(), {"--style", "default", "--rim", "none"}), usage,
                   {"--rim none: is for styles with voids; haze has none"});
    expect_refusal(shoot(bundled(), {"--style", no_json}), failed, {no_json});
    const auto colourless = file("b.json", R"({"name": "b", "tints": [{"H_m": 0, "colour": "green"}]})");
    expect_refusal(shoot(bundled(), {"--style", colourless}), failed, {colourless, "green"});
    const auto table = file("c.txt", "0 white\n50% beige\n");
    expect_refusal(shoot(bundled(), {"--style", table}), failed,
                   {table.string() + ", line 2: no colour is called 'beige'"});
    expect_refusal(shoot(bundled(), {"--style", "no-such.txt"}), failed, {"no-such.txt"});
}

TEST_F(BadInput, ViewFiles) {
    const auto text = file("view.json", "not a view");
    const auto other = file("other.json", "{\"a\": 1}");
    const auto picture = file("view.png", bytes_of(bundled()));
    for (const fs::path& view : {text, other, picture, folder / "nothing.png"}) {
        const fs::path out = oro::test::scratch_folder();
        expect_refusal(run_orograph({"shot", "--view", view, "--out", (out / "p.png").string()}), failed,
                       {view});
        EXPECT_EQ(names_in(out), Words{});
    }
}

TEST_F(BadInput, OutThatCannotBeWritten) {
    const auto shoot_to = [](const fs::path& out, const Circumstances& circumstances) {
        return run_orograph({"shot", bundled(), "--size", "64x48", "--out", out, "-q"}, circumstances);
    };
    expect_refusal(shoot_to(folder / "nowhere" / "p.png", {}), failed, {folder / "nowhere"});
    fs::create_directory(folder / "folder.png");
    expect_refusal(shoot_to(folder / "folder.png", {}), failed, {folder / "folder.png"});
    EXPECT_EQ(names_in(folder), Words{"folder.png"});

    ASSERT_TRUE(oro::test::permissions_bind()) << "this process cannot be made to heed permissions";
    Circumstances bound;
    bound.bound_by_permissions = true;
    fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
    expect_refusal(shoot_to(folder / "p.png", bound), failed, {folder, "ermission"});
    EXPECT_EQ(names_in(folder), Words{"folder.png"});
    fs::permissions(folder, fs::perms::owner_all);
}

TEST_F(BadInput, ExistingFileStaysWithoutOverwrite) {
    for (const char* name : {"p.png", "p.error.png"}) {
        const fs::path there = oro::test::scratch_folder();
        write_bytes(there / name, "mine");
        const Outcome outcome =
            run_orograph({"shot", bundled(), "--size", "64x48", "--out", there / "p.png", "-q", "--verify"});
        expect_refusal(outcome, failed, {there / name, "--overwrite"});
        EXPECT_EQ(bytes_of(there / name), "mine");
        EXPECT_EQ(names_in(there), Words{name});
    }
}

// A file system of 16 kB, seen by the program alone: writing fails half way. The files that were there stay.
TEST_F(BadInput, FullDisk) {
    const std::string session = R"(
        disk=$1 kept=$2 name=$3; shift 3
        mount -t tmpfs -o size=16k none "$disk" 2>/dev/null || exit 99
        printf mine >"$disk/$name"; printf 'mine, too' >"$disk/p.json"
        "$@" --out "$disk/$name" --overwrite -q; code=$?
        cp -a "$disk/." "$kept"
        exit $code)";
    for (const char* name : {"p.png", "p.jpg", "p.tif"}) {
        SCOPED_TRACE(name);
        const fs::path disk = oro::test::scratch_folder(), kept = oro::test::scratch_folder();
        Words words{"unshare", "--mount"};
        if (geteuid() != 0)
            words.emplace_back("--map-root-user");  // root can do without, and may be refused it
        for (const std::string& word : Words{"sh", "-c", session, "sh", disk, kept, name, OROGRAPH_PROGRAM,
                                             "shot", bundled(), "--style", "default", "--size", "640x480"})
            words.push_back(word);
        const Outcome outcome = oro::test::run_program(words);
        if (outcome.exit_code == 99 || outcome.err.rfind("unshare:", 0) == 0)
            GTEST_SKIP() << "needs to mount a small file system";
        expect_refusal(outcome, failed, {disk / name, "No space left"});
        EXPECT_EQ(bytes_of(kept / name), "mine");
        EXPECT_EQ(bytes_of(kept / "p.json"), "mine, too");
        EXPECT_EQ(names_in(kept).size(), 2U);
    }
}

TEST_F(BadInput, NoVulkanDriver) {
    Circumstances driverless;
    driverless.environment = {"VK_DRIVER_FILES=/nonexistent", "VK_ICD_FILENAMES=/nonexistent",
                              "VK_ADD_DRIVER_FILES"};
    expect_refusal(shoot(bundled(), {}, driverless), no_device, {"scripts/set-up"});
    const Outcome doctor = run_orograph({"doctor"}, driverless);
    EXPECT_EQ(doctor.exit_code, 0) << doctor.err;
    EXPECT_NE(doctor.out.find("none"), std::string::npos) << doctor.out;
}

TEST_F(BadInput, NoDisplayForAWindow) {
    Circumstances blind;
    blind.environment = {"DISPLAY", "WAYLAND_DISPLAY"};
    expect_refusal(run_orograph({"view", bundled()}, blind), failed, {"display", "orograph shot"});
}

TEST_F(BadInput, NoMeshShader) {
    Circumstances without;
    without.environment = {"OROGRAPH_WITHOUT=mesh_shader,compute"};
    expect_refusal(shoot(bundled(), {}, without), no_device, {"VK_EXT_mesh_shader", "scripts/set-up"});
    // With the compute path left, only who insists on mesh shaders is refused.
    without.environment = {"OROGRAPH_WITHOUT=mesh_shader"};
    expect_refusal(shoot(bundled(), {"--pipeline", "mesh"}, without), no_device,
                   {"VK_EXT_mesh_shader", "--pipeline compute"});
}

// Found: 010 was eight.
TEST_F(BadInput, WholeNumbersAreDecimal) {
    const auto samples = [&](const char* text) {
        return run_orograph({"shot", bundled(), "--size", "16x16", "--samples", text, "--json", "-q",
                             "--overwrite", "--out", folder / "p.png"});
    };
    for (const auto& [text, number] : {std::pair{"010", "10"}, {"08", "8"}, {"0000064", "64"}}) {
        const Outcome outcome = samples(text);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_NE(outcome.out.find(std::string("\"samples\": ") + number + ","), std::string::npos) << text;
    }
    for (const char* text : {"0x10", "1e1", "4.0", "0b11", " 4", "4 ", "four", "00", "-4"})
        expect_refusal(samples(text), usage, {"--samples"});
    expect_refusal(run_orograph({"trade", bundled(), "--views", "0x1"}), usage, {"--views"});
    expect_refusal(run_orograph({"shot", bundled(), "--out", "p.png", "--memory", "0x40"}), usage,
                   {"--memory"});
}

// The software driver keeps its memory in a file, which the shell's limit of file sizes bounds.
TEST_F(BadInput, LimitOfFileSizes) {
    for (const char* command : {"shot", "panorama"}) {
        for (const char* kib : {"1", "1024", "16384", "32768"}) {
            SCOPED_TRACE(std::string(command) + " " + kib);
            const fs::path out = oro::test::scratch_folder() / "p.png";
            Words words{"bash",      "-c",      "ulimit -f $1; shift; exec \"$@\"",
                        "bash",      kib,       OROGRAPH_PROGRAM,
                        command,     bundled(), "--style",
                        "default",   "-q",      "--out",
                        out.string()};
            if (std::string_view(command) == "shot")
                words.insert(words.end(), {"--size", "64x48"});
            else
                words.insert(words.end(),
                             {"--at", "36.53,-84.23", "--width", "400", "--elevation", "-10,10"});
            const Outcome outcome = oro::test::run_program(words);
            if (outcome.exit_code == 0) continue;  // there is room enough, or a GPU
            expect_refusal(outcome, failed, {"KiB"});
            EXPECT_FALSE(fs::exists(out));
        }
    }
}

}  // namespace
