// orograph viewshed --observers: what thousands of masts see, as one raster and one table.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
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
using oro::test::joined;
using oro::test::object_said_by;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::says;
using oro::test::Words;
using oro::test::write_bytes;

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

class TableObservers : public testing::Test {
  protected:
    [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
    [[nodiscard]] Words words(const std::string& table, const Words& more = {}) const {
        return joined({"viewshed", bundled(), "-q", "--radius", "2", "--observers", table, "--out",
                       file("all.tif"), "--table", file("all.csv")},
                      more);
    }
    fs::path folder_{oro::test::scratch_folder()};
};

// Each has the figures of a viewshed of its own, and the raster those of all of them by the command line. Who
// stands outside the data is left out.
TEST_F(TableObservers, SeeWhatEachSeesAlone) {
    write_bytes(folder_ / "masts.csv",
                "name;lat;lon;above;owner\r\nTower;36.55;-84.25;30;a\r\n\"A; b\";36.57;-84.22;;b\r\n"
                "Far away;46.5;8.0;10;c\r\n;36.52;-84.28;30;d\r\n");
    const auto said = object_said_by(words(file("masts.csv"), {"--json", "--above", "30"}));
    ASSERT_EQ(said["observers"].size(), 3U);
    EXPECT_EQ(said["left_out"], nlohmann::json::array({3}));
    const auto rows = lines_of(bytes_of(folder_ / "all.csv"));
    ASSERT_EQ(rows.size(), 5U);
    EXPECT_EQ(rows[0], "number,name,lat_deg,lon_deg,H_m,h_m,above_m,posts,seen");
    EXPECT_EQ(rows[3], "3,Far away,46.5,8,,,,,");
    EXPECT_TRUE(rows[2].starts_with("2,\"A; b\",36.570000000,-84.220000000,")) << rows[2];
    EXPECT_TRUE(rows[4].starts_with("4,,36.520000000,-84.280000000,")) << rows[4];
    const Words places{"36.55,-84.25", "36.57,-84.22", "36.52,-84.28"};
    Words together{"viewshed", bundled(), "-q", "--radius", "2", "--above", "30", "--out", file("each.tif")};
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto alone = object_said_by({"viewshed", bundled(), "-q", "--json", "--radius", "2", "--above",
                                           "30", "--at", places[i], "--out", file("one.tif"), "--overwrite"});
        EXPECT_EQ(said["observers"][i]["seen"], alone["seen"]) << places[i];
        EXPECT_EQ(said["observers"][i]["cells"], alone["cells"]) << places[i];
        EXPECT_TRUE(
            rows[i < 2 ? i + 1 : 4].ends_with("," + alone["cells"].dump() + "," + alone["seen"].dump()))
            << rows[i < 2 ? i + 1 : 4];
        together.insert(together.end(), {"--at", places[i]});
    }
    ASSERT_EQ(run_orograph(together).exit_code, 0);
    const auto of_table = run_program({"gdalinfo", "-json", "-checksum", file("all.tif")});
    if (of_table.exit_code == 127) GTEST_SKIP() << "needs gdalinfo";
    const auto table = oro::test::one_object(of_table.out);
    const auto each =
        oro::test::one_object(run_program({"gdalinfo", "-json", "-checksum", file("each.tif")}).out);
    ASSERT_EQ(table["bands"].size(), 3U);
    EXPECT_EQ(table["size"], each["size"]);
    EXPECT_EQ(table["metadata"][""]["OBSERVERS"], "3");
    EXPECT_FALSE(table["metadata"][""].contains("OBSERVER_1"));
    for (std::size_t band = 0; band < 3; ++band)
        EXPECT_EQ(table["bands"][band]["checksum"], each["bands"][band]["checksum"]) << band;
}

// A table that is good for --names is good for this.
TEST_F(TableObservers, ColumnsHaveTheirUsualNames) {
    write_bytes(folder_ / "plain.csv", "name,lat,lon,above\nA,36.55,-84.25,30\n");
    ASSERT_EQ(run_orograph(words(file("plain.csv"))).exit_code, 0);
    const std::string plain = bytes_of(folder_ / "all.csv");
    for (const char* const table : {"Name,Latitude,Longitude,Above\nA,36.55,-84.25,30\n",
                                    "NAME;lng;decimalLatitude;above (m)\nA;-84.25;36.55;30\n"}) {
        write_bytes(folder_ / "other.csv", table);
        const auto outcome = run_orograph(words(file("other.csv"), {"--overwrite"}));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(bytes_of(folder_ / "all.csv"), plain) << table;
    }
}

// Whose heights count is always told, and which columns do not; each eye's height is in the table.
TEST_F(TableObservers, HeightsOverTheGroundHaveSeveralNames) {
    const auto reported = [&](const std::string& table, const Words& more = {}) {
        write_bytes(folder_ / "masts.csv", table);
        const auto outcome = run_orograph(words(file("masts.csv"), joined({"--overwrite"}, more)));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const std::size_t at = outcome.out.find("Eyes: ");
        return at == std::string::npos ? "" : outcome.out.substr(at, outcome.out.find('\n', at) - at);
    };
    const auto above_of_first = [&] {
        const std::string row = lines_of(bytes_of(folder_ / "all.csv")).at(1);
        std::vector<std::string> fields;
        std::istringstream stream(row);
        for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
        return fields.at(6);
    };
    EXPECT_EQ(reported("Name,Latitude,Longitude,Height\nA,36.55,-84.25,30\n"),
              "Eyes: by the column Height, in metres above the ground");
    EXPECT_EQ(above_of_first(), "30.000");
    EXPECT_EQ(
        reported("lat,lon,mast_height (m),Owner,Colour\n36.55,-84.25,25,a,b\n36.56,-84.25,,a,b\n"),
        "Eyes: by the column mast_height (m), in metres above the ground; 2 m above the ground where it is "
        "empty; not used: Owner and Colour");
    EXPECT_EQ(above_of_first(), "25.000");
    EXPECT_EQ(reported("lat,lon,height,above\n36.55,-84.25,900,12\n"),
              "Eyes: by the column above, in metres above the ground; not used: height");
    EXPECT_EQ(above_of_first(), "12.000");
    EXPECT_EQ(reported("lat,lon,Eye\n36.55,-84.25,1.7\n"),
              "Eyes: by the column Eye, in metres above the ground");
    EXPECT_EQ(above_of_first(), "1.700");
    EXPECT_EQ(reported("lat,lon,Height (ft),ele\n36.55,-84.25,90,500\n", {"--above", "7"}),
              "Eyes: 7 m above the ground (the table has no column above); not used: Height (ft) and ele");
    EXPECT_EQ(above_of_first(), "7.000");
    const auto said = object_said_by(words(file("masts.csv"), {"--overwrite", "--json"}));
    EXPECT_EQ(said["above_column"], "");
    EXPECT_EQ(said["columns_not_used"], nlohmann::json({"Height (ft)", "ele"}));
}

TEST_F(TableObservers, TwoColumnsOfHeightsAreRefused) {
    for (const char* const headings :
         {"lat,lon,Height,Height", "lat,lon,Height,height", "lat,lon,above,Above"}) {
        write_bytes(folder_ / "two.csv", std::string(headings) + "\n36.55,-84.25,2,300\n");
        const auto outcome = run_orograph(words(file("two.csv"), {"--overwrite"}));
        EXPECT_EQ(outcome.exit_code, 1) << headings;
        EXPECT_NE(outcome.err.find("is the name of several columns"), std::string::npos) << outcome.err;
    }
}

// The bundled tile lies at H 500 m and more here: such heights, below the 1,000 m of which no mast is, were
// masts of as many metres.
TEST_F(TableObservers, HeightsOfTheGroundAboveTheSeaAreRefused) {
    const auto ground = object_said_by(
        {"sight", bundled(), "-q", "--json", "--from", "36.55,-84.25", "--to", "36.57,-84.22"});
    const std::string H = std::to_string(std::lround(ground["from"]["H_m"].get<double>()) - 2 + 10);
    write_bytes(folder_ / "masts.csv", "lat,lon,Height\n36.55,-84.25," + H + "\n");
    const auto outcome = run_orograph(words(file("masts.csv")));
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_TRUE(says(outcome.err,
                     "masts.csv, column Height: has the ground's own heights above the sea (place 1: " + H +
                         ", where the ground lies at H "))
        << outcome.err;
    // Under a name that leaves no doubt it is taken; and so are masts, and turbines of one model.
    for (const std::string& table :
         {"lat,lon,above\n36.55,-84.25," + H + "\n", std::string("lat,lon,Height\n36.55,-84.25,45\n"),
          "lat,lon,Height\n36.55,-84.25," + H + "\n36.5501,-84.25," + H + "\n"}) {
        write_bytes(folder_ / "masts.csv", table);
        const auto taken = run_orograph(words(file("masts.csv"), {"--overwrite"}));
        EXPECT_EQ(taken.exit_code, 0) << table << taken.err;
    }
}

// How the file was read is said, of observers as of names.
TEST_F(TableObservers, NotesOfTheFileAreSaid) {
    write_bytes(folder_ / "masts.csv", "name,lat,lon\nGr\xfcn,36.55,-84.25\n");
    const auto outcome = run_orograph(joined(
        {"viewshed", bundled(), "--radius", "2", "--observers", file("masts.csv"), "--out", file("all.tif")},
        {}));
    EXPECT_TRUE(says(outcome.err, "note: " + file("masts.csv") + ": is no UTF-8 and is read as Windows-1252"))
        << outcome.err;
}

// As --names reads them.
TEST_F(TableObservers, DecimalCommasAreReadAndTold) {
    write_bytes(folder_ / "masts.csv", "lat;lon;above\n36,55;-84,25;1,5\n36,56;-84,25;2\n");
    const auto outcome =
        run_orograph({"viewshed", bundled(), "--radius", "2", "--observers", file("masts.csv"), "--out",
                      file("all.tif"), "--table", file("all.csv")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(says(outcome.err,
                     "note: " + file("masts.csv") + ": has commas for decimals: '36,55' is read as 36.55"))
        << outcome.err;
    const auto rows = lines_of(bytes_of(folder_ / "all.csv"));
    EXPECT_TRUE(rows.at(1).starts_with("1,,36.550000000,-84.250000000,")) << rows[1];
    EXPECT_TRUE(says(rows[1], ",1.500,")) << rows[1];
    write_bytes(folder_ / "masts.csv", "lat;lon;above\n36,55;-84,25;1,500\n");
    expect_refusal(run_orograph(words(file("masts.csv"), {"--overwrite"})), oro::test::failed,
                   {"place 1: above: \"1,500\" is no number"});
}

// Points of a vector file, and what is told without --json.
TEST_F(TableObservers, OfAVectorFile) {
    write_bytes(folder_ / "masts.geojson",
                R"({"type": "FeatureCollection", "features": [
                    {"type": "Feature", "properties": {"name": "One", "above": 40},
                     "geometry": {"type": "Point", "coordinates": [-84.25, 36.55]}},
                    {"type": "Feature", "properties": {"name": "Two"},
                     "geometry": {"type": "Point", "coordinates": [7.5, 46.5]}}]})");
    const auto outcome = run_orograph(words(file("masts.geojson")));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(says(
        outcome.out,
        "Observers: 1 of " + file("masts.geojson") +
            "; 1 stands where there are no elevation data and is left out, place 2 "
            "(Two)\nEyes: by the column above, in metres above the ground; 2 m above the ground where it "
            "is empty\nLight: "))
        << outcome.out;
}

TEST_F(TableObservers, WhatIsWrongIsSaidInOneLine) {
    const auto refused = [&](const std::string& table, int code, const std::string& what) {
        write_bytes(folder_ / "masts.csv", table);
        expect_refusal(run_orograph(words(file("masts.csv"))), code, {what});
        EXPECT_FALSE(fs::exists(file("all.tif")) || fs::exists(file("all.csv")));
    };
    using oro::test::failed, oro::test::usage, oro::test::no_data;
    refused("name,lat\nA,36.5\n", failed, "masts.csv, place 1 (A): lat and lon: are missing");
    refused("lat,lon\n36.5,-84.2\n36.5,west\n", failed, "masts.csv, place 2: lon: \"west\" is no number");
    refused("lat,lon\n36.5,1e400\n", failed, "masts.csv, place 1: lon: \"1e400\" is no number");
    refused("lat,lon\n96.5,-84.2\n", usage, "masts.csv, place 1: --observers 96.5,-84.2: ");
    refused("lat,lon,above\n36.5,-84.2,-3\n", usage, "masts.csv, place 1: above -3: must be 0 or more");
    refused("lat,lon,Height\n36.5,-84.2,1200\n", failed,
            "masts.csv, place 1: Height 1200: is no height of a mast over the ground");
    refused("lat,lon\n36.5,\n", failed, "masts.csv, place 1: lon: is empty");
    refused("name,lat,lon\n\"A,36.5,-84.2\nB,36.6,-84.2\n", failed,
            "masts.csv: line 2 has a quotation mark without an end");
    refused("lat,lon\n36.5,-84.2,8\n", failed, "masts.csv: line 2 has 3 fields, and the first line names 2");
    refused("lat,lon\n46.5,8.2\n", no_data, "masts.csv, place 1: ");
    refused("", failed, "masts.csv: has no places");
    write_bytes(folder_ / "masts.csv", "lat,lon\n36.55,-84.25\n");
    const std::string masts = file("masts.csv");
    expect_refusal(run_orograph(words(masts, {"--at", "36.5,-84.2"})), usage,
                   {"--observers " + masts + ": is not to be given with --at"});
    expect_refusal(run_orograph({"viewshed", bundled(), "--at", "36.5,-84.2", "--table", "a.csv", "--out",
                                 file("all.tif")}),
                   usage, {"--table a.csv: needs --observers FILE"});
    expect_refusal(run_orograph({"viewshed", bundled(), "--observers", masts, "--table", "a.txt", "--out",
                                 file("all.tif")}),
                   usage, {"--table a.txt: the file's name must end in .csv"});
    // It is not replaced by what is made of it.
    expect_refusal(run_orograph({"viewshed", bundled(), "--observers", masts, "--table", masts, "--overwrite",
                                 "--radius", "1", "--out", file("all.tif")}),
                   usage, {"--table: would replace " + masts + ", which the observers are in"});
    EXPECT_EQ(bytes_of(masts), "lat,lon\n36.55,-84.25\n");
}

// A line of a list; given again it is not done again.
TEST_F(TableObservers, AreALineOfABatch) {
    write_bytes(folder_ / "masts.csv", "lat,lon\n36.55,-84.25\n36.57,-84.22\n");
    const nlohmann::json shed{{"command", "viewshed"},          {"path", bundled()},
                              {"observers", file("masts.csv")}, {"radius", 1},
                              {"out", file("all.tif")},         {"table", file("all.csv")}};
    const nlohmann::json around{
        {"command", "horizon"}, {"path", bundled()}, {"bbox", "-84.26,36.55,-84.25,36.56"},
        {"radius", 1},          {"directions", 4},   {"out", file("h.tif")}};
    write_bytes(folder_ / "jobs.jsonl", shed.dump() + "\n" + around.dump() + "\n");
    const Words batch{"batch", file("jobs.jsonl"), "--json"};
    const auto first = object_said_by(batch);
    EXPECT_EQ(first["lines"]["done"], 2);
    EXPECT_EQ(first["each"][0]["files"].size(), 3U);  // a style for QGIS, too
    EXPECT_EQ(first["each"][1]["files"].size(), 3U);  // likewise
    EXPECT_EQ(object_said_by(batch)["lines"]["kept"], 2);
    // One of a pair has gone: the line is done again.
    fs::remove(file("h.sky-view.tif"));
    fs::remove(file("h.horizon.tif"));
    const auto again = object_said_by(batch);
    EXPECT_EQ(again["lines"]["done"], 1);
    EXPECT_TRUE(fs::exists(file("h.sky-view.tif")));
    // Another line that would write one of the files of a horizon is refused.
    write_bytes(folder_ / "clash.jsonl", around.dump() + "\n" +
                                             nlohmann::json({{"command", "viewshed"},
                                                             {"path", bundled()},
                                                             {"at", "36.55,-84.25"},
                                                             {"out", file("h.sky-view.tif")}})
                                                 .dump() +
                                             "\n");
    const auto clash = run_orograph({"batch", file("clash.jsonl"), "--check"});
    EXPECT_EQ(clash.exit_code, oro::test::failed);
    EXPECT_TRUE(says(clash.err, "h.sky-view.tif: is what line 1 writes")) << clash.err;
}

}  // namespace
