#include "geo/vectors/json_text.h"

#include <utf8.h>

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace oro {
namespace {

constexpr std::size_t deepest = 128;
constexpr std::string_view json_blanks = " \t\r\n";

std::size_t after_blanks(std::string_view text, std::size_t at) {
    return std::min(text.find_first_not_of(json_blanks, at), text.size());
}

// The byte after a text that begins at `at` with its quotation mark; npos where it has no end.
std::size_t after_text(std::string_view text, std::size_t at) {
    for (++at;; at += 2) {
        at = text.find_first_of("\"\\", at);
        if (at == std::string_view::npos || text[at] == '"') break;
    }
    return at == std::string_view::npos ? at : at + 1;
}

// The byte after a word or number.
std::size_t after_word(std::string_view text, std::size_t at) {
    return std::min(text.find_first_of(" \t\r\n,:[]{}\"", at), text.size());
}

bool is_constant(std::string_view word) {
    return word == "true" || word == "false" || word == "null";
}

bool is_numeric(std::string_view word) {
    if (word == "NaN" || word == "Infinity" || word == "-Infinity") return true;
    return !word.empty() && word.find_first_not_of("0123456789+-.eE") == std::string_view::npos &&
           word.find_first_of("0123456789") != std::string_view::npos;
}

// The walk over a text that may be anything.
class JsonCheck {
  public:
    explicit JsonCheck(std::string_view text) : text_(text) {}

    Result<std::size_t> value(std::size_t at) {
        for (;;) {
            at = after_blanks(text_, at);
            if (at == text_.size()) return fault(at, "it ends before its end: it is cut");
            const char c = text_[at];
            if (c == '{' || c == '[') {
                if (open_.size() == deepest)
                    return fault(at, "lists within lists are more than " + std::to_string(deepest) + " deep");
                open_.push_back(c);
                at = after_blanks(text_, at + 1);
                const bool is_empty = at < text_.size() && text_[at] == closing();
                if (!is_empty) {
                    if (c == '{') {
                        ORO_TRY(at, name(at));
                    }
                    continue;
                }
            } else {
                ORO_TRY(at, simple(at));
            }
            ORO_TRY(const bool goes_on, after_value(at));
            if (!goes_on) return at;
        }
    }

  private:
    [[nodiscard]] char closing() const { return open_.back() == '{' ? '}' : ']'; }

    [[nodiscard]] Error fault(std::size_t at, const std::string& what) const {
        const auto line = 1 + std::ranges::count(text_.substr(0, at), '\n');
        return {ErrorKind::failed, "", "is no whole JSON: line " + std::to_string(line) + ": " + what};
    }

    Result<std::size_t> simple(std::size_t at) {
        if (text_[at] == '"') {
            const std::size_t end = after_text(text_, at);
            if (end == std::string_view::npos) return fault(at, "a text has no end");
            return end;
        }
        const std::size_t end = after_word(text_, at);
        const std::string_view word = text_.substr(at, end - at);
        if (is_constant(word) || is_numeric(word)) return end;
        return fault(at, "here should be a value, and is '" +
                             std::string(text_.substr(at, std::clamp<std::size_t>(word.size(), 1, 20))) +
                             "'");
    }

    // A member's name with its colon; gives where the value may begin.
    Result<std::size_t> name(std::size_t at) {
        if (at == text_.size()) return fault(at, "it ends before its end: it is cut");
        if (text_[at] != '"') return fault(at, "here should be the name of a member in quotation marks");
        const std::size_t end = after_text(text_, at);
        if (end == std::string_view::npos) return fault(at, "a text has no end");
        const std::size_t colon = after_blanks(text_, end);
        if (colon == text_.size() || text_[colon] != ':') return fault(colon, "a colon is missing");
        return colon + 1;
    }

    // Closes what ends here. Whether another value follows; `at`: where.
    Result<bool> after_value(std::size_t& at) {
        // An empty list stands at its closing bracket.
        while (!open_.empty()) {
            const std::size_t next = after_blanks(text_, at);
            if (next == text_.size()) return fault(next, "it ends before its end: it is cut");
            if (text_[next] == closing()) {
                open_.pop_back();
                at = next + 1;
                continue;
            }
            if (text_[next] != ',') return fault(next, "a comma is missing, or a bracket is too many");
            at = after_blanks(text_, next + 1);
            if (open_.back() == '{') {
                ORO_TRY(at, name(at));
            }
            return true;
        }
        return false;
    }

    std::string_view text_;
    std::string open_;
};

std::uint32_t hex_at(std::string_view text, std::size_t at) {
    std::uint32_t code = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const char c = at + i < text.size() ? text[at + i] : 'x';
        const std::size_t digit = std::string_view("0123456789abcdefABCDEF").find(c);
        if (digit == std::string_view::npos) return 0xFFFD;
        code = code << 4U | static_cast<std::uint32_t>(digit < 16 ? digit : digit - 6);
    }
    return code;
}

// A character written as \uXXXX, or as two of them; `at` stands on the u, and then on its last digit.
void append_code(std::string_view text, std::size_t& at, std::string& to) {
    std::uint32_t code = hex_at(text, at + 1);
    at = std::min(at + 4, text.size() - 1);
    if (code >= 0xD800 && code < 0xDC00 && text.substr(at + 1).starts_with("\\u")) {
        const std::uint32_t low = hex_at(text, at + 3);
        if (low >= 0xDC00 && low < 0xE000) {
            code = 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00);
            at += 6;
        }
    }
    if (code >= 0xD800 && code < 0xE000) code = 0xFFFD;
    utf8::unchecked::append(code, std::back_inserter(to));
}

// What stands between quotation marks.
std::string unescaped(std::string_view text) {
    std::string plain;
    plain.reserve(text.size());
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] != '\\' || at + 1 == text.size()) {
            plain += text[at];
            continue;
        }
        const char c = text[++at];
        constexpr std::string_view letters = "nrtbf", means = "\n\r\t\b\f";
        const std::size_t which = letters.find(c);
        if (c == 'u')
            append_code(text, at, plain);
        else
            plain += which == std::string_view::npos ? c : means[which];
    }
    return plain;
}

}  // namespace

JsonValue::Kind JsonValue::kind() const {
    switch (text_[at_]) {
        case '{':
            return Kind::object;
        case '[':
            return Kind::array;
        case '"':
            return Kind::text;
        case 't':
        case 'f':
            return Kind::boolean;
        case 'n':
            return Kind::null;
        default:
            return Kind::number;
    }
}

std::size_t JsonValue::end_of(std::size_t at) const {
    std::size_t depth = 0;
    do {
        const char c = text_[at];
        if (c == '"') {
            at = after_text(text_, at);
        } else if (c == '{' || c == '[') {
            ++depth, ++at;
        } else if (c == '}' || c == ']') {
            --depth, ++at;
        } else if (depth == 0) {
            at = after_word(text_, at);
        } else {
            at = std::min(text_.find_first_of("\"[]{}", at), text_.size());
        }
    } while (depth > 0);
    return at;
}

std::size_t JsonValue::first_within(std::size_t at) const {
    return after_blanks(text_, at);
}

std::size_t JsonValue::after_comma(std::size_t at) const {
    at = after_blanks(text_, at);
    return text_[at] == ',' ? after_blanks(text_, at + 1) : at;
}

std::string_view JsonValue::source() const {
    return text_.substr(at_, end_of(at_) - at_);
}

std::vector<std::pair<std::string, JsonValue>> JsonValue::members() const {
    std::vector<std::pair<std::string, JsonValue>> all;
    if (!is(Kind::object)) return all;
    for (std::size_t at = first_within(at_ + 1); text_[at] != '}';) {
        const JsonValue name(text_, at);
        const std::size_t colon = after_blanks(text_, end_of(at));
        const std::size_t value = after_blanks(text_, colon + 1);
        all.emplace_back(name.text(), JsonValue(text_, value));
        at = after_comma(end_of(value));
    }
    return all;
}

std::string JsonValue::text() const {
    if (!is(Kind::text)) return "";
    const std::string_view whole = source();
    return unescaped(whole.substr(1, whole.size() - 2));
}

std::string JsonValue::words() const {
    if (is(Kind::null)) return "";
    return is(Kind::text) ? text() : std::string(source());
}

Result<std::size_t> check_json(std::string_view text, std::size_t from) {
    return JsonCheck(text).value(from);
}

}  // namespace oro
