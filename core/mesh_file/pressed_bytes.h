// Bytes pressed by zstd, with their length before.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace oro {

// The same bytes give the same. At most 4 GiB.
[[nodiscard]] std::vector<std::byte> pressed(std::span<const std::byte> bytes);
// The inverse. Nothing where they are no such bytes, or more than `most` would come out.
[[nodiscard]] std::optional<std::vector<std::byte>> unpressed(std::span<const std::byte> bytes,
                                                              std::size_t most);

}  // namespace oro
