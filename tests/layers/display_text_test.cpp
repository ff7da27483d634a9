// No decision is taken on text that is made for people: facts are enums, flags and numbers, and words are
// made of them at the edge. Sources are searched for comparisons with fields and functions that hold such
// text.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/layers/source_files.h"

namespace {
namespace fs = std::filesystem;

// Members that hold prose. A name that people give to things (a file, a device) is none.
const std::string prose =
    "(attribution|caption|crs|damage|doubts?|format|geoid|line|meaning|messages?|no_choice|notes?|placement|"
    "posts_are|problem|reason|remark|title|type|unfit|vertical_datum|void_method|what|why|[a-z_]*_words|"
    "[a-z]+_text)";

// The one file that makes words of a source's facts, and for baked regions facts of these words.
const std::string words_and_back = "geo/sources/source_words.cpp";

// The lines of a source that compare prose with something, or look for something in it.
std::vector<std::string> decisions_on_prose(const std::string& text) {
    const std::string member = "(\\.|->)" + prose + "(\\([^()]*\\))?";
    const std::string call = "\\b([a-z_]*_words|[a-z]+_text)\\([^()]*\\)";
    const std::string held = "(" + member + "|" + call + ")";
    const std::string literal = "(std::string(_view)?[({])?\"";
    static const std::regex decision(held + "\\s*(==|!=)\\s*" + literal + "|" +          // a.note == "..."
                                     "\"[)}]?\\s*(==|!=)\\s*[A-Za-z_:]+" + held + "|" +  // "..." == a.note
                                     held +
                                     "\\.(r?find|find_first_of|starts_with|ends_with|contains|compare)\\(|" +
                                     "(strn?cmp|strstr|regex_search|regex_match)\\([^;]*" + held + "|" +
                                     "\\b(note|reason|remark|message)\\s*(==|!=)\\s*" + literal);
    std::vector<std::string> found;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const std::string code = line.substr(0, line.find("//"));
        if (std::regex_search(code, decision)) found.push_back(line);
    }
    return found;
}

TEST(DisplayText, NothingIsDecidedOnIt) {
    const fs::path root = oro::test::project_folder();
    int sources = 0;
    for (const fs::path& file : oro::test::sources_in({"core", "geo", "render", "apps"})) {
        if (file.lexically_relative(root) == words_and_back) continue;
        ++sources;
        for (const std::string& line : decisions_on_prose(oro::test::text_of(file)))
            ADD_FAILURE() << file << " decides on text made for people:" << line;
    }
    EXPECT_GT(sources, 200);
    EXPECT_TRUE(fs::exists(root / words_and_back));
}

// The search finds what it is for: the first two were once in these sources.
TEST(DisplayText, ADecisionThatIsPlantedIsFound) {
    for (const char* line :
         {"if (source.format.find(\"SRTM\") != std::string::npos) return 16.0;",
          "[](const Source& source) { return source.report.format.ends_with(\".hgt\"); }",
          "if (gpu_->report().type == \"software\") slow = true;",
          "if (\"holes\" == region.void_method) return;", "return source->placement.starts_with(\"cubic\");",
          "if (datum_words(d).contains(\"EGM96\")) return;",
          "if (error.line() == \"cannot be read\") retry();", "if (std::strcmp(g.meaning.c_str(), why)) {",
          "if (std::regex_search(finding.reason, cut)) {", "if (note == \"\") return;",
          "if (report.posts_are != std::string(\"points\")) {"})
        EXPECT_EQ(decisions_on_prose(line).size(), 1U) << line;
    for (const char* line :
         {"if (source.format != SourceFormat::raster) return 16.0;", "report.format = \"GTiff\";",
          "// once: source.format.find(\"SRTM\")", "if (!shift.note().empty()) say(shift.note());",
          "if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);",
          "const bool mesh = request == \"mesh\";", "if (path.ends_with(\".oro\")) open(path);"})
        EXPECT_EQ(decisions_on_prose(line).size(), 0U) << line;
}

}  // namespace
