// The files that the program keeps for a user: where they are, and that neither damage nor company harms
// them.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/settings/user_file.h"
#include "apps/settings/user_folders.h"
#include "apps/settings/window_settings.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::read_user_json;
using oro::UnitSystem;
using oro::WindowSettings;
using oro::write_user_json;

// Environment variables for a test, and what they were after it. nullptr: not set.
class UserEnvironment {
  public:
    UserEnvironment(std::initializer_list<std::pair<const char*, const char*>> values) {
        for (const auto& [name, value] : values) {
            const char* const before = std::getenv(name);
            before_[name] = before ? std::optional<std::string>(before) : std::nullopt;
            set(name, value);
        }
    }
    ~UserEnvironment() {
        for (const auto& [name, value] : before_) set(name, value ? value->c_str() : nullptr);
    }
    UserEnvironment(const UserEnvironment&) = delete;
    UserEnvironment& operator=(const UserEnvironment&) = delete;

  private:
    static void set(const std::string& name, const char* value) {
        if (value)
            setenv(name.c_str(), value, 1);
        else
            unsetenv(name.c_str());
    }
    std::map<std::string, std::optional<std::string>> before_;
};

std::string text_in(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

void put_text(const fs::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

std::vector<std::string> names_of(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

// Source: XDG Base Directory Specification 0.8: the defaults, and "If an implementation encounters a relative
// path in any of these variables it should consider the path invalid and ignore it."
TEST(UserFolders, AreThoseOfTheSpecification) {
    {
        const UserEnvironment named{{"XDG_CONFIG_HOME", "/c"},
                                    {"XDG_STATE_HOME", "/s"},
                                    {"XDG_CACHE_HOME", "/k"},
                                    {"OROGRAPH_CACHE", nullptr},
                                    {"HOME", "/home/a"}};
        EXPECT_EQ(*oro::user_config_folder(), fs::path("/c/orograph"));
        EXPECT_EQ(*oro::user_state_folder(), fs::path("/s/orograph"));
        EXPECT_EQ(*oro::user_cache_folder(), fs::path("/k/orograph"));
    }
    const UserEnvironment at_home{{"XDG_CONFIG_HOME", "relative/c"},
                                  {"XDG_STATE_HOME", ""},
                                  {"XDG_CACHE_HOME", nullptr},
                                  {"OROGRAPH_CACHE", nullptr},
                                  {"HOME", "/home/a"}};
    EXPECT_EQ(*oro::user_config_folder(), fs::path("/home/a/.config/orograph"));
    EXPECT_EQ(*oro::user_state_folder(), fs::path("/home/a/.local/state/orograph"));
    EXPECT_EQ(*oro::user_cache_folder(), fs::path("/home/a/.cache/orograph"));
    const UserEnvironment own{{"OROGRAPH_CACHE", "here"}};
    EXPECT_EQ(*oro::user_cache_folder(), fs::path("here"));
}

TEST(UserFolders, NeedAHome) {
    for (const char* home : {static_cast<const char*>(nullptr), "", "relative"}) {
        const UserEnvironment homeless{{"XDG_CONFIG_HOME", nullptr}, {"HOME", home}};
        const auto folder = oro::user_config_folder();
        ASSERT_FALSE(folder.ok());
        EXPECT_EQ(
            folder.error().line(),
            "XDG_CONFIG_HOME: neither it nor HOME is set to an absolute path: there is no folder for this "
            "user's files");
        std::vector<std::string> notes;
        EXPECT_FALSE(oro::read_window_settings(notes).ok());
        EXPECT_FALSE(oro::write_window_settings({}).ok());
    }
}

TEST(UserFile, ComesBackAsItWasWritten) {
    const fs::path folder = oro::test::scratch_folder(), file = folder / "a" / "b" / "settings.json";
    std::vector<std::string> notes;
    EXPECT_EQ(*read_user_json(file, notes), json::object()) << "absent";
    const json written = {{"size", {1280, 720}}, {"name", "Z\xc3\xbcrich"}, {"deep", {{"a", true}}}};
    ASSERT_TRUE(write_user_json(file, written).ok());
    EXPECT_EQ(*read_user_json(file, notes), written);
    ASSERT_TRUE(write_user_json(file, {{"other", 1}}).ok()) << "over the first";
    EXPECT_EQ(*read_user_json(file, notes), (json{{"other", 1}}));
    EXPECT_TRUE(notes.empty());
    EXPECT_EQ(names_of(file.parent_path()), std::vector<std::string>{"settings.json"});
    for (const fs::path& made : {folder / "a", folder / "a" / "b"})
        EXPECT_EQ(fs::status(made).permissions() & fs::perms::mask, fs::perms::owner_all) << made;
}

TEST(UserFile, ADamagedOneIsSetAsideAndSaidOnce) {
    const fs::path folder = oro::test::scratch_folder(), file = folder / "settings.json";
    const std::vector<std::string> damaged = {"",
                                              "{",
                                              "{\"a\": 1",
                                              "{\"a\": 1}}",
                                              "[1, 2]",
                                              "null",
                                              "17",
                                              "{'a': 1}",
                                              std::string("\0\0\0\0", 4),
                                              "\xff\xfe{}",
                                              "{\"a\": \"\xc3\x28\"}",
                                              std::string(2000, '['),
                                              "{\"a\": 1e999}"};
    std::size_t number = 0;
    for (const std::string& text : damaged) {
        ++number;
        put_text(file, text);
        std::vector<std::string> notes;
        const auto read = read_user_json(file, notes);
        ASSERT_TRUE(read.ok()) << read.error().line();
        EXPECT_EQ(*read, json::object()) << text;
        const fs::path other =
            file.string() + (number == 1 ? ".damaged" : ".damaged." + std::to_string(number));
        ASSERT_EQ(notes.size(), 1U) << text;
        EXPECT_NE(notes[0].find(file.string() + ": "), std::string::npos) << notes[0];
        EXPECT_NE(notes[0].find("it is now " + other.string()), std::string::npos) << notes[0];
        EXPECT_EQ(text_in(other), text) << "nothing is lost";
        EXPECT_FALSE(fs::exists(file));
        EXPECT_EQ(*read_user_json(file, notes), json::object());
        EXPECT_EQ(notes.size(), 1U) << "it is said once";
    }
}

// Texts by the grammar of JSON and cuts of them: each is read as an object, or set aside with all its bytes.
TEST(UserFile, ByChanceFromTheGrammar) {
    const unsigned seed = 49;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 chance(seed);
    const std::vector<std::string> pieces = {"{",         "}",     "[",  "]",      ":",    ",",
                                             "\"a\"",     "\"b\"", "1",  "-2.5e3", "true", "null",
                                             "\"\\u12\"", " ",     "\n", "\"",     "\xc3"};
    const fs::path folder = oro::test::scratch_folder();
    for (int round = 0; round < 300; ++round) {
        const fs::path file = folder / (std::to_string(round) + ".json");
        std::string text = round % 3 == 0 ? R"({"a": [1, {"b": null}], "c": "d"})" : "{";
        if (round % 3 == 0)
            text.resize(chance() % (text.size() + 1));
        else
            for (unsigned i = chance() % 8; i > 0; --i) text += pieces[chance() % pieces.size()];
        put_text(file, text);
        std::vector<std::string> notes;
        const auto read = read_user_json(file, notes);
        ASSERT_TRUE(read.ok()) << text;
        EXPECT_TRUE(read->is_object());
        const json expected = json::parse(text, nullptr, false);
        EXPECT_EQ(notes.empty(), expected.is_object()) << text;
        EXPECT_EQ(*read, expected.is_object() ? expected : json::object()) << text;
        EXPECT_EQ(text_in(notes.empty() ? file : fs::path(file.string() + ".damaged")), text);
    }
}

TEST(UserFile, WhatCannotBeReadOrWrittenIsAnError) {
    const fs::path folder = oro::test::scratch_folder();
    std::vector<std::string> notes;
    EXPECT_FALSE(read_user_json(folder, notes).ok()) << "a folder";
    EXPECT_FALSE(write_user_json(folder, json::object()).ok());
    put_text(folder / "file", "");
    EXPECT_FALSE(write_user_json(folder / "file" / "settings.json", json::object()).ok()) << "in a file";
    EXPECT_EQ(*read_user_json(folder / "file" / "settings.json", notes), json::object());
    json deep = json::object();
    for (int i = 0; i < 20; ++i) deep = json{{"in", deep}};
    put_text(folder / "settings.json", "{\"a\": 1}\n");
    const auto refused = write_user_json(folder / "settings.json", deep);
    ASSERT_FALSE(refused.ok());
    EXPECT_NE(refused.error().line().find("is not written: values are nested deeper than 16"),
              std::string::npos);
    EXPECT_EQ(text_in(folder / "settings.json"), "{\"a\": 1}\n") << "what was there stays";
    EXPECT_TRUE(notes.empty());
    EXPECT_EQ(names_of(folder), (std::vector<std::string>{"file", "settings.json"}));
}

TEST(UserFile, OfAFolderThatMayNotBeWritten) {
    if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
    const fs::path folder = oro::test::scratch_folder(), file = folder / "settings.json";
    put_text(file, "{");
    ASSERT_EQ(chmod(folder.c_str(), S_IRUSR | S_IXUSR), 0);
    std::vector<std::string> notes;
    const auto read = read_user_json(file, notes);
    const auto written = write_user_json(folder / "new.json", json::object());
    ASSERT_EQ(chmod(folder.c_str(), S_IRWXU), 0);
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.error().line().find("cannot be renamed: "), std::string::npos) << read.error().line();
    EXPECT_FALSE(written.ok());
    EXPECT_EQ(names_of(folder), std::vector<std::string>{"settings.json"});
}

// Two windows write, a third reads: whatever it finds is all of one version.
TEST(UserFile, IsNeverTorn) {
    const fs::path file = oro::test::scratch_folder() / "settings.json";
    const auto version = [](int writer) {
        return json{{"writer", writer}, {"text", std::string(20000, static_cast<char>(97 + writer))}};
    };
    ASSERT_TRUE(write_user_json(file, version(0)).ok());
    std::atomic<int> running{2};
    std::vector<std::thread> writers;
    for (int writer = 0; writer < 2; ++writer)
        writers.emplace_back([&, writer] {
            for (int i = 0; i < 40; ++i) EXPECT_TRUE(write_user_json(file, version(writer)).ok());
            --running;
        });
    std::vector<std::string> notes;
    do {
        const auto read = read_user_json(file, notes);
        EXPECT_TRUE(read.ok());
        if (read.ok()) {
            EXPECT_EQ(*read, version(read->value("writer", 0)));
        }
    } while (running > 0);
    for (std::thread& writer : writers) writer.join();
    EXPECT_TRUE(notes.empty());
    EXPECT_EQ(names_of(file.parent_path()), std::vector<std::string>{"settings.json"});
}

TEST(WindowSettings, ComeBackAndKeepWhatOthersWrote) {
    const fs::path folder = oro::test::scratch_folder();
    const UserEnvironment here{{"XDG_CONFIG_HOME", folder.c_str()}};
    std::vector<std::string> notes;
    EXPECT_EQ(*oro::read_window_settings(notes), WindowSettings()) << "of the first run";
    const fs::path file = folder / "orograph" / "window.json";
    ASSERT_TRUE(write_user_json(file, {{"of_a_later_version", {1, 2}}}).ok());
    WindowSettings settings;
    settings.width_px = 1920;
    settings.height_px = 1080;
    settings.is_maximised = true;
    settings.ui_scale = 1.5;
    settings.units = UnitSystem::imperial;
    settings.panels = {{"compass", false}, {"read-out", true}};
    ASSERT_TRUE(oro::write_window_settings(settings).ok());
    EXPECT_EQ(*oro::read_window_settings(notes), settings);
    EXPECT_TRUE(notes.empty());
    EXPECT_EQ(*read_user_json(file, notes), (json{{"of_a_later_version", {1, 2}},
                                                  {"width_px", 1920},
                                                  {"height_px", 1080},
                                                  {"maximised", true},
                                                  {"ui_scale", 1.5},
                                                  {"units", "imperial"},
                                                  {"panels", {{"compass", false}, {"read-out", true}}}}));
}

TEST(WindowSettings, AValueThatIsNoneLeavesTheDefault) {
    const json object = {{"width_px", 1920},    {"height_px", "tall"},
                         {"maximised", 1},      {"ui_scale", 9},
                         {"units", "nautical"}, {"panels", {{"compass", false}, {"scale", "yes"}}},
                         {"unknown", nullptr}};
    std::vector<std::string> notes;
    WindowSettings expected;
    expected.width_px = 1920;
    expected.panels = {{"compass", false}};
    EXPECT_EQ(oro::window_settings_in(object, notes), expected);
    EXPECT_EQ(notes,
              (std::vector<std::string>{
                  "window settings: 'height_px' must be a whole number, and is string; the default holds",
                  "window settings: 'maximised' must be true or false, and is number; the default holds",
                  "window settings: 'ui_scale' is 9, not between 0.5 and 4; the default holds",
                  "window settings: 'units' is 'nautical', neither metric nor imperial; the default holds",
                  "window settings: 'scale' must be true or false, and is string; the default holds"}));
    for (const json& none : {json::array(), json(3)}) {
        notes.clear();
        EXPECT_EQ(oro::window_settings_in(json{{"panels", none}}, notes), WindowSettings());
        EXPECT_EQ(notes.size(), 1U);
    }
}

}  // namespace
