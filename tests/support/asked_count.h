// How much of something a test does, where the environment may ask for more.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace oro::test {

// The number in a variable of the environment, at least 1, or `otherwise` where there is none.
inline int asked_count(const char* variable, int otherwise) {
    const char* const specified = std::getenv(variable);
    return specified != nullptr ? std::max(1, std::atoi(specified)) : otherwise;
}

// The whole number in a variable of the environment, or `otherwise` where there is none: seeds, and large
// counts.
inline std::uint64_t asked_number(const char* variable, std::uint64_t otherwise) {
    const char* const specified = std::getenv(variable);
    return specified != nullptr && *specified != '\0' ? std::strtoull(specified, nullptr, 10) : otherwise;
}

}  // namespace oro::test
