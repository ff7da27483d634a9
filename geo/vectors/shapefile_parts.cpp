#include "geo/vectors/shapefile_parts.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/open_file.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t shp_header_bytes = 100;
constexpr std::uint64_t dbf_header_bytes = 32;
constexpr std::uint64_t shx_record_bytes = 8;

Error shapefile_fault(const std::string& what) {
    return Error{ErrorKind::failed, "", what};
}

// A file in GDAL's memory, as members of archives are (geo/files/memory_files.h).
bool is_in_memory(const std::string& file) {
    return file.starts_with("/vsimem/");
}

bool is_regular_file(const std::string& file) {
    VSIStatBufL status;
    if (is_in_memory(file)) return VSIStatL(file.c_str(), &status) == 0;
    std::error_code failed;
    return fs::is_regular_file(file, failed) && !failed;
}

// The file beside `file` with another ending, or "" where there is none.
std::string part_beside(const std::string& file, const char* small, const char* capital) {
    for (const char* const ending : {small, capital}) {
        fs::path path(file);
        path.replace_extension(ending);
        if (is_regular_file(path.string())) return path.string();
    }
    return "";
}

// The beginning of a file, and its length.
struct PartHead {
    std::array<unsigned char, dbf_header_bytes> bytes{};
    std::uint64_t length{};

    [[nodiscard]] std::uint64_t number_low_first(std::size_t at, std::size_t count) const {
        std::uint64_t value = 0;
        for (std::size_t i = count; i > 0; --i) value = value << 8U | bytes[at + i - 1];
        return value;
    }
    [[nodiscard]] std::uint64_t number_high_first(std::size_t at, std::size_t count) const {
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < count; ++i) value = value << 8U | bytes[at + i];
        return value;
    }
};

Result<void> check_has_head(std::uint64_t length, const char* what) {
    if (length >= dbf_header_bytes) return {};
    return shapefile_fault(std::string("its ") + what + " is cut: it has " + std::to_string(length) +
                           " bytes");
}

Result<PartHead> head_in_memory(const std::string& file, const char* what) {
    PartHead head;
    vsi_l_offset length = 0;
    const unsigned char* const bytes = VSIGetMemFileBuffer(file.c_str(), &length, FALSE);
    head.length = bytes != nullptr ? length : 0;
    ORO_CHECK(check_has_head(head.length, what));
    std::copy_n(bytes, head.bytes.size(), head.bytes.begin());
    return head;
}

Result<PartHead> head_of(const std::string& file, const char* what) {
    if (is_in_memory(file)) return head_in_memory(file, what);
    const auto in_one_line = [&](const Error& error) {
        return shapefile_fault(std::string("its ") + what + " " + error.what);
    };
    Result<OpenFile> opened = OpenFile::open(file, OpenFile::Use::read);
    if (!opened.ok()) return in_one_line(opened.error());
    const Result<std::uint64_t> length = opened->size();
    if (!length.ok()) return in_one_line(length.error());
    PartHead head;
    head.length = *length;
    ORO_CHECK(check_has_head(head.length, what));
    const Result<void> read = opened->read(0, std::as_writable_bytes(std::span(head.bytes)));
    return read.ok() ? Result<PartHead>(head) : in_one_line(read.error());
}

Result<void> check_length(const char* what, std::uint64_t stated, std::uint64_t length) {
    if (length >= stated) return {};
    return shapefile_fault(std::string("its ") + what + " is cut: it should have " + std::to_string(stated) +
                           " bytes, and has " + std::to_string(length));
}

// A .shp or .shx counts its length in words of two bytes.
Result<std::uint64_t> checked_length(const std::string& file, const char* what) {
    ORO_TRY(const PartHead head, head_of(file, what));
    const std::uint64_t stated = 2 * head.number_high_first(24, 4);
    if (stated < shp_header_bytes)
        return shapefile_fault(std::string("its ") + what + " is damaged: it says that it has " +
                               std::to_string(stated) + " bytes");
    ORO_CHECK(check_length(what, stated, head.length));
    return stated;
}

// Length of a record's content in a .shx, behind its offset in the .shp: both in words of two bytes, the high
// byte first.
std::uint64_t shape_bytes(const unsigned char* record) {
    std::uint64_t words = 0;
    for (std::size_t i = 4; i < shx_record_bytes; ++i) words = words << 8U | record[i];
    return 2 * words;
}

// How many bytes of the .shp a .shx of so many bytes lists: header, and each shape behind a header of 8
// bytes.
Result<std::uint64_t> bytes_listed(const std::string& shx, std::uint64_t index_bytes) {
    constexpr std::uint64_t shape_header_bytes = 8, block = shx_record_bytes << 13U;
    std::uint64_t listed = shp_header_bytes;
    const auto add = [&](const unsigned char* records, std::uint64_t bytes) {
        for (std::uint64_t at = 0; at + shx_record_bytes <= bytes; at += shx_record_bytes)
            listed += shape_header_bytes + shape_bytes(records + at);
    };
    if (is_in_memory(shx)) {
        vsi_l_offset length = 0;
        const unsigned char* const bytes = VSIGetMemFileBuffer(shx.c_str(), &length, FALSE);
        if (bytes != nullptr && length >= index_bytes)
            add(bytes + shp_header_bytes, index_bytes - shp_header_bytes);
        return listed;
    }
    ORO_TRY(const OpenFile opened, OpenFile::open(shx, OpenFile::Use::read));
    std::vector<unsigned char> bytes;
    for (std::uint64_t at = shp_header_bytes; at < index_bytes; at += block) {
        bytes.resize(std::min(block, index_bytes - at));
        ORO_CHECK(opened.read(at, std::as_writable_bytes(std::span(bytes))));
        add(bytes.data(), bytes.size());
    }
    return listed;
}

// The number of records of a .dbf.
Result<std::uint64_t> checked_records(const std::string& file) {
    ORO_TRY(const PartHead head, head_of(file, ".dbf"));
    const std::uint64_t records = head.number_low_first(4, 4), header = head.number_low_first(8, 2),
                        record = head.number_low_first(10, 2);
    ORO_CHECK(check_length(".dbf", header + records * record, head.length));
    return records;
}

}  // namespace

Result<ShapefileParts> shapefile_parts(const std::string& file, const std::string& shown, bool needs_prj) {
    ShapefileParts parts;
    const std::string shx = part_beside(file, ".shx", ".SHX"), dbf = part_beside(file, ".dbf", ".DBF"),
                      prj = part_beside(file, ".prj", ".PRJ"), cpg = part_beside(file, ".cpg", ".CPG");
    for (const auto& [part, what] :
         {std::pair{&shx, ".shx, which says where each shape stands"},
          {&prj, ".prj, which says in which coordinate reference system its places are"}})
        if (part->empty() && (part != &prj || needs_prj))
            return shapefile_fault("is a shapefile without its " + std::string(what) +
                                   ": put it beside the .shp, under the same name");
    ORO_TRY(const std::uint64_t shape_file_bytes, checked_length(file, ".shp"));
    ORO_TRY(const std::uint64_t index_bytes, checked_length(shx, ".shx"));
    const Result<std::uint64_t> listed = bytes_listed(shx, index_bytes);
    if (!listed.ok()) return shapefile_fault("its .shx " + listed.error().what);
    if (*listed < shape_file_bytes)
        parts.notes.push_back(shown + ": its .shp has " + std::to_string(shape_file_bytes) +
                              " bytes, and its .shx lists " + std::to_string(*listed) +
                              " of them: the two may not belong together, and shapes may be left out");
    if (dbf.empty()) {
        parts.notes.push_back(shown +
                              ": is a shapefile without its .dbf: its shapes are read, their names and "
                              "other fields are not there");
    } else {
        ORO_TRY(const std::uint64_t records, checked_records(dbf));
        const std::uint64_t shapes = (index_bytes - shp_header_bytes) / shx_record_bytes;
        if (records != shapes)
            parts.notes.push_back(shown + ": its .shx counts " + std::to_string(shapes) +
                                  " shapes and its .dbf " + std::to_string(records) +
                                  " records: the two may not belong together");
    }
    for (const std::string& part : {file, shx, dbf, prj, cpg})
        if (!part.empty()) parts.files.push_back(part);
    return parts;
}

}  // namespace oro
