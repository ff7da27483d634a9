// Names of files as other files refer to them.
#pragma once

#include <cstdio>
#include <string>

namespace oro {

// A file's name as a relative reference (RFC 3986): what is no letter, digit, '-', '.', '_' or '~' by its hex
// digits.
inline std::string reference_to(const std::string& name) {
    std::string reference;
    for (const char c : name) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                           c == '-' || c == '.' || c == '_' || c == '~';
        char hex[8];
        std::snprintf(hex, sizeof hex, "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
        reference += plain ? std::string(1, c) : std::string(hex);
    }
    return reference;
}

}  // namespace oro
