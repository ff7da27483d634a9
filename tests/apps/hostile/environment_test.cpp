// What the environment and files of the user's say to GDAL, and what it says to a terminal.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"

namespace {
namespace fs = std::filesystem;
using oro::test::Circumstances;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::write_bytes;

Circumstances with(const std::vector<std::string>& environment) {
    Circumstances circumstances;
    circumstances.environment = environment;
    return circumstances;
}

// A raster whose posts are points: GDAL moves it by half a post where GTIFF_POINT_GEO_IGNORE is set.
class Environment : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const std::string land = folder / "points.tif";

    void SetUp() override {
        const Outcome made =
            run_program({"gdal_translate", "-q", "-mo", "AREA_OR_POINT=Point", oro::test::bundled(), land});
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }
    std::string reported(const Circumstances& circumstances = {}) const {
        const Outcome outcome = run_orograph({"info", land, "--json"}, circumstances);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.out;
    }
};

TEST_F(Environment, ChangesNothingThatAFileMeans) {
    const std::string plain = reported();
    for (const char* option :
         {"GTIFF_POINT_GEO_IGNORE=YES", "GTIFF_IGNORE_READ_ERRORS=YES", "GDAL_PAM_ENABLED=NO",
          "GTIFF_HONOUR_NEGATIVE_SCALEY=YES", "GTIFF_REPORT_COMPD_CS=NO", "GTIFF_SRS_SOURCE=EPSG",
          "GDAL_GEOREF_SOURCES=NONE", "OSR_STRIP_TOWGS84=NO", "GTIFF_DIRECT_IO=YES",
          "GDAL_DRIVER_PATH=/nowhere", "VRT_VIRTUAL_OVERVIEWS=YES"})
        EXPECT_EQ(reported(with({option})), plain) << option;
}

TEST_F(Environment, FilesOfOptionsChangeNothing) {
    const std::string plain = reported(), options = "[configoptions]\nGTIFF_POINT_GEO_IGNORE=YES\n";
    write_bytes(folder / "rc", options);
    EXPECT_EQ(reported(with({"GDAL_CONFIG_FILE=" + (folder / "rc").string()})), plain);
    fs::create_directory(folder / ".gdal");
    write_bytes(folder / ".gdal" / "gdalrc", options);
    EXPECT_EQ(reported(with({"HOME=" + folder.string(), "GDAL_CONFIG_FILE"})), plain);
}

// Options that make GDAL faster stay the user's.
TEST_F(Environment, MayMakeGdalFaster) {
    EXPECT_EQ(reported(with({"GDAL_CACHEMAX=16", "GDAL_NUM_THREADS=2"})), reported());
}

TEST_F(Environment, DoctorPrintsNoControlCharacters) {
    const Circumstances odd =
        with({"OROGRAPH_DATA=/\x1b[31m\xc2\x9b"
              "31m\xe2\x80\xae/Z\xfcrich"});
    for (const oro::test::Words& words : {oro::test::Words{"doctor"}, oro::test::Words{"doctor", "--json"}}) {
        const Outcome outcome = run_orograph(words, odd);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        for (const char* unseen : {"\x1b", "\xc2\x9b", "\xe2\x80\xae", "Z\xfcrich"})
            EXPECT_EQ(outcome.out.find(unseen), std::string::npos) << outcome.out;
        EXPECT_NE(outcome.out.find("Z\xEF\xBF\xBDrich"), std::string::npos) << outcome.out;
    }
}

}  // namespace
