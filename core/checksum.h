// The checksum of what lies in files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace oro {

// XXH64 of some bytes: tells damage (any flipped bit, but for one case in 2^64), not forgery. The same on
// every machine. `seed` tells alike bytes in different places from each other.
// Source: Y. Collet, xxHash fast digest algorithm, specification 0.1.1, section "XXH64".
[[nodiscard]] std::uint64_t xxh64(std::span<const std::byte> bytes, std::uint64_t seed = 0);

}  // namespace oro
