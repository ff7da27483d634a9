#include "geo/files/archive_entries.h"

#include <cpl_vsi.h>
#include <libdeflate.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>

#include "geo/files/letter_case.h"
#include "geo/files/raster_library.h"

namespace oro {
namespace {

using Bytes = std::span<const unsigned char>;

struct CloseFile {
    void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};
using File = std::unique_ptr<VSILFILE, CloseFile>;

// Little-endian, as zip has it.
std::uint64_t number_at(Bytes bytes, std::size_t place, std::size_t length) {
    std::uint64_t number = 0;
    for (std::size_t i = length; i-- > 0;) number = number << 8U | bytes[place + i];
    return number;
}

std::string text_at(Bytes bytes, std::size_t place, std::size_t length) {
    return {reinterpret_cast<const char*>(bytes.data()) + place, length};
}

// As GDAL names an entry.
std::string plain_name(std::string name) {
    std::ranges::replace(name, '\\', '/');
    while (name.starts_with("./")) name.erase(0, 2);
    return name;
}

struct Archive {
    File file;
    std::string shown;
    std::uint64_t size{};

    [[nodiscard]] Error fault(const std::string& what) const {
        return {ErrorKind::failed, shown, "cannot be read as an archive: " + what};
    }
    // Exactly these bytes, or an error.
    [[nodiscard]] Result<std::vector<unsigned char>> read(std::uint64_t place, std::uint64_t length) const {
        std::vector<unsigned char> bytes(length);
        errno = 0;
        if (VSIFSeekL(file.get(), place, SEEK_SET) != 0 ||
            VSIFReadL(bytes.data(), 1, length, file.get()) != length)
            return fault(errno != 0 ? std::generic_category().message(errno)
                                    : "it ends at byte " + std::to_string(VSIFTellL(file.get())));
        return bytes;
    }
};

Result<Archive> open_archive(const std::string& path, const std::string& shown) {
    errno = 0;
    Archive archive{File(VSIFOpenL(path.c_str(), "rb")), shown};
    if (!archive.file) {
        const int reason = errno;
        return Error{ErrorKind::failed, shown,
                     "cannot be opened: " + (reason != 0 ? std::generic_category().message(reason)
                                                         : std::string("it is damaged"))};
    }
    return archive;
}

// ---- zip: PKWARE's APPNOTE 6.3, sections 4.3.12 to 4.3.16

constexpr std::uint64_t end_bytes = 22, end_zip64_bytes = 56, locator_bytes = 20, entry_bytes = 46;
constexpr std::uint64_t in_zip64_16 = 0xffff, in_zip64_32 = 0xffffffff;

struct ZipDirectory {
    std::uint64_t entries{};
    std::uint64_t bytes{};
    std::uint64_t offset{};
    std::uint64_t end{};  // the byte after the directory
};

// Where the record at the end of a zip starts within its last bytes.
std::optional<std::size_t> end_record(Bytes tail) {
    for (std::size_t i = tail.size() >= end_bytes ? tail.size() - end_bytes + 1 : 0; i-- > 0;) {
        if (number_at(tail, i, 4) == 0x06054b50 && i + end_bytes + number_at(tail, i + 20, 2) <= tail.size())
            return i;
    }
    return std::nullopt;
}

Result<ZipDirectory> zip_directory(const Archive& archive) {
    const std::uint64_t length = std::min<std::uint64_t>(archive.size, end_bytes + 0xffff);
    const std::uint64_t start = archive.size - length;
    ORO_TRY(const std::vector<unsigned char> tail, archive.read(start, length));
    const auto at = end_record(tail);
    if (!at) return archive.fault("it is no .zip, or its end is missing");
    const std::uint64_t end = start + *at;
    ZipDirectory found{number_at(tail, *at + 10, 2), number_at(tail, *at + 12, 4),
                       number_at(tail, *at + 16, 4), end};
    const bool zip64 =
        found.entries == in_zip64_16 || found.bytes == in_zip64_32 || found.offset == in_zip64_32;
    if (zip64 && *at >= locator_bytes && number_at(tail, *at - locator_bytes, 4) == 0x07064b50) {
        const std::uint64_t place = number_at(tail, *at - locator_bytes + 8, 8);
        if (place > end || end - place < end_zip64_bytes + locator_bytes)
            return archive.fault("its end is damaged");
        ORO_TRY(const std::vector<unsigned char> record, archive.read(place, end_zip64_bytes));
        if (number_at(record, 0, 4) != 0x06064b50) return archive.fault("its end is damaged");
        found = {number_at(record, 32, 8), number_at(record, 40, 8), number_at(record, 48, 8), place};
    }
    // What stands before the archive (a program that unpacks it) moves all places by as much.
    if (found.bytes > found.end || found.offset > found.end - found.bytes)
        return archive.fault("a part of it is missing: its list of files should start at byte " +
                             std::to_string(found.offset));
    return found;
}

// What stands in an entry's extra field of that number; empty where there is none. Its fields have a number
// and a length of two bytes each before them.
Bytes extra_field(Bytes extra, std::uint64_t number) {
    for (std::size_t i = 0; i + 4 <= extra.size();) {
        const std::uint64_t length = number_at(extra, i + 2, 2);
        if (number_at(extra, i, 2) == number)
            return extra.subspan(i + 4, std::min<std::size_t>(length, extra.size() - i - 4));
        i += 4 + length;
    }
    return {};
}

// The unpacked size of an entry too large for 32 bits.
std::uint64_t zip64_size(Bytes extra, std::uint64_t otherwise) {
    const Bytes sizes = extra_field(extra, 1);
    return sizes.size() >= 8 ? number_at(sizes, 0, 8) : otherwise;
}

// The name in UTF-8 that an entry has beside that in another encoding, where it belongs to that (APPNOTE
// 4.6.9): GDAL, which writes such names in KMZ, opens it by this one.
std::string unicode_name(Bytes extra, std::string name) {
    constexpr std::size_t before_name = 5;  // version 1, and the checksum of the other name
    const Bytes field = extra_field(extra, 0x7075);
    if (field.size() <= before_name || field[0] != 1) return name;
    const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(name.data()), static_cast<uInt>(name.size()));
    return number_at(field, 1, 4) == sum ? text_at(field, before_name, field.size() - before_name) : name;
}

// Why an entry with these flags and this method cannot be unpacked by GDAL, which knows two methods.
std::string unreadable_words(std::uint64_t flags, std::uint64_t method) {
    if ((flags & 1U) != 0) return "is locked with a password: unpack it, and name the file";
    if (method == 0 || method == 8) return "";
    struct Method {
        std::uint64_t number;
        std::string_view name;
    };
    static constexpr std::array<Method, 8> known{{{6, "Implode"},
                                                  {9, "Deflate64"},
                                                  {12, "bzip2"},
                                                  {14, "LZMA"},
                                                  {93, "Zstandard"},
                                                  {95, "XZ"},
                                                  {98, "PPMd"},
                                                  {99, "AES encryption"}}};
    const auto* const found = std::ranges::find(known, method, &Method::number);
    const std::string name =
        found == known.end() ? "method " + std::to_string(method) : std::string(found->name);
    return "is packed by " + name + ", and only Deflate is read: unpack it, and name the file";
}

Error too_many(const Archive& archive, std::uint64_t entries) {
    return archive.fault("it has " + (entries > 0 ? std::to_string(entries) : "more") +
                         " entries, and the limit is " + std::to_string(most_archive_entries) +
                         "; unpack it and name the files");
}

Result<std::vector<ArchiveEntry>> zip_entries(const Archive& archive) {
    ORO_TRY(const ZipDirectory directory, zip_directory(archive));
    if (directory.entries > most_archive_entries) return too_many(archive, directory.entries);
    if (directory.entries == 0) return archive.fault("it is empty");
    ORO_TRY(const std::vector<unsigned char> list,
            archive.read(directory.end - directory.bytes, directory.bytes));
    std::vector<ArchiveEntry> entries;
    std::size_t at = 0;
    for (std::uint64_t i = 0; i < directory.entries; ++i) {
        const auto damaged = [&] {
            return archive.fault("its list of files is damaged at entry " + std::to_string(i + 1) + " of " +
                                 std::to_string(directory.entries));
        };
        if (list.size() - at < entry_bytes || number_at(list, at, 4) != 0x02014b50) return damaged();
        const std::uint64_t name = number_at(list, at + 28, 2), extra = number_at(list, at + 30, 2);
        const std::uint64_t all = entry_bytes + name + extra + number_at(list, at + 32, 2);
        if (list.size() - at < all) return damaged();
        const Bytes extra_fields = Bytes(list).subspan(at + entry_bytes + name, extra);
        ArchiveEntry entry{plain_name(unicode_name(extra_fields, text_at(list, at + entry_bytes, name))),
                           number_at(list, at + 24, 4),
                           unreadable_words(number_at(list, at + 8, 2), number_at(list, at + 10, 2)),
                           static_cast<std::uint32_t>(number_at(list, at + 16, 4))};
        if (entry.bytes == in_zip64_32) entry.bytes = zip64_size(extra_fields, entry.bytes);
        if (!entry.name.ends_with('/')) entries.push_back(std::move(entry));
        at += all;
    }
    return entries;
}

// ---- tar: POSIX ustar and pax, with GNU's long names and large numbers

constexpr std::uint64_t tar_block = 512;

std::string tar_text(Bytes header, std::size_t place, std::size_t length) {
    const std::string text = text_at(header, place, length);
    return text.substr(0, std::min(text.find('\0'), text.size()));
}

std::optional<std::uint64_t> tar_number(Bytes header, std::size_t place, std::size_t length) {
    std::uint64_t number = 0;
    if ((header[place] & 0x80U) != 0) {  // base 256
        for (std::size_t i = 1; i < length; ++i) number = number << 8U | header[place + i];
        return number;
    }
    for (std::size_t i = 0; i < length; ++i) {
        const unsigned char c = header[place + i];
        if (c == ' ' || c == '\0') continue;
        if (c < '0' || c > '7') return std::nullopt;
        number = number << 3U | (c - std::uint64_t{'0'});
    }
    return number;
}

bool tar_sum_holds(Bytes header) {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < tar_block; ++i) sum += i >= 148 && i < 156 ? ' ' : header[i];
    return tar_number(header, 148, 8) == sum;
}

// What "path=" says in pax records of the form "LENGTH path=NAME\n".
std::string pax_path(std::string_view records) {
    for (std::size_t at = 0; at < records.size();) {
        const std::size_t end = std::min(records.find('\n', at), records.size());
        const std::string_view line = records.substr(at, end - at);
        const std::size_t key = line.find(" path=");
        if (key != std::string_view::npos && key <= 10) return std::string(line.substr(key + 6));
        at = end + 1;
    }
    return "";
}

class TarWalk {
  public:
    explicit TarWalk(const Archive& archive) : archive_(archive) {}

    Result<std::vector<ArchiveEntry>> entries() {
        std::vector<ArchiveEntry> found;
        std::uint64_t headers = 0;
        for (;;) {
            ORO_TRY(const std::vector<unsigned char> header, next(tar_block));
            if (std::ranges::all_of(header, [](unsigned char c) { return c == 0; })) break;
            if (!tar_sum_holds(header)) return archive_.fault("it is no .tar, or damaged " + here());
            const auto size = tar_number(header, 124, 12);
            if (!size) return archive_.fault("it is damaged " + here());
            if (++headers > most_archive_entries) return too_many(archive_, 0);
            const auto type = static_cast<char>(header[156]);
            if (type == 'L' || type == 'x') {
                if (*size > (1U << 20U)) return archive_.fault("it is damaged " + here());
                ORO_TRY(const std::vector<unsigned char> said, next(*size));
                long_name_ =
                    type == 'x' ? pax_path(text_at(said, 0, said.size())) : tar_text(said, 0, said.size());
                ORO_CHECK(skip(padding(*size)));
                continue;
            }
            if (type == '0' || type == '\0' || type == '7')
                found.push_back(
                    {plain_name(long_name_.empty() ? name_of(header) : long_name_), *size, "", 0});
            long_name_.clear();
            ORO_CHECK(skip(*size + padding(*size)));
        }
        if (headers == 0) return archive_.fault("it is empty");
        // To the end, where the checksum of a packed one is compared.
        return skip_to_end().ok() ? Result<std::vector<ArchiveEntry>>(std::move(found))
                                  : archive_.fault(said_.last("its packing is damaged"));
    }

  private:
    static std::uint64_t padding(std::uint64_t size) { return (tar_block - size % tar_block) % tar_block; }
    [[nodiscard]] std::string here() const { return "at byte " + std::to_string(at_); }

    static std::string name_of(Bytes header) {
        const std::string name = tar_text(header, 0, 100);
        const std::string prefix =
            text_at(header, 257, 5) == "ustar" && header[262] == 0 ? tar_text(header, 345, 155) : "";
        return prefix.empty() ? name : prefix + "/" + name;
    }

    Error ends(int reason) const {
        if (reason != 0) return archive_.fault(std::generic_category().message(reason));
        return archive_.fault(said_.last("it ends early, " + here()));
    }

    Result<std::vector<unsigned char>> next(std::uint64_t length) {
        std::vector<unsigned char> bytes(length);
        errno = 0;
        const std::size_t got = VSIFReadL(bytes.data(), 1, length, archive_.file.get());
        at_ += got;
        if (got != length || !said_.last("").empty()) return ends(errno);
        return bytes;
    }

    Result<void> skip(std::uint64_t length) {
        if (at_ + length < at_ || at_ + length > most_unpacked_tar_bytes)
            return archive_.fault("it unpacks to more than " +
                                  std::to_string(most_unpacked_tar_bytes >> 30U) +
                                  " GiB, which is the limit; unpack it and name the files");
        // Read and not sought: only what has been read is known to be there.
        while (length > 0) {
            const std::uint64_t part = std::min<std::uint64_t>(length, 1U << 20U);
            ORO_TRY(const std::vector<unsigned char> bytes, next(part));
            length -= part;
        }
        return {};
    }

    Result<void> skip_to_end() {
        std::vector<unsigned char> rest(1U << 20U);
        while (VSIFReadL(rest.data(), 1, rest.size(), archive_.file.get()) > 0) {
        }
        if (said_.last("").empty()) return {};
        return ends(0);
    }

    const Archive& archive_;
    GdalMessages said_;
    std::uint64_t at_{};
    std::string long_name_;
};

// Where a packed entry of a .zip lies, what it takes there, and its CRC-32.
struct PackedEntry {
    std::uint64_t header{}, packed{};
    std::uint32_t checksum{};
};
std::optional<PackedEntry> packed_entry(const Archive& archive, const std::string& name,
                                        std::uint64_t bytes) {
    const Result<ZipDirectory> directory = zip_directory(archive);
    if (!directory.ok() || directory->entries > most_archive_entries) return std::nullopt;
    const std::uint64_t begin = directory->end - directory->bytes;
    const Result<std::vector<unsigned char>> list = archive.read(begin, directory->bytes);
    if (!list.ok()) return std::nullopt;
    std::optional<PackedEntry> found;
    for (std::size_t at = 0; at + entry_bytes <= list->size();) {
        const std::uint64_t length = number_at(*list, at + 28, 2);
        const std::uint64_t all =
            entry_bytes + length + number_at(*list, at + 30, 2) + number_at(*list, at + 32, 2);
        if (number_at(*list, at, 4) != 0x02014b50 || all > list->size() - at) return std::nullopt;
        if (plain_name(text_at(*list, at + entry_bytes, length)) == name) {
            const bool is_plain =
                (number_at(*list, at + 8, 2) & 1U) == 0 && number_at(*list, at + 10, 2) == 8;
            const std::uint64_t packed = number_at(*list, at + 20, 4), place = number_at(*list, at + 42, 4);
            // One name twice, a place or a size of 64 bits: GDAL knows which and where.
            if (found || !is_plain || number_at(*list, at + 24, 4) != bytes || packed == in_zip64_32 ||
                place == in_zip64_32)
                return std::nullopt;
            found = PackedEntry{begin - directory->offset + place, packed,
                                static_cast<std::uint32_t>(number_at(*list, at + 16, 4))};
        }
        at += all;
    }
    return found;
}

struct FreeDecompressor {
    void operator()(libdeflate_decompressor* one) const { libdeflate_free_decompressor(one); }
};

}  // namespace

std::optional<std::vector<unsigned char>> unpacked_at_once(const std::string& file, const std::string& name,
                                                           std::uint64_t bytes) {
    constexpr std::uint64_t most_bytes = std::uint64_t{1} << 28U;
    constexpr std::uint64_t local_bytes = 30;
    if (bytes == 0 || bytes > most_bytes) return std::nullopt;
    const GdalMessages messages;
    Result<Archive> archive = open_archive(file, file);
    if (!archive.ok() || VSIFSeekL(archive->file.get(), 0, SEEK_END) != 0) return std::nullopt;
    archive->size = VSIFTellL(archive->file.get());
    const std::optional<PackedEntry> entry = packed_entry(*archive, name, bytes);
    if (!entry || entry->packed > archive->size) return std::nullopt;
    const auto local = archive->read(entry->header, local_bytes);
    if (!local.ok() || number_at(*local, 0, 4) != 0x04034b50) return std::nullopt;
    const auto packed = archive->read(
        entry->header + local_bytes + number_at(*local, 26, 2) + number_at(*local, 28, 2), entry->packed);
    const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> unpacks(libdeflate_alloc_decompressor());
    if (!packed.ok() || !unpacks) return std::nullopt;
    std::vector<unsigned char> all(bytes);
    if (libdeflate_deflate_decompress(unpacks.get(), packed->data(), packed->size(), all.data(), all.size(),
                                      nullptr) != LIBDEFLATE_SUCCESS ||
        libdeflate_crc32(0, all.data(), all.size()) != entry->checksum)
        return std::nullopt;
    return all;
}

Result<std::vector<ArchiveEntry>> archive_entries(const std::string& file, const std::string& shown,
                                                  ArchiveKind kind) {
    start_gdal();
    const GdalMessages messages;
    ORO_TRY(Archive archive, open_archive(file, shown));
    if (VSIFSeekL(archive.file.get(), 0, SEEK_END) != 0) return archive.fault("its end cannot be found");
    archive.size = VSIFTellL(archive.file.get());
    if (archive.size == 0) return archive.fault("it is empty");
    if (kind == ArchiveKind::zip) return zip_entries(archive);
    const std::string lower = lower_case(file);
    if (lower.ends_with(".tgz") || lower.ends_with(".gz")) {
        ORO_TRY(archive, open_archive("/vsigzip/" + file, shown));
        return TarWalk(archive).entries();
    }
    VSIFSeekL(archive.file.get(), 0, SEEK_SET);
    return TarWalk(archive).entries();
}

Result<std::string> unpacked(const std::string& file, const std::string& shown, const ArchiveEntry& entry) {
    start_gdal();
    const std::string where = shown + "/" + entry.name;
    if (!entry.unreadable.empty()) return Error{ErrorKind::failed, where, entry.unreadable};
    const GdalMessages messages;
    const File opened(VSIFOpenL(("/vsizip/{" + file + "}/" + entry.name).c_str(), "rb"));
    const Error damaged{ErrorKind::failed, where, "cannot be unpacked: it is damaged"};
    if (!opened) return damaged;
    std::string bytes(entry.bytes, '\0');
    const std::size_t got = VSIFReadL(bytes.data(), 1, bytes.size(), opened.get());
    if (got != bytes.size() || !messages.last("").empty()) return damaged;
    // GDAL compares checksums of what was packed alone.
    uLong sum = crc32(0, nullptr, 0);
    for (std::size_t at = 0; at < bytes.size();) {
        const auto part = static_cast<uInt>(std::min<std::size_t>(bytes.size() - at, std::size_t{1} << 30U));
        sum = crc32(sum, reinterpret_cast<const Bytef*>(bytes.data() + at), part);
        at += part;
    }
    if (sum != entry.checksum) return damaged;
    return bytes;
}

}  // namespace oro
