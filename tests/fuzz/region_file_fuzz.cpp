// Any bytes as a region file. The first byte says how they are taken: as the whole file; as numbers of a
// header whose magic, size and checksums are then made right, with the parts after it, the net among them; as
// the payload of a page. What opens must have an outline that makes sense, and may be read to its end.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "core/baked/region_file.h"
#include "core/baked/region_format.h"
#include "core/base/checksum.h"
#include "core/base/little_endian.h"

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

// Makes right what a fuzzer cannot guess, so that the numbers behind it are looked at.
void mend(std::vector<std::byte>& bytes, std::uint32_t version) {
    using namespace region_format;
    if (bytes.size() < header_bytes) bytes.resize(header_bytes);
    std::memcpy(bytes.data(), magic.data(), magic.size());
    to_little_endian(version, &bytes[8]);
    to_little_endian(std::uint32_t{header_bytes}, &bytes[12]);
    to_little_endian(std::uint64_t{bytes.size()}, &bytes[16]);
    HeaderBytes front;
    std::copy_n(bytes.begin(), header_bytes, front.begin());
    const RegionHeader header = header_from_bytes(front);
    if (!implausible(header)) {  // then the sizes fit the file
        const RegionOffsets places = offsets_of(header);
        const std::span<std::byte> all(bytes);
        to_little_endian(xxh64(all.subspan(header_bytes, header.description_bytes)), &bytes[232]);
        to_little_endian(xxh64(all.subspan(places.undulation, header.undulation_nodes * 4)), &bytes[240]);
        if (is_on_net(version))
            to_little_endian(xxh64(all.subspan(places.net, header.net_bytes)), &bytes[80]);
        for (std::uint64_t at = places.records; at < places.payloads; at += record_bytes)
            to_little_endian(xxh64(all.subspan(at, record_bytes - 8)), &bytes[at + record_bytes - 8]);
    }
    to_little_endian(xxh64(std::span(bytes).first(header_bytes - 8)), &bytes[header_bytes - 8]);
}

void read_all(const std::string& path) {
    const auto file = RegionFile::open(path);
    if (!file.ok()) return check_line(file.error());
    if (file->outline().grid.rows() < 1 || !(file->outline().grid.north_deg() < 90.1)) std::abort();
    if (const auto verified = file->verify(); !verified.ok()) check_line(verified.error());
    const auto payload = std::make_unique<PagePayload>();
    for (std::uint64_t number = 0; number < std::min<std::uint64_t>(file->order().count(), 3); ++number) {
        const auto read = file->payload(file->order().index(number), *payload);
        if (read.ok()) check_payload(*payload);
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
    // 1 and 3 in turn, or 2 and 4.
    if (data[0] % 2 == 1) mend(bytes, (data[0] % 4 == 1 ? 1U : 2U) + (data[0] % 8 > 3 ? 2U : 0U));
    static const std::string path =
        (std::filesystem::temp_directory_path() / ("orograph-oro-fuzz-" + std::to_string(getpid()))).string();
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    read_all(path);
    std::filesystem::remove(path);
    return 0;
}
