// Models of the world as options: said in --json, kept in the view, drawn again from it.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

class ModelOptions : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();

    json shoot(const fs::path& out, const Words& more, const std::string& data = bundled()) const {
        Words words{"shot",      data,         "--out",   out,  "--json", "-q",
                    "--at",      "36.6,-84.2", "--above", "30", "--size", "160x120",
                    "--heading", "200.5",      "--pitch", "-3", "--time", "2026-11-21T09:00:00Z"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run_orograph(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const json said = json::parse(outcome.out, nullptr, false);
        EXPECT_TRUE(said.is_object()) << outcome.out;
        return said;
    }
};

TEST_F(ModelOptions, AreSaidAndKeptAndDrawnAgain) {
    const json plain = shoot(folder / "plain.png", {});
    EXPECT_EQ(plain["models"], json({{"earth", "ellipsoid"},
                                     {"geoid", "egm96"},
                                     {"refraction", 0.0},
                                     {"air", "constant"},
                                     {"precision", "relative"},
                                     {"heights", "f32"},
                                     {"height_step_m", 0.00048828125}}));
    const std::vector<std::pair<std::string, std::string>> options{
        {"earth", "sphere"},    {"earth", "flat"}, {"refraction", "0.9"}, {"air", "standard"},
        {"precision", "naive"}, {"geoid", "none"}, {"heights", "i16"}};
    for (const auto& [name, value] : options) {
        SCOPED_TRACE(name + " " + value);
        const fs::path picture = folder / (name + "-" + value + ".png");
        const json said = shoot(picture, {"--" + name, value});
        const json expected = name == "refraction" ? json(0.9) : json(value);
        EXPECT_EQ(said["models"][name], expected);
        const json view = json::parse(oro::test::view_in(picture));
        EXPECT_EQ(view[name], expected);
        EXPECT_NE(bytes_of(picture), bytes_of(folder / "plain.png"));
        const fs::path again = folder / "again.png";
        const Outcome outcome =
            run_orograph({"shot", "--view", picture, "--out", again, "--overwrite", "-q"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_TRUE(bytes_of(again) == bytes_of(picture)) << "other bytes from the view";
    }
}

TEST_F(ModelOptions, HalfTheHeightsHalfTheBytes) {
    const json f32 = shoot(folder / "a.png", {}), i16 = shoot(folder / "b.png", {"--heights", "i16"});
    EXPECT_NEAR(i16["pages"]["bytes_on_gpu"].get<double>() / f32["pages"]["bytes_on_gpu"].get<double>(),
                0.581, 0.001);  // spheres, cones and boxes of nodes stay
    EXPECT_EQ(i16["models"]["height_step_m"].get<double>(), 0.015625);  // 840 m: 65,534 / 128 = 512
}

TEST_F(ModelOptions, PackedHeightsDrawTheSamePicture) {
    for (const std::string pipeline : {"compute", "mesh"}) {
        const json f32 = shoot(folder / "a.png", {"--pipeline", pipeline, "--overwrite"});
        const json packed =
            shoot(folder / "b.png", {"--pipeline", pipeline, "--heights", "packed", "--overwrite"});
        EXPECT_EQ(packed["models"]["heights"], "packed");
        EXPECT_EQ(packed["models"]["height_step_m"], f32["models"]["height_step_m"]);
        EXPECT_LT(packed["pages"]["bytes_on_gpu"].get<double>(), f32["pages"]["bytes_on_gpu"].get<double>());
        EXPECT_TRUE(oro::test::pixels_of(folder / "b.png").rgb == oro::test::pixels_of(folder / "a.png").rgb);
        EXPECT_EQ(json::parse(oro::test::view_in(folder / "b.png"))["heights"], "packed");
        const Outcome again = run_orograph({"shot", "--view", folder / "b.png", "-q"});
        EXPECT_EQ(again.exit_code, 0) << "compared with its file: " << again.err;
    }
}

// N is about -31 m there: without it the eye stands as high over ground that is 31 m higher.
TEST_F(ModelOptions, WithoutGeoidHeightsAreAboveTheEllipsoid) {
    const json with = shoot(folder / "a.png", {}), without = shoot(folder / "b.png", {"--geoid", "none"});
    EXPECT_EQ(without["eye"]["N_m"].get<double>(), 0.0);
    EXPECT_EQ(without["eye"]["geoid"], "none");
    EXPECT_EQ(without["region"]["geoid"], "none");
    EXPECT_NEAR(without["eye"]["H_m"].get<double>(), with["eye"]["H_m"].get<double>(), 0.01);
    EXPECT_NEAR(without["eye"]["h_m"].get<double>() - with["eye"]["h_m"].get<double>(), 31.0, 3.0);
    const Outcome baked = run_orograph({"bake", bundled(), "--out", folder / "region.oro", "-q"});
    ASSERT_EQ(baked.exit_code, 0) << baked.err;
    shoot(folder / "c.png", {"--geoid", "none"}, folder / "region.oro");
    EXPECT_TRUE(oro::test::pixels_of(folder / "c.png").rgb == oro::test::pixels_of(folder / "b.png").rgb);
}

TEST_F(ModelOptions, ViewsOfBeforeDrawAsBefore) {
    shoot(folder / "new.png", {});
    json view = json::parse(oro::test::view_in(folder / "new.png"));
    for (const char* field : {"earth", "geoid", "refraction", "air", "precision", "heights"})
        EXPECT_EQ(view.erase(field), 1U) << field;
    oro::test::write_bytes(folder / "old.json", view.dump());
    const Outcome outcome =
        run_orograph({"shot", "--view", folder / "old.json", "--out", folder / "again.png", "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(bytes_of(folder / "again.png") == bytes_of(folder / "new.png"));
}

// Before, --refraction 0.13 was what --air standard is now, and views did not name their air.
TEST_F(ModelOptions, RefractionOfBeforeDrawsAsStandardAir) {
    const json standard = shoot(folder / "standard.png", {"--air", "standard"});
    const json surveyed = shoot(folder / "surveyed.png", {"--refraction", "0.13"});
    EXPECT_EQ(surveyed["light"]["k"], 0.13);
    EXPECT_EQ(surveyed["light"]["air"], "constant");
    EXPECT_EQ(standard["light"]["air"], "standard");
    EXPECT_EQ(standard["light"]["refraction"], 0.13);
    const double eye_h_m = standard["light"]["eye_h_m"];
    EXPECT_NEAR(standard["light"]["k"].get<double>(), 0.13 * std::exp(-eye_h_m / 8434.0), 1e-12);
    json view = json::parse(oro::test::view_in(folder / "surveyed.png"));
    EXPECT_EQ(view.erase("air"), 1U);
    oro::test::write_bytes(folder / "old.json", view.dump());
    const Outcome outcome =
        run_orograph({"shot", "--view", folder / "old.json", "--out", folder / "again.png", "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(bytes_of(folder / "again.png") == bytes_of(folder / "standard.png"));
    EXPECT_FALSE(bytes_of(folder / "again.png") == bytes_of(folder / "surveyed.png"));
}

TEST_F(ModelOptions, BadValuesAreRefused) {
    for (const Words& bad :
         {Words{"--earth", "disc"}, Words{"--geoid", "egm2008"}, Words{"--precision", "rounded_posts"},
          Words{"--heights", "i8"}, Words{"--refraction", "0.91"}, Words{"--refraction", "-1.5"},
          Words{"--refraction", "nan"}, Words{"--refraction", "much"}, Words{"--air", "thick"},
          Words{"--air", "standard", "--refraction", "0.13"}}) {
        Words words{"shot", bundled(), "--out", folder / "x.png"};
        words.insert(words.end(), bad.begin(), bad.end());
        const Outcome outcome = run_orograph(words);
        EXPECT_EQ(outcome.exit_code, 2) << bad[0] << " " << bad[1];
        EXPECT_NE(outcome.err.find(bad[0]), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }
    shoot(folder / "new.png", {});
    json view = json::parse(oro::test::view_in(folder / "new.png"));
    view["precision"] = "rounded_posts";
    oro::test::write_bytes(folder / "bad.json", view.dump());
    const Outcome outcome = run_orograph({"shot", "--view", folder / "bad.json", "--out", folder / "x.png"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.err.find("'precision' is 'rounded_posts': choose relative or naive"), std::string::npos)
        << outcome.err;
}

}  // namespace
