// Any bytes as a baked file. The first byte says how they are taken: as the whole file; as the chunks of a
// grid, the net among them, whose table and checksums are then made right; as the payload of a page. What
// opens must have outlines that make sense, and may be read to its end.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/baked/baked_file.h"
#include "core/baked/net_bytes.h"
#include "core/baked/region_format.h"
#include "core/base/checksum.h"
#include "core/base/little_endian.h"
#include "tests/support/mended_container.h"

namespace {

using namespace oro;

void check_line(const Error& error) {
    if (error.what.empty()) std::abort();
    for (const char c : error.line())
        if (static_cast<unsigned char>(c) < 0x20) std::abort();
}

void check_payload(const PagePayload& payload) {
    for (const float H_m : payload.H_m)
        if (!std::isfinite(H_m)) std::abort();
}

std::string text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// Puts right what a fuzzer cannot guess, so that the numbers behind it are looked at.
std::string as_grid(std::vector<std::byte> bytes, bool on_net) {
    using namespace region_format;
    if (bytes.size() < outline_bytes + 2) bytes.resize(outline_bytes + 2);
    const OutlineNumbers numbers = numbers_from_bytes(std::span(bytes).first(outline_bytes));
    ChunkTable table{0, {{ChunkType::outline, 0, 0, outline_bytes, 0}}};
    std::uint64_t left = bytes.size() - outline_bytes;
    const auto add = [&](ChunkType type, std::uint64_t size) {
        table.chunks.push_back({type, 0, 0, std::min(size, left), 0});
        left -= table.chunks.back().bytes;
    };
    const auto count = [](const GridAxis& axis) {
        return static_cast<std::uint64_t>(std::max(axis.count, 0));
    };
    add(ChunkType::description, std::to_integer<std::uint64_t>(bytes[outline_bytes]) % 64);
    add(ChunkType::undulation, sizeof(float) * count(numbers.undulation_lat) * count(numbers.undulation_lon));
    if (on_net)
        add(ChunkType::net,
            net_front_bytes + patch_bytes * (std::to_integer<unsigned>(bytes[outline_bytes + 1]) % 4));
    const bool is_plausible = !implausible(numbers, table.chunks[2].bytes, on_net);
    add(ChunkType::pages, is_plausible ? record_bytes * PageOrder({numbers.lat, numbers.lon}).count() : 0);
    const Chunk pages = table.chunks.back();
    add(ChunkType::heights, left);
    table.file_bytes = table.place();
    const std::uint64_t front = table.bytes();
    const Chunk& placed = table.chunks[table.chunks.size() - 2];
    for (std::uint64_t at = 0; at + record_bytes <= pages.bytes; at += record_bytes) {
        const auto record = std::span(bytes).subspan(placed.offset - front + at, record_bytes);
        to_little_endian(xxh64(record.first(record_bytes - 8)), &record[record_bytes - 8]);
    }
    return test::mended(text_of(table.to_bytes()) + text_of(bytes));
}

void read_all(const std::string& path) {
    const auto grids = open_baked_file(path);
    if (!grids.ok()) return check_line(grids.error());
    for (const BakedGrid& grid : *grids) {
        const RegionFile& file = *grid.region;
        if (grid.rank >= grids->size()) std::abort();
        if (file.outline().grid.rows() < 1 || !(file.outline().grid.north_deg() < 90.1)) std::abort();
        if (const auto verified = file.verify(); !verified.ok()) check_line(verified.error());
        const auto payload = std::make_unique<PagePayload>();
        for (std::uint64_t number = 0; number < std::min<std::uint64_t>(file.order().count(), 3); ++number) {
            const auto read = file.payload(file.order().index(number), *payload);
            if (read.ok()) check_payload(*payload);
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const auto* const from = reinterpret_cast<const std::byte*>(data);
    std::vector<std::byte> bytes(from + 1, from + size);
    if (data[0] % 4 == 2) {
        const auto payload = std::make_unique<PagePayload>();
        if (!decode_payload(bytes, *payload)) check_payload(*payload);
        return 0;
    }
    const std::string file = data[0] % 2 == 1   ? as_grid(std::move(bytes), data[0] % 4 == 3)
                             : data[0] % 8 == 4 ? test::mended(text_of(bytes))
                                                : text_of(bytes);
    static const std::string path =
        (std::filesystem::temp_directory_path() / ("orograph-oro-fuzz-" + std::to_string(getpid()))).string();
    std::ofstream(path, std::ios::binary) << file;
    read_all(path);
    std::filesystem::remove(path);
    return 0;
}
