// Words of a mesh file's text, one after the other, and what is wrong with them.
#pragma once

#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "geo/vectors/text_path.h"

namespace oro {

// Takes the next word off the front of a text, blanks before it, too; "" at its end.
inline std::string_view take_word(std::string_view& text) {
    constexpr std::string_view blanks = " \t\r\n\v\f";
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return text = {};
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    return word;
}

// Takes the next line off the front of a text, without its end.
inline std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

// A reason with its place in the file: "line 7: why".
inline Error mesh_fault(const char* place, std::size_t number, const std::string& why) {
    return {ErrorKind::failed, "", std::string(place) + " " + std::to_string(number) + ": " + why};
}

// A word as people are shown it: not longer than 40 bytes.
inline std::string shown_word(std::string_view word) {
    constexpr std::size_t most = 40;
    return word.size() > most ? std::string(word.substr(0, most)) + "..." : std::string(word);
}

// A number, which may be NaN or infinite; false for what is none.
inline bool mesh_number(std::string_view word, double& value) {
    const WrittenNumber number = written_number(word);
    value = number.value;
    return number.fault == nullptr || number.fault == no_place::not_finite;
}

inline bool whole_number_in(std::string_view word, long long& value) {
    const auto [end, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    return fault == std::errc{} && end == word.data() + word.size();
}

}  // namespace oro
