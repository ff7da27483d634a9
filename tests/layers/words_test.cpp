// No name in the code holds a word that docs/GLOSSARY.md has retired. Its table of retired words says for
// each what to say instead.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "tests/layers/source_files.h"

namespace {
namespace fs = std::filesystem;
using oro::test::text_of;
using Parts = std::vector<std::string>;

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}
bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}
bool is_upper(char c) {
    return std::isupper(static_cast<unsigned char>(c)) != 0;
}

// The words of a name in lower case: split where no letter is, and before a capital that begins a word.
Parts parts_of(std::string_view name) {
    Parts parts(1);
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        if (!is_letter(c)) {
            if (!parts.back().empty()) parts.emplace_back();
            continue;
        }
        const bool begins = is_upper(c) && i > 0 &&
                            (!is_upper(name[i - 1]) || (i + 1 < name.size() && !is_upper(name[i + 1])));
        if (begins && !parts.back().empty()) parts.emplace_back();
        parts.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    if (parts.back().empty()) parts.pop_back();
    return parts;
}

struct RetiredWord {
    Parts parts;  // of one word, or of several that follow each other
    std::string instead;
};

// The rows of the glossary's table of retired words.
std::vector<RetiredWord> retired_words_in(const std::string& page) {
    std::vector<RetiredWord> words;
    std::istringstream lines(page);
    bool is_there = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("## ")) is_there = line == "## Retired words";
        if (!is_there || !line.starts_with("| ") || line.starts_with("| word |")) continue;
        const std::size_t end = line.find(" |", 2), last = line.find(" |", end + 2);
        if (last == std::string::npos) continue;
        words.push_back({parts_of(line.substr(2, end - 2)), line.substr(end + 3, last - end - 3)});
    }
    return words;
}

std::size_t end_of_literal(const std::string& text, std::size_t begin) {
    for (std::size_t at = begin + 1; at < text.size(); ++at) {
        if (text[at] == '\\')
            ++at;
        else if (text[at] == text[begin] || text[at] == '\n')
            return at + 1;
    }
    return text.size();
}

std::size_t end_of_raw_string(const std::string& text, std::size_t quote) {
    const std::size_t open = text.find('(', quote);
    const std::string close = ")" + text.substr(quote + 1, open - quote - 1) + "\"";
    const std::size_t end = text.find(close, open);
    return end == std::string::npos ? text.size() : end + close.size();
}

std::size_t end_of_word(const std::string& text, std::size_t begin) {
    while (begin < text.size() && (is_letter(text[begin]) || is_digit(text[begin]) || text[begin] == '_'))
        ++begin;
    return begin;
}

// The names in a source's code, not in comments and strings. The second name of a test does not count: it is
// a sentence.
std::set<std::string> names_in(const std::string& text) {
    std::set<std::string> names;
    const auto behind = [&](const char* mark, std::size_t from) {
        const std::size_t found = text.find(mark, from);
        return found == std::string::npos ? text.size() : found + std::string_view(mark).size();
    };
    int names_of_test = 0;
    bool is_of_imgui = false;
    for (std::size_t at = 0; at < text.size();) {
        if (text.compare(at, 2, "//") == 0) {
            at = behind("\n", at);
        } else if (text.compare(at, 2, "/*") == 0) {
            at = behind("*/", at);
        } else if (text[at] == '"' || text[at] == '\'') {
            at = end_of_literal(text, at);
        } else if (is_digit(text[at])) {  // 1'000u
            while (at < text.size() && (end_of_word(text, at) > at || text[at] == '\'')) ++at;
        } else if (is_letter(text[at]) || text[at] == '_') {
            const std::size_t end = end_of_word(text, at);
            const std::string name = text.substr(at, end - at);
            if (name.ends_with('R') && end < text.size() && text[end] == '"') {
                at = end_of_raw_string(text, end);
                continue;
            }
            at = end;
            // Names of Dear ImGui are its own.
            const bool is_own = !name.starts_with("ImGui") && !is_of_imgui;
            is_of_imgui = name == "ImGui" && text.compare(end, 2, "::") == 0;
            if ((names_of_test == 0 || --names_of_test > 0) && is_own) names.insert(name);
            if (name == "TEST" || name == "TEST_F" || name == "TEST_P" || name == "TYPED_TEST")
                names_of_test = 2;
        } else {
            ++at;
        }
    }
    return names;
}

// The first of the words that a name holds; null where it holds none.
const RetiredWord* retired_in(const std::vector<RetiredWord>& words, std::string_view name) {
    const Parts parts = parts_of(name);
    const auto found = std::ranges::find_if(
        words, [&](const RetiredWord& word) { return !std::ranges::search(parts, word.parts).empty(); });
    return found == words.end() ? nullptr : &*found;
}

TEST(Words, NoRetiredOneIsInAName) {
    const fs::path project = oro::test::project_folder();
    const std::vector<RetiredWord> words = retired_words_in(text_of(project / "docs" / "GLOSSARY.md"));
    EXPECT_GT(words.size(), 20U) << "the search finds few of the rows that there are";
    std::size_t names = 0;
    std::map<std::string, const RetiredWord*> found;  // of each name, which stands in many files
    const auto expect_none = [&](const std::string& name, const std::string& file) {
        ++names;
        const auto [at, is_new] = found.try_emplace(name, nullptr);
        if (is_new) at->second = retired_in(words, name);
        if (const RetiredWord* const word = at->second)
            ADD_FAILURE() << file << ": " << name << " has a retired word; say " << word->instead;
    };
    for (const fs::path& path :
         oro::test::sources_in({"apps", "core", "geo", "render", "shaders", "tests"})) {
        const std::string file = path.lexically_relative(project).generic_string();
        for (const fs::path& part : fs::path(file)) expect_none(part.stem().string(), file);
        for (const std::string& name : names_in(text_of(path))) expect_none(name, file);
    }
    EXPECT_GT(names, 50000U) << "the search finds few of the names that there are";
}

// The search finds a word in names of either kind, and passes over comments, strings and sentences.
TEST(Words, AreFoundInNamesAlone) {
    EXPECT_EQ(parts_of("HTTPShelf2_of_GPUs_"), (Parts{"http", "shelf", "of", "gp", "us"}));
    EXPECT_EQ(parts_of("std::vector"), (Parts{"std", "vector"}));
    const std::string page =
        "## Retired words\n\n| word | say instead |\n|---|---|\n| shelf | bin |\n"
        "| give way | evict |\n\n## Next\n\n| word | say instead |\n| bin | shelf |\n";
    const std::vector<RetiredWord> words = retired_words_in(page);
    ASSERT_EQ(words.size(), 2U);
    EXPECT_EQ(words[1].instead, "evict");
    for (const char* name : {"shelf", "Shelf", "PageShelf", "shelf_", "most_shelf_bytes", "must_give_way_"})
        EXPECT_NE(retired_in(words, name), nullptr) << name;
    for (const char* name : {"shelfmark", "give_the_way", "way_give", "bin"})
        EXPECT_EQ(retired_in(words, name), nullptr) << name;
    const std::string code =
        "int a = 1'000u; // shelf\nb(\"shelf\\\" shelf\", 'c', R\"x(shelf \" )x\", d); /* shelf\n"
        "shelf */ TEST(Suite, AShelfIsFound) { e; }\n";
    EXPECT_EQ(names_in(code), (std::set<std::string>{"int", "a", "b", "d", "TEST", "Suite", "e"}));
}

}  // namespace
