// Each type of the program has a name of its own: two of one name in one namespace, linked into one program,
// are one to the linker, and a vector of the second then has wrong elements.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/layers/source_files.h"

namespace {
namespace fs = std::filesystem;
using oro::test::text_of;

// The types that a text defines in named namespaces, as clang-format lays them out: a namespace's own lines
// begin in the first column. Types in other types and in unnamed namespaces do not count.
std::vector<std::string> types_defined_in(const std::string& text) {
    static const std::regex opening(R"(^(inline )?namespace ([\w:]*) ?\{.*$)");
    static const std::regex closing(R"(^\}  // namespace.*$)");
    static const std::regex type(
        R"(^(struct|class|union|enum|enum class) (\w+)( final)?( : [^;]*)?( \{.*|)$)");
    static const std::regex alias(R"(^using (\w+) =.*$)");
    std::vector<std::string> found, scopes;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (std::regex_match(line, match, opening)) {
            if (line.find("{}") == std::string::npos) scopes.push_back(match[2]);
            continue;
        }
        if (std::regex_match(line, closing)) {
            if (!scopes.empty()) scopes.pop_back();
            continue;
        }
        std::string scope;
        bool named = true;
        for (const std::string& one : scopes) {
            named = named && !one.empty();
            scope += one + "::";
        }
        if (!named) continue;
        if (std::regex_match(line, match, type)) found.push_back(scope + match[2].str());
        if (std::regex_match(line, match, alias)) found.push_back(scope + match[1].str());
    }
    return found;
}

TEST(Types, EachHasANameOfItsOwn) {
    std::map<std::string, std::set<std::string>> files_of;
    for (const fs::path& file : oro::test::sources_in({"core", "geo", "render", "apps"})) {
        if (file.extension() != ".h" && file.extension() != ".cpp") continue;
        for (const std::string& type : types_defined_in(text_of(file)))
            files_of[type].insert(file.lexically_relative(oro::test::project_folder()).string());
    }
    EXPECT_GT(files_of.size(), 500U) << "the search finds few of the types that there are";
    for (const auto& [type, files] : files_of) {
        std::string named;
        for (const std::string& file : files) named += " " + file;
        EXPECT_EQ(files.size(), 1U) << type << " is defined in" << named;
    }
}

TEST(Types, AreFoundInNamedNamespacesAlone) {
    const std::string text =
        "namespace oro {\nstruct A {\n    struct Inner {\n    };\n};\nclass B final : public A {\n};\n"
        "struct Declared;\nenum class C { one };\nusing D = int;\nnamespace {\nstruct Hidden {\n};\n}  // "
        "namespace\n"
        "namespace gpu {\nstruct A {\n};\n}  // namespace gpu\n}  // namespace oro\n";
    EXPECT_EQ(types_defined_in(text),
              (std::vector<std::string>{"oro::A", "oro::B", "oro::C", "oro::D", "oro::gpu::A"}));
}

}  // namespace
