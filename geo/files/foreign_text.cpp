#include "geo/files/foreign_text.h"

#include <utf8.h>

#include <iterator>

namespace oro {

std::string foreign_text(std::string_view text) {
    constexpr char32_t replacement = 0xFFFD;
    std::string valid;
    utf8::replace_invalid(text.begin(), text.end(), std::back_inserter(valid), replacement);
    std::string clean;
    clean.reserve(valid.size());
    for (auto at = valid.begin(); at != valid.end();) {
        const char32_t code = utf8::unchecked::next(at);
        const bool control = code < 0x20 && code != '\t' && code != '\n' && code != '\r';
        utf8::unchecked::append(control || code == 0xFFFE || code == 0xFFFF ? replacement : code,
                                std::back_inserter(clean));
    }
    return clean;
}

}  // namespace oro
