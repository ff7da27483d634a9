// Archives that tests write, stored without packing, each of whose fields may be false.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tests/geo/vectors/written_vectors.h"

namespace oro::test {

struct ZipEntry {
    ZipEntry(std::string its_name, std::string its_bytes)
        : name(std::move(its_name)),
          bytes(std::move(its_bytes)),
          crc(static_cast<std::uint32_t>(
              crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())))) {}
    std::string name, bytes;
    std::uint32_t crc;
    std::uint16_t flags{}, method{};
    std::size_t stated_bytes{bytes.size()};  // its length, as the archive tells it
};

// PKWARE's APPNOTE 6.3: local headers with their bytes, the list of files, the record at the end.
inline std::string written_zip(const std::string& name, const std::vector<ZipEntry>& entries) {
    const auto number = [](std::uint64_t value, int bytes) {
        std::string text;
        for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xffU);
        return text;
    };
    std::string zip, list;
    for (const ZipEntry& entry : entries) {
        const std::string common = number(20, 2) + number(entry.flags, 2) + number(entry.method, 2) +
                                   number(0, 4) + number(entry.crc, 4) + number(entry.bytes.size(), 4) +
                                   number(entry.stated_bytes, 4) + number(entry.name.size(), 2) +
                                   number(0, 2);
        list += "PK\1\2" + number(20, 2) + common + number(0, 10) + number(zip.size(), 4) + entry.name;
        zip += "PK\3\4" + common + entry.name + entry.bytes;
    }
    const std::size_t at = zip.size();
    return written(name, zip + list + "PK\5\6" + number(0, 4) + number(entries.size(), 2) +
                             number(entries.size(), 2) + number(list.size(), 4) + number(at, 4) +
                             number(0, 2));
}

}  // namespace oro::test
