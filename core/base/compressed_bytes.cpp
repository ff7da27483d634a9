#include "core/base/compressed_bytes.h"

#include <zstd_errors.h>

#include <cstdint>
#include <new>

#include "core/base/little_endian.h"
#include "core/base/zstd_contexts.h"

namespace oro {

std::vector<std::byte> compressed(std::span<const std::byte> bytes) {
    constexpr int effort = 12;
    constexpr std::size_t front = sizeof(std::uint32_t);
    std::vector<std::byte> out(front + ZSTD_compressBound(bytes.size()));
    to_little_endian(static_cast<std::uint32_t>(bytes.size()), out.data());
    const ZstdPacker context;
    const std::size_t size = ZSTD_compressCCtx(context.get(), out.data() + front, out.size() - front,
                                               bytes.data(), bytes.size(), effort);
    if (ZSTD_isError(size) != 0) throw std::bad_alloc();
    out.resize(front + size);
    return out;
}

std::optional<std::vector<std::byte>> decompressed(std::span<const std::byte> bytes, std::size_t most) {
    constexpr std::size_t front = sizeof(std::uint32_t);
    if (bytes.size() < front) return std::nullopt;
    const auto size = static_cast<std::size_t>(from_little_endian<std::uint32_t>(bytes.data()));
    if (size > most) return std::nullopt;
    std::vector<std::byte> out(size);
    const ZstdUnpacker context;
    const std::size_t found = ZSTD_decompressDCtx(context.get(), out.data(), out.size(), bytes.data() + front,
                                                  bytes.size() - front);
    if (ZSTD_isError(found) != 0 && ZSTD_getErrorCode(found) == ZSTD_error_memory_allocation)
        throw std::bad_alloc();
    if (ZSTD_isError(found) != 0 || found != size) return std::nullopt;
    return out;
}

}  // namespace oro
