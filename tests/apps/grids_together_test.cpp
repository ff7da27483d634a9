// Files that lie over each other with posts of their own: each is drawn as it is, the finer over the coarser.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
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
using Words = std::vector<std::string>;

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
        const json told = object_said_by(words);
        return told["eye"]["h_m"].get<double>();
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
    const json told = object_said_by({"info", coarse_, fine_, "--json"});
    ASSERT_EQ(told["apart"].size(), 1U);
    EXPECT_EQ(told["region"]["own_posts"], false);
    EXPECT_EQ(told["apart"][0]["region"]["own_posts"], true);
    EXPECT_EQ(told["apart"][0]["region"]["posts"]["rows"], 125);
    const json one = object_said_by({"info", coarse_, fine_, "--resample", "--json"});
    EXPECT_FALSE(one.contains("apart"));
}

}  // namespace
