// --pipeline auto as people meet it: measured once, remembered, and named by every view that it drew.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

class Pipeline : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const fs::path cache = folder / "cache";
    const fs::path file = cache / "pipelines.json";

    [[nodiscard]] Circumstances here(const Words& more = {}) const {
        Circumstances circumstances;
        circumstances.environment = {"OROGRAPH_CACHE=" + cache.string(), "OROGRAPH_VALIDATION=1"};
        circumstances.environment.insert(circumstances.environment.end(), more.begin(), more.end());
        return circumstances;
    }
    // What doctor says of the first device.
    static json doctor(const Circumstances& circumstances) {
        const Outcome outcome = run_orograph({"doctor", "--json"}, circumstances);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        const json all = json::parse(outcome.out, nullptr, false);
        EXPECT_TRUE(all.is_object() && !all["devices"].empty()) << outcome.out;
        return all["devices"][0];
    }
    // Makes auto choose the way that is wanted.
    void pretend(const char* faster) const {
        json all = json::parse(bytes_of(file));
        for (json& entry : all["measured"]) {
            entry["mesh_s"] = faster == std::string("mesh") ? 0.001 : 0.002;
            entry["compute_s"] = faster == std::string("mesh") ? 0.002 : 0.001;
        }
        oro::test::write_bytes(file, all.dump());
    }
    json shoot(const fs::path& out, const Words& more) const {
        Words words{"shot", "--out", out, "--json", "-q"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run_orograph(words, here());
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return json::parse(outcome.out, nullptr, false);
    }
    static bool has_both_ways(const json& device) {
        return device["pipelines"] == json({{"mesh", true}, {"compute", true}});
    }
};

TEST_F(Pipeline, IsMeasuredOnceAndRemembered) {
    const json device = doctor(here({"SOURCE_DATE_EPOCH=1795251600"}));
    if (!has_both_ways(device)) GTEST_SKIP() << "needs a device with both ways of drawing";
    const json first = device["auto"];
    EXPECT_EQ(first["measured_now"], true);
    EXPECT_EQ(first["measured"], "2026-11-21T09:00:00Z");
    const double mesh_ms = first["mesh_ms"], compute_ms = first["compute_ms"];
    EXPECT_GT(mesh_ms, 0.0);
    EXPECT_GT(compute_ms, 0.0);
    EXPECT_EQ(first["pipeline"], mesh_ms <= compute_ms ? "mesh" : "compute");
    EXPECT_NE(first["why"].get<std::string>().find("measured now"), std::string::npos) << first;

    json again = doctor(here())["auto"];
    EXPECT_EQ(again["measured_now"], false);
    EXPECT_EQ(again["measured"], "2026-11-21T09:00:00Z");
    EXPECT_EQ(again["mesh_ms"], mesh_ms);
    EXPECT_NE(again["why"].get<std::string>().find("(measured 2026-11-21)"), std::string::npos) << again;

    pretend("mesh");
    const Outcome reported = run_orograph({"doctor"}, here());
    EXPECT_NE(reported.out.find(
                  "--pipeline auto takes mesh: 2.0 times faster than compute here (measured 2026-11-21)"),
              std::string::npos)
        << reported.out;

    json other_driver = json::parse(bytes_of(file));
    other_driver["measured"][0]["driver"] = "another 1.0";
    oro::test::write_bytes(file, other_driver.dump());
    EXPECT_EQ(doctor(here())["auto"]["measured_now"], true);
    EXPECT_EQ(json::parse(bytes_of(file))["measured"].size(), 2U);
    EXPECT_EQ(doctor(here())["auto"]["measured_now"], false);

    oro::test::write_bytes(file, "{");
    EXPECT_EQ(doctor(here())["auto"]["measured_now"], true);
    EXPECT_EQ(doctor(here())["auto"]["measured_now"], false);
}

TEST_F(Pipeline, NeedsNoCache) {
    const std::vector<Words> cacheless{
        {"OROGRAPH_CACHE", "XDG_CACHE_HOME", "HOME"},
        {"OROGRAPH_CACHE=", "XDG_CACHE_HOME=", "HOME="},
        {"OROGRAPH_CACHE=/proc/nowhere"},
    };
    for (const Words& environment : cacheless) {
        SCOPED_TRACE(environment.size());
        Circumstances circumstances;
        circumstances.environment = environment;
        circumstances.folder = oro::test::scratch_folder();
        const json device = doctor(circumstances);
        EXPECT_TRUE(device["auto"]["pipeline"].is_string()) << device;
        EXPECT_EQ(device["auto"]["measured_now"], has_both_ways(device)) << device;
        const Outcome outcome = run_orograph({"shot", (oro::test::bundled_data() / "jacksboro.tif").string(),
                                              "--size", "64x48", "--out", "p.png", "-q"},
                                             circumstances);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        EXPECT_EQ(oro::test::names_in(circumstances.folder), Words{"p.png"});
    }
}

TEST_F(Pipeline, NothingIsMeasuredWhereThereIsOneWay) {
    for (const auto& [without, way] : {std::pair{"compute", "mesh"}, std::pair{"mesh_shader", "compute"}}) {
        const Circumstances one_way = here({std::string("OROGRAPH_WITHOUT=") + without});
        const json device = doctor(one_way);
        if (!device["can_draw"].get<bool>()) continue;
        EXPECT_EQ(device["auto"]["pipeline"], way);
        EXPECT_EQ(device["auto"]["why"], std::string(way) + ": the only way here");
        EXPECT_EQ(device["auto"]["mesh_ms"], nullptr);
        EXPECT_EQ(device["auto"]["measured"], nullptr);
        EXPECT_EQ(device["auto"]["measured_now"], false);
        const Outcome reported = run_orograph({"doctor"}, one_way);
        EXPECT_NE(reported.out.find(std::string("auto takes ") + way + ": the only way here\n"),
                  std::string::npos)
            << reported.out;
    }
    EXPECT_FALSE(fs::exists(cache));
}

// A processor takes longer to make the programs of both ways than to draw: a picture measures nothing there,
// and goes by what doctor has measured.
TEST_F(Pipeline, APictureMeasuresNothingWhereAProcessorDraws) {
    Circumstances forgetful;
    forgetful.environment = {"OROGRAPH_CACHE=/proc/nowhere"};
    const json device = doctor(forgetful);
    if (!has_both_ways(device) || device["type"] != "software")
        GTEST_SKIP() << "needs a processor that draws";
    const std::string data = (oro::test::bundled_data() / "jacksboro.tif").string();
    EXPECT_EQ(shoot(folder / "p.png", {data, "--size", "64x48", "--style", "default"})["pipeline"],
              "compute");
    EXPECT_FALSE(fs::exists(file));
    doctor(here());
    pretend("mesh");
    EXPECT_EQ(shoot(folder / "q.png", {data, "--size", "64x48", "--style", "default"})["pipeline"], "mesh");
}

// The two ways differ in a few pixels: a view that auto drew must not change when auto changes its mind.
TEST_F(Pipeline, ViewsNameTheWayThatDrewThem) {
    if (!has_both_ways(doctor(here()))) GTEST_SKIP() << "needs a device with both ways of drawing";
    const std::string data = (oro::test::bundled_data() / "jacksboro.tif").string();
    for (const auto& [way, other] : {std::pair{"mesh", "compute"}, std::pair{"compute", "mesh"}}) {
        SCOPED_TRACE(way);
        const fs::path there = oro::test::scratch_folder();
        pretend(way);
        const json said = shoot(there / "p.png", {data, "--size", "64x48"});
        EXPECT_EQ(said["pipeline"], way);
        EXPECT_EQ(json::parse(oro::test::view_in(there / "p.png"))["pipeline"], way);
        pretend(other);
        oro::test::write_bytes(there / "v.json", oro::test::view_in(there / "p.png"));
        for (const char* view : {"p.png", "v.json"}) {
            const json again = shoot(there / "again.png", {"--view", there / view, "--overwrite"});
            EXPECT_EQ(again["pipeline"], way);
            EXPECT_TRUE(bytes_of(there / "again.png") == bytes_of(there / "p.png")) << view;
        }
        EXPECT_EQ(shoot(there / "other.png", {"--view", there / "p.png", "--pipeline", "auto"})["pipeline"],
                  other);
    }
}

}  // namespace
