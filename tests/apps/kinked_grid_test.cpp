// A file whose datum comes by a grid of shifts (DHDN by BETA2007) keeps its own posts, and so does its bake.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/baked/baking.h"
#include "tests/apps/picture_pixels.h"
#include "tests/apps/said_json.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;

class KinkedGrid : public oro::test::Bake {
  protected:
    // The bundled region's heights where its posts would be every 90 m in Bavaria.
    void SetUp() override {
        if (!fs::exists("/usr/share/proj/BETA2007.gsb")) GTEST_SKIP() << "needs BETA2007.gsb of proj-data";
        const Outcome made = run_program({"gdal_translate", "-q", "-outsize", "500", "400", "-ot", "Float32",
                                          "-a_srs", "EPSG:31468", "-a_ullr", "4400000", "5300000", "4445000",
                                          "5264000", oro::test::bundled(), tif});
        if (made.exit_code == 127) GTEST_SKIP() << "needs gdal_translate";
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }
    const std::string tif = folder / "dhdn.tif";
};

TEST_F(KinkedGrid, IsNotResampled) {
    const Outcome reported = run_orograph({"info", tif});
    EXPECT_EQ(reported.exit_code, 0) << reported.err;
    EXPECT_EQ(reported.out.find("resampl"), std::string::npos) << reported.out;
    EXPECT_NE(reported.out.find("DHDN to WGS 84 (4)"), std::string::npos) << reported.out;
    const json info = object_said_by({"info", tif, "--json"});
    EXPECT_EQ(info["region"]["posts"]["rows"], 400);
    EXPECT_EQ(info["region"]["posts"]["columns"], 500);
    EXPECT_TRUE(info["sources"][0]["resampling"].is_null());
}

TEST_F(KinkedGrid, IsTheSamePictureBaked) {
    const std::string oro = folder / "dhdn.oro", again = folder / "again.oro";
    ASSERT_EQ(run_orograph({"bake", tif, "--out", oro, "-q"}).exit_code, 0);
    ASSERT_EQ(run_orograph({"bake", oro, "--out", again, "-q"}).exit_code, 0);
    EXPECT_TRUE(oro::test::bytes_of(again) == oro::test::bytes_of(oro));
    EXPECT_EQ(object_said_by({"info", oro, "--json", "--check"})["region"],
              object_said_by({"info", tif, "--json"})["region"]);
    const fs::path of_source = folder / "source.png", of_file = folder / "file.png";
    for (const auto& [from, to] : {std::pair{tif, of_source}, std::pair{oro, of_file}}) {
        const Outcome shot = run_orograph({"shot", from, "--size", "240x135", "--time",
                                           "2026-01-01T00:00:00Z", "--verify", "-q", "--out", to});
        ASSERT_EQ(shot.exit_code, 0) << shot.err;
    }
    const oro::test::Pixels was = oro::test::pixels_of(of_source), is = oro::test::pixels_of(of_file);
    ASSERT_EQ(was.width, 240U);
    EXPECT_TRUE(is.rgb == was.rgb);
}

}  // namespace
