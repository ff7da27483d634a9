// What --pipeline auto remembers: written, read back, and worth nothing for another device, driver or
// program.
#include "apps/drawing/pipeline_choice.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/support/test_data.h"

namespace oro {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

DeviceReport some_device() {
    DeviceReport device;
    device.name = "Some \"GPU\" 3000";
    device.driver = "somedriver 1.2.3";
    device.mesh_shader = device.compute_raster = true;
    return device;
}

constexpr PipelineTimes some_times{0.0031, 0.001, 1795251600};  // 2026-11-21T09:00:00Z

class PipelineChoiceTest : public testing::Test {
  protected:
    const fs::path folder = test::scratch_folder() / "cache";
    const fs::path file = folder / "pipelines.json";
    std::vector<std::pair<std::string, std::optional<std::string>>> before_;

    void SetUp() override {
        for (const char* name : {"OROGRAPH_CACHE", "XDG_CACHE_HOME", "HOME"}) {
            const char* const value = std::getenv(name);
            before_.emplace_back(name, value ? std::optional<std::string>(value) : std::nullopt);
        }
        setenv("OROGRAPH_CACHE", folder.c_str(), 1);
    }
    void TearDown() override {
        for (const auto& [name, value] : before_)
            value ? setenv(name.c_str(), value->c_str(), 1) : unsetenv(name.c_str());
    }
    [[nodiscard]] std::string text() const {
        std::ifstream stream(file);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    void write(const std::string& content) const {
        fs::create_directories(folder);
        std::ofstream(file) << content;
    }
};

TEST_F(PipelineChoiceTest, WhatIsRememberedComesBack) {
    EXPECT_FALSE(remembered_times(some_device()));
    EXPECT_FALSE(known_choice(some_device()));
    ASSERT_TRUE(remember_times(some_device(), some_times));
    const auto times = remembered_times(some_device());
    ASSERT_TRUE(times);
    EXPECT_EQ(times->mesh_s, 0.0031);
    EXPECT_EQ(times->compute_s, 0.001);
    EXPECT_EQ(times->measured_utc_s, 1795251600);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "a temporary file is left";
    const auto choice = known_choice(some_device());
    ASSERT_TRUE(choice);
    EXPECT_EQ(choice->path, RasterPath::compute);
    EXPECT_FALSE(choice->measured_now);
    EXPECT_EQ(text_of(*choice), "compute: 3.1 times faster than mesh shaders here (measured 2026-11-21)");
}

TEST_F(PipelineChoiceTest, AnotherDeviceDriverOrProgramIsNotKnown) {
    ASSERT_TRUE(remember_times(some_device(), some_times));
    DeviceReport other = some_device();
    other.driver = "somedriver 1.2.4";
    EXPECT_FALSE(remembered_times(other));
    ASSERT_TRUE(remember_times(other, {0.001, 0.002, 1}));
    EXPECT_EQ(known_choice(other)->path, RasterPath::mesh);
    EXPECT_EQ(known_choice(some_device())->path, RasterPath::compute) << "the other's times replaced these";
    other = some_device();
    other.name = "Some \"GPU\" 3001";
    EXPECT_FALSE(remembered_times(other));
    json all = json::parse(text());
    for (json& entry : all["measured"]) entry["program"] = "0.0.0";
    write(all.dump());
    EXPECT_FALSE(remembered_times(some_device()));
}

TEST_F(PipelineChoiceTest, NewTimesReplaceOldOnesAndTheOldestAreForgotten) {
    ASSERT_TRUE(remember_times(some_device(), some_times));
    ASSERT_TRUE(remember_times(some_device(), {0.001, 0.002, 1}));
    EXPECT_EQ(remembered_times(some_device())->compute_s, 0.002);
    EXPECT_EQ(json::parse(text())["measured"].size(), 1U);
    DeviceReport other = some_device();
    for (int i = 0; i < 40; ++i) {
        other.driver = "driver " + std::to_string(i);
        ASSERT_TRUE(remember_times(other, some_times));
    }
    EXPECT_EQ(json::parse(text())["measured"].size(), 32U);
    EXPECT_FALSE(remembered_times(some_device()));
    other.driver = "driver 8";
    EXPECT_TRUE(remembered_times(other));
    other.driver = "driver 7";
    EXPECT_FALSE(remembered_times(other));
}

TEST_F(PipelineChoiceTest, DamageIsNoErrorAndIsWrittenOver) {
    ASSERT_TRUE(remember_times(some_device(), some_times));
    const std::string whole = text();
    const auto bent = [&](const char* field, const json& value) {
        json all = json::parse(whole);
        all["measured"][0][field] = value;
        return all.dump();
    };
    const std::vector<std::string> damaged{"",
                                           "[]",
                                           "null",
                                           "{}",
                                           "no JSON",
                                           whole.substr(0, whole.size() / 2),
                                           std::string(5000, '['),
                                           std::string("\0\0\0", 3),
                                           R"({"orograph_pipelines": 2, "measured": []})",
                                           R"({"orograph_pipelines": 1, "measured": {"device": 3}})",
                                           R"({"orograph_pipelines": 1, "measured": [null, 7, [], {}]})",
                                           bent("mesh_s", -1.0),
                                           bent("mesh_s", 0.0),
                                           bent("compute_s", "fast"),
                                           bent("compute_s", nullptr),
                                           bent("measured_utc_s", 1e300),
                                           bent("driver", 5)};
    for (const std::string& content : damaged) {
        SCOPED_TRACE(content.substr(0, 200));
        write(content);
        EXPECT_FALSE(remembered_times(some_device()));
        EXPECT_TRUE(remember_times(some_device(), some_times));
        EXPECT_TRUE(remembered_times(some_device()));
    }
    // One entry's damage is not the other's.
    json all = json::parse(whole);
    all["measured"].insert(all["measured"].begin(), json{{"device", 1}});
    write(all.dump());
    EXPECT_TRUE(remembered_times(some_device()));
}

TEST_F(PipelineChoiceTest, AFolderThatCannotBeIsNoError) {
    std::ofstream(folder) << "a file where the folder should be";
    EXPECT_FALSE(remembered_times(some_device()));
    EXPECT_FALSE(remember_times(some_device(), some_times));
    EXPECT_FALSE(remembered_times(some_device()));
    fs::remove(folder);
    fs::create_directories(file);
    EXPECT_FALSE(remember_times(some_device(), some_times));
    EXPECT_FALSE(remembered_times(some_device()));
}

TEST_F(PipelineChoiceTest, TheFolderIsWhereTheEnvironmentSays) {
    setenv("XDG_CACHE_HOME", "/x", 1);
    setenv("HOME", "/h", 1);
    EXPECT_EQ(cache_folder(), folder);
    for (const char* nothing : {"", "-"}) {
        SCOPED_TRACE(nothing);
        const auto away = [&](const char* name) { *nothing ? unsetenv(name) : setenv(name, "", 1); };
        setenv("XDG_CACHE_HOME", "/x", 1);
        setenv("HOME", "/h", 1);
        away("OROGRAPH_CACHE");
        EXPECT_EQ(cache_folder(), "/x/orograph");
        away("XDG_CACHE_HOME");
        EXPECT_EQ(cache_folder(), "/h/.cache/orograph");
        away("HOME");
        EXPECT_EQ(cache_folder(), "");
        EXPECT_FALSE(remember_times(some_device(), some_times));
        EXPECT_FALSE(remembered_times(some_device()));
    }
    setenv("XDG_CACHE_HOME", "not/absolute", 1);  // the XDG base directory specification: to be ignored
    setenv("HOME", "/h", 1);
    EXPECT_EQ(cache_folder(), "/h/.cache/orograph");
}

TEST_F(PipelineChoiceTest, OneWayNeedsNoTimes) {
    DeviceReport device = some_device();
    device.compute_raster = false;
    ASSERT_TRUE(known_choice(device));
    EXPECT_EQ(text_of(*known_choice(device)), "mesh: the only way here");
    device = some_device();
    device.mesh_shader = false;
    ASSERT_TRUE(known_choice(device));
    EXPECT_EQ(text_of(*known_choice(device)), "compute: the only way here");
    EXPECT_FALSE(fs::exists(folder));
}

TEST_F(PipelineChoiceTest, SaysWhatWasMeasured) {
    PipelineChoice choice{RasterPath::mesh, PipelineTimes{0.001, 0.01, 0}, false};
    EXPECT_EQ(text_of(choice), "mesh: 10.0 times faster than compute here (measured 1970-01-01)");
    choice.measured_now = true;
    EXPECT_EQ(text_of(choice),
              "mesh: 10.0 times faster than compute here (measured now, for the first time)");
    choice.times->compute_s = 0.00104;
    EXPECT_EQ(text_of(choice), "mesh: as fast as compute here (measured now, for the first time)");
}

}  // namespace
}  // namespace oro
