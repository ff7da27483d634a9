// --on-summit: who stands on a summit by its published place stands on the highest post nearby, and is told
// so.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::run_orograph;
using oro::test::says;
using oro::test::Words;

// A cone of 30 m a post around the post at 10.5 N 20.5 E, 2,000 m high; the place below is that of the post
// one row to the south and one column to the west: 1,957.6, rounded to 1958 m.
constexpr const char* published = "10.499166666666666,20.499166666666667";
constexpr double post_deg = 1.0 / 1200.0;

class OnSummit : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const std::string tile = (folder / "N10E020.hgt").string();

    void SetUp() override {
        std::string heights;
        for (int row = 0; row <= 1200; ++row) {
            for (int column = 0; column <= 1200; ++column) {
                const int H_m = static_cast<int>(
                    std::lround(std::max(0.0, 2000.0 - 30.0 * std::hypot(row - 600.0, column - 600.0))));
                heights += {static_cast<char>(H_m / 256), static_cast<char>(H_m % 256)};
            }
        }
        oro::test::write_bytes(tile, heights);
    }

    static void expect_moved(const json& moved) {
        ASSERT_TRUE(moved.is_object());
        EXPECT_NEAR(moved["asked_lat_deg"].get<double>(), 10.5 - post_deg, 1e-12);
        EXPECT_NEAR(moved["lat_deg"].get<double>(), 10.5, 1e-12);
        EXPECT_NEAR(moved["lon_deg"].get<double>(), 20.5, 1e-12);
        EXPECT_NEAR(moved["H_m"].get<double>(), 2000.0, 1e-6);
        EXPECT_NEAR(moved["higher_m"].get<double>(), 42.0, 0.01);  // 2000 - 1958
        // A post of 92.16 m along the meridian, 91.24 m along the parallel (Vincenty).
        EXPECT_NEAR(moved["moved_m"].get<double>(), 129.69, 0.05);
    }
};

TEST_F(OnSummit, MovesTheEyeOfEachCommandThatStands) {
    const Words sight{"sight", tile, "--from", published, "--to", "10.6,20.5", "--json", "-q"};
    const json plain = oro::test::object_said_by(sight);
    EXPECT_FALSE(plain.contains("on_summit"));
    const json seen = oro::test::object_said_by(oro::test::joined(sight, {"--on-summit"}));
    expect_moved(seen["on_summit"]);
    EXPECT_NEAR(seen["from"]["H_m"].get<double>(), 2002.0, 0.001);
    EXPECT_NEAR(seen["from"]["above_ground_m"].get<double>(), 2.0, 0.001);

    const json sun = oro::test::object_said_by(
        {"sun", tile, "--at", published, "--on-summit", "--date", "2026-03-21", "--json", "-q"});
    expect_moved(sun["on_summit"]);
    EXPECT_NEAR(sun["place"]["H_m"].get<double>(), 2002.0, 0.001);

    const json shed =
        oro::test::object_said_by({"viewshed", tile, "--at", published, "--at", "10.5,20.5", "--on-summit",
                                   "--radius", "1", "--out", folder / "v.tif", "--json", "-q"});
    expect_moved(shed["observers"][0]["on_summit"]);
    EXPECT_EQ(shed["observers"][1]["on_summit"]["moved_m"], 0.0) << "it stands on the summit";

    const json shot = oro::test::object_said_by({"shot", tile, "--at", published, "--on-summit", "--above",
                                                 "5", "--heading", "90", "--size", "64x48", "--out",
                                                 folder / "s.png", "--json", "-q"});
    expect_moved(shot["on_summit"]);
    EXPECT_NEAR(shot["eye"]["H_m"].get<double>(), 2005.0, 0.001);

    const json around =
        oro::test::object_said_by({"panorama", tile, "--at", published, "--on-summit", "--width", "400",
                                   "--sector", "0,90", "--out", folder / "p.png", "--json", "-q"});
    expect_moved(around["on_summit"]);
    EXPECT_NEAR(around["eye"]["H_m"].get<double>(), 2002.0, 0.001);
}

TEST_F(OnSummit, IsSaidInWords) {
    const auto sight = run_orograph(
        {"sight", tile, "--from", published, "--to", "10.6,20.5", "--on-summit", "--refraction", "0"});
    EXPECT_EQ(sight.exit_code, 0) << sight.err;
    EXPECT_TRUE(
        says(sight.out,
             "Summit: the eye stands on the highest post nearby: 10.500000 20.500000, H 2000.0 m, 130 "
             "m from the place that was given and 42.0 m higher\n"))
        << sight.out;
    const auto shot = run_orograph(
        {"shot", tile, "--at", "10.5,20.5", "--on-summit", "--size", "64x48", "--out", folder / "w.png"});
    EXPECT_TRUE(says(shot.err, "the eye stands on the place itself: no post nearby is higher")) << shot.err;
}

TEST_F(OnSummit, NeedsAPlaceOnTheGround) {
    oro::test::expect_refusal(run_orograph({"shot", tile, "--on-summit", "--out", folder / "x.png"}),
                              oro::test::usage, {"--on-summit: says nothing without --at PLACE"});
    oro::test::expect_refusal(
        run_orograph({"shot", tile, "--at", "geo:10.5,20.5,3000", "--on-summit", "--out", folder / "x.png"}),
        oro::test::usage, {"gives a height of its own: leave --on-summit out"});
}

// Four posts to the south of the top, 1,880 m: the post two rows nearer is 60 m higher, and none.
constexpr const char* flank = "10.496666666666667,20.5";

TEST_F(OnSummit, AWallBeforeWhoStandsOnAFlankIsSaid) {
    const std::string note = "note: a post 130 m away is 42.0 m higher; --on-summit stands there\n";
    const auto shot = run_orograph(
        {"shot", tile, "--at", published, "--above", "2", "--size", "64x48", "--out", folder / "a.png"});
    EXPECT_TRUE(says(shot.err, note)) << shot.err;
    const auto sun = run_orograph({"sun", tile, "--at", published, "--date", "2026-03-21"});
    EXPECT_TRUE(says(sun.err, note)) << sun.err;
    const auto shed =
        run_orograph({"viewshed", tile, "--at", published, "--radius", "1", "--out", folder / "a.tif"});
    EXPECT_TRUE(says(shed.err, note)) << shed.err;
    const auto sight = run_orograph({"sight", tile, "--from", flank, "--to", published});
    // On a slope that goes on rising people stand on purpose.
    EXPECT_FALSE(says(sight.err, "--on-summit")) << sight.err;
    EXPECT_TRUE(says(
        sight.err, "note: the target: a post 130 m away is 42.0 m higher; --target-on-summit stands there\n"))
        << sight.err;
    const auto moved = run_orograph({"sight", tile, "--from", flank, "--to", published, "--on-summit"});
    EXPECT_TRUE(says(moved.err,
                     "note: the target: a post 130 m away is 42.0 m higher; --target-on-summit stands "
                     "there\n"))
        << moved.err;
    EXPECT_FALSE(says(moved.err, note)) << moved.err;
    // Not of an eye that is over all of it, nor of one that looks at the place from elsewhere.
    for (const Words& more : {Words{"--above", "70"}, Words{}}) {
        const Words words{"shot",  tile,    "--at",           published,    "--size",
                          "64x48", "--out", folder / "b.png", "--overwrite"};
        const auto high = run_orograph(oro::test::joined(words, more));
        EXPECT_EQ(high.exit_code, 0) << high.err;
        EXPECT_FALSE(says(high.err, "a post 130 m away")) << high.err;
    }
}

// Posts that are invented between those of the data are nearer to each other, and are no summits.
TEST_F(OnSummit, IsTheSameWithGroundBetweenPosts) {
    for (const char* const detail : {"0", "1", "3"}) {
        const json shot = oro::test::object_said_by(
            {"shot", tile, "--at", published, "--on-summit", "--above", "5", "--heading", "90", "--detail",
             std::string(detail) + (detail[0] == '0' ? "" : ",1"), "--size", "64x48", "--out",
             folder / (std::string("d") + detail + ".png"), "--json", "-q"});
        expect_moved(shot["on_summit"]);
        EXPECT_EQ(shot["on_summit"]["goes_on_rising"], false) << detail;
        EXPECT_NEAR(shot["eye"]["H_m"].get<double>(), 2005.0, 0.001) << detail;
    }
}

TEST_F(OnSummit, MovesTheTargetOfASight) {
    const Words sight{"sight", tile, "--from", "10.6,20.5", "--above", "3000", "--to", published};
    const json plain = oro::test::object_said_by(oro::test::joined(sight, {"--json", "-q"}));
    EXPECT_FALSE(plain.contains("target_on_summit"));
    EXPECT_NEAR(plain["to"]["H_m"].get<double>(), 1958.0, 0.001);
    const json moved =
        oro::test::object_said_by(oro::test::joined(sight, {"--target-on-summit", "--json", "-q"}));
    expect_moved(moved["target_on_summit"]);
    EXPECT_FALSE(moved.contains("on_summit"));
    EXPECT_NEAR(moved["to"]["H_m"].get<double>(), 2000.0, 0.001);
    const auto said = run_orograph(oro::test::joined(sight, {"--target-on-summit"}));
    EXPECT_TRUE(says(said.out, "Summit: the target stands on the highest post nearby: 10.500000 20.500000"))
        << said.out;
    EXPECT_FALSE(says(said.err, "note: the target")) << said.err;
    oro::test::expect_refusal(run_orograph({"sight", tile, "--from", published, "--to", "geo:10.5,20.5,3000",
                                            "--target-on-summit"}),
                              oro::test::usage, {"gives a height of its own: leave --target-on-summit out"});
}

// A cone of 18 degrees before an eye that lies 5 cm over it: so near, a height of the target says nothing.
TEST_F(OnSummit, GroundBeforeTheEyeIsSaidToHideTheTarget) {
    const Words sight{"sight", tile, "--from", flank, "--above", "0.05", "--to"};
    const auto far = run_orograph(oro::test::joined(sight, {"10.6,20.5"}));
    EXPECT_TRUE(says(far.out, "Hidden by ground ")) << far.out;
    EXPECT_TRUE(says(far.out, " m in front of the eye: the eye would have to be ")) << far.out;
    EXPECT_FALSE(says(far.out, "the target would have to be")) << far.out;
    // What hides is far, and a tower could be so high.
    const auto tower =
        run_orograph({"sight", tile, "--from", "10.48,20.5", "--above", "200", "--to", "10.52,20.5"});
    EXPECT_TRUE(says(tower.out, "Hidden: the target would have to be ")) << tower.out;
    const json reported = oro::test::object_said_by(oro::test::joined(sight, {"10.6,20.5", "--json", "-q"}));
    EXPECT_GT(reported["target_missed_by_m"].get<double>(), 100.0) << "programs are told";
    EXPECT_LT(reported["obstacle"]["distance_m"].get<double>(), 30.0);
}

TEST_F(OnSummit, GroundThatGoesOnRisingIsNoSummit) {
    const auto around = run_orograph({"panorama", tile, "--at", flank, "--on-summit", "--width", "400",
                                      "--sector", "330,30", "--out", folder / "r.png"});
    EXPECT_EQ(around.exit_code, 0) << around.err;
    EXPECT_TRUE(says(around.err,
                     "184 m from the place that was given and 60.0 m higher; no summit: the ground "
                     "goes on rising\n"))
        << around.err;
    EXPECT_TRUE(says(around.err, "--elevation shows it, and a larger --above looks over it\n")) << around.err;
    EXPECT_FALSE(says(around.err, "--on-summit")) << around.err;
}

}  // namespace
