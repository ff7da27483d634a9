// orograph sight as people and programs use it.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

nlohmann::json reported(Words words) {
    words.insert(words.begin(), {"sight", bundled(), "--json", "-q"});
    return object_said_by(words);
}

TEST(SightCommand, AHiddenTargetIsSeenFromSoMuchHigherUp) {
    const auto hidden = reported({"--from", "36.5,-84.2", "--to", "36.55,-84.35", "--target", "2"});
    ASSERT_FALSE(hidden["visible"].get<bool>());
    const double by_m = hidden["target_missed_by_m"], eye_by_m = hidden["eye_missed_by_m"];
    EXPECT_GT(by_m, 1.0);
    EXPECT_LT(hidden["clearance"]["least_m"].get<double>(), 0.0);
    const auto higher = [&](const char* option, double height_m) {
        return reported({"--from", "36.5,-84.2", "--to", "36.55,-84.35", option, std::to_string(height_m),
                         option == std::string("--target") ? "--above" : "--target", "2"})["visible"]
            .get<bool>();
    };
    EXPECT_TRUE(higher("--target", 2.0 + by_m + 0.001));
    EXPECT_FALSE(higher("--target", 2.0 + by_m - 0.001));
    EXPECT_TRUE(higher("--above", 2.0 + eye_by_m + 0.001));
    EXPECT_FALSE(higher("--above", 2.0 + eye_by_m - 0.001));
    // What stands in the way lies on the line, nearer than the target.
    EXPECT_GT(hidden["obstacle"]["distance_m"].get<double>(), 0.0);
    EXPECT_LT(hidden["obstacle"]["distance_m"].get<double>(), hidden["distance_m"].get<double>());
}

// By Vincenty's formulae (Survey Review 23, 1975): 14535.0160 m at 292.4854484 degrees.
TEST(SightCommand, DistanceAndDirectionAreTheGeodesics) {
    const auto sight = reported({"--from", "36.5,-84.2", "--to", "36.55,-84.35", "--above", "500"});
    EXPECT_NEAR(sight["distance_m"].get<double>(), 14535.0160, 1e-4);
    EXPECT_NEAR(sight["azimuth_deg"].get<double>(), 292.4854484, 1e-7);
}

TEST(SightCommand, LightBendsAsItIsAsked) {
    const Words line{"--from", "36.5,-84.2", "--to", "36.55,-84.35", "--above", "500"};
    const auto with = [&](Words more) {
        more.insert(more.begin(), line.begin(), line.end());
        return reported(more);
    };
    const auto straight = with({"--refraction", "0"}), bent = with({"--refraction", "0.13"});
    EXPECT_EQ(straight["light"]["k"], 0.0);
    // k s^2 / (2 R) over the distance: k s / (2 R) = 0.13 * 14,535 / (2 * 6,367,000) rad = 0.0085 degree.
    EXPECT_NEAR(bent["elevation_deg"].get<double>() - straight["elevation_deg"].get<double>(), 0.0085, 1e-4);
    EXPECT_EQ(with({})["light"]["air"], "standard");
}

TEST(SightCommand, HiddenIsAnAnswer) {
    const Outcome outcome =
        run_orograph({"sight", bundled(), "--from", "36.5,-84.2", "--to", "36.55,-84.35"});
    EXPECT_EQ(outcome.exit_code, 0);
    for (const char* words : {"\nHidden: the target would have to be ", "\nFirst obstacle: ",
                              "\nLeast clearance: -", " m over the ellipsoid, ", "\nLight: k 0.12 "})
        EXPECT_NE(outcome.out.find(words), std::string::npos) << words << outcome.out;
    const Outcome seen =
        run_orograph({"sight", bundled(), "--from", "36.5,-84.2", "--to", "36.5,-84.201", "--above", "300"});
    EXPECT_EQ(seen.exit_code, 0);
    EXPECT_NE(seen.out.find("\nVisible\n"), std::string::npos) << seen.out;
}

TEST(SightCommand, WhatIsBeyondTheDataIsTold) {
    const Outcome outcome =
        run_orograph({"sight", bundled(), "--from", "36.6,-84.2", "--to", "geo:36.55,-84.6,1500"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find("km of the line lie over no data; ground that is there could hide the target"),
              std::string::npos)
        << outcome.err;
}

TEST(SightCommand, WhatIsWrongIsSaidInOneLine) {
    const std::string data = bundled();
    expect_refusal(run_orograph({"sight", data}), 2, {"--from: is missing: name the place"});
    expect_refusal(run_orograph({"sight", data, "--from", "36.5,-84.2"}), 2, {"--to: is missing"});
    expect_refusal(run_orograph({"sight", data, "--from", "Eiger", "--to", "36.5,-84.2"}), 2,
                   {"--from Eiger: "});
    expect_refusal(run_orograph({"sight", "--from", "36.5,-84.2", "--to", "36.5,-84.3"}), 2, {"PATH"});
    expect_refusal(run_orograph({"sight", data, "--from", "36.5,-84.2", "--to", "46,8"}), 3,
                   {"--to 46.000000,8.000000: no elevation data there to stand on; give geo:LAT,LON,HEIGHT"});
    expect_refusal(
        run_orograph({"sight", data, "-q", "--from", "36.5,-84.2", "--to", "36.5,-84.3", "--target", "-1"}),
        2, {"--target -1: must be 0 or more"});
    expect_refusal(
        run_orograph({"sight", data, "-q", "--from", "36.5,-84.2", "--altitude", "0", "--to", "36.5,-84.3"}),
        2, {"--from 36.5,-84.2: lies ", " m under the ground"});
    expect_refusal(
        run_orograph({"sight", data, "-q", "--from", "36.5,-84.2", "--above", "1e9", "--to", "36.5,-84.3"}),
        2, {"--from 36.5,-84.2: would be at h 1e+09 m"});
    expect_refusal(
        run_orograph({"sight", data, "-q", "--from", "36.5,-84.2", "--above", "0", "--to", "36.5,-84.2"}), 2,
        {"--to 36.5,-84.2: is where --from is"});
}

}  // namespace
