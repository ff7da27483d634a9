// orograph export of tiles in parts, and after kills: the files of one go.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::names_in;
using oro::test::object_said_by;
using oro::test::run_orograph;
using oro::test::Words;

// Every file of a folder and its bytes.
std::map<std::string, std::string> files_in(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files[fs::relative(entry.path(), folder)] = bytes_of(entry.path());
    return files;
}

// layer.json and tiles.json name their folder: both exports have the same name, in different places.
struct TileFormat {
    const char* name;
    Words choice;
    const char* index;
    Words other_choice;
};
const TileFormat formats[]{{"terrain-rgb", {"--zoom", "9:12"}, "tiles.json", {"--hole-height", "7"}},
                           {"quantized-mesh", {"--zoom", "0:10"}, "layer.json", {"--hole-height", "7"}},
                           {"3dtiles", {"--max-error", "4"}, "tileset.json", {"--no-normals"}}};

oro::test::Circumstances in_folder(const fs::path& folder) {
    oro::test::Circumstances there;
    there.folder = folder;
    return there;
}

Words tiles_words(const TileFormat& format, const Words& more = {}) {
    return oro::test::joined(
        oro::test::joined({"export", bundled(), "-q", "--json", "--to", format.name, "--out", "globe"},
                          format.choice),
        more);
}

TEST(ExportParts, TilesOfPartsAreThoseOfOneGo) {
    for (const TileFormat& format : formats) {
        const fs::path one = oro::test::scratch_folder(), parts = oro::test::scratch_folder();
        const auto whole = oro::test::one_object(run_orograph(tiles_words(format), in_folder(one)).out);
        std::uint64_t kept = 0;
        for (const char* const shard : {"1/3", "3/3", "2/3"}) {
            const auto said = oro::test::one_object(
                run_orograph(tiles_words(format, {"--shard", shard}), in_folder(parts)).out);
            EXPECT_EQ(said["parts"], 3);
            kept += said["tiles"].get<std::uint64_t>();
            EXPECT_FALSE(fs::exists(parts / "globe"));
        }
        EXPECT_GE(kept, whole["tiles"].get<std::uint64_t>());
        expect_refusal(run_orograph(tiles_words(format, format.other_choice), in_folder(parts)),
                       oro::test::failed, {"globe.tiles: holds tiles of other data, options"});
        const auto joined = oro::test::one_object(run_orograph(tiles_words(format), in_folder(parts)).out);
        EXPECT_EQ(joined, whole);
        EXPECT_EQ(names_in(parts), Words{"globe"});
        EXPECT_TRUE(files_in(parts / "globe") == files_in(one / "globe")) << format.name;
        EXPECT_TRUE(fs::exists(one / "globe" / format.index));
    }
}

struct Killed {
    int kills = 0;
    std::size_t most_kept = 0;  // files of parts that a kill left
};

// An export that is killed (SIGKILL) again and again, each time later by step_s, until it is done.
Killed killed_export(const TileFormat& format, const fs::path& folder, double step_s) {
    Killed found;
    for (double lives_s = step_s; !fs::exists(folder / "globe") && lives_s < 300.0 * step_s;
         lives_s += step_s) {
        auto there = in_folder(folder);
        there.signal = SIGKILL;
        there.signal_after_s = lives_s;
        if (run_orograph(tiles_words(format), there).exit_code != 128 + SIGKILL) continue;
        ++found.kills;
        // Whole or absent: what is there when it is killed has no name of its own yet, or is complete. Then
        // its parts may still be there.
        if (fs::exists(folder / "globe"))
            fs::remove_all(folder / "globe.tiles");
        else if (fs::exists(folder / "globe.tiles"))
            found.most_kept = std::max(found.most_kept, names_in(folder / "globe.tiles").size());
    }
    return found;
}

// On a busy machine all kills of a round may come before its parts or after them: then there is another.
TEST(ExportParts, AKilledExportGoesOn) {
    for (const TileFormat& format : formats) {
        const fs::path one = oro::test::scratch_folder();
        ASSERT_EQ(run_orograph(tiles_words(format), in_folder(one)).exit_code, 0);
        Killed found;
        for (double step_s = 0.1; step_s > 0.02 && found.most_kept <= 2; step_s *= 0.75) {
            const fs::path killed = oro::test::scratch_folder();
            found = killed_export(format, killed, step_s);
            std::printf("%s: %d kills, %zu files kept at most\n", format.name, found.kills, found.most_kept);
            EXPECT_TRUE(files_in(killed / "globe") == files_in(one / "globe")) << format.name;
            EXPECT_FALSE(fs::exists(killed / "globe.tiles"));
        }
        EXPECT_GT(found.kills, 0);
        EXPECT_GT(found.most_kept, 2U);
    }
}

// One file: killed at any moment it is not there under its name, or all of it is.
TEST(ExportParts, AKilledFileIsWholeOrAbsent) {
    for (const Words& format : {Words{"cog", "h.tif"}, Words{"gltf", "h.glb"}}) {
        const fs::path one = oro::test::scratch_folder(), killed = oro::test::scratch_folder();
        const Words words{"export", bundled(), "-q", "--to", format[0], "--out", format[1]};
        ASSERT_EQ(run_orograph(words, in_folder(one)).exit_code, 0);
        const std::string whole = bytes_of(one / format[1]);
        int kills = 0;
        for (double lives_s = 0.02; !fs::exists(killed / format[1]) && lives_s < 20.0; lives_s *= 1.15) {
            auto there = in_folder(killed);
            there.signal = SIGKILL;
            there.signal_after_s = lives_s;
            kills += run_orograph(words, there).exit_code == 128 + SIGKILL ? 1 : 0;
        }
        std::printf("%s: %d kills\n", format[0].c_str(), kills);
        EXPECT_GT(kills, 0);
        EXPECT_TRUE(bytes_of(killed / format[1]) == whole) << format[0];
        // What was on its way has names of its own, which no program takes for the file.
        for (const std::string& name : names_in(killed))
            EXPECT_TRUE(name == format[1] || name.starts_with(".") || name.ends_with(".partial")) << name;
    }
}

// 30 m of a UTM zone over a part of 3": a tree of tiles each, and what is between them.
TEST(ExportParts, SeveralGridsMakeOneTileset) {
    const fs::path folder = oro::test::scratch_folder(), fine = folder / "fine.tif";
    const auto made = oro::test::run_program({"gdalwarp", "-q", "-t_srs", "EPSG:32616", "-tr", "30", "30",
                                              "-te", "745000", "4045000", "748000", "4047400", "-r", "cubic",
                                              "-ot", "Float32", bundled(), fine.string()});
    if (made.exit_code == 127) GTEST_SKIP() << "needs gdalwarp";
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Words words{"export", bundled(), fine.string(), "-q",   "--json", "--bbox=-84.3,36.48,-84.2,36.58",
                      "--to",   "3dtiles", "--out",       "globe"};
    const fs::path one = folder / "one", parts = folder / "parts";
    fs::create_directories(one);
    fs::create_directories(parts);
    const auto said = oro::test::one_object(run_orograph(words, in_folder(one)).out);
    ASSERT_EQ(said["grids"].size(), 2U) << said;
    EXPECT_FALSE(said.contains("levels"));
    std::uint64_t tiles = said["between"]["tiles"];
    EXPECT_GT(said["between"]["triangles"].get<int>(), 200);
    // Places there are rounded along three axes to a sixteenth of the finer grid's 6.03 m: by sqrt(3) / 2 of
    // that, and triangles of 3" sag by less than a millimetre.
    EXPECT_LT(said["between"]["largest_error_m"].get<double>(), 0.34);
    for (const auto& grid : said["grids"])
        for (const auto& level : grid["levels"]) tiles += level["tiles"].get<std::uint64_t>();
    EXPECT_EQ(said["tiles"], tiles);
    // A fifth of the way between posts of each grid, with the equator's radius: 3" and 30 m.
    EXPECT_LE(said["grids"][0]["levels"].back()["largest_error_m"].get<double>(), 18.5533);
    EXPECT_LE(said["grids"][1]["levels"].back()["largest_error_m"].get<double>(), 6.1);
    const auto files = files_in(one / "globe");
    EXPECT_EQ(files.size(), tiles + 1);
    EXPECT_TRUE(files.contains("2/0/0/0.glb") && files.contains("between/0.glb"));
    for (const char* const shard : {"1/2", "2/2"})
        EXPECT_EQ(run_orograph(oro::test::joined(words, {"--shard", shard}), in_folder(parts)).exit_code, 0);
    const auto joined = oro::test::one_object(run_orograph(words, in_folder(parts)).out);
    EXPECT_EQ(joined, said);
    EXPECT_TRUE(files_in(parts / "globe") == files);
    // --overwrite takes it for a tileset.
    EXPECT_EQ(run_orograph(oro::test::joined(words, {"--overwrite"}), in_folder(one)).exit_code, 0);
    EXPECT_TRUE(files_in(one / "globe") == files);
}

TEST(ExportParts, WhatHasNoTilesHasNoParts) {
    const fs::path folder = oro::test::scratch_folder();
    for (const char* const format : {"cog", "gltf"})
        expect_refusal(run_orograph({"export", bundled(), "-q", "--to", format, "--out",
                                     (folder / (format == std::string("cog") ? "a.tif" : "a.glb")).string(),
                                     "--shard", "1/2"}),
                       oro::test::usage, {"--shard 1/2: needs --to 3dtiles, quantized-mesh or terrain-rgb"});
}

}  // namespace
