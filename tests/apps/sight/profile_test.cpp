// orograph profile as people and programs use it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/csv_rows.h"
#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::write_bytes;
namespace fs = std::filesystem;

const std::string line_of_three = "36.5,-84.2; 36.55,-84.35; 36.6,-84.3";

const std::string names_of_columns = "distance_m,lat_deg,lon_deg,H_m,h_m";

TEST(ProfileCommand, ATableHasTheSumsThatAreTold) {
    const fs::path out = oro::test::scratch_folder() / "p.csv";
    const auto reported = object_said_by(
        {"profile", bundled(), "-q", "--json", "--along", line_of_three, "--out", out.string()});
    const auto rows = oro::test::rows_of(bytes_of(out), names_of_columns);
    ASSERT_EQ(rows.size(), reported["points"].get<std::size_t>());
    double ascent_m = 0.0, descent_m = 0.0, highest_m = -1e9;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ASSERT_EQ(rows[i].size(), 5U);
        highest_m = std::max(highest_m, rows[i][3]);
        // Over Tennessee N is some -31 m.
        EXPECT_NEAR(rows[i][4] - rows[i][3], -31.0, 2.0);
        if (i == 0) continue;
        EXPECT_GT(rows[i][0], rows[i - 1][0]);
        const double rise_m = rows[i][3] - rows[i - 1][3];
        (rise_m > 0 ? ascent_m : descent_m) += std::abs(rise_m);
    }
    EXPECT_NEAR(ascent_m, reported["ascent_m"].get<double>(), 1.0);
    EXPECT_NEAR(descent_m, reported["descent_m"].get<double>(), 1.0);
    EXPECT_NEAR(highest_m, reported["highest"]["H_m"].get<double>(), 0.001);
    EXPECT_EQ(rows.front()[0], 0.0);
    // Vincenty's formulae (Survey Review 23, 1975): 14535.0160 m and 7128.3499 m.
    EXPECT_NEAR(rows.back()[0], 14535.0160 + 7128.3499, 1e-3);
}

TEST(ProfileCommand, TheSumThatGuidesUseIsToldWithItsThreshold) {
    const oro::test::Words line{"profile", bundled(), "-q", "--along", line_of_three};
    const auto with = [&](const oro::test::Words& more) { return oro::test::joined(line, more); };
    const auto usual = object_said_by(with({"--json"}));
    EXPECT_EQ(usual["over_threshold"]["threshold_m"], 10.0);
    EXPECT_LT(usual["over_threshold"]["ascent_m"].get<double>(), usual["ascent_m"].get<double>());
    EXPECT_LT(usual["over_threshold"]["descent_m"].get<double>(), usual["descent_m"].get<double>());
    const auto every = object_said_by(with({"--json", "--climb-threshold", "0"}));
    EXPECT_NEAR(every["over_threshold"]["ascent_m"].get<double>(), every["ascent_m"].get<double>(), 1e-6);
    const Outcome reported = run_orograph(with({"--climb-threshold", "25"}));
    EXPECT_TRUE(oro::test::says(reported.out, " m, in rises and falls of 25 m or more\n")) << reported.out;
    expect_refusal(run_orograph(with({"--climb-threshold", "-1"})), 2,
                   {"--climb-threshold -1: must be between 0 and 10000"});
}

TEST(ProfileCommand, StepsAreAsAskedFor) {
    const fs::path out = oro::test::scratch_folder() / "p.csv";
    object_said_by({"profile", bundled(), "-q", "--json", "--along", line_of_three, "--out", out.string(),
                    "--step", "1000"});
    const auto rows = oro::test::rows_of(bytes_of(out), names_of_columns);
    ASSERT_GT(rows.size(), 10U);
    for (std::size_t i = 0; i + 1 < rows.size(); ++i)
        EXPECT_NEAR(rows[i][0], 1000.0 * static_cast<double>(i), 1e-3);
}

TEST(ProfileCommand, ADrawingNamesItsAxesAndItsExaggeration) {
    const fs::path out = oro::test::scratch_folder() / "p.svg";
    const Outcome outcome =
        run_orograph({"profile", bundled(), "--along", line_of_three, "--out", out.string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string svg = bytes_of(out);
    for (const char* words : {"<svg xmlns=", "distance along the line, km", "H: height above sea level, m",
                              "times as large as distances", "36.500000,-84.200000 to 36.600000,-84.300000",
                              "class=\"surface\"", "</svg>"})
        EXPECT_NE(svg.find(words), std::string::npos) << words;
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST(ProfileCommand, ALineThatLeavesTheDataIsCut) {
    const fs::path out = oro::test::scratch_folder() / "p.geojson";
    const auto reported =
        object_said_by({"profile", bundled(), "-q", "--json", "--along",
                        "36.5,-84.2; 36.5,-83.9; 36.55,-83.9; 36.55,-84.2", "--out", out.string()});
    EXPECT_GT(reported["without_data_m"].get<double>(), 1000.0);
    const auto feature = nlohmann::json::parse(bytes_of(out));
    EXPECT_EQ(feature["type"], "Feature");
    EXPECT_EQ(feature["geometry"]["type"], "MultiLineString");
    const auto& parts = feature["geometry"]["coordinates"];
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(feature["properties"]["H_m"].size(), 2U);
    EXPECT_EQ(feature["properties"]["H_m"][1].size(), parts[1].size());
    EXPECT_NEAR(parts[0][0][0].get<double>(), -84.2, 1e-9);
    EXPECT_NEAR(parts[0][0][1].get<double>(), 36.5, 1e-9);
}

// Flat ground on both sides of the 180th meridian, a post every 0.01 degrees.
std::string ground_over_180(const fs::path& folder) {
    std::string text = "ncols 61\nnrows 21\nxllcorner 179.695\nyllcorner -17.105\ncellsize 0.01\n";
    for (int row = 0; row < 21; ++row) {
        for (int column = 0; column < 61; ++column) text += "120 ";
        text += "\n";
    }
    write_bytes(folder / "flat.asc", text);
    write_bytes(folder / "flat.prj",
                "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS "
                "84\",6378137,298.257223563]],PRIMEM[\"Greenwich\","
                "0],UNIT[\"degree\",0.0174532925199433]]");
    return (folder / "flat.asc").string();
}

// RFC 7946, 3.1.9: parts end at 180 and begin at -180. Whatever was asked between was lost.
TEST(ProfileCommand, ALineOverThe180thMeridianIsWhole) {
    const fs::path folder = oro::test::scratch_folder(), out = folder / "p.geojson";
    const std::string ground = ground_over_180(folder);
    write_bytes(folder / "line.geojson",
                R"({"type":"LineString","coordinates":[[179.9,-17],[-179.9,-17.02]]})");
    for (const std::vector<std::string>& more :
         {std::vector<std::string>{"--step", "2000"}, {"--step", "50000"}, {}}) {
        std::vector<std::string> words{"profile",
                                       ground,
                                       "-q",
                                       "--json",
                                       "--overwrite",
                                       "--along",
                                       (folder / "line.geojson").string(),
                                       "--out",
                                       out.string()};
        words.insert(words.end(), more.begin(), more.end());
        object_said_by(words);
        const auto feature = nlohmann::json::parse(bytes_of(out));
        const auto& parts = feature["geometry"]["coordinates"];
        ASSERT_EQ(parts.size(), 2U);
        EXPECT_EQ(parts[0][0][0].get<double>(), 179.9);
        EXPECT_EQ(parts[0].back()[0].get<double>(), 180.0);
        EXPECT_EQ(parts[1][0][0].get<double>(), -180.0);
        EXPECT_EQ(parts[1].back()[0].get<double>(), -179.9);
        EXPECT_EQ(parts[1][0][1], parts[0].back()[1]);
        EXPECT_EQ(parts[1][0][2], parts[0].back()[2]);
        // The middle of the line but for its curve: 3.4e-5 degrees of latitude are 4 m.
        EXPECT_NEAR(parts[1][0][1].get<double>(), -17.01, 5e-5);
        for (std::size_t i : {0U, 1U}) {
            EXPECT_EQ(feature["properties"]["H_m"][i].size(), parts[i].size());
            EXPECT_EQ(feature["properties"]["distance_m"][i].size(), parts[i].size());
        }
        EXPECT_EQ(feature["properties"]["H_m"][1][0].get<double>(), 120.0);
    }
}

TEST(ProfileCommand, FilesHaveLinesOrAreRefused) {
    const fs::path folder = oro::test::scratch_folder();
    const auto file = [&](const std::string& name, const std::string& text) {
        write_bytes(folder / name, text);
        return (folder / name).string();
    };
    const auto refused = [&](const std::string& path, int code, const std::string& says) {
        expect_refusal(run_orograph({"profile", bundled(), "-q", "--along", path}), code, {says});
    };
    const std::string geojson_line =
        R"({"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[-84.2,36.5],[-84.3,36.55]]}})";
    const std::string one = file("one.geojson", geojson_line);
    EXPECT_NEAR(
        object_said_by({"profile", bundled(), "-q", "--json", "--along", one})["length_m"].get<double>(),
        object_said_by(
            {"profile", bundled(), "-q", "--json", "--along", "36.5,-84.2;36.55,-84.3"})["length_m"]
            .get<double>(),
        1e-6);
    const std::string two = file("two.geojson", R"({"type":"FeatureCollection","features":[)" + geojson_line +
                                                    "," + geojson_line + "]}");
    refused(two, 2, "holds 2 lines: say which by --line 1 to 2");
    EXPECT_EQ(run_orograph({"profile", bundled(), "-q", "--along", two, "--line", "2"}).exit_code, 0);
    expect_refusal(run_orograph({"profile", bundled(), "-q", "--along", two, "--line", "3"}), 2,
                   {"--line 3: ", "holds 2 lines only"});
    refused(
        file("point.geojson",
             R"({"type":"Feature","properties":{},"geometry":{"type":"Point","coordinates":[-84.2,36.5]}})"),
        2, "holds no line, but 1 point and 0 polygons");
    refused(file("empty.gpx", ""), 1, "empty.gpx: ");
    refused(file("cut.gpx",
                 "<?xml version=\"1.0\"?><gpx version=\"1.1\" creator=\"x\"><trk><trkseg><trkpt lat=\"36"),
            1, "cut.gpx: ");
    refused((folder / "none.gpx").string(), 1, "none.gpx: ");
    refused(file("crs.geojson",
                 R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:1"}},)"
                 R"("features":[)" +
                     geojson_line + "]}"),
            1, "crs.geojson: ");
}

TEST(ProfileCommand, AMillionPlacesAreALine) {
    const fs::path path = oro::test::scratch_folder() / "long.geojson";
    {
        std::ofstream out(path);
        out << R"({"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[)";
        for (int i = 0; i < 1000000; ++i)
            out << (i > 0 ? "," : "") << "[" << -84.2 - 1e-7 * i << "," << 36.5 + 0.01 * (i % 2) * 1e-3
                << "]";
        out << "]}}";
    }
    const auto reported = object_said_by({"profile", bundled(), "-q", "--json", "--along", path.string()});
    EXPECT_EQ(reported["places"], 1000000);
}

TEST(ProfileCommand, WhatIsWrongIsSaidInOneLine) {
    const std::string data = bundled();
    const auto refused = [&](std::vector<std::string> words, int code, const std::string& says) {
        words.insert(words.begin(), {"profile", data, "-q"});
        expect_refusal(run_orograph(words), code, {says});
    };
    refused({}, 2, "--along: is missing");
    refused({"--along", "36.5,-84.2"}, 2, "--along 36.5,-84.2: is one place");
    refused({"--along", "36.5,-84.2;"}, 2, "is one place");
    refused({"--along", "36.5,-84.2; Eiger"}, 2, "--along  Eiger: ");
    refused({"--along", "36.5,-84.2; 36.5,-84.2"}, 2, "has no length");
    refused({"--along", line_of_three, "--step", "0"}, 2, "--step 0: must be more than 0");
    refused({"--along", line_of_three, "--step", "1e-4"}, 2, "makes more than 10,000,000 places");
    refused({"--along", line_of_three, "--line", "1"}, 2, "--line 1: is for files");
    refused({"--along", line_of_three, "--out", "p.png"}, 2,
            "--out p.png: the file's name must end in .csv, .svg or .geojson");
    refused({"--along", "46,8; 46,9"}, 3, "no elevation data along the line (the data's box is ");
    const fs::path there = oro::test::scratch_folder() / "there.csv";
    write_bytes(there, "kept");
    refused({"--along", line_of_three, "--out", there.string()}, 1,
            "is there already (--overwrite replaces it)");
    EXPECT_EQ(bytes_of(there), "kept");
}

}  // namespace
