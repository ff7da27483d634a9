#include "apps/styles/colours.h"

#include <charconv>
#include <cstdio>

namespace oro {

std::optional<ColourCodes> colour_from(const std::string& text) {
    constexpr std::size_t length = 7;
    unsigned number = 0;
    if (text.size() != length || text.front() != '#') return std::nullopt;
    const char* const end = text.data() + text.size();
    const auto read = std::from_chars(text.data() + 1, end, number, 16);
    if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
    const auto code = [&](unsigned shift) { return static_cast<int>((number >> shift) & 0xFFU); };
    return ColourCodes{code(16), code(8), code(0)};
}

std::string colour_text(const ColourCodes& colour) {
    char text[16];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(colour.red) & 0xFFU,
                  static_cast<unsigned>(colour.green) & 0xFFU, static_cast<unsigned>(colour.blue) & 0xFFU);
    return text;
}

}  // namespace oro
