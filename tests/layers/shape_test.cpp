// The shape of the code: a file holds one concept and is as long as that takes, a function fits on a screen.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/layers/source_files.h"

namespace {
namespace fs = std::filesystem;
using oro::test::text_of;

constexpr std::size_t most_lines_in_a_file = 800;
constexpr std::size_t most_lines_in_a_function = 60;

std::vector<fs::path> sources() {
    return oro::test::sources_in({"apps", "core", "geo", "render", "shaders", "tests"});
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

struct Function {
    std::string first_line;
    std::size_t lines{};
};

// The functions of a text that clang-format has laid out: each starts with a line that ends in ") {" (or with
// what may stand between), and ends with a brace below its own first letter. Lines of a table in it ("= {" or
// "name{" to "};") do not count.
std::vector<Function> functions_in(const std::string& text) {
    static const std::regex head(R"(^( {0,4})[^ #/}:].*\)( const| noexcept| override|( -> [\w:<>]+))* \{$)");
    static const std::regex open_signature(R"(^( {0,4})[A-Za-z~].*[(,]$)");
    static const std::regex end_of_signature(R"(^ +.*\)( const| noexcept| override| : .*)* \{$)");
    static const std::regex statement(
        R"(^ *(if|for|while|switch|else|do|try|catch|return|namespace|INSTANTIATE_TEST_SUITE_P)\b.*)");
    static const std::regex table(R"(^( *).*(= |[A-Za-z_])\{$)");
    const std::vector<std::string> lines = lines_of(text);
    std::vector<Function> found;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        std::smatch start;
        std::size_t body = i;
        if (std::regex_match(lines[i], statement)) continue;
        if (!std::regex_match(lines[i], start, head)) {
            if (!std::regex_match(lines[i], start, open_signature)) continue;
            while (body + 1 < lines.size() && body < i + 8 && !lines[body].ends_with("{") &&
                   !lines[body].ends_with(";"))
                ++body;
            if (!std::regex_match(lines[body], end_of_signature)) continue;
        }
        const std::string close = start[1].str() + "}";
        std::size_t counted = body - i + 1;
        std::string table_close;
        for (++body; body < lines.size() && lines[body] != close; ++body) {
            std::smatch opening;
            if (!table_close.empty()) {
                if (lines[body].starts_with(table_close)) table_close.clear();
                continue;
            }
            if (std::regex_match(lines[body], opening, table)) table_close = opening[1].str() + "}";
            ++counted;
        }
        found.push_back({lines[i], counted + 1});
        i = body;
    }
    return found;
}

TEST(Shape, FilesAreShort) {
    for (const fs::path& file : sources())
        EXPECT_LE(lines_of(text_of(file)).size(), most_lines_in_a_file) << file;
}

TEST(Shape, FunctionsAreShort) {
    std::size_t seen = 0;
    for (const fs::path& file : sources()) {
        for (const Function& function : functions_in(text_of(file))) {
            ++seen;
            EXPECT_LE(function.lines, most_lines_in_a_function) << file << ": " << function.first_line;
        }
    }
    EXPECT_GT(seen, 2000U) << "the search finds few of the functions that there are";
}

// The search finds a long function, also in a class and with a signature of two lines, and passes over a
// table.
TEST(Shape, ALongFunctionIsFound) {
    std::string body, rows;
    for (int i = 0; i < 70; ++i) {
        body += "    x += 1;\n";
        rows += "        {1, 2},\n";
    }
    const auto longest = [](const std::string& text) {
        std::size_t most = 0;
        for (const Function& function : functions_in(text)) most = std::max(most, function.lines);
        return most;
    };
    EXPECT_EQ(longest("int f(int x) {\n" + body + "}\n"), 72U);
    EXPECT_EQ(longest("int f(int x,\n      int y) {\n" + body + "}\n"), 73U);
    EXPECT_EQ(longest("class C {\n  public:\n    int f(int x) const {\n" + body + "    }\n};\n"), 72U);
    EXPECT_EQ(longest("int f(int x) {\n    static const T t[] = {\n" + rows + "    };\n    return t;\n}\n"),
              4U);
}

}  // namespace
