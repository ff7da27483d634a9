#include "core/base/one_line.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>

namespace oro {
namespace {

struct CodeRange {
    char32_t first, last;
};

// Sources: Unicode 15.0, general categories Cc, Cf, Zl and Zp and the property Default_Ignorable_Code_Point,
// less what real names need: marks before Arabic numbers (0600 to 0605 and their kind), variation selectors.
constexpr std::array unseen{
    CodeRange{0x0000, 0x001F},   CodeRange{0x007F, 0x009F},   CodeRange{0x00AD, 0x00AD},
    CodeRange{0x034F, 0x034F},   CodeRange{0x061C, 0x061C},   CodeRange{0x115F, 0x1160},
    CodeRange{0x17B4, 0x17B5},   CodeRange{0x180E, 0x180E},   CodeRange{0x200B, 0x200F},
    CodeRange{0x2028, 0x202E},   CodeRange{0x2060, 0x206F},   CodeRange{0x3164, 0x3164},
    CodeRange{0xFDD0, 0xFDEF},   CodeRange{0xFEFF, 0xFEFF},   CodeRange{0xFFA0, 0xFFA0},
    CodeRange{0xFFF0, 0xFFFB},   CodeRange{0xFFFE, 0xFFFF},   CodeRange{0x1BCA0, 0x1BCA3},
    CodeRange{0x1D173, 0x1D17A}, CodeRange{0xE0000, 0xE00FF}, CodeRange{0xE01F0, 0xE0FFF}};

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD

struct Letter {
    char32_t code{};
    std::size_t bytes{1};
    bool is_valid{};
};

unsigned byte_at(std::string_view text, std::size_t at) {
    return at < text.size() ? static_cast<unsigned char>(text[at]) : 0U;
}

// The character that begins at a byte. Of what is no UTF-8: as many bytes as might have begun one (The
// Unicode Standard 15.0, table 3-7, and "maximal subpart" in section 3.9).
Letter letter_at(std::string_view text, std::size_t at) {
    const unsigned lead = byte_at(text, at);
    if (lead < 0x80U) return {lead, 1, true};
    const std::size_t length = lead >= 0xC2U && lead <= 0xDFU   ? 2
                               : lead >= 0xE0U && lead <= 0xEFU ? 3
                               : lead >= 0xF0U && lead <= 0xF4U ? 4
                                                                : 0;
    if (length == 0) return {0, 1, false};
    // The second byte has narrower bounds after some: no overlong forms, no surrogates, nothing past 10FFFF.
    const unsigned low = lead == 0xE0U ? 0xA0U : lead == 0xF0U ? 0x90U : 0x80U;
    const unsigned high = lead == 0xEDU ? 0x9FU : lead == 0xF4U ? 0x8FU : 0xBFU;
    char32_t code = lead & (0xFFU >> (length + 1));
    for (std::size_t i = 1; i < length; ++i) {
        const unsigned next = byte_at(text, at + i);
        if (next < (i == 1 ? low : 0x80U) || next > (i == 1 ? high : 0xBFU)) return {0, i, false};
        code = code << 6U | (next & 0x3FU);
    }
    return {code, length, true};
}

bool is_joiner(char32_t code) {
    return code == 0x200C || code == 0x200D;
}

// Of the scripts from Hebrew on, among which those that joiners shape are.
bool may_be_joined(const Letter& letter) {
    return letter.is_valid && letter.code >= 0x0590 && letter.code < 0x2000;
}

}  // namespace

bool is_unseen(char32_t code) {
    // Numbers that end in FFFE and FFFF are no characters in any plane.
    return (code & 0xFFFEU) == 0xFFFEU || std::ranges::any_of(unseen, [&](const CodeRange& range) {
               return code >= range.first && code <= range.last;
           });
}

std::string one_line(std::string_view text, Joiners joiners) {
    constexpr std::size_t longest = 1000;
    std::string line;
    line.reserve(std::min(text.size(), longest));
    Letter before;
    for (std::size_t at = 0; at < text.size();) {
        const Letter letter = letter_at(text, at);
        std::string_view shown = text.substr(at, letter.bytes);
        at += letter.bytes;
        const bool joins = joiners == Joiners::kept_in_words && is_joiner(letter.code) &&
                           may_be_joined(before) && may_be_joined(letter_at(text, at));
        if (!letter.is_valid)
            shown = replacement;
        else if (is_unseen(letter.code) && !joins)
            shown = "?";
        if (line.size() + shown.size() > longest) return line + "...";
        line += shown;
        before = letter;
    }
    return line;
}

std::string with_unseen_escaped(std::string_view json) {
    std::string escaped;
    escaped.reserve(json.size());
    for (std::size_t at = 0; at < json.size();) {
        const Letter letter = letter_at(json, at);
        const std::string_view bytes = json.substr(at, letter.bytes);
        at += letter.bytes;
        if (!letter.is_valid || letter.code < 0x7F || !is_unseen(letter.code)) {
            escaped += bytes;
            continue;
        }
        const auto add = [&](std::uint32_t unit) {
            std::array<char, 16> text{};
            std::snprintf(text.data(), text.size(), "\\u%04x", unit);
            escaped += text.data();
        };
        const auto code = static_cast<std::uint32_t>(letter.code);
        if (code < 0x10000U) {
            add(code);
        } else {  // a pair of surrogates (RFC 8259, section 7)
            add(0xD800U + ((code - 0x10000U) >> 10U));
            add(0xDC00U + ((code - 0x10000U) & 0x3FFU));
        }
    }
    return escaped;
}

}  // namespace oro
