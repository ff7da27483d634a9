// Bookmarks and what was opened last: files in the user's folders.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "apps/settings/bookmarks.h"
#include "apps/settings/recent_files.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using namespace oro;

std::string read_all(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

// Folders of its own.
class UserLists : public testing::Test {
  protected:
    void SetUp() override {
        folder = oro::test::scratch_folder();
        setenv("XDG_CONFIG_HOME", (folder / "config").c_str(), 1);
        setenv("XDG_STATE_HOME", (folder / "state").c_str(), 1);
    }
    void TearDown() override {
        unsetenv("XDG_CONFIG_HOME");
        unsetenv("XDG_STATE_HOME");
    }
    [[nodiscard]] fs::path bookmarks_file() const {
        return folder / "config" / "orograph" / "bookmarks.json";
    }
    [[nodiscard]] fs::path recent_file() const { return folder / "state" / "orograph" / "recent.json"; }
    static void write(const fs::path& file, const std::string& text) {
        fs::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
    }

    fs::path folder;
};

TEST_F(UserLists, BookmarksAreKeptToTheLastBit) {
    EXPECT_TRUE(read_bookmarks()->all.empty());
    EXPECT_FALSE(fs::exists(folder / "config")) << "reading makes nothing";
    const Bookmark eiger{"Eiger, Ostegg", 46.577621, 8.005393,
                         BookmarkedEye{3967.1234567890123, 211.5, -3.25, 0.0, 45.0}};
    ASSERT_TRUE(add_bookmark(eiger).ok());
    ASSERT_TRUE(add_bookmark({"Zürich", 47.37, 8.54, {}}).ok());
    Bookmarks read = read_bookmarks().value();
    EXPECT_TRUE(read.notes.empty());
    ASSERT_EQ(read.all.size(), 2U);
    EXPECT_EQ(read.all[0].name, "Eiger, Ostegg");
    EXPECT_EQ(read.all[0].lat_deg, eiger.lat_deg);
    ASSERT_TRUE(read.all[0].eye);
    EXPECT_EQ(read.all[0].eye->h_m, eiger.eye->h_m);
    EXPECT_EQ(read.all[0].eye->pitch_deg, -3.25);
    EXPECT_EQ(read.all[1].name, "Zürich");
    EXPECT_FALSE(read.all[1].eye);
    // The same name again takes its place.
    ASSERT_TRUE(add_bookmark({"Eiger, Ostegg", 46.5, 8.0, {}}).ok());
    read = read_bookmarks().value();
    ASSERT_EQ(read.all.size(), 2U);
    EXPECT_EQ(read.all[0].lat_deg, 46.5);
    EXPECT_EQ(remove_bookmark("Eiger, Ostegg")->all.size(), 1U);
    EXPECT_EQ(remove_bookmark("Eiger").error().line(), "bookmark \"Eiger\": there is none of that name");
    EXPECT_EQ(read_bookmarks()->all.front().name, "Zürich");
    struct stat found {};
    ASSERT_EQ(stat((folder / "config" / "orograph").c_str(), &found), 0);
    EXPECT_EQ(found.st_mode & 0777U, 0700U);
    for (const auto& entry : fs::directory_iterator(folder / "config" / "orograph"))
        EXPECT_EQ(entry.path().filename(), "bookmarks.json") << "nothing is left beside it";
}

TEST_F(UserLists, WhatIsNoBookmarkIsRefused) {
    const std::string whole = R"({"orograph_bookmarks": 1, "bookmarks": []})";
    write(bookmarks_file(), whole);
    for (const Bookmark& wrong : {Bookmark{"", 46.0, 8.0, {}}, Bookmark{"two\nlines", 46.0, 8.0, {}},
                                  Bookmark{"a", 91.0, 8.0, {}}, Bookmark{"a", 46.0, std::nan(""), {}},
                                  Bookmark{"a", 46.0, 8.0, BookmarkedEye{1e99, 0.0, 0.0, 0.0, 45.0}},
                                  Bookmark{"a", 46.0, 8.0, BookmarkedEye{0.0, 0.0, 0.0, 0.0, 0.0}}}) {
        const auto added = add_bookmark(wrong);
        ASSERT_FALSE(added.ok()) << wrong.name;
        EXPECT_EQ(added.error().kind, ErrorKind::usage);
        EXPECT_EQ(read_all(bookmarks_file()), whole) << "the file stays as it was";
    }
}

TEST_F(UserLists, ADamagedFileIsSetAsideAndSaid) {
    const std::vector<std::string> damaged{
        "",
        "{",
        "[]",
        "null",
        R"({"orograph_bookmarks": 2, "bookmarks": []})",
        R"({"orograph_bookmarks": 1})",
        R"({"orograph_bookmarks": 1, "bookmarks": [{"name": "a", "lat_deg": 91, "lon_deg": 8}]})",
        R"({"orograph_bookmarks": 1, "bookmarks": [{"name": "a", "lat_deg": "46", "lon_deg": 8}]})",
        R"({"orograph_bookmarks": 1, "bookmarks": [{"name": "a", "lat_deg": 46, "lon_deg": 8, "eye": {}}]})"};
    for (const std::string& text : damaged) {
        write(bookmarks_file(), text);
        const auto read = read_bookmarks();
        ASSERT_TRUE(read.ok()) << read.error().line();
        EXPECT_TRUE(read->all.empty());
        ASSERT_EQ(read->notes.size(), 1U);
        EXPECT_NE(read->notes[0].find("bookmarks.json: "), std::string::npos) << read->notes[0];
        EXPECT_NE(read->notes[0].find("; it is now "), std::string::npos) << read->notes[0];
        EXPECT_FALSE(fs::exists(bookmarks_file()));
        const fs::path aside = bookmarks_file().string() + ".damaged";
        EXPECT_EQ(read_all(aside), text);
        EXPECT_TRUE(read_bookmarks()->notes.empty()) << "said once";
        fs::remove(aside);
    }
    write(recent_file(), R"({"orograph_recent": 1, "opened": [[]]})");
    EXPECT_NE(read_recent_files()->notes.at(0).find("recent.json: "), std::string::npos);
    ASSERT_TRUE(add_recent_files({"/data/alps"}).ok()) << "and one begins anew";
    EXPECT_EQ(read_recent_files()->all.size(), 1U);
}

TEST_F(UserLists, TheLastOpenedComesFirst) {
    using List = std::vector<std::vector<std::string>>;
    EXPECT_TRUE(read_recent_files()->all.empty());
    const std::string no_text = "/data/\xff\xfe.hgt";
    ASSERT_TRUE(add_recent_files({"/data/alps"}).ok());
    ASSERT_TRUE(add_recent_files({"/data/a.tif", no_text}).ok());
    ASSERT_TRUE(add_recent_files({"/data/alps"}).ok());
    EXPECT_EQ(read_recent_files()->all, (List{{"/data/alps"}, {"/data/a.tif", no_text}}));
    for (int i = 0; i < 30; ++i) ASSERT_TRUE(add_recent_files({"/data/" + std::to_string(i)}).ok());
    const auto all = read_recent_files()->all;
    ASSERT_EQ(all.size(), most_recent_files);
    EXPECT_EQ(all.front().front(), "/data/29");
    EXPECT_EQ(all.back().front(), "/data/10");
    ASSERT_TRUE(add_recent_files({"."}).ok()) << "from the working folder";
    EXPECT_TRUE(fs::path(read_recent_files()->all.front().front()).is_absolute());
    EXPECT_FALSE(add_recent_files({}).ok());
}

TEST_F(UserLists, AFolderThatCannotBeMadeIsAnError) {
    write(folder / "config", "a file");
    const auto added = add_bookmark({"a", 46.0, 8.0, {}});
    ASSERT_FALSE(added.ok());
    EXPECT_EQ(added.error().kind, ErrorKind::failed);
    EXPECT_NE(added.error().line().find("config/orograph"), std::string::npos) << added.error().line();
}

}  // namespace
