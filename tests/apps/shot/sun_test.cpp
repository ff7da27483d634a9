// Light by time: the picture says what it was, and is drawn again to the same bytes.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::view_in;
using oro::test::Words;

class SunOfAShot : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();

    Outcome shoot(const std::string& name, const Words& more) const {
        Words words{"shot",    (oro::test::bundled_data() / "jacksboro.tif").string(),
                    "--at",    "36.5,-84.2",
                    "--above", "800",
                    "--pitch", "-20",
                    "--size",  "64x48",
                    "--time",  "2026-01-01T00:00:00Z",
                    "--json",  "-q",
                    "--out",   folder / name};
        words.insert(words.end(), more.begin(), more.end());
        return run_orograph(words);
    }
};

TEST_F(SunOfAShot, ItsPlaceIsToldAndTheViewDrawsTheSameBytes) {
    const Outcome drawn = shoot("a.png", {"--sun-time", "2026-06-21T16:00-04:00"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const auto sun = nlohmann::json::parse(drawn.out)["sun"];
    EXPECT_EQ(sun["time"], "2026-06-21T16:00-04:00");
    // By hand, to the degree: the sun passes the meridian at 13:39 there, 2 h 21 min before: an hour angle of
    // 35.3 degrees at a declination of 23.4.
    EXPECT_NEAR(sun["azimuth_deg"].get<double>(), 257.0, 2.0);
    EXPECT_NEAR(sun["elevation_deg"].get<double>(), 57.0, 2.0);
    EXPECT_EQ(sun["direct_light"], 1.0);
    const auto view = nlohmann::json::parse(view_in(folder / "a.png"));
    EXPECT_EQ(view["sun"]["time"], "2026-06-21T16:00-04:00");
    const Outcome again = run_orograph({"shot", "--view", folder / "a.png", "--out", folder / "b.png", "-q"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(bytes_of(folder / "b.png"), bytes_of(folder / "a.png"));
}

// Nobody asks for a time: 10:00 by the sun on 20 March 2026, which is 12:07:26 less two hours and 84.2
// degrees west of Greenwich. By the formula in tests/core/light/usual_sun_test.cpp, declination 0.016: 44.13
// degrees high without air, which lifts it by 0.02, at 135.84. Tolerance: 0.08 degree.
TEST_F(SunOfAShot, IsTheUsualOneInTheStyleOfDaylight) {
    const Outcome drawn = shoot("a.png", {"--style", "natural"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const auto sun = nlohmann::json::parse(drawn.out)["sun"];
    EXPECT_EQ(sun["usual"], true);
    EXPECT_EQ(sun["time"], "2026-03-20T15:44:14Z");
    EXPECT_NEAR(sun["azimuth_deg"].get<double>(), 135.84, 0.08);
    EXPECT_NEAR(sun["elevation_deg"].get<double>(), 44.15, 0.08);
    const Outcome asked = shoot("b.png", {"--style", "natural", "--sun-time", "2026-03-20T15:44:14Z"});
    ASSERT_EQ(asked.exit_code, 0) << asked.err;
    const auto by_time = nlohmann::json::parse(asked.out)["sun"];
    EXPECT_EQ(by_time["usual"], false);
    EXPECT_EQ(by_time["azimuth_deg"], sun["azimuth_deg"]);
    EXPECT_EQ(by_time["elevation_deg"], sun["elevation_deg"]);
    const Outcome again = run_orograph({"shot", "--view", folder / "a.png", "--out", folder / "c.png", "-q"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(bytes_of(folder / "c.png"), bytes_of(folder / "a.png"));
}

// Maps keep the light that maps have; so does what goes from one style to the other.
TEST_F(SunOfAShot, OtherStylesKeepTheirOwn) {
    for (const auto& [style, elevation_deg] :
         {std::pair{"relief", 40.0}, {"hillshade", 45.0}, {"default", 38.0}}) {
        SCOPED_TRACE(style);
        const Outcome drawn = shoot(std::string(style) + ".png", {"--style", style});
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
        const auto sun = nlohmann::json::parse(drawn.out)["sun"];
        EXPECT_EQ(sun["azimuth_deg"], 315.0);
        EXPECT_EQ(sun["elevation_deg"], elevation_deg);
        EXPECT_EQ(sun["time"], nullptr);
    }
    const auto sun_of_view = [&](const std::string& view, const std::string& style) {
        const Outcome drawn = run_orograph({"shot", "--view", folder / view, "--style", style, "--out",
                                            folder / ("again-" + view), "--json", "-q", "--overwrite"});
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        return nlohmann::json::parse(drawn.out, nullptr, false)["sun"];
    };
    ASSERT_EQ(shoot("a.png", {"--style", "natural"}).exit_code, 0);
    EXPECT_EQ(sun_of_view("a.png", "relief")["azimuth_deg"], 315.0);
    EXPECT_EQ(sun_of_view("relief.png", "natural")["time"], "2026-03-20T15:44:14Z");
}

// Before there was a usual sun `natural` had 315,38, and its pictures did not say so.
TEST_F(SunOfAShot, OlderPicturesKeepTheirs) {
    ASSERT_EQ(shoot("a.png", {"--style", "natural", "--sun", "315,38"}).exit_code, 0);
    auto old = nlohmann::json::parse(view_in(folder / "a.png"));
    old["sun"] = nullptr;
    old["sources"] = {(oro::test::bundled_data() / "jacksboro.tif").string()};
    old.erase("paths_from");
    oro::test::write_bytes(folder / "old.json", old.dump());
    const Outcome again =
        run_orograph({"shot", "--view", folder / "old.json", "--out", folder / "b.png", "--json", "-q"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    const auto sun = nlohmann::json::parse(again.out)["sun"];
    EXPECT_EQ(sun["azimuth_deg"], 315.0);
    EXPECT_EQ(sun["elevation_deg"], 38.0);
    EXPECT_EQ(sun["usual"], false);
    EXPECT_EQ(oro::test::pixels_of(folder / "b.png").rgb, oro::test::pixels_of(folder / "a.png").rgb);
}

// A view may be given another sun of either kind; the one that it had is gone.
TEST_F(SunOfAShot, AViewTakesAnother) {
    ASSERT_EQ(shoot("a.png", {"--sun", "90,20"}).exit_code, 0);
    ASSERT_EQ(run_orograph(
                  {"shot", "--view", folder / "a.png", "--out", folder / "b.png", "-q", "--sun-time", "view"})
                  .exit_code,
              0);
    const auto timed = nlohmann::json::parse(view_in(folder / "b.png"))["sun"];
    EXPECT_EQ(timed["time"], "2026-01-01T00:00:00Z");
    ASSERT_EQ(
        run_orograph({"shot", "--view", folder / "b.png", "--out", folder / "c.png", "-q", "--sun", "90,20"})
            .exit_code,
        0);
    EXPECT_EQ(bytes_of(folder / "c.png"), bytes_of(folder / "a.png"));
}

// Found: --sun 270,-3 lit slopes fully. Without direct light all suns are one.
TEST_F(SunOfAShot, BelowTheHorizonOnlyTheSkyLights) {
    ASSERT_EQ(shoot("a.png", {"--sun", "270,-3"}).exit_code, 0);
    ASSERT_EQ(shoot("b.png", {"--sun", "90,-30"}).exit_code, 0);
    const Outcome night = shoot("c.png", {"--sun-time", "2026-06-21T04:00Z"});
    ASSERT_EQ(night.exit_code, 0) << night.err;
    EXPECT_EQ(nlohmann::json::parse(night.out)["sun"]["direct_light"], 0.0);
    ASSERT_EQ(shoot("d.png", {"--sun", "270,3"}).exit_code, 0);
    const auto pixels = [&](const char* name) { return oro::test::pixels_of(folder / name).rgb; };
    EXPECT_EQ(pixels("a.png"), pixels("b.png"));
    EXPECT_EQ(pixels("a.png"), pixels("c.png"));
    EXPECT_NE(pixels("a.png"), pixels("d.png"));
}

TEST_F(SunOfAShot, BothWaysAtOnceAreRefused) {
    expect_refusal(shoot("a.png", {"--sun", "90,20", "--sun-time", "2026-06-21T04:00Z"}), 2,
                   {"--sun: give either --sun or --sun-time, not both"});
    EXPECT_FALSE(fs::exists(folder / "a.png"));
}

}  // namespace
