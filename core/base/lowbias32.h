// A hash of 32 bits.
#pragma once

#include <cstdint>

namespace oro {

// Mixes all bits of a number into each bit of another; every number comes from one. Source: C. Wellons,
// hash-prospector, 2018, lowbias32 (public domain).
[[nodiscard]] constexpr std::uint32_t lowbias32(std::uint32_t h) {
    h ^= h >> 16U;
    h *= 0x7feb352dU;
    h ^= h >> 15U;
    h *= 0x846ca68bU;
    return h ^ (h >> 16U);
}

}  // namespace oro
