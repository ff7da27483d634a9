// orograph horizon as people and programs use it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::object_said_by;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;
using oro::test::write_bytes;

// Posts 1 .. 20 columns and rows from the tile's middle, whose spacing gdalinfo tells.
const Words small_box{"--bbox", "-84.26,36.55,-84.25,36.56"};

std::vector<double> values_of(const fs::path& file, int column, int row) {
    const auto outcome = run_program(
        {"gdallocationinfo", "-valonly", file.string(), std::to_string(column), std::to_string(row)});
    std::vector<double> values;
    std::string value;
    for (const char c : outcome.out) {
        if (c != '\n') {
            value += c;
            continue;
        }
        if (!value.empty()) values.push_back(std::stod(value));
        value.clear();
    }
    return values;
}

TEST(HorizonCommand, WritesGeoTiffsOnTheRegionsPosts) {
    const fs::path folder = oro::test::scratch_folder();
    const auto said = object_said_by(
        oro::test::joined({"horizon", bundled(), "-q", "--json", "--radius", "8", "--directions", "8",
                           "--above", "1", "--out", (folder / "h.tif").string()},
                          small_box));
    EXPECT_EQ(oro::test::names_in(folder), (Words{"h.horizon.qml", "h.horizon.tif", "h.sky-view.tif"}));
    EXPECT_EQ(said["posts"].get<int>(), said["columns"].get<int>() * said["rows"].get<int>());
    const auto source = run_program({"gdalinfo", "-json", bundled()});
    if (source.exit_code == 127) GTEST_SKIP() << "needs gdalinfo";
    const auto data = oro::test::one_object(source.out);
    const auto horizon =
        oro::test::one_object(run_program({"gdalinfo", "-json", folder / "h.horizon.tif"}).out);
    const auto sky = oro::test::one_object(run_program({"gdalinfo", "-json", folder / "h.sky-view.tif"}).out);
    ASSERT_EQ(horizon["bands"].size(), 8U);
    EXPECT_EQ(horizon["bands"][1]["description"], "horizon's elevation in azimuth 45, degrees");
    EXPECT_EQ(horizon["bands"][0]["noDataValue"], -9999.0);
    EXPECT_EQ(horizon["metadata"][""]["RADIUS_KM"], "8");
    ASSERT_EQ(sky["bands"].size(), 1U);
    EXPECT_EQ(sky["geoTransform"], horizon["geoTransform"]);
    EXPECT_EQ(horizon["size"][0], said["columns"]);
    // Whole posts from the data's own corner, and none outside the box.
    const auto of = data["geoTransform"], is = horizon["geoTransform"];
    for (const int axis : {0, 3}) {
        const double step = of[axis == 0 ? 1 : 5].get<double>();
        EXPECT_NEAR(is[axis == 0 ? 1 : 5].get<double>(), step, 1.0e-12);
        const double posts = (is[axis].get<double>() - of[axis].get<double>()) / step;
        EXPECT_NEAR(posts, std::round(posts), 1.0e-5);
    }
    const double west = is[0].get<double>() + 0.5 * is[1].get<double>();
    EXPECT_GE(west, -84.26 - 1.0e-9);
    EXPECT_LT(west - is[1].get<double>(), -84.26);
    // The sky-view factor is the mean of cos^2 of the bands.
    const std::vector<double> elevations_deg = values_of(folder / "h.horizon.tif", 3, 5);
    ASSERT_EQ(elevations_deg.size(), 8U);
    double sum = 0.0;
    for (const double elevation_deg : elevations_deg)
        sum += std::pow(std::cos(std::max(0.0, elevation_deg) * 0.017453292519943295), 2);
    EXPECT_NEAR(values_of(folder / "h.sky-view.tif", 3, 5).at(0), sum / 8.0, 1.0e-6);
}

// What lies outside the box hides as well: the same posts have the same values in a larger box.
TEST(HorizonCommand, LooksBeyondItsBox) {
    const fs::path folder = oro::test::scratch_folder();
    const auto sky = [&](const char* name, const char* box) {
        object_said_by({"horizon", bundled(), "-q", "--json", "--radius", "6", "--directions", "6", "--bbox",
                        box, "--out", (folder / name).string()});
        return oro::test::one_object(
            run_program({"gdalinfo", "-json", folder / (fs::path(name).stem().string() + ".sky-view.tif")})
                .out);
    };
    if (run_program({"gdalinfo", "--version"}).exit_code == 127) GTEST_SKIP() << "needs gdalinfo";
    const auto small = sky("small.tif", "-84.26,36.55,-84.25,36.56")["geoTransform"];
    const auto large = sky("large.tif", "-84.28,36.53,-84.23,36.58")["geoTransform"];
    const int right = static_cast<int>(
        std::lround((small[0].get<double>() - large[0].get<double>()) / small[1].get<double>()));
    const int down = static_cast<int>(
        std::lround((small[3].get<double>() - large[3].get<double>()) / small[5].get<double>()));
    EXPECT_GT(right, 5);
    EXPECT_GT(down, 5);
    for (const auto& [column, row] : {std::pair{0, 0}, {4, 7}, {9, 2}})
        EXPECT_EQ(values_of(folder / "small.horizon.tif", column, row),
                  values_of(folder / "large.horizon.tif", column + right, row + down));
}

TEST(HorizonCommand, TheSameCommandWritesTheSameBytes) {
    const fs::path folder = oro::test::scratch_folder();
    for (const char* name : {"a.tif", "b.tif"})
        object_said_by(oro::test::joined(
            {"horizon", bundled(), "-q", "--json", "--radius", "3", "--out", (folder / name).string()},
            small_box));
    EXPECT_EQ(bytes_of(folder / "a.horizon.tif"), bytes_of(folder / "b.horizon.tif"));
    EXPECT_EQ(bytes_of(folder / "a.sky-view.tif"), bytes_of(folder / "b.sky-view.tif"));
}

// QGIS takes three bands for red, green and blue, unless a style beside the raster says otherwise.
TEST(HorizonCommand, HasAStyleForQgisBesideIt) {
    const fs::path folder = oro::test::scratch_folder();
    const Words command = oro::test::joined({"horizon", bundled(), "-q", "--overwrite", "--directions", "4",
                                             "--radius", "1", "--out", (folder / "a.tif").string()},
                                            small_box);
    ASSERT_EQ(run_orograph(command).exit_code, 0);
    EXPECT_EQ(oro::test::names_in(folder), (Words{"a.horizon.qml", "a.horizon.tif", "a.sky-view.tif"}));
    // The style of the plugin.
    EXPECT_EQ(bytes_of(folder / "a.horizon.qml"), bytes_of(oro::test::bundled_data().parent_path() / "apps" /
                                                           "qgis" / "orograph" / "styles" / "horizon.qml"));
    // A user's own stays.
    oro::test::write_bytes(folder / "a.horizon.qml", "mine");
    ASSERT_EQ(run_orograph(command).exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "a.horizon.qml"), "mine");
}

TEST(HorizonCommand, TellsThatTheRadiusLeavesTheData) {
    const auto said = [](const char* radius) {
        return run_orograph(
                   oro::test::joined({"horizon", bundled(), "--overwrite", "--directions", "4", "--radius",
                                      radius, "--out", (oro::test::scratch_folder() / "beyond.tif").string()},
                                     small_box))
            .err;
    };
    EXPECT_EQ(said("3").find("beyond the data"), std::string::npos);
    EXPECT_NE(said("60").find("the radius reaches beyond the data"), std::string::npos);
}

// A disk with room for the first file alone: both are what they were before, or absent.
TEST(HorizonCommand, BothFilesAreWrittenOrNone) {
    const fs::path whole = oro::test::scratch_folder();
    const Words words = oro::test::joined(
        {"horizon", bundled(), "-q", "--radius", "1", "--directions", "4", "--out"}, small_box);
    const auto to = [&](const fs::path& out) {
        Words all = words;
        all.insert(all.begin() + 8, out.string());
        return all;
    };
    ASSERT_EQ(run_orograph(to(whole / "h.tif")).exit_code, 0);
    constexpr std::uintmax_t page = 4096;
    const std::uintmax_t first_pages = (fs::file_size(whole / "h.horizon.tif") + page - 1) / page;
    const std::string session = R"(
        disk=$1 kept=$2 size=$3 there=$4; shift 4
        mount -t tmpfs -o size="$size" none "$disk" 2>/dev/null || exit 99
        if [ "$there" = 1 ]; then printf old >"$disk/h.horizon.tif"; printf 'old, too' >"$disk/h.sky-view.tif"; fi
        "$@" --overwrite; code=$?
        cp -a "$disk/." "$kept"
        exit $code)";
    for (const bool there : {false, true}) {
        const fs::path disk = oro::test::scratch_folder(), kept = oro::test::scratch_folder();
        Words all{"unshare", "--mount"};
        if (geteuid() != 0) all.emplace_back("--map-root-user");
        for (const std::string& word : Words{"sh", "-c", session, "sh", disk, kept,
                                             std::to_string((first_pages + (there ? 2 : 0)) * page),
                                             there ? "1" : "0", OROGRAPH_PROGRAM})
            all.push_back(word);
        const auto outcome = run_program(oro::test::joined(all, to(disk / "h.tif")));
        if (outcome.exit_code == 99 || outcome.err.rfind("unshare:", 0) == 0)
            GTEST_SKIP() << "needs to mount a small file system";
        expect_refusal(outcome, oro::test::failed, {"h.sky-view.tif: cannot be written", "No space left"});
        EXPECT_EQ(oro::test::names_in(kept), there ? (Words{"h.horizon.tif", "h.sky-view.tif"}) : Words{});
        if (!there) continue;
        EXPECT_EQ(bytes_of(kept / "h.horizon.tif"), "old");
        EXPECT_EQ(bytes_of(kept / "h.sky-view.tif"), "old, too");
    }
}

// Stopped at any moment, in each way: both files are there, or none and nothing else.
TEST(HorizonCommand, StoppedItLeavesBothFilesOrNone) {
    int stopped = 0;
    for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
        for (const double after_s : {0.02, 0.1, 0.2, 0.3, 0.4}) {
            const fs::path folder = oro::test::scratch_folder();
            oro::test::Circumstances circumstances;
            circumstances.signal = signal;
            circumstances.signal_after_s = after_s;
            const auto outcome =
                run_orograph(oro::test::joined({"horizon", bundled(), "-q", "--radius", "8", "--directions",
                                                "72", "--out", (folder / "h.tif").string()},
                                               small_box),
                             circumstances);
            const Words names = oro::test::names_in(folder);
            if (outcome.exit_code == 0) {
                EXPECT_EQ(names, (Words{"h.horizon.qml", "h.horizon.tif", "h.sky-view.tif"}));
                continue;
            }
            ++stopped;
            EXPECT_EQ(outcome.exit_code, 128 + signal) << outcome.err;
            EXPECT_TRUE(names.empty()) << names.front();
        }
    }
    EXPECT_GT(stopped, 2);
}

TEST(HorizonCommand, WhatIsWrongIsSaidInOneLine) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string out = (folder / "v.tif").string();
    const auto refused = [&](Words words, int code, const std::string& says) {
        words.insert(words.begin(), {"horizon", bundled(), "-q"});
        expect_refusal(run_orograph(words), code, {says});
    };
    refused({}, 2, "--out: is missing");
    refused({"--out", "v.png"}, 2, "--out v.png: the file's name must end in .tif");
    refused({"--out", out, "--radius", "0"}, 2, "--radius 0: must be between 0.01 and 500");
    refused({"--out", out, "--above", "-3"}, 2, "--above -3: must be 0 or more");
    refused({"--out", out, "--directions", "2"}, 2, "--directions");
    refused({"--out", out, "--bbox", "1,2,3"}, 2, "--bbox 1,2,3: ");
    refused({"--out", out, "--bbox", "8,46,9,47"}, 3, "");
    write_bytes(folder / "there.sky-view.tif", "kept");
    refused({"--out", (folder / "there.tif").string()}, 1, "is there already (--overwrite replaces it)");
    EXPECT_EQ(bytes_of(folder / "there.sky-view.tif"), "kept");
    EXPECT_FALSE(fs::exists(folder / "there.horizon.tif"));
    refused({"--out", "/nowhere/v.tif"}, 1, "/nowhere");
    const fs::path copy = folder / "ground.horizon.tif";
    fs::copy_file(bundled(), copy);
    expect_refusal(run_orograph(oro::test::joined({"horizon", copy.string(), "-q", "--out",
                                                   (folder / "ground.tif").string(), "--overwrite"},
                                                  small_box)),
                   2, {"--out: would replace ", "which the elevation data are in"});
}

}  // namespace
