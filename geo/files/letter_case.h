// Letters regardless of case.
#pragma once

#include <cctype>
#include <string>
#include <string_view>

namespace oro {

// ASCII letters in small; all other bytes as they are (in the C locale, which the program keeps).
inline std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return lower;
}

}  // namespace oro
