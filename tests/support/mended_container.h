// Baked files as bytes: where their chunks are, and checksums made right again after a change.
#pragma once

#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/base/checksum.h"
#include "core/base/container.h"
#include "core/base/little_endian.h"

namespace oro::test {

// The chunk of a whole file; one of no bytes at 0 where it has none.
inline Chunk chunk_of(const std::filesystem::path& path, ChunkType type, std::uint32_t grid = 0) {
    const auto container = Container::open(path.string());
    const Chunk* const chunk = container.ok() ? (*container)->find(type, grid) : nullptr;
    return chunk ? *chunk : Chunk{};
}

// The byte of the table where a chunk's line begins.
inline std::size_t line_of(std::size_t number) {
    return ChunkTable::header_bytes + number * ChunkTable::entry_bytes;
}

template <class Number>
void set_number(std::string& bytes, std::size_t at, Number number) {
    to_little_endian(number, reinterpret_cast<std::byte*>(&bytes[at]));
}

// The checksums of all chunks that are there, unless `chunks` is false, and that of the table. Any bytes may
// be given.
inline std::string mended(std::string bytes, bool chunks = true) {
    const auto all = std::as_bytes(std::span(bytes));
    if (all.size() < ChunkTable::header_bytes) return bytes;
    const std::size_t count = from_little_endian<std::uint32_t>(&all[12]);
    const std::size_t end = count < all.size() ? line_of(count) : all.size() + 1;
    if (end > all.size()) return bytes;
    for (std::size_t i = 0; chunks && i < count; ++i) {
        const auto offset = from_little_endian<std::uint64_t>(&all[line_of(i) + 8]),
                   size = from_little_endian<std::uint64_t>(&all[line_of(i) + 16]);
        if (offset <= all.size() && size <= all.size() - offset)
            set_number(bytes, line_of(i) + 24, xxh64(all.subspan(offset, size)));
    }
    RunningChecksum sum;
    sum.add(all.first(24));
    sum.add(all.subspan(ChunkTable::header_bytes, end - ChunkTable::header_bytes));
    set_number(bytes, 24, sum.sum());
    return bytes;
}

}  // namespace oro::test
