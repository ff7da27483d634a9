// Files that lie over each other with posts of their own: each is drawn as it is, the finer over the coarser.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;

class GridsOverEachOther : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = oro::test::scratch_folder();
        coarse_ = (oro::test::bundled_data() / "jacksboro.tif").string();
        // 5 x 5 km of it in UTM, every 40 m and 100 m higher.
        const std::string warped = folder_ / "warped.tif";
        fine_ = folder_ / "fine.tif";
        EXPECT_EQ(
            run_program({"gdalwarp", "-q", "-t_srs", "EPSG:32616", "-te", "742000", "4046000", "747000",
                         "4051000", "-tr", "40", "40", "-r", "cubic", "-ot", "Float32", coarse_, warped})
                .exit_code,
            0);
        EXPECT_EQ(run_program({"gdal_translate", "-q", "-scale", "0", "1000", "100", "1100", warped, fine_})
                      .exit_code,
                  0);
    }
    // H of the ground at a place, as an eye that stands on it tells.
    double ground_H_m(const Words& files, const std::string& place) {
        Words words{"shot"};
        words.insert(words.end(), files.begin(), files.end());
        for (const char* word : {"--above", "0", "--size", "16x16", "--overwrite", "--json", "--at"})
            words.push_back(word);
        words.push_back(place);
        words.push_back("--out");
        words.push_back(folder_ / "eye.png");
        const json reported = object_said_by(words);
        return reported["eye"]["h_m"].get<double>();
    }
    fs::path folder_;
    std::string coarse_, fine_;
};

TEST_F(GridsOverEachOther, AreStoodOnWhereTheFinerHasGround) {
    const std::string inside = "36.56,-84.265", outside = "36.45,-84.2";
    EXPECT_NEAR(ground_H_m({coarse_, fine_}, inside), ground_H_m({fine_}, inside), 0.001);
    EXPECT_NEAR(ground_H_m({coarse_, fine_}, outside), ground_H_m({coarse_}, outside), 0.001);
    // The step, but for what a cubic curve makes of the ground.
    EXPECT_NEAR(ground_H_m({coarse_, fine_}, inside) - ground_H_m({coarse_}, inside), 100.0, 15.0);
}

TEST_F(GridsOverEachOther, AreDrawnAgainFromTheirView) {
    const fs::path picture = folder_ / "both.png", again = folder_ / "again.png";
    const Words eye{"--at",    "36.53,-84.35", "--above", "900",     "--heading", "70",
                    "--pitch", "-15",          "--size",  "160x120", "-q"};
    for (const char* pipeline : {"mesh", "compute"}) {
        Words words{"shot", coarse_, fine_, "--pipeline", pipeline, "--overwrite", "--out", picture};
        words.insert(words.end(), eye.begin(), eye.end());
        const Outcome drawn = run_orograph(words);
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
        const json view = json::parse(oro::test::view_in(picture));
        EXPECT_EQ(view["several_grids"], true);
        const Outcome redrawn =
            run_orograph({"shot", "--view", picture, "--overwrite", "-q", "--out", again});
        ASSERT_EQ(redrawn.exit_code, 0) << redrawn.err;
        EXPECT_EQ(view["fingerprints"]["pixels"],
                  json::parse(oro::test::view_in(again))["fingerprints"]["pixels"]);
    }
}

// The same files named the other way round.
TEST_F(GridsOverEachOther, AreTheSamePictureInAnyOrder) {
    std::string pixels[2];
    for (const bool turned : {false, true}) {
        const fs::path picture = folder_ / "order.png";
        const Outcome drawn = run_orograph({"shot", turned ? fine_ : coarse_, turned ? coarse_ : fine_,
                                            "--size", "120x90", "--overwrite", "-q", "--out", picture});
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
        pixels[turned ? 1 : 0] =
            json::parse(oro::test::view_in(picture))["fingerprints"]["pixels"].get<std::string>();
    }
    EXPECT_EQ(pixels[0], pixels[1]);
}

TEST_F(GridsOverEachOther, AreToldOneByOne) {
    const json reported = object_said_by({"info", coarse_, fine_, "--json"});
    ASSERT_EQ(reported["apart"].size(), 1U);
    EXPECT_EQ(reported["region"]["own_posts"], false);
    EXPECT_EQ(reported["apart"][0]["region"]["own_posts"], true);
    EXPECT_EQ(reported["apart"][0]["region"]["posts"]["rows"], 125);
    const json one = object_said_by({"info", coarse_, fine_, "--resample", "--json"});
    EXPECT_FALSE(one.contains("apart"));
}

// One grid of such posts over both would have 10^11: info told that of files that every picture opens.
TEST_F(GridsOverEachOther, AreToldWhereOneHasFarCloserPosts) {
    const std::string close = folder_ / "close.tif";
    ASSERT_EQ(run_program({"gdalwarp", "-q", "-t_srs", "EPSG:32616", "-te", "744000", "4048000", "744010",
                           "4048010", "-tr", "0.05", "0.05", "-r", "cubic", "-ot", "Float32", coarse_, close})
                  .exit_code,
              0);
    const json reported = object_said_by({"info", coarse_, close, "--json"});
    ASSERT_TRUE(reported.contains("apart")) << reported.dump(1);
    ASSERT_EQ(reported["apart"].size(), 1U);
    EXPECT_FALSE(reported.contains("error"));
    const Outcome one = run_orograph({"info", coarse_, close, "--resample"});
    EXPECT_NE(one.exit_code, 0);
    EXPECT_NE(one.err.find("0.05 m apart, are those of " + close), std::string::npos) << one.err;
}

// Steps of the finer grid are not smoothed away to foretell something, and what is foretold is held.
TEST_F(GridsOverEachOther, AreForetold) {
    const std::vector<std::string> view{coarse_,         fine_,     "-q",     "--at",
                                        "36.53,-84.35",  "--above", "300",    "--look-at",
                                        "36.56,-84.265", "--size",  "320x180"};
    std::vector<std::string> plan{"plan", "--json", "--tolerance", "1px"},
        shot{"shot", "--json", "--tolerance", "1px", "--verify", "--out", folder_ / "foretold.png"};
    plan.insert(plan.end(), view.begin(), view.end());
    shot.insert(shot.end(), view.begin(), view.end());
    const json reported = object_said_by(plan);
    EXPECT_FALSE(reported.contains("resampling"));
    EXPECT_TRUE(reported["view"]["several_grids"].get<bool>());
    EXPECT_EQ(reported["cheapest"]["accuracy"], "balanced");
    EXPECT_TRUE(reported["cheapest"]["holds"].get<bool>());
    const json drawn = object_said_by(shot);
    EXPECT_EQ(drawn["beside"].size(), 1U);
    EXPECT_LE(drawn["error"]["largest_px"].get<double>(), 1.0) << drawn["error"].dump(1);
}

// From far away what closes the rim is as wide as tau: plan told of less than was drawn.
TEST_F(GridsOverEachOther, HaveARimThatIsForetold) {
    const std::vector<std::string> view{coarse_,  fine_,    "-q",    "--json",
                                        "--size", "160x90", "--air", "standard"};
    for (const char* tau : {"0", "4"}) {
        std::vector<std::string> plan{"plan", "--tau", tau};
        std::vector<std::string> shot{
            "shot", "--tau", tau, "--verify", "--overwrite", "--out", folder_ / "rim.png"};
        plan.insert(plan.end(), view.begin(), view.end());
        shot.insert(shot.end(), view.begin(), view.end());
        const json reported = object_said_by(plan)["total"], drawn = object_said_by(shot)["error"];
        EXPECT_GT(drawn["pixels_between_grids"].get<int>(), 0);
        EXPECT_LE(drawn["largest_px"].get<double>(), reported["worst_px"].get<double>()) << "tau " << tau;
        EXPECT_LE(drawn["displacement_m"]["max"].get<double>(), reported["worst_m"].get<double>())
            << "tau " << tau;
        constexpr double rounded_px = 0.01;
        EXPECT_LE(reported["worst_px"].get<double>(),
                  drawn["slack_px"].get<double>() + rounded_px + std::stod(tau));
    }
}

// What is named first is the ground, however far apart its posts are.
TEST_F(GridsOverEachOther, AreInTheOrderThatIsAskedFor) {
    const std::string inside = "36.56,-84.265";
    const double coarse_m = ground_H_m({coarse_}, inside), fine_m = ground_H_m({fine_}, inside);
    EXPECT_NEAR(ground_H_m({coarse_, fine_, "--order", "listed"}, inside), coarse_m, 0.001);
    EXPECT_NEAR(ground_H_m({fine_, coarse_, "--order", "listed"}, inside), fine_m, 0.001);
    EXPECT_NEAR(ground_H_m({coarse_, fine_, "--order", "finest"}, inside), fine_m, 0.001);
    const fs::path picture = folder_ / "listed.png", again = folder_ / "again.png";
    ASSERT_EQ(run_orograph({"shot", coarse_, fine_, "--order", "listed", "--at", "36.53,-84.35", "--above",
                            "900", "--heading", "70", "--size", "96x64", "-q", "--out", picture})
                  .exit_code,
              0);
    EXPECT_EQ(json::parse(oro::test::view_in(picture))["order"], "listed");
    ASSERT_EQ(run_orograph({"shot", "--view", picture, "-q", "--out", again}).exit_code, 0);
    EXPECT_EQ(json::parse(oro::test::view_in(picture))["fingerprints"]["pixels"],
              json::parse(oro::test::view_in(again))["fingerprints"]["pixels"]);
    EXPECT_NE(
        run_orograph({"info", coarse_, fine_, "--order", "listed"}).out.find("the one named first is drawn"),
        std::string::npos);
}

// The step goes over into the ground below, which is told, and drawn again from the view.
TEST_F(GridsOverEachOther, AreFeatheredWhereThatIsAskedFor) {
    const fs::path picture = folder_ / "soft.png", again = folder_ / "again.png";
    const json reported =
        object_said_by({"shot", coarse_, fine_, "--feather", "400", "--at", "36.53,-84.35", "--above", "900",
                        "--heading", "70", "--size", "96x64", "-q", "--json", "--out", picture});
    EXPECT_EQ(reported["region"].contains("feathered") || reported["apart"][0].contains("feathered"), true)
        << reported.dump(1);
    EXPECT_EQ(json::parse(oro::test::view_in(picture))["feather_m"], 400.0);
    ASSERT_EQ(run_orograph({"shot", "--view", picture, "-q", "--out", again}).exit_code, 0);
    EXPECT_EQ(json::parse(oro::test::view_in(picture))["fingerprints"]["pixels"],
              json::parse(oro::test::view_in(again))["fingerprints"]["pixels"]);
    EXPECT_NE(
        run_orograph({"info", coarse_, fine_, "--feather", "400"}).out.find("go over to the heights below"),
        std::string::npos);
}

// Against the oracle, which sees both grids and the step between them.
TEST_F(GridsOverEachOther, AreMeasured) {
    const fs::path picture = folder_ / "measured.png";
    for (const char* pipeline : {"mesh", "compute"}) {
        for (const char* tau : {"0.5", "2"}) {
            const json reported = object_said_by(
                {"shot", coarse_,    fine_,    "--at",   "36.53,-84.35", "--above",    "400",    "--heading",
                 "70",   "--fov",    "50",     "--size", "160x120",      "--pipeline", pipeline, "--tau",
                 tau,    "--verify", "--json", "-q",     "--overwrite",  "--out",      picture});
            const json& error = reported["error"];
            EXPECT_GT(error["drawn_pixels"].get<int>(), 8000);
            EXPECT_GT(error["pixels_between_grids"].get<int>(), 10);
            EXPECT_EQ(error["pixels_beyond_data"], 0);
            EXPECT_LE(error["largest_px"].get<double>(), std::stod(tau) + error["slack_px"].get<double>());
        }
    }
}

// From west of the raised inset over its rim: the ground alone would leave the line free.
TEST_F(GridsOverEachOther, HideWhatLiesBehindTheStep) {
    const json alone = object_said_by({"sight", coarse_, "--from", "36.555,-84.33", "--to", "36.555,-84.28",
                                       "--above", "900", "--target", "150", "--json", "-q"});
    ASSERT_EQ(alone["visible"], true) << alone.dump(1);
    // As high above sea level, over both.
    const auto point = [&](const char* end) {
        return "geo:" + std::to_string(alone[end]["lat_deg"].get<double>()) + "," +
               std::to_string(alone[end]["lon_deg"].get<double>()) + "," +
               std::to_string(alone[end]["h_m"].get<double>());
    };
    const json over = object_said_by(
        {"sight", coarse_, fine_, "--from", point("from"), "--to", point("to"), "--json", "-q"});
    const double free_m = alone["clearance"]["least_m"].get<double>();
    EXPECT_EQ(over["visible"], free_m > 115.0);
}

TEST_F(GridsOverEachOther, HaveAStepInTheirProfile) {
    const fs::path csv = folder_ / "profile.csv";
    ASSERT_EQ(run_orograph(
                  {"profile", coarse_, fine_, "--along", "36.555,-84.33;36.555,-84.28", "-q", "--out", csv})
                  .exit_code,
              0);
    std::ifstream lines(csv);
    std::string line;
    std::getline(lines, line);
    std::vector<std::string> names;
    std::stringstream head(line);
    for (std::string name; std::getline(head, name, ',');) names.push_back(name);
    const auto column = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) - names.begin();
    };
    double step_m = 0.0, before_m = 0.0, at_m = -1.0e9;
    while (std::getline(lines, line)) {
        std::vector<double> values;
        std::stringstream row(line);
        for (std::string value; std::getline(row, value, ',');)
            values.push_back(value.empty() ? 0.0 : std::stod(value));
        const double along_m = values.at(static_cast<std::size_t>(column("distance_m"))),
                     H_m = values.at(static_cast<std::size_t>(column("H_m")));
        if (along_m - at_m < 0.1) step_m = std::max(step_m, std::abs(H_m - before_m));
        at_m = along_m;
        before_m = H_m;
    }
    // 100 m, but for what a cubic curve makes of the ground.
    EXPECT_NEAR(step_m, 100.0, 15.0);
}

// What stands 100 m higher in the middle hides what lies behind, and sight says the same of each post.
TEST_F(GridsOverEachOther, AreLookedOverTogether) {
    const std::string out = folder_ / "seen.tif", eye = "36.53,-84.35";
    const json reported = object_said_by({"viewshed", coarse_, fine_, "-q", "--json", "--at", eye, "--above",
                                          "20", "--target", "2", "--radius", "7", "--out", out});
    EXPECT_EQ(reported["posts_of"], coarse_);
    EXPECT_GT(reported["seen"].get<int>(), 100);
    const json corners = json::parse(run_program({"gdalinfo", "-json", out}).out)["geoTransform"];
    std::vector<std::string> places;
    const std::string list = folder_ / "places.txt";
    for (int step = -8; step <= 8; ++step) {
        if (step == 0) continue;
        const double column = reported["columns"].get<int>() / 2 + step * 9,
                     row = reported["rows"].get<int>() / 2 - step * 4;
        char lon[40], lat[40];
        std::snprintf(lon, sizeof lon, "%.12f",
                      corners[0].get<double>() + (column + 0.5) * corners[1].get<double>());
        std::snprintf(lat, sizeof lat, "%.12f",
                      corners[3].get<double>() + (row + 0.5) * corners[5].get<double>());
        places.push_back(std::string(lat) + "," + lon);
        std::ofstream(list, std::ios::app) << lon << ' ' << lat << '\n';
    }
    std::istringstream values(
        run_program({"sh", "-c", R"(gdallocationinfo -valonly -wgs84 "$1" <"$2")", "sh", out, list}).out);
    int seen = 0;
    for (const std::string& to : places) {
        double is_seen = -1.0, missed_m = -1.0;
        values >> is_seen >> missed_m;
        const json sight = object_said_by({"sight", coarse_, fine_, "-q", "--json", "--from", eye, "--above",
                                           "20", "--to", to, "--target", "2"});
        EXPECT_EQ(is_seen == 1.0, sight["visible"].get<bool>()) << to;
        EXPECT_NEAR(missed_m, sight["target_missed_by_m"].get<double>(), 0.001) << to;
        seen += is_seen == 1.0;
    }
    EXPECT_GT(seen, 0);
    EXPECT_LT(seen, 16);
    const Outcome small = run_orograph({"viewshed", coarse_, fine_, "--at", "36.55,-84.265", "--radius",
                                        "0.5", "--overwrite", "--out", out});
    EXPECT_EQ(small.exit_code, 0) << small.err;
    EXPECT_NE(small.err.find("note: the file has the posts of " + fine_), std::string::npos) << small.err;
}

TEST_F(GridsOverEachOther, AreToldApartByLayers) {
    const fs::path picture = folder_ / "layers.png";
    const json reported =
        object_said_by({"shot",      coarse_,    fine_,     "--at", "36.53,-84.35", "--above", "900",
                        "--heading", "70",       "--pitch", "-15",  "--size",       "96x64",   "--tau",
                        "0",         "--layers", "--json",  "-q",   "--out",        picture});
    ASSERT_EQ(reported["sources"].size(), 2U);
    const Outcome info = run_program({"gdalinfo", "-mm", (folder_ / "layers.source.tif").string()});
    EXPECT_NE(info.out.find("Computed Min/Max=0.000,1.000"), std::string::npos) << info.out;
    const Outcome heights = run_program({"gdalinfo", "-mm", (folder_ / "layers.height.tif").string()});
    EXPECT_EQ(heights.exit_code, 0);
}

// From straight above: around both, each where it is the ground.
TEST_F(GridsOverEachOther, AreMappedTogether) {
    const std::string map = folder_ / "map.tif", coarse_map = folder_ / "coarse.tif";
    for (const auto& [files, out] :
         {std::pair{Words{coarse_, fine_}, map}, std::pair{Words{coarse_}, coarse_map}}) {
        Words words{"shot"};
        words.insert(words.end(), files.begin(), files.end());
        for (const char* word :
             {"--ortho", "--crs", "EPSG:32616", "--resolution", "200", "--style", "hillshade", "-q", "--out"})
            words.push_back(word);
        words.push_back(out);
        const Outcome drawn = run_orograph(words);
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    }
    const auto value = [&](const std::string& file, const char* x, const char* y) {
        return run_program({"gdallocationinfo", "-valonly", "-geoloc", "-b", "1", file, x, y}).out;
    };
    // The same frame; beside the inset the same ground, on its rim a step.
    EXPECT_EQ(json::parse(run_program({"gdalinfo", "-json", map}).out)["size"],
              json::parse(run_program({"gdalinfo", "-json", coarse_map}).out)["size"]);
    EXPECT_EQ(value(map, "738000", "4042000"), value(coarse_map, "738000", "4042000"));
    EXPECT_NE(value(map, "742100", "4048100"), value(coarse_map, "742100", "4048100"));
}

TEST_F(GridsOverEachOther, StandInPanoramasWithNames) {
    const fs::path names = folder_ / "names.geojson", picture = folder_ / "around.png";
    std::ofstream(names) << R"({"type":"FeatureCollection","features":[
        {"type":"Feature","properties":{"natural":"peak","name":"Inside"},"geometry":{"type":"Point","coordinates":[-84.30,36.555]}},
        {"type":"Feature","properties":{"natural":"peak","name":"Near"},"geometry":{"type":"Point","coordinates":[-84.34,36.535]}}]})";
    const json reported =
        object_said_by({"panorama", coarse_, fine_, "--at", "36.53,-84.37", "--above", "600", "--width",
                        "360", "--names", names, "--json", "-q", "--out", picture});
    EXPECT_EQ(reported["names"]["named"].size(), 2U) << reported["names"].dump(1);
}

}  // namespace
