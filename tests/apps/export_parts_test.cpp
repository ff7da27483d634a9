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
    const char *name, *zooms, *index;
};
constexpr TileFormat formats[]{{"terrain-rgb", "9:12", "tiles.json"},
                               {"quantized-mesh", "0:10", "layer.json"}};

oro::test::Circumstances in_folder(const fs::path& folder) {
    oro::test::Circumstances there;
    there.folder = folder;
    return there;
}

Words tiles_words(const TileFormat& format, const Words& more = {}) {
    return oro::test::joined(
        {"export", bundled(), "-q", "--json", "--to", format.name, "--zoom", format.zooms, "--out", "globe"},
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
        expect_refusal(run_orograph(tiles_words(format, {"--hole-height", "7"}), in_folder(parts)),
                       oro::test::failed, {"globe.tiles: holds tiles of other data, options"});
        const auto joined = oro::test::one_object(run_orograph(tiles_words(format), in_folder(parts)).out);
        EXPECT_EQ(joined, whole);
        EXPECT_EQ(names_in(parts), Words{"globe"});
        EXPECT_TRUE(files_in(parts / "globe") == files_in(one / "globe")) << format.name;
        EXPECT_TRUE(fs::exists(one / "globe" / format.index));
    }
}

// Killed (SIGKILL) again and again, each time a little later, until it is done.
TEST(ExportParts, AKilledExportGoesOn) {
    for (const TileFormat& format : formats) {
        const fs::path one = oro::test::scratch_folder(), killed = oro::test::scratch_folder();
        ASSERT_EQ(run_orograph(tiles_words(format), in_folder(one)).exit_code, 0);
        int kills = 0;
        std::size_t most_kept = 0;
        for (double lives_s = 0.1; !fs::exists(killed / "globe") && lives_s < 30.0; lives_s += 0.1) {
            auto there = in_folder(killed);
            there.signal = SIGKILL;
            there.signal_after_s = lives_s;
            const auto outcome = run_orograph(tiles_words(format), there);
            if (outcome.exit_code != 128 + SIGKILL) continue;
            ++kills;
            // Whole or absent: what is there when it is killed has no name of its own yet, or is complete.
            // Then its parts may still be there.
            if (fs::exists(killed / "globe")) {
                fs::remove_all(killed / "globe.tiles");
                break;
            }
            if (fs::exists(killed / "globe.tiles"))
                most_kept = std::max(most_kept, names_in(killed / "globe.tiles").size());
        }
        std::printf("%s: %d kills, %zu files kept at most\n", format.name, kills, most_kept);
        EXPECT_GT(kills, 0);
        EXPECT_GT(most_kept, 2U);
        EXPECT_TRUE(files_in(killed / "globe") == files_in(one / "globe")) << format.name;
        EXPECT_FALSE(fs::exists(killed / "globe.tiles"));
    }
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
