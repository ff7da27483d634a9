// Heights on contour lines as users meet them: asked for or not, told, kept in the view, compared.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::object_said_by;
using oro::test::pixels_of;
using oro::test::run_orograph;
using oro::test::usage;
using oro::test::view_in;
using oro::test::Words;
using oro::test::write_bytes;

class LabelsOfShots : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const std::string land = (folder / "land.tif").string();

    LabelsOfShots() { fs::copy_file(oro::test::bundled_data() / "jacksboro.tif", land); }
    [[nodiscard]] std::string path(const char* name) const { return (folder / name).string(); }
    // A map of the bundled region, drawn from that file.
    json shot(const std::string& of, const std::string& out, const Words& more) const {
        const Words map{"--at", "36.545,-84.235", "--altitude", "30000", "--pitch", "-90", "--fov", "30"};
        return object_said_by(joined(joined({"shot", of, "--size", "480x360", "-q", "--json", "--out", out,
                                             "--time", "2026-01-01T00:00:00Z"},
                                            map),
                                     more));
    }
};

TEST_F(LabelsOfShots, AreToldAndDrawnAgain) {
    const json said = shot(land, path("map.png"), {"--style", "contours"});
    ASSERT_GE(said["labels"].size(), 2U);
    const double interval_m = said["contour_interval_m"];
    for (const json& label : said["labels"]) {
        EXPECT_EQ(label["text"], std::to_string(std::lround(label["H_m"].get<double>())));
        EXPECT_NEAR(std::remainder(label["H_m"].get<double>(), 5.0 * interval_m), 0.0, 1e-6);
        EXPECT_GT(label["middle_px"][0], 11.0);
        EXPECT_LT(label["middle_px"][0], 469.0);
    }
    EXPECT_EQ(said["view"]["labels"], "style");
    EXPECT_EQ(run_orograph({"shot", "--view", path("map.png"), "-q", "--out", path("again.png")}).exit_code,
              0);
    EXPECT_EQ(bytes_of(path("again.png")), bytes_of(path("map.png")));
    // What is written on a picture is part of what its view draws.
    const auto compared = run_orograph({"compare", path("map.png")});
    EXPECT_EQ(compared.exit_code, 0) << compared.err;
    EXPECT_NE(compared.err.find("Pixels: as the view draws them here"), std::string::npos) << compared.err;
}

TEST_F(LabelsOfShots, AreLeftOutWhereTheViewSaysSo) {
    shot(land, path("with.png"), {"--style", "contours"});
    const json off = shot(land, path("without.png"), {"--style", "contours", "--labels", "off"});
    EXPECT_TRUE(off["labels"].empty());
    EXPECT_EQ(off["view"]["labels"], "off");
    EXPECT_NE(pixels_of(path("with.png")).rgb, pixels_of(path("without.png")).rgb);
    // A view of before there were labels must draw what it drew.
    json old = json::parse(view_in(path("with.png")));
    old.erase("labels");
    write_bytes(path("old.json"), old.dump());
    ASSERT_EQ(run_orograph({"shot", "--view", path("old.json"), "-q", "--out", path("old.png")}).exit_code,
              0);
    EXPECT_EQ(pixels_of(path("old.png")).rgb, pixels_of(path("without.png")).rgb);
    // --labels wins over it, as all looks do.
    ASSERT_EQ(
        run_orograph({"shot", "--view", path("old.json"), "--labels", "on", "-q", "--out", path("asked.png")})
            .exit_code,
        0);
    EXPECT_EQ(pixels_of(path("asked.png")).rgb, pixels_of(path("with.png")).rgb);
    const json plain = shot(land, path("plain.png"), {"--style", "plain"});
    EXPECT_TRUE(plain["labels"].empty());
    EXPECT_TRUE(plain["contour_interval_m"].is_null());
    expect_refusal(
        run_orograph({"shot", land, "--style", "plain", "--labels", "on", "-q", "--out", path("none.png")}),
        usage, {"--labels on", "'plain' has no contour lines"});
}

// A map of the same ground: heights on every fifth line of the interval that was asked for.
TEST_F(LabelsOfShots, AreOnMapsToo) {
    const Words words{
        "shot", land,     "--ortho",      "--style", "contours", "--contour-interval",      "20",
        "-q",   "--json", "--resolution", "8",       "--bbox",   "-84.26,36.5,-84.22,36.54"};
    const auto map = [&](const char* out, const Words& more) {
        return object_said_by(joined(joined(words, {"--out", path(out)}), more));
    };
    const json said = map("m.png", {});
    EXPECT_EQ(said["contour_interval_m"], 20.0);
    EXPECT_EQ(said["view"]["contour_interval_m"], 20.0);
    ASSERT_GE(said["labels"].size(), 2U);
    for (const json& label : said["labels"])
        EXPECT_NEAR(std::remainder(label["H_m"].get<double>(), 100.0), 0.0, 1e-6) << label;
    const json off = map("off.png", {"--labels", "off"});
    EXPECT_TRUE(off["labels"].empty());
    EXPECT_NE(pixels_of(path("m.png")).rgb, pixels_of(path("off.png")).rgb);
    ASSERT_EQ(run_orograph({"shot", "--view", path("m.png"), "-q", "--out", path("again.png")}).exit_code, 0);
    EXPECT_EQ(bytes_of(path("again.png")), bytes_of(path("m.png")));
    expect_refusal(run_orograph({"shot", land, "--style", "plain", "--contour-interval", "20", "-q", "--out",
                                 path("none.png")}),
                   usage, {"--contour-interval: the style 'plain' has no contour lines"});
    expect_refusal(run_orograph({"shot", land, "--style", "contours", "--contour-interval", "0.05", "-q",
                                 "--out", path("none.png")}),
                   usage, {"--contour-interval 0.05: must be between 0.1 and 5000"});
}

// The same ground from a baked file, by both ways of drawing: the same labels.
TEST_F(LabelsOfShots, AreTheSameFromABakedRegion) {
    ASSERT_EQ(run_orograph({"bake", land, "--out", path("land.oro"), "-q"}).exit_code, 0);
    json first;
    for (const std::string& from : {land, path("land.oro")}) {
        for (const char* pipeline : {"mesh", "compute"}) {
            const json said =
                shot(from, path("map.png"), {"--style", "contours", "--pipeline", pipeline, "--overwrite"});
            if (first.is_null()) first = said["labels"];
            EXPECT_EQ(said["labels"], first) << from << ", " << pipeline;
        }
    }
    EXPECT_FALSE(first.empty());
}

}  // namespace
