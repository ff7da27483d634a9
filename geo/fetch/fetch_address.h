// Where a file is asked for, and what of that nobody else may see.
#pragma once

#include <string>
#include <utility>

namespace oro {

// An address that may hold a user's key. Only the server is told the key: messages and files say {key} in its
// place.
struct FetchAddress {
    FetchAddress(std::string plain) : url(std::move(plain)) {}
    FetchAddress(std::string with_key, std::string secret)
        : url(std::move(with_key)), key(std::move(secret)) {}

    // A text without the key, wherever it stands in it.
    [[nodiscard]] std::string without_key(std::string text) const {
        if (key.empty()) return text;
        for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at))
            text.replace(at, key.size(), "{key}");
        return text;
    }
    // The address as messages and files say it.
    [[nodiscard]] std::string shown() const { return without_key(url); }

    std::string url;  // http or https, as the server is asked
    std::string key;  // or ""
};

}  // namespace oro
