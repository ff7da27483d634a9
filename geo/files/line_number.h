// Lines of a text, for messages.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace oro {

// The number, from 1, of the line in which a byte of a text stands. A line ends with LF, CR LF, or CR alone.
inline std::size_t line_number(std::string_view text, std::size_t at) {
    const std::string_view before = text.substr(0, std::min(at, text.size()));
    std::size_t number = 1;
    for (std::size_t i = 0; i < before.size(); ++i)
        if (before[i] == '\n' || (before[i] == '\r' && (i + 1 >= text.size() || text[i + 1] != '\n')))
            ++number;
    return number;
}

}  // namespace oro
