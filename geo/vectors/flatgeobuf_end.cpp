#include "geo/vectors/flatgeobuf_end.h"

#include <cpl_vsi.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/open_file.h"

namespace oro {
namespace {

// The bytes of a file on the disk, or of a member of an archive in GDAL's memory, read in blocks.
class FlatBytes {
  public:
    static std::optional<FlatBytes> of(const std::string& file) {
        FlatBytes bytes;
        if (file.starts_with("/vsimem/")) {
            vsi_l_offset length = 0;
            bytes.memory_ = VSIGetMemFileBuffer(file.c_str(), &length, FALSE);
            bytes.size_ = length;
            return bytes.memory_ != nullptr ? std::optional(std::move(bytes)) : std::nullopt;
        }
        Result<OpenFile> opened = OpenFile::open(file, OpenFile::Use::read);
        if (!opened.ok()) return std::nullopt;
        const Result<std::uint64_t> size = opened->size();
        if (!size.ok()) return std::nullopt;
        bytes.size_ = *size;
        bytes.file_ = std::make_unique<OpenFile>(std::move(*opened));
        return bytes;
    }

    [[nodiscard]] std::uint64_t size() const { return size_; }
    // A number of 1 to 8 bytes, the low one first; nothing beyond the end.
    std::optional<std::uint64_t> number(std::uint64_t at, std::size_t count) {
        if (at > size_ || size_ - at < count) return std::nullopt;
        const unsigned char* from = memory_ != nullptr ? memory_ + at : in_block(at, count);
        if (from == nullptr) return std::nullopt;
        std::uint64_t value = 0;
        for (std::size_t i = count; i > 0; --i) value = value << 8U | from[i - 1];
        return value;
    }

  private:
    const unsigned char* in_block(std::uint64_t at, std::size_t count) {
        constexpr std::uint64_t block_bytes = std::uint64_t{1} << 16U;
        if (at < begin_ || at + count > begin_ + block_.size()) {
            block_.resize(static_cast<std::size_t>(std::min(block_bytes, size_ - at)));
            begin_ = at;
            if (!file_->read(at, std::as_writable_bytes(std::span(block_))).ok()) return nullptr;
        }
        return block_.data() + (at - begin_);
    }

    const unsigned char* memory_{};
    std::unique_ptr<OpenFile> file_;
    std::uint64_t size_{};
    std::vector<unsigned char> block_;
    std::uint64_t begin_{};
};

// Where a field of a table of FlatBuffers stands; nothing where the table has its default.
std::optional<std::uint64_t> field_at(FlatBytes& bytes, std::uint64_t table, std::uint64_t number) {
    const auto back = bytes.number(table, 4);
    if (!back) return std::nullopt;
    const std::uint64_t fields = table - static_cast<std::uint64_t>(static_cast<std::int32_t>(*back)),
                        at = 4 + 2 * number;
    const auto length = bytes.number(fields, 2);
    if (!length || at + 2 > *length) return std::nullopt;
    const auto offset = bytes.number(fields + at, 2);
    return offset && *offset > 0 ? std::optional(table + *offset) : std::nullopt;
}

// Bytes of the packed R-tree over so many features: nodes of 40 bytes, level by level up to one root.
std::uint64_t bytes_of_index(std::uint64_t features, std::uint64_t children) {
    if (children < 2) return 0;
    std::uint64_t level = features, nodes = features;
    do {
        level = (level + children - 1) / children;
        nodes += level;
    } while (level > 1);
    return 40 * nodes;
}

}  // namespace

// Source: the specification of FlatGeobuf, version 3: 8 bytes of magic, the length of the header, the header,
// the index, and features, each behind its length. Fields 8 and 9 of the header are features_count (0) and
// index_node_size (16).
Result<void> check_flatgeobuf_end(const std::string& file) {
    constexpr std::uint64_t magic_bytes = 8, length_bytes = 4;
    std::optional<FlatBytes> bytes = FlatBytes::of(file);
    if (!bytes) return {};
    const auto header_length = bytes->number(magic_bytes, 4),
               root = bytes->number(magic_bytes + length_bytes, 4);
    if (!header_length || !root) return {};
    const std::uint64_t header = magic_bytes + length_bytes, table = header + *root;
    const auto count_at = field_at(*bytes, table, 8), children_at = field_at(*bytes, table, 9);
    const std::uint64_t count = count_at ? bytes->number(*count_at, 8).value_or(0) : 0,
                        children = children_at ? bytes->number(*children_at, 2).value_or(0) : 16;
    // Each feature has a length before it: no file holds more.
    if (count == 0 || count > bytes->size() / length_bytes) return {};
    std::uint64_t at = header + *header_length + bytes_of_index(count, children);
    for (std::uint64_t i = 0; i < count; ++i) {
        const auto length = bytes->number(at, length_bytes);
        if (!length) return {};
        at += length_bytes + *length;
    }
    if (at >= bytes->size()) return {};
    return Error{ErrorKind::failed, "",
                 "goes on for " + std::to_string(bytes->size() - at) + " bytes behind the " +
                     std::to_string(count) + (count == 1 ? " feature" : " features") +
                     " that its header counts: is the count too small?"};
}

}  // namespace oro
