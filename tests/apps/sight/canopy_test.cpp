// --canopy as users meet it: what hides, what is told of it, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::no_data;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::says;
using oro::test::usage;
using oro::test::view_in;
using oro::test::Words;

constexpr int wood_rows = 81, wood_columns = 121;

// A plain of 500 m in UTM zone 32, posts 10 m apart; over it a row of spruces of 20 m, from north to south.
class CanopyCommand : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();

    [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
    // The GeoTIFF that GDAL's program makes of an ASCII grid; "" where there is no such program.
    [[nodiscard]] std::string written(const std::string& name, const char* type,
                                      const std::function<double(int row, int column)>& value) const {
        std::ofstream grid(path(name + ".asc"));
        grid << "ncols " << wood_columns << "\nnrows " << wood_rows
             << "\nxllcorner 500000\nyllcorner 5149190\ncellsize 10\n";
        for (int row = 0; row < wood_rows; ++row)
            for (int column = 0; column < wood_columns; ++column)
                grid << value(row, column) << (column + 1 < wood_columns ? ' ' : '\n');
        grid.close();
        const Outcome made = run_program({"gdal_translate", "-q", "-ot", type, "-a_srs", "EPSG:32632",
                                          path(name + ".asc"), path(name + ".tif")});
        return made.exit_code == 0 ? path(name + ".tif") : "";
    }
    static double spruce_m(int, int column) { return column == 60 ? 20.0 : 0.0; }

    const std::string plain = written("plain", "Float32", [](int, int) { return 500.0; });
    const std::string spruce = written("spruce", "Float32", spruce_m);
    void SetUp() override {
        if (plain.empty() || spruce.empty()) GTEST_SKIP() << "needs gdal_translate";
    }
    // The middle of a cell of row 40.
    [[nodiscard]] static std::string at(int column) {
        return std::to_string(500005 + 10 * column) + ",5149595";
    }
    [[nodiscard]] Words sight(const Words& more) const {
        return joined({"sight", plain, "--coordinates", "EPSG:32632", "--refraction", "0", "--from", at(10),
                       "--to", at(110), "--target", "32"},
                      more);
    }
    [[nodiscard]] Words viewshed(const std::string& data, const Words& more) const {
        return joined({"viewshed", data, "--coordinates", "EPSG:32632", "-q", "--json", "--at", at(10),
                       "--radius", "1.2", "--overwrite", "--out", path("seen.tif")},
                      more);
    }
};

// By hand: half way the line from 2 to 32 m is 17 m high, and 0.02 m less over the round Earth; the tops are
// 20 m high, and the target twice as far away as they: 2 * 3.02 m.
TEST_F(CanopyCommand, SaysThatSixMetresOfSpruceHideTheTarget) {
    EXPECT_TRUE(object_said_by(sight({"-q", "--json"}))["visible"].get<bool>());
    const json report = object_said_by(sight({"-q", "--json", "--canopy", spruce}));
    EXPECT_FALSE(report["visible"].get<bool>());
    EXPECT_NEAR(report["target_missed_by_m"].get<double>(), 6.04, 0.02);
    EXPECT_EQ(report["obstacle"]["is"], "canopy");
    // Where the line enters the trees, which rise by 2 m a metre to the post of 20 m: there the line is
    // 2 + 0.03 * 498.5 - 0.02 m over the ground.
    EXPECT_NEAR(report["obstacle"]["canopy_m"].get<double>(), 16.93, 0.03);
    EXPECT_TRUE(report["to"]["canopy_m"].is_null());
    EXPECT_EQ(report["canopy"]["from"], "file");
    EXPECT_FALSE(report["canopy"]["invented"].get<bool>());
    EXPECT_EQ(report["canopy"]["held"][0]["share"], 0.0);
    EXPECT_EQ(report["canopy"]["raised_posts"], wood_rows);
    const Outcome printed = run_orograph(sight({"--canopy", spruce}));
    EXPECT_EQ(printed.exit_code, 0);
    EXPECT_TRUE(says(printed.out, "\nFirst obstacle: canopy, 16.")) << printed.out;
    EXPECT_TRUE(says(printed.out,
                     "\nCanopy: data of spruce.tif, up to 20.0 m; 0 of it is taken to be in the "
                     "data already\n"))
        << printed.out;
    // A share that the data hold is not added: trees of 18 m hide the line at 16.98 m, those of 16 m do not.
    EXPECT_FALSE(
        object_said_by(sight({"-q", "--json", "--canopy", spruce, "--canopy-held", "0.1"}))["visible"]);
    EXPECT_TRUE(
        object_said_by(sight({"-q", "--json", "--canopy", spruce, "--canopy-held", "0.2"}))["visible"]);
}

TEST_F(CanopyCommand, AnEyeUnderTreesSeesNothing) {
    const Words line{"sight",  plain,  "--coordinates", "EPSG:32632", "--canopy", spruce,
                     "--from", at(60), "--to",          at(110),      "--target", "32"};
    const json report = object_said_by(joined(line, {"-q", "--json"}));
    EXPECT_FALSE(report["visible"].get<bool>());
    EXPECT_NEAR(report["from"]["above_ground_m"].get<double>(), 2.0, 1e-6);
    EXPECT_NEAR(report["from"]["canopy_m"].get<double>(), 20.0, 1e-3);
    EXPECT_TRUE(report["target_missed_by_m"].is_null());
    EXPECT_NEAR(report["eye_missed_by_m"].get<double>(), 18.0, 0.01);
    EXPECT_EQ(report["obstacle"]["distance_m"], 0.0);
    const Outcome printed = run_orograph(line);
    EXPECT_TRUE(says(printed.err, "the eye stands in the canopy, 18.0 m below its top, and sees nothing"))
        << printed.err;
    EXPECT_TRUE(says(printed.out, "2.0 m above the ground, in a canopy of 20.0 m")) << printed.out;
    EXPECT_TRUE(object_said_by(joined(line, {"-q", "--json", "--above", "18.1"}))["visible"].is_boolean());
    EXPECT_TRUE(object_said_by(joined(line, {"-q", "--json", "--above", "20.1"}))["visible"].get<bool>());
    expect_refusal(run_orograph({"viewshed", plain, "--coordinates", "EPSG:32632", "--canopy", spruce, "--at",
                                 at(60), "-q", "--out", path("none.tif")}),
                   usage, {"--at", "stands in the canopy, 18.0 m below its top", "--above 20"});
}

// The viewshed of targets on the canopy is that of a file of H + canopy, to the byte; of targets on the
// ground it is another where trees stand.
TEST_F(CanopyCommand, AViewshedIsThatOfAFileOfHeightAndCanopy) {
    const std::string both =
        written("both", "Float32", [](int row, int column) { return 500.0 + spruce_m(row, column); });
    const auto bands = [&](const std::string& name) {
        const Outcome made =
            run_program({"gdal_translate", "-q", "-of", "ENVI", path("seen.tif"), path(name + ".raw")});
        EXPECT_EQ(made.exit_code, 0) << made.err;
        return bytes_of(path(name + ".raw"));
    };
    const json data = object_said_by(viewshed(both, {}));
    const std::string of_data = bands("data");
    const json canopy = object_said_by(viewshed(plain, {"--canopy", spruce, "--target-on", "canopy"}));
    EXPECT_EQ(canopy["seen"], data["seen"]);
    EXPECT_EQ(canopy["target_on"], "canopy");
    EXPECT_EQ(bands("canopy"), of_data);
    const json ground = object_said_by(viewshed(plain, {"--canopy", spruce}));
    EXPECT_EQ(ground["target_on"], "ground");
    EXPECT_EQ(ground["cells"], data["cells"]);
    EXPECT_LT(ground["seen"].get<int>(), data["seen"].get<int>());
    EXPECT_LT(data["seen"].get<int>(), object_said_by(viewshed(plain, {}))["seen"].get<int>());
}

TEST_F(CanopyCommand, OfClassesIsInvented) {
    const std::string cover =
        written("cover", "Byte", [](int, int column) { return column == 60 ? 10.0 : 30.0; });
    const json report =
        object_said_by(sight({"-q", "--json", "--landcover", cover + ",worldcover", "--canopy", "class"}));
    EXPECT_TRUE(report["canopy"]["invented"].get<bool>());
    EXPECT_EQ(report["canopy"]["from"], "class");
    EXPECT_EQ(report["canopy"]["table"], "worldcover");
    EXPECT_NEAR(report["canopy"]["highest_m"].get<double>(), 17.0, 1e-6);
    EXPECT_TRUE(
        says(run_orograph(sight({"-q", "--landcover", cover + ",worldcover", "--canopy", "class"})).out,
             "\nCanopy: invented, by classes of ESA WorldCover, up to 17.0 m; "));
}

TEST_F(CanopyCommand, WhatIsWrongIsSaidInOneLine) {
    const auto refused = [&](const Words& more, int exit_code, const Words& what) {
        expect_refusal(run_orograph(sight(joined({"-q"}, more))), exit_code, what);
    };
    refused({"--canopy", "class"}, usage, {"--canopy class: needs the classes: give --landcover FILE"});
    refused({"--canopy", "class", "--canopy", spruce}, usage,
            {"--canopy class: heights are those of classes or"});
    refused({"--canopy-held", "0.5"}, usage, {"--canopy-held 0.5: needs --canopy"});
    refused({"--canopy", spruce, "--canopy-held", "1.5"}, usage, {"--canopy-held 1.5: "});
    refused({"--canopy", path("none.tif")}, oro::test::failed,
            {"none.tif: no such raster of canopy heights"});
    const std::string sea = written("sea", "Float32", [](int, int) { return 812.5; });
    refused({"--canopy", sea}, oro::test::failed,
            {"sea.tif: holds 812.5 m in column", "no canopy is higher than 100 m"});
    refused({"--canopy", (oro::test::bundled_data() / "jacksboro.tif").string()}, no_data,
            {"jacksboro.tif: holds no canopy over the elevation data"});
    expect_refusal(run_orograph({"viewshed", plain, "-q", "--coordinates", "EPSG:32632", "--at", at(10),
                                 "--target-on", "canopy", "--out", path("none.tif")}),
                   usage, {"--target-on canopy: needs --canopy"});
    expect_refusal(run_orograph({"viewshed", plain, "-q", "--coordinates", "EPSG:32632", "--at", at(10),
                                 "--canopy", spruce, "--out", spruce, "--overwrite"}),
                   usage, {"spruce.tif"});
}

TEST_F(CanopyCommand, PlanTellsTheVegetationInMetresAndPixels) {
    const Words words{"plan",      plain, "--coordinates", "EPSG:32632", "--at",   at(10),    "--above", "30",
                      "--heading", "90",  "--pitch",       "-5",         "--size", "160x120", "-q"};
    const json report = object_said_by(joined(words, {"--json", "--canopy", spruce}));
    EXPECT_NEAR(report["vegetation"]["worst_m"].get<double>(), 20.0, 1e-3);
    EXPECT_GT(report["vegetation"]["worst_px"].get<double>(), 1.0);
    EXPECT_EQ(report["canopy"]["held"][0]["share"], 0.0);
    const Outcome printed =
        run_orograph(joined(words, {"--all", "--canopy", spruce, "--canopy-held", "0.5"}));
    EXPECT_EQ(printed.exit_code, 0) << printed.err;
    EXPECT_TRUE(says(printed.out, "\nvegetation ")) << printed.out;
    EXPECT_TRUE(says(printed.out, "0.5 of it is taken to be in the data already.\n")) << printed.out;
    EXPECT_FALSE(object_said_by(joined(words, {"--json"})).contains("vegetation"));
    expect_refusal(run_orograph({"plan", plain, "-q", "--coordinates", "EPSG:32632", "--at", at(60),
                                 "--above", "2", "--canopy", spruce}),
                   usage, {"--at", "stands in the canopy"});
}

// A picture has the canopy as a surface, tells of it, and is drawn again from what it tells.
TEST_F(CanopyCommand, PicturesHaveItAndTellOfIt) {
    const std::string out = path("trees.png"), again = path("again.png");
    const json report = object_said_by({"shot",
                                        plain,
                                        "--coordinates",
                                        "EPSG:32632",
                                        "--at",
                                        at(30),
                                        "--above",
                                        "12",
                                        "--heading",
                                        "90",
                                        "--size",
                                        "160x120",
                                        "--time",
                                        "2026-01-02T03:04:05Z",
                                        "-q",
                                        "--json",
                                        "--canopy",
                                        spruce,
                                        "--out",
                                        out});
    EXPECT_EQ(report["canopy"]["from"], "file");
    // The row of trees stands in the middle of the picture.
    EXPECT_NEAR(report["destination"]["H_m"].get<double>(), 500.0, 0.1);
    EXPECT_NEAR(report["destination"]["canopy_m"].get<double>(), 12.0, 0.2);
    const json view = json::parse(view_in(out));
    EXPECT_EQ(view["canopy"]["from"], "file");
    EXPECT_EQ(view["canopy"]["files"][0], "spruce.tif");
    EXPECT_EQ(view["fingerprints"]["canopy"].size(), 1U);
    const Outcome redrawn = run_orograph({"shot", "--view", out, "-q", "--out", again});
    EXPECT_EQ(redrawn.exit_code, 0) << redrawn.err;
    EXPECT_EQ(json::parse(view_in(again))["fingerprints"]["pixels"], view["fingerprints"]["pixels"]);
}

// A mound of 10 m stands 10 m east, and 10 m behind it trees of 20 m: the summit is the mound's, not theirs.
TEST_F(CanopyCommand, OnSummitStandsOnTheGround) {
    const std::string mound = written(
        "mound", "Float32", [](int row, int column) { return row == 40 && column == 51 ? 510.0 : 500.0; });
    const std::string trees =
        written("trees", "Float32", [](int, int column) { return column == 52 ? 20.0 : 0.0; });
    const json report = object_said_by({"shot", mound, "--coordinates", "EPSG:32632", "--at", at(50),
                                        "--on-summit", "--above", "30", "--size", "64x48", "-q", "--json",
                                        "--canopy", trees, "--out", path("summit.png")});
    EXPECT_EQ(report["canopy"]["from"], "file");
    EXPECT_NEAR(report["on_summit"]["H_m"].get<double>(), 510.0, 0.001);
    EXPECT_NEAR(report["on_summit"]["moved_m"].get<double>(), 10.0, 0.1);
    const json eye = json::parse(view_in(path("summit.png")))["eye"];
    EXPECT_EQ(eye["lat_deg"], report["on_summit"]["lat_deg"]);
    EXPECT_EQ(eye["lon_deg"], report["on_summit"]["lon_deg"]);
}

// A name behind the trees is hidden, one before them is not; the sheet tells of the canopy.
TEST_F(CanopyCommand, PanoramasNameWhatIsSeenOverIt) {
    std::ofstream(path("names.geojson"))
        << R"({"type":"FeatureCollection","features":[)"
           R"({"type":"Feature","properties":{"name":"Near"},"geometry":{"type":"Point","coordinates":[9.00463,46.49992]}},)"
           R"({"type":"Feature","properties":{"name":"Far"},"geometry":{"type":"Point","coordinates":[9.01310,46.50172]}}]})";
    const auto named = [&](const Words& more) {
        const json report = object_said_by(
            joined({"panorama", plain, "--coordinates", "EPSG:32632", "--at", at(10), "--names",
                    path("names.geojson"), "--sector", "60,120", "--elevation", "-10,10", "--width", "400",
                    "-q", "--json", "--overwrite", "--out", path("around.svg")},
                   more));
        std::set<std::string> names;
        for (const json& name : report["names"]["named"]) names.insert(name["name"].get<std::string>());
        return names;
    };
    EXPECT_EQ(named({}), (std::set<std::string>{"Far", "Near"}));
    EXPECT_EQ(named({"--canopy", spruce}), (std::set<std::string>{"Near"}));
    EXPECT_TRUE(says(bytes_of(path("around.svg")), "; with canopy"));
}

}  // namespace
