// Bytes compressed by zstd, with their length before.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace oro {

// The same bytes give the same. At most 4 GiB.
[[nodiscard]] std::vector<std::byte> compressed(std::span<const std::byte> bytes);
// The inverse. Nothing where they are no such bytes, or more than `most` would come out. Want of memory, here
// as there, is std::bad_alloc: it is no fault of the bytes.
[[nodiscard]] std::optional<std::vector<std::byte>> decompressed(std::span<const std::byte> bytes,
                                                                 std::size_t most);

}  // namespace oro
