// orograph viewshed as people and programs use it.
#include <gtest/gtest.h>

#include <cmath>
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

// What gdallocationinfo says of a place: a value for each band.
Words values_at(const fs::path& file, const std::string& lon, const std::string& lat) {
    const auto outcome = run_program({"gdallocationinfo", "-valonly", "-wgs84", file.string(), lon, lat});
    Words values;
    std::string value;
    for (const char c : outcome.out) {
        if (c == '\n') {
            if (!value.empty()) values.push_back(value);
            value.clear();
        } else {
            value += c;
        }
    }
    return values;
}

TEST(ViewshedCommand, IsAGeoTiffThatSaysWhatSightSays) {
    const fs::path out = oro::test::scratch_folder() / "v.tif";
    const auto reported =
        object_said_by({"viewshed", bundled(), "-q", "--json", "--at", "36.5,-84.2", "--above", "30",
                        "--target", "2", "--radius", "8", "--out", out.string()});
    EXPECT_GT(reported["seen"].get<int>(), 100);
    EXPECT_LT(reported["seen"].get<int>(), reported["cells"].get<int>());
    const auto info = run_program({"gdalinfo", "-json", out.string()});
    if (info.exit_code == 127) GTEST_SKIP() << "needs gdalinfo";
    const auto raster = oro::test::one_object(info.out);
    EXPECT_NE(raster["coordinateSystem"]["wkt"].get<std::string>().find("WGS 84"), std::string::npos);
    EXPECT_EQ(raster["bands"].size(), 2U);
    EXPECT_EQ(raster["bands"][0]["noDataValue"], -9999.0);
    EXPECT_EQ(raster["metadata"][""]["TARGET_ABOVE_GROUND_M"], "2");
    EXPECT_EQ(raster["size"][0], reported["columns"]);
    const auto corners = raster["geoTransform"];
    // Of some posts, seen and hidden: what sight says of the same place.
    int compared = 0;
    for (int step = -6; step <= 6; ++step) {
        if (step == 0) continue;
        const double column = reported["columns"].get<int>() / 2 + step * 9,
                     row = reported["rows"].get<int>() / 2 + step * 5;
        const double lon = corners[0].get<double>() + (column + 0.5) * corners[1].get<double>();
        const double lat = corners[3].get<double>() + (row + 0.5) * corners[5].get<double>();
        char to[80], east[40], north[40];
        std::snprintf(east, sizeof east, "%.12f", lon);
        std::snprintf(north, sizeof north, "%.12f", lat);
        std::snprintf(to, sizeof to, "%.12f,%.12f", lat, lon);
        const Words values = values_at(out, east, north);
        ASSERT_EQ(values.size(), 2U);
        const auto sight = object_said_by({"sight", bundled(), "-q", "--json", "--from", "36.5,-84.2",
                                           "--above", "30", "--to", to, "--target", "2"});
        EXPECT_EQ(values[0] == "1", sight["visible"].get<bool>()) << to;
        EXPECT_NEAR(std::stod(values[1]), sight["target_missed_by_m"].get<double>(), 0.02) << to;
        ++compared;
    }
    EXPECT_EQ(compared, 12);
}

// Of a projected file: on its own grid, in its own CRS, and what sight says of the same places.
TEST(ViewshedCommand, OfAProjectedFileLiesOnItsOwnPosts) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string utm = folder / "utm.tif";
    const auto warped = run_program({"gdalwarp", "-q", "-t_srs", "EPSG:32616", "-tr", "80", "80", "-r",
                                     "bilinear", "-dstnodata", "-9999", bundled(), utm});
    if (warped.exit_code == 127) GTEST_SKIP() << "needs gdalwarp";
    const fs::path out = folder / "v.tif";
    const auto reported = object_said_by({"viewshed", utm, "-q", "--json", "--at", "36.55,-84.25", "--above",
                                          "30", "--target", "2", "--radius", "6", "--out", out.string()});
    EXPECT_GT(reported["seen"].get<int>(), 100);
    EXPECT_LT(reported["seen"].get<int>(), reported["cells"].get<int>());
    const auto raster = oro::test::one_object(run_program({"gdalinfo", "-json", out.string()}).out);
    const auto source = oro::test::one_object(run_program({"gdalinfo", "-json", utm}).out);
    EXPECT_EQ(raster["coordinateSystem"]["wkt"], source["coordinateSystem"]["wkt"]);
    const auto is = raster["geoTransform"], was = source["geoTransform"];
    for (const std::size_t i : {1U, 2U, 4U, 5U}) EXPECT_EQ(is[i], was[i]);
    for (const std::size_t i : {0U, 3U}) {
        const double posts = (is[i].get<double>() - was[i].get<double>()) / 80.0;
        EXPECT_NEAR(posts, std::round(posts), 1e-9) << "a whole number of posts apart";
    }
    int compared = 0;
    for (int step = -6; step <= 6; ++step) {
        if (step == 0) continue;
        const double column = reported["columns"].get<int>() / 2 + step * 9,
                     row = reported["rows"].get<int>() / 2 + step * 5;
        char x[40], y[40];
        std::snprintf(x, sizeof x, "%.3f", is[0].get<double>() + (column + 0.5) * 80.0);
        std::snprintf(y, sizeof y, "%.3f", is[3].get<double>() - (row + 0.5) * 80.0);
        const auto at = run_program({"gdallocationinfo", "-valonly", "-geoloc", out.string(), x, y});
        double lon = 0.0, lat = 0.0;
        const auto piped = run_program(
            {"sh", "-c",
             std::string("echo ") + x + " " + y + " | gdaltransform -s_srs EPSG:32616 -t_srs EPSG:4326"});
        ASSERT_EQ(std::sscanf(piped.out.c_str(), "%lf %lf", &lon, &lat), 2) << piped.out << piped.err;
        char to[80];
        std::snprintf(to, sizeof to, "%.12f,%.12f", lat, lon);
        double seen = 0.0, missed_m = 0.0;
        ASSERT_EQ(std::sscanf(at.out.c_str(), "%lf %lf", &seen, &missed_m), 2) << at.out;
        if (seen == -9999.0) continue;
        const auto sight = object_said_by({"sight", utm, "-q", "--json", "--from", "36.55,-84.25", "--above",
                                           "30", "--to", to, "--target", "2"});
        EXPECT_EQ(seen == 1.0, sight["visible"].get<bool>()) << to;
        EXPECT_NEAR(missed_m, sight["target_missed_by_m"].get<double>(), 0.02) << to;
        ++compared;
    }
    EXPECT_GE(compared, 10);
}

TEST(ViewshedCommand, SeveralObserversAreCounted) {
    const fs::path folder = oro::test::scratch_folder();
    const auto shed = [&](const char* name, const Words& places) {
        Words words{"viewshed", bundled(), "-q",    "--json",
                    "--radius", "5",       "--out", (folder / name).string()};
        for (const std::string& place : places) words.insert(words.end(), {"--at", place});
        return object_said_by(words);
    };
    const auto one = shed("1.tif", {"36.5,-84.2"}), other = shed("2.tif", {"36.52,-84.22"});
    const auto both = shed("3.tif", {"36.5,-84.2", "36.52,-84.22"});
    EXPECT_EQ(both["observers"].size(), 2U);
    EXPECT_GE(both["seen"].get<int>(), one["seen"].get<int>());
    EXPECT_GE(both["seen"].get<int>(), other["seen"].get<int>());
    EXPECT_LE(both["seen"].get<int>(), one["seen"].get<int>() + other["seen"].get<int>());
    EXPECT_GT(both["cells"].get<int>(), one["cells"].get<int>());
}

// The bundled region is 36.45 to 36.73 N and 84.41 to 84.08 W: 5 km around the place are in it, 60 km leave
// it.
TEST(ViewshedCommand, TellsThatACircleLeavesTheData) {
    const auto said = [](const char* at, const char* radius) {
        const std::string out = (oro::test::scratch_folder() / "beyond.tif").string();
        return run_orograph(
                   {"viewshed", bundled(), "--overwrite", "--at", at, "--radius", radius, "--out", out})
            .err;
    };
    EXPECT_EQ(said("36.5,-84.2", "5").find("beyond the data"), std::string::npos);
    EXPECT_NE(said("36.5,-84.2", "60")
                  .find("the circle reaches beyond the data (north, east, south, west): what is seen there "
                        "is not in"),
              std::string::npos);
}

TEST(ViewshedCommand, TheSameCommandWritesTheSameBytes) {
    const fs::path folder = oro::test::scratch_folder();
    for (const char* name : {"a.tif", "b.tif"})
        object_said_by({"viewshed", bundled(), "-q", "--json", "--at", "36.5,-84.2", "--radius", "3", "--out",
                        (folder / name).string()});
    EXPECT_EQ(bytes_of(folder / "a.tif"), bytes_of(folder / "b.tif"));
    EXPECT_EQ(oro::test::names_in(folder), (Words{"a.tif", "b.tif"}));
}

// QGIS takes three bands for red, green and blue, unless a style beside the raster says otherwise.
TEST(ViewshedCommand, OfThreeBandsHasAStyleForQgisBesideIt) {
    const fs::path folder = oro::test::scratch_folder();
    const Words shed{"viewshed",   bundled(),     "-q",          "--at",
                     "36.5,-84.2", "--at",        "36.52,-84.2", "--radius",
                     "2",          "--overwrite", "--out",       (folder / "a.tif").string()};
    ASSERT_EQ(run_orograph(shed).exit_code, 0);
    EXPECT_EQ(oro::test::names_in(folder), (Words{"a.qml", "a.tif"}));
    // The style of the plugin.
    EXPECT_EQ(bytes_of(folder / "a.qml"), bytes_of(oro::test::bundled_data().parent_path() / "apps" / "qgis" /
                                                   "orograph" / "styles" / "viewshed.qml"));
    // A user's own stays.
    write_bytes(folder / "a.qml", "mine");
    ASSERT_EQ(run_orograph(shed).exit_code, 0);
    EXPECT_EQ(bytes_of(folder / "a.qml"), "mine");
    const auto shown = oro::test::run_program({"gdalinfo", "-json", (folder / "a.tif").string()});
    if (shown.exit_code == 127) GTEST_SKIP() << "needs gdalinfo";
    const auto bands = oro::test::one_object(shown.out)["bands"];
    ASSERT_EQ(bands.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(bands[i]["colorInterpretation"], i == 0 ? "Gray" : "Undefined") << i;
        EXPECT_EQ(bands[i]["noDataValue"], -9999.0) << i;
    }
    EXPECT_EQ(bands[0]["description"], "seen (1) or hidden (0)");
    EXPECT_EQ(bands[1]["description"], "missed by, metres of height (0: seen)");
    EXPECT_EQ(bands[2]["description"], "observers that see it");
}

TEST(ViewshedCommand, WhatIsWrongIsSaidInOneLine) {
    const fs::path there = oro::test::scratch_folder() / "there.tif";
    write_bytes(there, "kept");
    const auto refused = [&](Words words, int code, const std::string& says) {
        words.insert(words.begin(), {"viewshed", bundled(), "-q"});
        expect_refusal(run_orograph(words), code, {says});
    };
    const std::string out = (oro::test::scratch_folder() / "v.tif").string();
    refused({"--out", out}, 2, "--at: is missing");
    refused({"--at", "36.5,-84.2"}, 2, "--out: is missing");
    refused({"--at", "36.5,-84.2", "--out", "v.png"}, 2, "--out v.png: the file's name must end in .tif");
    refused({"--at", "36.5,-84.2", "--at", "here", "--out", out}, 2, "--at here: ");
    refused({"--at", "36.5,-84.2", "--out", out, "--radius", "0"}, 2,
            "--radius 0: must be between 0.01 and 1000");
    refused({"--at", "36.5,-84.2", "--out", out, "--target", "-3"}, 2, "--target -3: must be 0 or more");
    refused({"--at", "46,8", "--out", out}, 3, "--at 46.000000,8.000000: no elevation data there");
    refused({"--at", "geo:46,8,5000", "--out", out}, 3, "no elevation data within the radius");
    refused({"--at", "36.5,-84.2", "--out", there.string()}, 1, "is there already (--overwrite replaces it)");
    EXPECT_EQ(bytes_of(there), "kept");
    refused({"--at", "36.5,-84.2", "--out", "/nowhere/v.tif"}, 1, "/nowhere");
    const fs::path copy = oro::test::scratch_folder() / "ground.tif";
    fs::copy_file(bundled(), copy);
    expect_refusal(run_orograph({"viewshed", copy.string(), "-q", "--at", "36.5,-84.2", "--out",
                                 copy.string(), "--overwrite"}),
                   2, {"--out: would replace ", "which the elevation data are in"});
}

}  // namespace
