#include "core/baked/grids_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>

#include "core/baked/region_format.h"
#include "core/base/checksum.h"
#include "core/base/little_endian.h"

namespace oro {
namespace {

constexpr std::string_view magic = "OROGRIDS";
constexpr std::uint32_t version = 1;
constexpr std::size_t at_version = 8, at_count = 12, front_bytes = 16, grid_bytes = 16, sum_bytes = 8;

bool begins_with_magic(std::span<const std::byte> bytes) {
    const auto expected = std::as_bytes(std::span(magic));
    return bytes.size() >= expected.size() && std::equal(expected.begin(), expected.end(), bytes.begin());
}

// Each rank below their number once.
bool are_ranks(const std::vector<GridInFile>& grids) {
    std::vector<char> told(grids.size(), 0);
    for (const GridInFile& grid : grids) {
        if (grid.rank >= grids.size() || told[grid.rank] != 0) return false;
        told[grid.rank] = 1;
    }
    return true;
}

}  // namespace

std::vector<std::byte> grids_header(std::span<const std::uint64_t> sizes,
                                    std::span<const std::uint32_t> ranks) {
    assert(sizes.size() == ranks.size() && sizes.size() >= 2 && sizes.size() <= most_grids_in_file);
    std::vector<std::byte> bytes(front_bytes + grid_bytes * sizes.size() + sum_bytes);
    const auto begins = std::as_bytes(std::span(magic));
    std::copy(begins.begin(), begins.end(), bytes.begin());
    to_little_endian(version, &bytes[at_version]);
    to_little_endian(static_cast<std::uint32_t>(sizes.size()), &bytes[at_count]);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        std::byte* const at = &bytes[front_bytes + grid_bytes * i];
        to_little_endian(sizes[i], at);
        to_little_endian(ranks[i], at + 8);
        to_little_endian(std::uint32_t{0}, at + 12);
    }
    const std::size_t end = bytes.size() - sum_bytes;
    to_little_endian(xxh64(std::span(bytes).first(end)), &bytes[end]);
    return bytes;
}

Result<std::vector<GridInFile>> grids_in(const OpenFile& file) {
    const auto refused = [&](const std::string& what) { return Error{ErrorKind::failed, file.path(), what}; };
    ORO_TRY(const std::uint64_t size, file.size());
    std::array<std::byte, front_bytes> front;
    if (size < front_bytes)
        return refused("is cut off at byte " + std::to_string(size) + ", within its header");
    ORO_CHECK(file.read(0, front));
    if (!begins_with_magic(front))
        return refused("holds no grids: it does not begin at byte 0 as such a file does");
    const auto found_version = from_little_endian<std::uint32_t>(&front[at_version]);
    if (found_version != version)
        return refused("is of version " + std::to_string(found_version) +
                       " of the format for several grids (byte 8), this program reads version " +
                       std::to_string(version));
    const auto count = from_little_endian<std::uint32_t>(&front[at_count]);
    if (count < 2 || count > most_grids_in_file)
        return file.damaged(at_count, "it tells of " + std::to_string(count) + " grids, not 2 to " +
                                          std::to_string(most_grids_in_file));
    std::vector<std::byte> bytes(front_bytes + grid_bytes * count + sum_bytes);
    if (size < bytes.size())
        return refused("is cut off at byte " + std::to_string(size) + ", within its header");
    ORO_CHECK(file.read(0, bytes));
    const std::size_t end = bytes.size() - sum_bytes;
    const std::uint64_t computed = xxh64(std::span(bytes).first(end));
    const auto stored = from_little_endian<std::uint64_t>(&bytes[end]);
    if (computed != stored)
        return file.damaged(0, "the header has checksum " + region_format::hexadecimal(computed) +
                                   ", expected " + region_format::hexadecimal(stored));
    std::vector<GridInFile> grids;
    std::uint64_t offset = bytes.size();
    for (std::size_t i = 0; i < count; ++i) {
        const std::byte* const at = &bytes[front_bytes + grid_bytes * i];
        const auto its_bytes = from_little_endian<std::uint64_t>(at);
        if (its_bytes > size - offset)
            return refused("is cut off at byte " + std::to_string(size) + ", within its grid number " +
                           std::to_string(i + 1));
        grids.push_back({offset, its_bytes, from_little_endian<std::uint32_t>(at + 8)});
        offset += its_bytes;
    }
    if (offset != size)
        return refused("goes on after its end at byte " + std::to_string(offset) + ": it has " +
                       std::to_string(size) + " bytes");
    if (!are_ranks(grids)) return file.damaged(front_bytes, "its grids have no order");
    return grids;
}

bool looks_like_grids_file(const std::string& path) {
    const auto file = OpenFile::open(path, OpenFile::Use::read);
    if (!file.ok()) return false;
    std::array<std::byte, magic.size()> bytes;
    return file->read(0, bytes).ok() && begins_with_magic(bytes);
}

}  // namespace oro
