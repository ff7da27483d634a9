// Any bytes as a file of several grids. An odd first byte makes magic, version and the header's checksum
// right, so that what the header tells is read. What is read must lie one right after the other and end with
// the file.
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/baked/grids_file.h"
#include "core/baked/region_file.h"
#include "core/base/checksum.h"
#include "core/base/little_endian.h"

namespace {

using namespace oro;

void mend(std::vector<std::byte>& bytes) {
    constexpr std::size_t front_bytes = 16, grid_bytes = 16, sum_bytes = 8;
    if (bytes.size() < front_bytes + 2 * grid_bytes + sum_bytes) return;
    std::memcpy(bytes.data(), "OROGRIDS", 8);
    to_little_endian(std::uint32_t{1}, &bytes[8]);
    const std::uint64_t count = from_little_endian<std::uint32_t>(&bytes[12]) % 6U;
    to_little_endian(static_cast<std::uint32_t>(count), &bytes[12]);
    const std::size_t end = front_bytes + grid_bytes * static_cast<std::size_t>(count);
    if (bytes.size() < end + sum_bytes) return;
    to_little_endian(xxh64(std::span(bytes).first(end)), &bytes[end]);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const auto* const from = reinterpret_cast<const std::byte*>(data);
    std::vector<std::byte> bytes(from + 1, from + size);
    if (data[0] % 2 == 1) mend(bytes);
    static const std::string path =
        (std::filesystem::temp_directory_path() / ("orograph-grids-fuzz-" + std::to_string(getpid())))
            .string();
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    const auto file = OpenFile::open(path, OpenFile::Use::read);
    if (!file.ok()) return 0;
    const auto grids = grids_in(*file);
    if (!grids.ok()) {
        if (grids.error().line().find('\n') != std::string::npos) std::abort();
        return 0;
    }
    std::uint64_t end = grids->front().offset;
    for (const GridInFile& grid : *grids) {
        if (grid.offset != end || grid.rank >= grids->size()) std::abort();
        end += grid.bytes;
        auto part = file->part(grid.offset, grid.bytes);
        if (!part.ok()) continue;
        const auto region = RegionFile::open(std::move(*part));
        if (region.ok() && region->outline().grid.rows() < 1) std::abort();
    }
    if (end != bytes.size()) std::abort();
    return 0;
}
