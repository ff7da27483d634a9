// orograph sun as people and programs use it.
#include <gtest/gtest.h>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

nlohmann::json reported(Words words) {
    words.insert(words.begin(), "sun");
    words.emplace_back("--json");
    const Outcome outcome = run_orograph(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? nlohmann::json::parse(outcome.out) : nlohmann::json();
}

// US Naval Observatory, Rise and Set for the Sun, 36.95 N 112.52 W: 5:11 and 19:53 in -07:00.
TEST(SunCommand, APlainHorizonIsTheAlmanacs) {
    const auto sun = reported({"--at", "36.95,-112.52", "--date", "2023-06-21", "--zone", "-07:00"});
    EXPECT_EQ(sun["from"], "2023-06-21T00:00:00-07:00");
    EXPECT_TRUE(sun["terrain"].is_null());
    EXPECT_EQ(sun["plain"]["day"], "rises_or_sets");
    EXPECT_NEAR(sun["plain"]["first_light"]["time_utc_s"].get<double>(), 1687349460.0, 40.0);
    EXPECT_NEAR(sun["plain"]["last_light"]["time_utc_s"].get<double>(), 1687402380.0, 40.0);
    const std::string first = sun["plain"]["first_light"]["time"];
    EXPECT_TRUE(first.starts_with("2023-06-21T05:1")) << first;
    EXPECT_TRUE(first.ends_with("-07:00")) << first;
    EXPECT_NEAR(sun["plain"]["sunlight_s"].get<double>(), 52920.0, 80.0);
}

// The day of a place begins with its own midnight, wherever it is: the sun rises first, then sets.
TEST(SunCommand, WithoutAZoneTheDayIsThePlacesOwn) {
    for (const char* at : {"46,8", "-36.84,174.74", "0,-179.9", "61.2,-149.9", "0,180"}) {
        const auto sun = reported({"--at", at, "--date", "2026-03-21"});
        const auto& crossings = sun["plain"]["crossings"];
        ASSERT_EQ(crossings.size(), 2U) << at;
        EXPECT_TRUE(crossings[0]["rising"].get<bool>()) << at;
        EXPECT_NEAR(sun["noon"]["time_utc_s"].get<double>() - sun["from_utc_s"].get<double>(), 43200.0,
                    1200.0)
            << at;
        EXPECT_TRUE(sun["noon"]["time"].get<std::string>().ends_with("Z"));
    }
}

// Found: a day from midnight to midnight begins, in the far north and in other zones, with the end of the
// evening before. That was told as the last light, and the night after it as "hidden". US Naval Observatory's
// rule (upper limb, 34 minutes of refraction) by NOAA's solar equations (Meeus, low accuracy): Mosjoen, 65.84
// N 13.19 E, 2026-06-12 in +02:00: set 00:37, rise 01:38, set 00:42 of the 13th, rise 01:33.
TEST(SunCommand, TheEveningIsThatOfTheDay) {
    const Words north{"--at", "65.84,13.19", "--date", "2026-06-12", "--zone", "+02:00"};
    const auto sun = reported(north);
    const auto time = [](const nlohmann::json& crossing) { return crossing["time"].get<std::string>(); };
    EXPECT_EQ(sun["date"], "2026-06-12");
    EXPECT_EQ(time(sun["plain"]["first_light"]).substr(0, 13), "2026-06-12T01") << sun["plain"];
    EXPECT_EQ(time(sun["plain"]["last_light"]).substr(0, 13), "2026-06-13T00") << sun["plain"];
    EXPECT_GT(sun["plain"]["last_light"]["time_utc_s"], sun["noon"]["time_utc_s"]);
    EXPECT_LT(sun["plain"]["first_light"]["time_utc_s"], sun["noon"]["time_utc_s"]);
    EXPECT_EQ(sun["night"]["from_utc_s"], sun["plain"]["last_light"]["time_utc_s"]);
    EXPECT_EQ(sun["night"]["to"].get<std::string>().substr(0, 13), "2026-06-13T01");
    Words words = north;
    words.insert(words.begin(), "sun");
    const Outcome text = run_orograph(words);
    EXPECT_EQ(text.out.find("hidden"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("    night        2026-06-13T00:"), std::string::npos) << text.out;
    // The same day by a clock that is far from the place's.
    const auto utc = reported({"--at", "61.2,-149.9", "--date", "2026-06-21", "--zone", "Z"});
    EXPECT_EQ(time(utc["plain"]["first_light"]).substr(0, 13), "2026-06-21T12") << utc["plain"];
    EXPECT_EQ(time(utc["plain"]["last_light"]).substr(0, 13), "2026-06-22T07") << utc["plain"];
}

// The same over terrain: what is hidden is so by day.
TEST(SunCommand, NightIsNotHiddenByTerrain) {
    for (const char* zone : {"-04:00", "Z", "+09:00"}) {
        const Outcome text = run_orograph({"sun", bundled(), "--at", "36.5,-84.2", "--above", "300", "--date",
                                           "2026-06-21", "--zone", zone});
        EXPECT_EQ(text.exit_code, 0) << text.err;
        EXPECT_EQ(text.out.find("hidden"), std::string::npos) << zone << text.out;
    }
}

TEST(SunCommand, PolarDayAndNightAreToldPlainly) {
    const Outcome day = run_orograph({"sun", "--at", "78.2,15.6", "--date", "2026-06-21"});
    EXPECT_NE(day.out.find("polar day: the sun does not set\n"), std::string::npos) << day.out;
    const Outcome night = run_orograph({"sun", "--at", "78.2,15.6", "--date", "2026-12-21"});
    EXPECT_NE(night.out.find("polar night: the sun does not rise\n"), std::string::npos) << night.out;
    EXPECT_EQ(reported({"--at", "-90,0", "--date", "2026-12-21"})["plain"]["day"], "up_all_day");
}

// A valley's sun comes later than the plain's and goes earlier; on a tower above all ridges it does neither.
TEST(SunCommand, OverTerrain) {
    const Words day{bundled(), "--at", "36.5,-84.2", "--date", "2026-03-21", "--zone", "-04:00"};
    const auto low = reported(day);
    Words tower = day;
    tower.insert(tower.end(), {"--above", "3000"});
    const auto high = reported(tower);
    const auto span = [](const nlohmann::json& light) {
        return std::pair(light["first_light"]["time_utc_s"].get<std::int64_t>(),
                         light["last_light"]["time_utc_s"].get<std::int64_t>());
    };
    EXPECT_GT(span(low["terrain"]).first, span(low["plain"]).first);
    EXPECT_LT(span(low["terrain"]).second, span(low["plain"]).second);
    EXPECT_LT(span(high["terrain"]).first, span(high["plain"]).first);
    EXPECT_GT(span(high["terrain"]).second, span(high["plain"]).second);
    // By hand: 0.1217 degree east to the data's edge at an azimuth of 103, 0.2133 west at 266.
    const auto reach_m = [&](const char* which) {
        return low["terrain"][which]["data_reach_m"].get<double>();
    };
    EXPECT_NEAR(reach_m("first_light"), 11200.0, 1000.0);
    EXPECT_NEAR(reach_m("last_light"), 19100.0, 1000.0);
    EXPECT_NEAR(high["place"]["above_ground_m"].get<double>(), 3000.0, 0.01);
    EXPECT_EQ(run_orograph({"sun", bundled(), "--at", "36.5,-84.2", "--date", "2026-03-21", "--zone",
                            "-04:00", "--json"})
                  .out,
              run_orograph({"sun", bundled(), "--at", "36.5,-84.2", "--date", "2026-03-21", "--zone",
                            "-04:00", "--json"})
                  .out);
}

// Held against an ephemeris from 1900 to 2100 (tests/core/light).
TEST(SunCommand, YearsThatAreLessExactAreToldInOneLine) {
    for (const auto& [date, less_exact] : {std::pair{"1899-12-30", true},
                                           {"1900-01-02", false},
                                           {"2100-12-30", false},
                                           {"2101-01-02", true}}) {
        const Outcome outcome = run_orograph({"sun", "--at", "46,8", "--date", date});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err_lines().size(), less_exact ? 1U : 0U) << date << outcome.err;
        EXPECT_EQ(
            outcome.err.find("note: the sun is less exact before 1900 and after 2100") != std::string::npos,
            less_exact)
            << date << outcome.err;
    }
}

TEST(SunCommand, WhatIsWrongIsSaidInOneLine) {
    expect_refusal(run_orograph({"sun"}), 2, {"--at: is missing: name the place"});
    expect_refusal(run_orograph({"sun", "--at", "nowhere"}), 2, {"--at nowhere: "});
    expect_refusal(run_orograph({"sun", "--at", "46,8", "--date", "2026-02-30"}), 2,
                   {"--date 2026-02-30: must be a day of the calendar like 2026-06-21"});
    expect_refusal(run_orograph({"sun", "--at", "46,8", "--zone", "CET"}), 2,
                   {"--zone CET: must be a distance from UTC like +02:00, -07:00 or Z"});
    expect_refusal(run_orograph({"sun", "--at", "46,8", "--above", "3"}), 2,
                   {"--above: says nothing without elevation data"});
    expect_refusal(run_orograph({"sun", bundled(), "--at", "46,8"}), 3, {"no elevation data there"});
}

}  // namespace
