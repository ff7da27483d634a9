// shot --at PLACE: looks at the place; stands on it where somebody says so.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::run_orograph;
using oro::test::Words;

json shot(Words more) {
    const fs::path folder = oro::test::scratch_folder();
    more.insert(more.begin(),
                {"shot", bundled(), "--out", folder / "a.png", "--json", "-q", "--size", "64x48"});
    return oro::test::object_said_by(more);
}

// The middle of an even number of pixels is a corner between four of them: exact but for the sight line's
// rounding.
TEST(AtPlace, IsInTheMiddleAndNotUnderTheFeet) {
    const json said = shot({"--at", "36.55,-84.25"});
    const json& seen = said.at("destination");
    ASSERT_TRUE(seen.is_object()) << said;
    EXPECT_NEAR(seen["lat_deg"].get<double>(), 36.55, 1e-6);
    EXPECT_NEAR(seen["lon_deg"].get<double>(), -84.25, 1e-6);
    // 40 posts of 1" * 3 around it: 3.7 km of ground, 45 degrees: some 10 km away.
    EXPECT_GT(seen["seen_distance_m"].get<double>(), 1000.0);
    EXPECT_LT(said["pitch_deg"].get<double>(), -15.0);
    // A side that somebody asks for is that of the line of sight.
    const json from_west = shot({"--at", "36.55,-84.25", "--heading", "90"});
    EXPECT_NEAR(from_west["heading_deg"].get<double>(), 90.0, 0.2);
    EXPECT_NEAR(from_west["destination"]["lon_deg"].get<double>(), -84.25, 1e-6);
    EXPECT_LT(from_west["eye"]["lon_deg"].get<double>(), -84.26);
}

TEST(AtPlace, IsStoodOnWhereAHeightOrAnotherPlaceIsNamed) {
    for (const Words& more :
         {Words{"--above", "2"}, Words{"--look-at", "36.6,-84.3"}, Words{"--altitude", "3000"}}) {
        Words words{"--at", "36.55,-84.25"};
        words.insert(words.end(), more.begin(), more.end());
        const json said = shot(words);
        EXPECT_NEAR(said["eye"]["lat_deg"].get<double>(), 36.55, 1e-12) << more[0];
        EXPECT_NEAR(said["eye"]["lon_deg"].get<double>(), -84.25, 1e-12) << more[0];
    }
}

// All of the bundled region lies in the cell N36W085.
TEST(AtPlace, ACellIsFramed) {
    const json cell = shot({"--at", "N36W085"}), all = shot({});
    for (const char* name : {"lat_deg", "lon_deg"})
        EXPECT_NEAR(cell["eye"][name].get<double>(), all["eye"][name].get<double>(), 1e-9) << name;
    EXPECT_NEAR(cell["eye"]["h_m"].get<double>(), all["eye"]["h_m"].get<double>(), 1e-3);
    EXPECT_EQ(cell["fov_deg"], all["fov_deg"]);
    EXPECT_EQ(cell["fov_deg"], 30.0);
    // A geohash of 0.044 x 0.044 degrees, of which much less ground is in view.
    const json hash = shot({"--at", "geohash:dnkpf"});
    EXPECT_LT(hash["eye"]["h_m"].get<double>(), all["eye"]["h_m"].get<double>());
}

TEST(AtPlace, WhatCannotBeShownIsSaid) {
    const auto refused = [](const Words& more, int code, const Words& says) {
        Words words{"shot", bundled(), "--out", oro::test::scratch_folder() / "a.png", "--size", "64x48"};
        words.insert(words.end(), more.begin(), more.end());
        expect_refusal(run_orograph(words), code, says);
    };
    refused({"--at", "46.5,8.5"}, oro::test::no_data,
            {"--at 46.500000,8.500000: no elevation data there to look at", "the data's box"});
    refused({"--at", "N46E008"}, oro::test::no_data, {"--at N46E008: no elevation data in this cell"});
    refused({"--at", "36.55,-84.25", "--pitch", "0", "--heading", "0"}, oro::test::usage,
            {"--at 36.550000,-84.250000: ground hides the place", "--above METRES"});
}

// From straight above the turn is a heading, as it was asked for, of a place and of the whole region.
TEST(AtPlace, StraightDownKeepsTheAskedHeading) {
    for (const Words& more : {Words{}, Words{"--at", "36.55,-84.25"}}) {
        Words words{"--pitch", "-90", "--heading", "200"};
        words.insert(words.end(), more.begin(), more.end());
        const json said = shot(words);
        EXPECT_EQ(said["heading_deg"], 200.0) << said;
        EXPECT_EQ(said["pitch_deg"], -90.0);
        EXPECT_EQ(said["roll_deg"], 0.0);
    }
}

}  // namespace
