// The rooms (folders of sources) of each folder are layers: no include leads from a room over others back to
// it. docs/drawings/rooms.md is drawn from the same includes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/layers/source_files.h"

namespace {
namespace fs = std::filesystem;
using oro::test::is_source;
using oro::test::text_of;

// A source file, by its path from the project's folder, and the files that it includes, as they are written.
struct SourceIncludes {
    std::string file;
    std::vector<std::string> includes;
};
// Of a room: the rooms that it includes, and of each the includes, "file includes file".
using RoomIncludes = std::map<std::string, std::vector<std::string>>;
using Rooms = std::map<std::string, RoomIncludes>;

std::string room_of(const std::string& file) {
    return fs::path(file).parent_path().generic_string();
}

std::vector<std::string> includes_in(const std::string& text) {
    static const std::regex directive("^[ \t]*#[ \t]*include[ \t]*\"([^\"]+)\".*$");
    std::vector<std::string> found;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::smatch name;
        if (std::regex_match(line, name, directive)) found.push_back(name[1]);
    }
    return found;
}

// The rooms of a folder ("core"), each with those of the same folder that it includes.
Rooms rooms_of(const std::string& folder, const std::vector<SourceIncludes>& sources) {
    Rooms rooms;
    for (const SourceIncludes& source : sources) {
        RoomIncludes& from = rooms[room_of(source.file)];
        for (const std::string& included : source.includes) {
            if (!included.starts_with(folder + "/") || room_of(included) == room_of(source.file)) continue;
            from[room_of(included)].push_back(source.file + " includes " + included);
        }
    }
    return rooms;
}

// All rooms that a room includes, itself or through others.
std::set<std::string> reached_from(const Rooms& rooms, const std::string& room) {
    std::set<std::string> reached;
    const std::function<void(const std::string&)> add = [&](const std::string& from) {
        const auto found = rooms.find(from);
        if (found == rooms.end()) return;
        for (const auto& [to, includes] : found->second) {
            if (reached.insert(to).second) add(to);
        }
    };
    add(room);
    return reached;
}

// The includes between rooms that reach each other, one a line, those of few files first: the ones to end. ""
// where there is no circle.
std::string circles_in(const Rooms& rooms) {
    std::map<std::string, std::set<std::string>> reached;
    for (const auto& [room, includes] : rooms) reached[room] = reached_from(rooms, room);
    std::vector<std::vector<std::string>> found;
    for (const auto& [from, towards] : rooms) {
        for (const auto& [to, includes] : towards) {
            if (reached[to].contains(from)) found.push_back(includes);
        }
    }
    std::ranges::stable_sort(found, {}, &std::vector<std::string>::size);
    std::string text;
    for (const std::vector<std::string>& includes : found) {
        for (const std::string& line : includes) text += "  " + line + "\n";
    }
    return text;
}

std::vector<SourceIncludes> sources_of(const std::string& folder) {
    std::vector<SourceIncludes> sources;
    const fs::path project = oro::test::project_folder();
    for (const fs::path& file : oro::test::sources_in({folder.c_str()}))
        sources.push_back({file.lexically_relative(project).generic_string(), includes_in(text_of(file))});
    return sources;
}

const std::vector<std::string>& folders() {
    static const std::vector<std::string> all = {"core", "geo", "render", "apps"};
    return all;
}

// One arrow for each include between rooms that no longer way says already, as a flow chart of Mermaid's.
std::string chart_of(const std::string& folder, const Rooms& rooms) {
    const auto id = [](const std::string& room) { return std::regex_replace(room, std::regex("/"), "_"); };
    std::string text = "## " + folder + "\n\n```mermaid\nflowchart TD\n";
    for (const auto& [room, includes] : rooms) {
        const std::string name = room == folder ? folder : room.substr(folder.size() + 1);
        text += "  " + id(room) + "[\"" + name + "\"]\n";
    }
    for (const auto& [from, towards] : rooms) {
        for (const auto& [to, includes] : towards) {
            const bool is_said = std::ranges::any_of(towards, [&](const auto& other) {
                return other.first != to && reached_from(rooms, other.first).contains(to);
            });
            if (!is_said) text += "  " + id(from) + " --> " + id(to) + "\n";
        }
    }
    return text + "```\n";
}

class RoomsTest : public testing::TestWithParam<std::string> {};

TEST_P(RoomsTest, AreLayers) {
    const Rooms rooms = rooms_of(GetParam(), sources_of(GetParam()));
    EXPECT_GE(rooms.size(), 5U) << "of " << GetParam();
    const std::string circles = circles_in(rooms);
    EXPECT_TRUE(circles.empty()) << "rooms of " << GetParam() << " include each other in a circle:\n"
                                 << circles;
}
INSTANTIATE_TEST_SUITE_P(Folders, RoomsTest, testing::ValuesIn(folders()),
                         [](const auto& folder) { return folder.param; });

// OROGRAPH_WRITE_DRAWINGS=1 writes the drawing anew.
TEST(Rooms, AreDrawnAsTheyAre) {
    std::string drawn =
        "# The rooms of each folder\n\n"
        "An arrow points from the room that includes to the room that is included. An include that a longer "
        "way says\nalready has no arrow. `layers_tests` draws this page from the source's includes, with "
        "OROGRAPH_WRITE_DRAWINGS=1\nset, and fails where the page differs from them.\n";
    for (const std::string& folder : folders())
        drawn += "\n" + chart_of(folder, rooms_of(folder, sources_of(folder)));
    const fs::path page = oro::test::project_folder() / "docs" / "drawings" / "rooms.md";
    if (std::getenv("OROGRAPH_WRITE_DRAWINGS")) std::ofstream(page, std::ios::binary) << drawn;
    EXPECT_EQ(text_of(page), drawn) << "draw it anew: OROGRAPH_WRITE_DRAWINGS=1 layers_tests "
                                       "--gtest_filter=Rooms.AreDrawnAsTheyAre";
}

// The search on a made-up folder: cellar and stairs are a circle, the roof only stands on them.
TEST(Rooms, ACircleIsFound) {
    const std::vector<SourceIncludes> made = {
        {"house/cellar/wine.h", {"house/stairs/step.h", "garden/vine.h"}},
        {"house/stairs/step.h", {"house/stairs/rail.h"}},
        {"house/stairs/rail.cpp", {"house/floor/board.h"}},
        {"house/floor/board.cpp", {"house/cellar/wine.h", "house/cellar/shelf.h"}},
        {"house/roof/tile.h", {"house/stairs/step.h", "house/floor/board.h"}}};
    EXPECT_EQ(circles_in(rooms_of("house", made)),
              "  house/cellar/wine.h includes house/stairs/step.h\n"
              "  house/stairs/rail.cpp includes house/floor/board.h\n"
              "  house/floor/board.cpp includes house/cellar/wine.h\n"
              "  house/floor/board.cpp includes house/cellar/shelf.h\n");
    const std::vector<SourceIncludes> mended(made.begin() + 1, made.end());
    EXPECT_EQ(circles_in(rooms_of("house", mended)), "");
    EXPECT_EQ(includes_in("#include <map>\n# include \"house/roof/tile.h\"  // that\n//#include \"a/b.h\"\n"),
              std::vector<std::string>{"house/roof/tile.h"});
}

// Of the roof's two includes the longer way says one.
TEST(Rooms, AChartHasOneWay) {
    const std::vector<SourceIncludes> made = {
        {"house/stairs/rail.cpp", {"house/floor/board.h"}},
        {"house/floor/board.h", {}},
        {"house/roof/tile.h", {"house/stairs/step.h", "house/floor/board.h"}}};
    EXPECT_EQ(chart_of("house", rooms_of("house", made)),
              "## house\n\n```mermaid\nflowchart TD\n"
              "  house_floor[\"floor\"]\n  house_roof[\"roof\"]\n  house_stairs[\"stairs\"]\n"
              "  house_roof --> house_stairs\n  house_stairs --> house_floor\n```\n");
}

}  // namespace
