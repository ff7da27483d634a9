#include "geo/files/text_encoding.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <utf8.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string_view>

#include "geo/files/foreign_text.h"
#include "geo/files/letter_case.h"
#include "geo/files/raster_library.h"

namespace oro {
namespace {

using namespace std::string_view_literals;

constexpr char32_t no_character = 0xFFFD;

// How many bytes a unit of text has, and which of them comes first.
struct TextUnits {
    std::size_t bytes{1};
    bool high_first{};
    std::size_t mark{};  // bytes of the mark
};

TextUnits units_of(std::string_view bytes) {
    if (bytes.starts_with("\xef\xbb\xbf"sv)) return {1, false, 3};
    // Before UTF-16's: its mark is the beginning of this one.
    if (bytes.starts_with("\xff\xfe\0\0"sv)) return {4, false, 4};
    if (bytes.starts_with("\0\0\xfe\xff"sv)) return {4, true, 4};
    if (bytes.starts_with("\xff\xfe"sv)) return {2, false, 2};
    if (bytes.starts_with("\xfe\xff"sv)) return {2, true, 2};
    constexpr std::string_view first = "<{[#";
    if (bytes.size() < 4) return {};
    const auto begins = [&](std::size_t at) { return first.find(bytes[at]) != std::string_view::npos; };
    if (begins(0) && bytes[1] == '\0') return {bytes[2] == '\0' && bytes[3] == '\0' ? 4U : 2U, false, 0};
    if (bytes[0] == '\0' && begins(1)) return {2, true, 0};
    if (bytes.starts_with("\0\0\0"sv) && begins(3)) return {4, true, 0};
    return {};
}

std::uint32_t unit_at(std::string_view bytes, std::size_t at, const TextUnits& units) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < units.bytes; ++i) {
        const std::size_t place = units.high_first ? at + i : at + units.bytes - 1 - i;
        value = value << 8U | static_cast<unsigned char>(bytes[place]);
    }
    return value;
}

std::string from_wide(std::string_view bytes, const TextUnits& units) {
    std::string text;
    text.reserve(bytes.size() / units.bytes);
    const auto is_half = [](std::uint32_t code, std::uint32_t from) {
        return code >= from && code < from + 0x400;
    };
    for (std::size_t at = 0; at < bytes.size(); at += units.bytes) {
        std::uint32_t code = unit_at(bytes, at, units);
        if (units.bytes == 2 && is_half(code, 0xD800) && at + 2 < bytes.size()) {
            const std::uint32_t low = unit_at(bytes, at + 2, units);
            if (is_half(low, 0xDC00)) {
                code = 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00);
                at += 2;
            }
        }
        if (code > 0x10FFFF || is_half(code, 0xD800) || is_half(code, 0xDC00)) code = no_character;
        utf8::unchecked::append(code, std::back_inserter(text));
    }
    return text;
}

// What an XML declaration at the beginning calls the encoding, in small letters; or "".
std::string declared_encoding(std::string_view text) {
    constexpr std::size_t longest = 400;
    if (!text.starts_with("<?xml")) return "";
    const std::string_view head = text.substr(0, longest);
    const std::string_view declaration = head.substr(0, std::min(head.find("?>"), head.size()));
    const std::size_t word = declaration.find("encoding");
    if (word == std::string_view::npos) return "";
    const std::size_t begin = declaration.find_first_of("\"'", word);
    if (begin == std::string_view::npos) return "";
    const std::size_t end = declaration.find(declaration[begin], begin + 1);
    if (end == std::string_view::npos) return "";
    return lower_case(declaration.substr(begin + 1, end - begin - 1));
}

struct FreeRecoded {
    void operator()(char* text) const { CPLFree(text); }
};

}  // namespace

Result<std::string> utf8_text(std::string bytes) {
    const TextUnits units = units_of(bytes);
    if (units.bytes == 1) {
        bytes.erase(0, units.mark);
        return bytes;
    }
    const std::string_view rest = std::string_view(bytes).substr(units.mark);
    if (rest.size() % units.bytes != 0)
        return Error{ErrorKind::failed, "",
                     std::string(units.bytes == 2 ? "is UTF-16" : "is UTF-32") +
                         " and ends within a character: it is cut"};
    return from_wide(rest, units);
}

Result<std::string> utf8_xml(std::string bytes) {
    const bool is_wide = units_of(bytes).bytes > 1;
    ORO_TRY(std::string text, utf8_text(std::move(bytes)));
    const std::string encoding = declared_encoding(text);
    static constexpr std::array as_it_is{"", "utf-8", "utf8", "us-ascii", "ascii"};
    if (is_wide || std::ranges::find(as_it_is, encoding) != as_it_is.end()) return text;
    // Many a file says another encoding than it has: what is UTF-8 beyond ASCII can hardly be anything else.
    if (utf8::is_valid(text.begin(), text.end())) return text;
    const Error unknown{ErrorKind::failed, "",
                        "is in the encoding '" + foreign_text(encoding) + "', which is not known here"};
    if (text.find('\0') != std::string::npos) return unknown;
    const GdalMessages messages;
    const std::unique_ptr<char, FreeRecoded> recoded(CPLRecode(text.c_str(), encoding.c_str(), CPL_ENC_UTF8));
    if (!recoded || !messages.last("").empty() || !messages.warning().empty()) return unknown;
    return std::string(recoded.get());
}

}  // namespace oro
