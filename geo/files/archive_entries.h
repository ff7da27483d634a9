// What lies in a .zip or .tar, read by its own structure: GDAL lists what it can and keeps silent about the
// rest, so that a cut archive looks like a smaller one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

// One archive may have so many entries; opening one of them costs GDAL a pass over all.
inline constexpr std::uint64_t most_archive_entries = 100'000;
// A packed .tar is unpacked to its end to know what is in it: so far, and no farther.
inline constexpr std::uint64_t most_unpacked_tar_bytes = std::uint64_t{4} << 30U;

enum class ArchiveKind { zip, tar };

struct ArchiveEntry {
    std::string name;  // with '/' between folders, as GDAL names it
    std::uint64_t bytes{};
    std::string unreadable;    // why it cannot be unpacked here (a password, a rare way of packing), or ""
    std::uint32_t checksum{};  // CRC-32 of its bytes, of a .zip
};

// Names and unpacked sizes of the files (not folders) in an archive, in its own order. `file` is a real path,
// `shown` what messages call it. Errors: a file that cannot be opened or read (with the system's reason), one
// that is no archive, is cut, is empty or has an impossible list, more entries or bytes than the limits
// above.
Result<std::vector<ArchiveEntry>> archive_entries(const std::string& file, const std::string& shown,
                                                  ArchiveKind kind);

// All bytes of an entry of a .zip. Errors: one that is unreadable, or is damaged.
Result<std::string> unpacked(const std::string& file, const std::string& shown, const ArchiveEntry& entry);

// All bytes of an entry of a .zip, in a third of the time: those of a plain entry, packed by Deflate, of so
// many bytes (256 MiB at most), whose checksum holds. Nothing where anything is another way, or cannot be
// read: what is wrong with it GDAL tells. `file` is a real path, `name` what GDAL calls the entry.
std::optional<std::vector<unsigned char>> unpacked_at_once(const std::string& file, const std::string& name,
                                                           std::uint64_t bytes);

}  // namespace oro
