// Baked regions: written whole or not at all, whatever happens meanwhile; drawn and told as their sources
// are.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "tests/apps/baked/baking.h"
#include "tests/apps/picture_pixels.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::Bake;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::hills;
using oro::test::joined;
using oro::test::names_in;
using oro::test::no_data;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::usage;
using oro::test::Words;
using oro::test::write_bytes;

TEST_F(Bake, TellsWhatItWrote) {
    const fs::path file = folder / "region.oro";
    const Outcome outcome = run_orograph({"bake", bundled(), "--out", file, "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("wrote " + file.string()), std::string::npos) << outcome.err;
    const json said = json::parse(outcome.out, nullptr, false);
    ASSERT_TRUE(said.is_object()) << outcome.out;
    EXPECT_EQ(said["file"], file.string());
    EXPECT_EQ(said["bytes"], fs::file_size(file));
    EXPECT_EQ(said["posts"], 403 * 344);
    EXPECT_EQ(said["triangles"], 2 * 402 * 343);
    EXPECT_EQ(said["pages"], json({{"all", 12 + 4 + 1}, {"of_a_bake_broken_off", 0}}));  // of 4 x 3, 2 x 2, 1
    EXPECT_NEAR(said["bytes_per_post"].get<double>(),
                static_cast<double>(fs::file_size(file)) / (403.0 * 344.0), 1e-9);
    EXPECT_GE(said["times_s"]["read"].get<double>(), 0.0);
    EXPECT_GE(said["times_s"]["build_and_write"].get<double>(), 0.0);
    EXPECT_EQ(names_in(folder), Words{"region.oro"});
}

TEST_F(Bake, TheSameInputMakesTheSameFile) {
    const std::string bytes = bytes_of(baked());
    EXPECT_TRUE(bytes_of(baked({"--overwrite"})) == bytes);
    // Also from what was baked.
    const fs::path again = folder / "again.oro";
    const Outcome outcome = run_orograph({"bake", folder / "region.oro", "--out", again, "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(bytes_of(again) == bytes);
}

TEST_F(Bake, InfoTellsTheSameAsOfItsSources) {
    const fs::path file = baked();
    const Outcome of_file = run_orograph({"info", file, "--json"});
    const Outcome of_tiles = run_orograph({"info", bundled(), "--json", "--check"});
    ASSERT_EQ(of_file.exit_code, 0) << of_file.err;
    const json baked_one = json::parse(of_file.out), tiles = json::parse(of_tiles.out);
    EXPECT_EQ(baked_one["sources"], tiles["sources"]);
    EXPECT_EQ(baked_one["region"], tiles["region"]);
    EXPECT_EQ(baked_one["file"]["bytes"], fs::file_size(file));
    EXPECT_EQ(baked_one["file"]["levels"], 3);
    EXPECT_EQ(baked_one["file"]["version"], 1);
    EXPECT_EQ(baked_one["checked"], false);
    EXPECT_TRUE(tiles["file"].is_null());
    EXPECT_EQ(tiles["checked"], true);
    EXPECT_EQ(json::parse(run_orograph({"info", file, "--json", "--check"}).out)["checked"], true);
    const Outcome lines = run_orograph({"info", file, "--check"});
    for (const char* words : {"baked region", "\n  levels      3: full detail (",
                              " triangles), and 2 coarser ones for ground that is far away\n",
                              "\n  size        ", " for each post\n", "USGS", "every page was read"})
        EXPECT_NE(lines.out.find(words), std::string::npos) << lines.out;
}

// Whatever the view, and also where only a part is drawn or heights are exaggerated.
TEST_F(Bake, PicturesAreThoseOfItsSources) {
    const fs::path file = baked();
    const std::vector<Words> views{
        {},
        {"--tau", "0"},
        {"--tau", "4", "--pipeline", "compute"},
        {"--samples", "4", "--sun", "120,20"},
        {"--exaggeration", "2.5"},
        {"--bbox", "-84.3,36.5,-84.15,36.62"},
        {"--at", "36.47,-84.27", "--above", "300", "--heading", "50", "--pitch", "-8"},
        {"--at", "36.6,-84.38", "--look-at", "36.5,-84.2"},
        {"--at", "36.5,-84.2", "--altitude", "2000000", "--pitch", "-89", "--fov", "4"}};
    for (const Words& view : views) {
        SCOPED_TRACE(testing::PrintToString(view));
        const fs::path of_tiles = folder / "tiles.png", of_file = folder / "file.png";
        const auto shoot = [&](const std::string& from, const fs::path& to) {
            const Outcome outcome =
                run_orograph(joined({"shot", from, "--size", "320x180", "--time", "2026-01-01T00:00:00Z",
                                     "--overwrite", "-q", "--json", "--out", to},
                                    view));
            EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
            return json::parse(outcome.out, nullptr, false);
        };
        const json tiles = shoot(bundled(), of_tiles), said = shoot(file, of_file);
        const oro::test::Pixels is = oro::test::pixels_of(of_file), was = oro::test::pixels_of(of_tiles);
        ASSERT_EQ(was.width, 320U);
        EXPECT_TRUE(is.rgb == was.rgb);
        for (const char* same : {"eye", "heading_deg", "destination", "attribution", "triangles"})
            EXPECT_EQ(said[same], tiles[same]) << same;
        // Of a part, a baked region still tells what its sources hold in all of it.
        if (view.empty() || view[0] != "--bbox") {
            EXPECT_EQ(said["sources"], tiles["sources"]);
            EXPECT_EQ(said["region"], tiles["region"]);
        }
        EXPECT_NE(said["attribution"].get<std::string>().find("USGS"), std::string::npos);
        EXPECT_NE(bytes_of(of_file).find("USGS"), std::string::npos) << "in its tags";
        // The view in the picture opens the baked region again.
        const fs::path again = folder / "again.png";
        const Outcome outcome =
            run_orograph({"shot", "--view", of_file, "--out", again, "--overwrite", "-q"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_TRUE(bytes_of(again) == bytes_of(of_file));
    }
}

TEST_F(Bake, AViewOfTilesIsDrawnFromTheBakedRegion) {
    const fs::path file = baked();
    ASSERT_EQ(
        run_orograph({"shot", bundled(), "--size", "160x90", "--out", folder / "p.png", "-q"}).exit_code, 0);
    const Outcome outcome =
        run_orograph({"shot", file, "--view", folder / "p.png", "--out", folder / "again.png", "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(oro::test::pixels_of(folder / "again.png").rgb == oro::test::pixels_of(folder / "p.png").rgb);
}

TEST_F(Bake, OutThatCannotBe) {
    const auto bake_to = [](const Words& out, const Circumstances& circumstances = {}) {
        return run_orograph(joined({"bake", bundled()}, out), circumstances);
    };
    expect_refusal(bake_to({}), usage, {"--out"});
    for (const char* name : {"region.tif", "region", "region.oro.gz", ""})
        expect_refusal(bake_to({"--out", name}), usage, {"--out"});
    expect_refusal(bake_to({"--out", folder / "nowhere" / "a.oro"}), failed, {folder / "nowhere"});
    fs::create_directory(folder / "folder.oro");
    expect_refusal(bake_to({"--out", folder / "folder.oro"}), failed, {"folder.oro", "folder"});
    expect_refusal(bake_to({"--out", folder / "folder.oro", "--overwrite"}), failed,
                   {"folder.oro", "folder"});
    file("mine.oro", "mine");
    expect_refusal(bake_to({"--out", folder / "mine.oro"}), failed, {"mine.oro", "--overwrite"});
    EXPECT_EQ(bytes_of(folder / "mine.oro"), "mine");
    EXPECT_EQ(names_in(folder), (Words{"folder.oro", "mine.oro"}));
    ASSERT_TRUE(oro::test::permissions_bind()) << "this process cannot be made to heed permissions";
    Circumstances bound;
    bound.bound_by_permissions = true;
    fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
    expect_refusal(bake_to({"--out", folder / "a.oro"}, bound), failed, {folder, "ermission"});
    fs::permissions(folder, fs::perms::owner_all);
}

// What is read is never replaced, under whatever name.
TEST_F(Bake, InputsAreSpared) {
    const fs::path tile = file("N46E008.hgt", hills());
    fs::create_hard_link(tile, folder / "hard.oro");
    fs::create_symlink(tile, folder / "soft.oro");
    for (const char* name : {"hard.oro", "soft.oro"}) {
        expect_refusal(run_orograph({"bake", tile, "--out", folder / name, "--overwrite"}), usage,
                       {"would replace", tile});
        // Also when it is found in a folder.
        expect_refusal(run_orograph({"bake", folder, "--out", folder / name, "--overwrite"}), usage,
                       {"would replace", tile});
    }
    EXPECT_TRUE(bytes_of(tile) == hills());
    const fs::path region = baked();
    const std::string bytes = bytes_of(region);
    expect_refusal(run_orograph({"bake", region, "--out", region, "--overwrite"}), usage, {"would replace"});
    fs::create_symlink(region, folder / "p.png");
    fs::create_symlink(region, folder / "q.jpg");
    for (const char* name : {"p.png", "q.jpg"}) {
        expect_refusal(
            run_orograph({"shot", region, "--size", "64x48", "--out", folder / name, "--overwrite"}), usage,
            {"would replace", region});
        expect_refusal(run_orograph({"shot", region, "--bbox", "-84.3,36.5,-84.2,36.6", "--size", "64x48",
                                     "--out", folder / name, "--overwrite"}),
                       usage, {"would replace", region});
    }
    EXPECT_TRUE(bytes_of(region) == bytes);
}

// What a bake would write on its way is no less lost than what it replaces.
TEST_F(Bake, FilesOnItsWayAreSpared) {
    const fs::path region = baked();
    const std::string bytes = bytes_of(region);
    const fs::path out = folder / "c.oro";
    for (const char* name : {"c.oro.partial", "c.oro.partial-stitched"}) {
        SCOPED_TRACE(name);
        const fs::path file = folder / name;
        const Words before = names_in(folder);
        // The input itself, by its name, by a link to it, and by another name of it.
        fs::rename(region, file);
        for (const Words& how : {Words{}, Words{"--overwrite"}, Words{"--bbox", "-84.3,36.5,-84.2,36.6"}})
            expect_refusal(run_orograph(joined({"bake", file, "--out", out}, how)), usage,
                           {"would replace", file});
        fs::create_symlink(out, folder / "d.oro");
        expect_refusal(run_orograph({"bake", file, "--out", out}), usage, {"would replace", file});
        fs::remove(folder / "d.oro");
        fs::rename(file, region);
        fs::create_hard_link(region, file);
        expect_refusal(run_orograph({"bake", region, "--out", out}), usage, {"would replace", region});
        expect_refusal(run_orograph({"bake", bundled(), "--out", out}), failed, {file, "a hard link"});
        fs::remove(file);
        fs::create_symlink(region, file);
        expect_refusal(run_orograph({"bake", bundled(), "--out", out}), failed, {file, "is a link"});
        fs::remove(file);
        write_bytes(file, "precious");
        expect_refusal(run_orograph({"bake", bundled(), "--out", out}), failed,
                       {file, "no bake has left it behind"});
        EXPECT_EQ(bytes_of(file), "precious");
        fs::remove(file);
        EXPECT_TRUE(bytes_of(region) == bytes);
        EXPECT_EQ(names_in(folder), before);
    }
}

TEST_F(Bake, NothingToBake) {
    expect_refusal(run_orograph({"bake", "--out", folder / "a.oro"}), usage, {"PATH"});
    expect_refusal(run_orograph({"bake", bundled(), "--bbox", "7,46,8,47", "--out", folder / "a.oro"}),
                   no_data, {});
    expect_refusal(run_orograph({"bake", folder / "nothing.tif", "--out", folder / "a.oro"}), failed,
                   {"nothing.tif"});
    EXPECT_EQ(names_in(folder), Words{});
}

// One clear line from every command that opens it.
TEST_F(Bake, FilesThatAreNoBakedRegions) {
    const fs::path region = baked();
    const std::string bytes = bytes_of(region);
    struct Bad {
        fs::path path;
        Words says;
    };
    const std::vector<Bad> all{
        {file("empty.oro", ""), {"empty.oro", "empty"}},
        {file("text.oro", "a shopping list\n"), {"text.oro", "byte 0"}},
        {file("older.oro", "\x89ORO\r\n\x1a\n" + bytes.substr(8)),
         {"older.oro", "was baked by an older Orograph: bake it again"}},
        {file("older.dat", "OROGRIDS" + bytes.substr(8)),
         {"older.dat", "was baked by an older Orograph: bake it again"}},
        {file("header.oro", bytes.substr(0, 100)), {"header.oro", "cut off at byte 100"}},
        {file("half.oro", bytes.substr(0, bytes.size() / 2)),
         {"half.oro", "cut off at byte " + std::to_string(bytes.size() / 2)}},
        {file("long.oro", bytes + "x"), {"long.oro", std::to_string(bytes.size())}},
        {folder / "nothing.oro", {"nothing.oro", "No such file"}},
        {file("half.dat", bytes.substr(0, 1000)), {"half.dat", "cut off at byte 1000"}}};
    for (const Bad& bad : all) {
        SCOPED_TRACE(bad.path);
        const fs::path out = oro::test::scratch_folder();
        expect_refusal(run_orograph({"info", bad.path}), failed, bad.says);
        expect_refusal(run_orograph({"shot", bad.path, "--size", "64x48", "--out", out / "p.png"}), failed,
                       bad.says);
        expect_refusal(run_orograph({"bake", bad.path, "--out", out / "a.oro"}), failed, bad.says);
        EXPECT_EQ(names_in(out), Words{}) << "left behind";
    }
    // A folder of that name is a folder like any other.
    fs::create_directory(folder / "folder.oro");
    expect_refusal(run_orograph({"info", folder / "folder.oro"}), no_data, {"folder.oro"});
    fs::copy_file(bundled(), folder / "folder.oro" / "a.tif");
    EXPECT_EQ(run_orograph({"info", folder / "folder.oro"}).exit_code, 0);
    // And a baked region is one under any name.
    fs::copy_file(region, folder / "region.bin");
    EXPECT_EQ(run_orograph({"info", folder / "region.bin"}).exit_code, 0);
}

TEST_F(Bake, BakedRegionsAreOpenedAloneAndAsTheyAre) {
    const fs::path region = baked();
    const fs::path out = folder / "p.png";
    for (const Words& paths : {Words{region, bundled()}, Words{bundled(), region}}) {
        expect_refusal(run_orograph(joined({"info"}, paths)), usage, {region, "opened alone"});
        expect_refusal(run_orograph(joined({"shot", "--out", out}, paths)), usage, {region, "opened alone"});
    }
    for (const Words& option :
         {Words{"--fill-voids"}, Words{"--strict-datum"}, Words{"--height-unit", "ft"},
          Words{"--source-crs", "EPSG:2056"}, Words{"--source-vertical", "EPSG:4979"}}) {
        expect_refusal(run_orograph(joined({"info", region}, option)), usage, {option[0], "baked"});
        expect_refusal(run_orograph(joined({"shot", region, "--out", out}, option)), usage,
                       {option[0], "baked"});
    }
    expect_refusal(run_orograph({"info", region, "--bbox", "7,46,8,47"}), no_data, {region});
    EXPECT_EQ(names_in(folder), Words{"region.oro"});
}

TEST_F(Bake, VoidsAreToldAndFilledWhenBaking) {
    std::string tile = hills();
    for (std::size_t post = 600 * 1201 + 600; post < 600 * 1201 + 620; ++post)
        tile.replace(2 * post, 2, "\x80\0", 2);
    const fs::path data = file("N46E008.hgt", tile);
    const auto note = [&](const Words& how) {
        const Outcome bake =
            run_orograph(joined({"bake", data, "--out", folder / "a.oro", "--overwrite", "-q"}, how));
        EXPECT_EQ(bake.exit_code, 0) << bake.err;
        const Outcome shot = run_orograph(
            {"shot", folder / "a.oro", "--size", "64x48", "--out", folder / "p.png", "--overwrite"});
        EXPECT_EQ(shot.exit_code, 0) << shot.err;
        return shot.err;
    };
    const std::string holes = note({});
    EXPECT_NE(holes.find("20 void posts are holes (baking with --fill-voids fills"), std::string::npos)
        << holes;
    const std::string filled = note({"--fill-voids"});
    EXPECT_EQ(filled.find("void"), std::string::npos) << filled;
    const json region = json::parse(run_orograph({"info", folder / "a.oro", "--json"}).out)["region"];
    EXPECT_EQ(region["filled"], 20);
    EXPECT_NE(region["void_method"].get<std::string>().find("GDALFillNodata"), std::string::npos);
}

// A byte changed anywhere, by chance and in every part: told with its place, by info --check and by a shot
// that draws all of it.
TEST_F(Bake, AFlippedByteIsTold) {
    const std::string bytes = bytes_of(baked());
    const auto seed = std::random_device{}();
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    std::vector<std::size_t> places{0, 9, 20, 200, 255, 300, bytes.size() - 1};
    for (int i = 0; i < 20; ++i) places.push_back(random() % bytes.size());
    for (const std::size_t place : places) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", byte " << place);
        std::string damaged = bytes;
        damaged[place] = static_cast<char>(damaged[place] ^ (1U << random() % 8));
        const fs::path bad = file("bad.oro", damaged);
        expect_refusal(run_orograph({"info", bad, "--check"}), failed, {bad, "byte"});
        const fs::path out = oro::test::scratch_folder();
        const Outcome shot =
            run_orograph({"shot", bad, "--size", "64x48", "--tau", "0", "--out", out / "p.png", "-q"});
        // A coarser level's damage does not touch a picture at full resolution.
        if (shot.exit_code != 0) {
            expect_refusal(shot, failed, {bad, "byte"});
            EXPECT_EQ(names_in(out), Words{});
        }
    }
}

// A file system that is too small for the file: the file that was there stays, and with more room the same
// command goes on.
TEST_F(Bake, FullDisk) {
    const std::string session = R"(
        disk=$1 kept=$2; shift 2
        mount -t tmpfs -o size=64k none "$disk" 2>/dev/null || exit 99
        printf mine >"$disk/a.oro"
        "$@" --out "$disk/a.oro" --overwrite -q; code=$?
        cp "$disk/a.oro" "$kept/first"
        mount -o remount,size=4m "$disk" || exit 98
        "$@" --out "$disk/a.oro" --overwrite -q || exit 97
        cp -a "$disk/." "$kept"
        exit $code)";
    const fs::path disk = oro::test::scratch_folder(), kept = oro::test::scratch_folder();
    Words words{"unshare", "--mount"};
    if (geteuid() != 0) words.emplace_back("--map-root-user");
    const Outcome outcome = oro::test::run_program(
        joined(words, {"sh", "-c", session, "sh", disk, kept, OROGRAPH_PROGRAM, "bake", bundled()}));
    if (outcome.exit_code == 99 || outcome.err.rfind("unshare:", 0) == 0)
        GTEST_SKIP() << "needs to mount a small file system";
    expect_refusal(outcome, failed, {disk / "a.oro", "No space left"});
    EXPECT_EQ(bytes_of(kept / "first"), "mine");
    EXPECT_TRUE(bytes_of(kept / "a.oro") == bytes_of(baked()));
    EXPECT_EQ(names_in(kept), (Words{"a.oro", "first"}));
}

// What another bake has left under the name is not taken for one's own, were a single post another.
TEST_F(Bake, LeftoversOfOtherInputAreNotUsed) {
    std::string tile = hills();
    const fs::path data = file("N46E008.hgt", tile), out = folder / "a.oro";
    const auto bake = [&](const fs::path& to) {
        const Outcome outcome = run_orograph({"bake", data, "--out", to, "-q"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    };
    bake(out);
    fs::rename(out, folder / "a.oro.partial");
    // Two posts change places: the lowest, the highest and the number of heights stay.
    const std::size_t post = 2 * (600 * 1201 + 600);
    std::swap_ranges(&tile[post], &tile[post] + 2, &tile[post + 2]);
    ASSERT_FALSE(tile == hills());
    write_bytes(data, tile);
    bake(out);
    bake(folder / "clean.oro");
    EXPECT_TRUE(bytes_of(out) == bytes_of(folder / "clean.oro"));
    EXPECT_EQ(names_in(folder), (Words{"N46E008.hgt", "a.oro", "clean.oro"}));
}

}  // namespace
