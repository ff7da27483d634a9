// How much of something a test does, where the environment may ask for more.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace oro::test {

// The number in a variable of the environment, at least 1, or `otherwise` where there is none.
inline int asked_count(const char* variable, int otherwise) {
    const char* const value = std::getenv(variable);
    return value != nullptr ? std::max(1, std::atoi(value)) : otherwise;
}

// The whole number in a variable of the environment, or `otherwise` where there is none: seeds, and large
// counts.
inline std::uint64_t asked_number(const char* variable, std::uint64_t otherwise) {
    const char* const value = std::getenv(variable);
    return value != nullptr && *value != '\0' ? std::strtoull(value, nullptr, 10) : otherwise;
}

}  // namespace oro::test
