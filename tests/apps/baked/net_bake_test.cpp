// Baked regions of projected files: the same bytes, pictures and answers as those of the files.
#include <gtest/gtest.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/baked/baking.h"
#include "tests/apps/picture_pixels.h"
#include "tests/apps/said_json.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;

class NetBake : public oro::test::Bake {
  protected:
    void SetUp() override {
        const Outcome warped = run_program({"gdalwarp", "-q", "-t_srs", "EPSG:32616", "-tr", "80", "80", "-r",
                                            "bilinear", "-dstnodata", "-9999", oro::test::bundled(), utm});
        if (warped.exit_code == 127) GTEST_SKIP() << "needs gdalwarp";
        ASSERT_EQ(warped.exit_code, 0) << warped.err;
        ASSERT_EQ(run_orograph({"bake", utm, "--out", oro, "-q"}).exit_code, 0);
    }
    const std::string utm = folder / "utm.tif";
    const std::string oro = folder / "utm.oro";
};

TEST_F(NetBake, TheSameInputMakesTheSameFile) {
    const std::string bytes = bytes_of(oro);
    ASSERT_EQ(run_orograph({"bake", utm, "--out", oro, "-q", "--overwrite"}).exit_code, 0);
    EXPECT_TRUE(bytes_of(oro) == bytes);
    const std::string again = folder / "again.oro";
    ASSERT_EQ(run_orograph({"bake", oro, "--out", again, "-q"}).exit_code, 0);
    EXPECT_TRUE(bytes_of(again) == bytes);
}

TEST_F(NetBake, InfoTellsTheSameAsOfItsSources) {
    const json of_file = object_said_by({"info", oro, "--json", "--check"}),
               of_source = object_said_by({"info", utm, "--json"});
    EXPECT_EQ(of_file["region"], of_source["region"]);
    EXPECT_EQ(of_file["sources"], of_source["sources"]);
    EXPECT_EQ(of_file["file"]["version"], 1);
    expect_refusal(run_orograph({"info", oro, "--resample"}), 2, {"bake the files with --resample"});
}

TEST_F(NetBake, PicturesAreThoseOfItsSources) {
    const std::vector<Words> views{
        {},
        {"--tau", "0"},
        {"--tau", "4", "--pipeline", "compute"},
        {"--exaggeration", "2.5"},
        {"--geoid", "none"},
        {"--bbox", "-84.3,36.5,-84.15,36.62"},
        {"--style", "hypsometric", "--at", "36.6,-84.2", "--above", "900", "--pitch", "-20"},
        {"--at", "36.5,-84.27", "--above", "300", "--heading", "50", "--pitch", "-8", "--drape",
         oro::test::bundled()}};
    for (const Words& view : views) {
        SCOPED_TRACE(testing::PrintToString(view));
        const fs::path of_source = folder / "source.png", of_file = folder / "file.png";
        const auto shoot = [&](const std::string& from, const fs::path& to) {
            return object_said_by(joined({"shot", from, "--size", "240x135", "--time", "2026-01-01T00:00:00Z",
                                          "--overwrite", "-q", "--json", "--out", to},
                                         view));
        };
        const json source = shoot(utm, of_source), said = shoot(oro, of_file);
        const oro::test::Pixels is = oro::test::pixels_of(of_file), was = oro::test::pixels_of(of_source);
        ASSERT_EQ(was.width, 240U);
        EXPECT_TRUE(is.rgb == was.rgb);
        EXPECT_EQ(said["triangles"], source["triangles"]);
        const fs::path again = folder / "again.png";
        const Outcome outcome =
            run_orograph({"shot", "--view", of_file, "--out", again, "--overwrite", "-q"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_TRUE(bytes_of(again) == bytes_of(of_file));
    }
}

// The picture of the files is that of the baked region, and may be drawn again from it.
TEST_F(NetBake, AViewOfTheFilesIsDrawnFromTheBakedRegion) {
    const std::string picture = folder / "a.png";
    ASSERT_EQ(run_orograph({"shot", utm, "--size", "120x80", "--out", picture, "-q"}).exit_code, 0);
    EXPECT_EQ(run_orograph({"compare", picture, oro, "-q"}).exit_code, 0);
}

TEST_F(NetBake, SightLinesAndViewshedsAreThoseOfItsSources) {
    const Words words{"--at", "36.55,-84.25", "--above", "10", "--radius", "6", "-q", "--json", "--out"};
    const std::string one = folder / "one.tif", other = folder / "other.tif";
    json of_source = object_said_by(joined(joined({"viewshed", utm}, words), {one})),
         of_file = object_said_by(joined(joined({"viewshed", oro}, words), {other}));
    EXPECT_EQ(of_file["seen"], of_source["seen"]);
    EXPECT_TRUE(bytes_of(one) == bytes_of(other));
    const Words sight{"--from", "36.55,-84.25", "--to", "36.6,-84.2", "--json", "-q"};
    json line = object_said_by(joined({"sight", utm}, sight)),
         of_baked = object_said_by(joined({"sight", oro}, sight));
    // Of what is assumed, and of holes: what a baked region can do about them is another thing.
    EXPECT_EQ(line["notes"].size(), 2U);
    EXPECT_EQ(of_baked["notes"].size(), 2U);
    line.erase("notes"), of_baked.erase("notes");
    EXPECT_EQ(line, of_baked);
}

}  // namespace
