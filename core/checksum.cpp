#include "core/checksum.h"

// All of xxHash is compiled into this file: a benchmark carries it to machines that lack the library.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace oro {

std::uint64_t xxh64(std::span<const std::byte> bytes, std::uint64_t seed) {
    return XXH64(bytes.data(), bytes.size(), seed);
}

}  // namespace oro
