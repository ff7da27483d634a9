#include "geo/files/name_pattern.h"

#include <cstddef>

namespace oro {
namespace {

bool matches_sign(char sign, char byte) {
    if (sign == '#') return byte >= '0' && byte <= '9';
    return sign == '?' || sign == byte;
}

// Goes back to the last `*` alone: what an earlier one stands for need never be longer.
bool matches_one_pattern(std::string_view pattern, std::string_view name) {
    std::size_t p = 0, n = 0, star = std::string_view::npos, held = 0;
    while (n < name.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            held = n;
        } else if (p < pattern.size() && matches_sign(pattern[p], name[n])) {
            ++p;
            ++n;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            n = ++held;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

}  // namespace

bool matches_name(std::string_view patterns, std::string_view name) {
    if (patterns.empty()) return false;
    for (;;) {
        const std::size_t bar = patterns.find('|');
        if (matches_one_pattern(patterns.substr(0, bar), name)) return true;
        if (bar == std::string_view::npos) return false;
        patterns.remove_prefix(bar + 1);
    }
}

}  // namespace oro
