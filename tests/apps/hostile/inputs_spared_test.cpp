// --overwrite: nothing that a command reads is replaced by what it writes, whatever it is to the command and
// by whatever name.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/apps/program.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::usage;
using oro::test::Words;
using oro::test::write_bytes;

class InputsSpared : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const fs::path land = folder / "land.tif";

    void SetUp() override { fs::copy_file(bundled(), land); }
    [[nodiscard]] std::string path(const std::string& name) const { return folder / name; }
    static Words small(Words words) {
        return joined(std::move(words), {"--size", "64x48", "-q", "--overwrite"});
    }
    static void run(const Words& words) {
        const Outcome outcome = run_program(words);
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    // The refusal, and all files as they were.
    void expect_spared(const Words& words, const std::string& named) const {
        std::vector<std::string> before;
        const std::vector<std::string> names = names_in(folder);
        for (const std::string& name : names) before.push_back(bytes_of(folder / name));
        expect_refusal(run_orograph(words), usage, {"would replace", named});
        EXPECT_EQ(names_in(folder), names);
        for (std::size_t i = 0; i < names.size(); ++i)
            EXPECT_TRUE(bytes_of(folder / names[i]) == before[i]) << names[i];
    }
};

TEST_F(InputsSpared, SourcesOfADrapedVrtOfVrts) {
    run({"gdal_translate", "-q", bundled(), path("image.tif")});
    run({"gdalbuildvrt", "-q", path("inner.vrt"), path("image.tif")});
    run({"gdalbuildvrt", "-q", path("outer.vrt"), path("inner.vrt")});
    fs::create_hard_link(path("inner.vrt"), path("inner.png"));
    for (const auto& [out, named] : {std::pair{"image.tif", "image.tif"}, {"inner.png", "inner.vrt"}})
        expect_spared(small({"shot", land, "--drape", path("outer.vrt"), "--out", path(out)}), path(named));
}

// image.tiff takes its place from image.tfw, which a map called image.tif has beside it, too.
TEST_F(InputsSpared, TheWorldFileOfADrape) {
    run({"gdal_translate", "-q", "-co", "PROFILE=BASELINE", "-co", "TFW=YES", bundled(), path("image.tif")});
    fs::rename(path("image.tif"), path("image.tiff"));
    fs::remove(path("image.tif.aux.xml"));
    write_bytes(path("image.tiff.aux.xml"), "<PAMDataset><SRS>EPSG:4269</SRS></PAMDataset>");
    ASSERT_TRUE(fs::exists(path("image.tfw")));
    expect_spared(small({"shot", land, "--ortho", "--drape", path("image.tiff"), "--out", path("image.tif")}),
                  "image.tfw");
}

TEST_F(InputsSpared, TheViewAsASideOutput) {
    ASSERT_EQ(run_orograph(small({"shot", land, "--out", path("first.png")})).exit_code, 0);
    fs::rename(path("first.png"), path("v.error.png"));
    expect_spared(
        {"shot", "--view", path("v.error.png"), "--verify", "--out", path("v.png"), "-q", "--overwrite"},
        "v.error.png");
    ASSERT_EQ(run_orograph(small({"shot", land, "--out", path("w.height.tif")})).exit_code, 0);
    expect_spared(
        {"shot", "--view", path("w.height.tif"), "--layers", "--out", path("w.png"), "-q", "--overwrite"},
        "w.height.tif");
}

TEST_F(InputsSpared, TheViewOfShotAndPanorama) {
    ASSERT_EQ(run_orograph(small({"shot", land, "--out", path("p.png")})).exit_code, 0);
    fs::create_symlink("p.png", path("q.png"));
    for (const char* out : {"p.png", "q.png"})
        expect_spared(
            {"shot", "--view", path("p.png"), "--tau", "4", "--out", path(out), "-q", "--overwrite"},
            "p.png");
    // Without --out the picture goes back to where it came from: that is what is asked for.
    EXPECT_EQ(run_orograph({"shot", "--view", path("p.png"), "--tau", "4", "-q", "--overwrite"}).exit_code,
              0);
    const Words around{"panorama", land,  "--at",        "36.53,-84.23", "--out", path("around.png"),
                       "--width",  "400", "--elevation", "-10,10",       "-q"};
    ASSERT_EQ(run_orograph(around).exit_code, 0);
    expect_spared(
        {"panorama", "--view", path("around.png"), "--out", path("around.png"), "-q", "--overwrite"},
        "around.png");
}

TEST_F(InputsSpared, NamesLinesStylesAndColours) {
    const std::string line = R"({"type":"Feature","properties":{"name":"a"},"geometry":{"type":"LineString",)"
                             R"("coordinates":[[-84.3,36.5],[-84.2,36.6]]}})";
    for (const char* name : {"line.geojson", "other.geojson"}) write_bytes(path(name), line);
    fs::create_hard_link(path("other.geojson"), path("linked.png"));
    expect_spared({"profile", land, "--along", path("line.geojson"), "--out", path("line.geojson"),
                   "--overwrite", "-q"},
                  "line.geojson");
    expect_spared(small({"shot", land, "--overlay", path("other.geojson"), "--out", path("linked.png")}),
                  "other.geojson");
    expect_spared({"panorama", land, "--at", "36.53,-84.23", "--overlay", path("other.geojson"), "--out",
                   path("linked.png"), "--width", "400", "--elevation", "-10,10", "-q", "--overwrite"},
                  "other.geojson");
    fs::copy_file(oro::test::bundled_data() / "styles" / "haze.json", path("own.json"));
    fs::create_hard_link(path("own.json"), path("own.png"));
    expect_spared(small({"shot", land, "--style", path("own.json"), "--out", path("own.png")}), "own");
}

// What a bake leaves beside its file on the way is a region like any other.
TEST_F(InputsSpared, ARegionThatHasTheNameOfAPart) {
    ASSERT_EQ(run_orograph({"bake", land, "--out", path("a.oro"), "-q"}).exit_code, 0);
    fs::rename(path("a.oro"), path("b.oro.grid-1"));
    expect_spared({"bake", path("b.oro.grid-1"), "--mesh", "clusters", "--out", path("b.oro"), "-q"},
                  "b.oro.grid-1");
}

}  // namespace
