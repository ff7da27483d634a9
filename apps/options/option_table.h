// Options as rows of tables: what the command line takes, help prints, docs/commands/options.md lists, and
// questions about what was given ask.
#pragma once

#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "apps/options/view_limits.h"
#include "core/base/result.h"

namespace oro {

// The headings that options of several commands stand under in help.
namespace option_headings {
inline constexpr const char* data = "Elevation data";
inline constexpr const char* eye = "The eye";
inline constexpr const char* looks = "Looks";
inline constexpr const char* detail = "Detail and models";
}  // namespace option_headings

// What an option is besides a value.
enum OptionTraits : unsigned {
    no_trait = 0,
    shown_first = 1,    // help lists it without being asked for all options
    changes_looks = 2,  // it changes the colours or the light of a picture
    in_every_view = 4,  // a view's JSON has it always: else one without it is of before there was the option
    of_eye = 8,         // it says where the eye is or what it sees: a view from a file has that itself
};

// What is written of an option. Only literals, which outlive the tables and are copied
// anywhere.
struct OptionText {
    const char* name;          // "--tau PIXELS": with the word for its value, but of flags and choices
    unsigned traits{};         // OptionTraits
    const char* usual{""};     // "1; in a window 0.5": what holds where it is not given
    const char* json{""};      // its key in a view's JSON
    Limits limits{};           // of a number
    const char* not_with{""};  // an option above it that it excludes

    [[nodiscard]] bool is(OptionTraits trait) const { return (traits & trait) != 0; }
};

// Where the parser puts what was given.
using OptionTarget = std::variant<bool*, std::string*, std::optional<std::string>*, std::optional<double>*,
                                  std::optional<int>*, std::vector<std::string>*>;

// One option of the struct Options.
template <class Options>
struct OptionRow {
    const char* heading{};
    OptionText text;
    std::string name;                // "--tau"
    std::string value_word;          // "PIXELS"; "" of flags
    const char* help{};              // sentences; {} stands for the limits
    std::string sentence;            // of help
    std::vector<std::string> words;  // that may be chosen; none: any value
    std::function<OptionTarget(Options&)> target;
    std::function<bool(const Options&)> is_given;
};

// The limits in words: "0.05 to 120".
std::string span(const Limits& limits);
// What help prints of an option: its sentences with its limits and its default.
std::string sentence_of(const char* help, const OptionText& text);
// The words as a choice of one of them: "a|b|c".
std::string alternatives(const std::vector<std::string>& words);
// The value gives itself where it is within the limits; else there is a usage error of that option.
Result<double> within(const std::string& option, double value, const Limits& limits);

// Whether a command line has given a value: a flag that is set, anything in an optional value, a text or a
// list.
inline bool was_given(bool value) {
    return value;
}
template <class T>
bool was_given(const std::optional<T>& value) {
    return value.has_value();
}
template <class Sequence>
bool was_given(const Sequence& value) {
    return !value.empty();
}

// The row for one field of Options. help: sentences, in which {} stands for the limits. words: the values
// that may be chosen.
template <class Options, class Value, class Owner>
OptionRow<Options> option_row(const char* heading, const OptionText& text, Value Owner::*field,
                              const char* help, std::vector<std::string> words = {}) {
    OptionRow<Options> row;
    row.heading = heading;
    row.text = text;
    row.name = text.name;
    if (const std::size_t gap = row.name.find(' '); gap != std::string::npos) {
        row.value_word = row.name.substr(gap + 1);
        row.name.resize(gap);
    } else {
        row.value_word = alternatives(words);
    }
    row.help = help;
    row.sentence = sentence_of(help, text);
    row.words = std::move(words);
    row.target = [field](Options& options) { return OptionTarget(&(options.*field)); };
    row.is_given = [field](const Options& options) { return was_given(options.*field); };
    return row;
}

// The row of that name. There must be one.
template <class Row>
const Row& row_named(const std::vector<Row>& table, std::string_view name) {
    for (const Row& row : table)
        if (row.name == name) return row;
    std::abort();
}

// The name of the first option that was given, of all for which `asked` is true; nothing where none was.
template <class Row, class Options, class Asked>
const char* first_given(const std::vector<Row>& table, const Options& options, Asked asked) {
    for (const Row& row : table)
        if (asked(row) && row.is_given(options)) return row.name.c_str();
    return nullptr;
}
// The first of the options with these names, in their order, that was given; nothing where none was.
template <class Row, class Options>
const char* first_given_of(const std::vector<Row>& table, const Options& options,
                           std::initializer_list<const char*> names) {
    for (const char* const name : names)
        if (row_named(table, name).is_given(options)) return name;
    return nullptr;
}

}  // namespace oro
