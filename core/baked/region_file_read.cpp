#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <memory>
#include <span>
#include <utility>

#include "core/baked/net_bytes.h"
#include "core/baked/region_format.h"
#include "core/base/checksum.h"
#include "core/base/little_endian.h"

namespace oro {
namespace {

using namespace region_format;

bool begins_with_magic(std::span<const std::byte> bytes) {
    return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

Result<RegionHeader> read_header(const OpenFile& file, std::uint64_t size, HeaderBytes& bytes) {
    const auto refused = [&](const std::string& what) { return Error{ErrorKind::failed, file.path(), what}; };
    bytes = {};
    const std::span<std::byte> there = std::span(bytes).first(std::min<std::uint64_t>(size, header_bytes));
    ORO_CHECK(file.read(0, there));
    if (!begins_with_magic(there))
        return refused(size == 0 ? "is no region file: it is empty"
                                 : "is no region file: it does not begin at byte 0 as one does");
    if (size < header_bytes)
        return refused("is cut off at byte " + std::to_string(size) + ", within its header of " +
                       std::to_string(header_bytes) + " bytes");
    const auto found_version = from_little_endian<std::uint32_t>(&bytes[magic.size()]);
    if (found_version < first_version || found_version > last_version)
        return refused("is of version " + std::to_string(found_version) +
                       " of the region format (byte 8), this program reads versions " +
                       std::to_string(first_version) + " to " + std::to_string(last_version));
    const std::uint64_t computed = xxh64(std::span(bytes).first(header_bytes - 8));
    const auto stored = from_little_endian<std::uint64_t>(&bytes[header_bytes - 8]);
    if (computed != stored)
        return file.damaged(
            0, "the header has checksum " + hexadecimal(computed) + ", expected " + hexadecimal(stored));
    const RegionHeader header = header_from_bytes(bytes);
    if (const auto wrong = implausible(header)) return file.damaged(wrong->offset, wrong->what);
    if (header.file_bytes == 0)
        return refused("is unfinished: the program that wrote it was stopped (its size at byte 16 is 0)");
    if (size < header.file_bytes)
        return refused("is cut off at byte " + std::to_string(size) + ", expected " +
                       std::to_string(header.file_bytes) + " bytes");
    if (size > header.file_bytes)
        return refused("goes on after its end at byte " + std::to_string(header.file_bytes) + ": it has " +
                       std::to_string(size) + " bytes");
    return header;
}

// A part that has its checksum in the header.
struct Part {
    const char* name;
    std::uint64_t offset;
    std::uint64_t bytes;
    std::uint64_t checksum;
};

// Reads a part piece by piece, and hands on each with its place in the part; a piece has whole floats.
template <class Take>
Result<void> read_part(const OpenFile& file, const Part& part, const Take& take) {
    constexpr std::uint64_t piece_bytes = 1U << 20U;
    std::vector<std::byte> buffer(std::min(part.bytes, piece_bytes));
    RunningChecksum sum;
    for (std::uint64_t at = 0; at < part.bytes; at += piece_bytes) {
        const auto piece = std::span(buffer).first(std::min(part.bytes - at, piece_bytes));
        ORO_CHECK(file.read(part.offset + at, piece));
        sum.add(piece);
        take(at, piece);
    }
    if (sum.sum() == part.checksum) return {};
    return file.damaged(part.offset, std::string("the ") + part.name + " has checksum " +
                                         hexadecimal(sum.sum()) + ", expected " + hexadecimal(part.checksum));
}
// A header may state any size, and a file with holes has it at no cost: memory is taken for what bears its
// checksum, which is read once more then.
Result<void> check_part(const OpenFile& file, const Part& part) {
    return read_part(file, part, [](std::uint64_t, std::span<const std::byte>) {});
}

Result<PostGrid> read_net(const OpenFile& file, const RegionHeader& header, std::uint64_t offset) {
    const Part part{"net", offset, header.net_bytes, header.net_checksum};
    ORO_CHECK(check_part(file, part));
    std::vector<std::byte> bytes(header.net_bytes);
    ORO_CHECK(read_part(file, part, [&](std::uint64_t at, std::span<const std::byte> piece) {
        std::copy(piece.begin(), piece.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
    }));
    auto net = net_from_bytes(bytes, header.grid.rows(), header.grid.columns());
    if (!net.ok()) return file.damaged(offset, "the net of its posts is none: " + net.error().what);
    if ((*net)->is_corrected() != is_on_corrected_net(header.version))
        return file.damaged(offset, "the net of its posts has " +
                                        std::string((*net)->is_corrected() ? "" : "no ") +
                                        "corrections, which version " + std::to_string(header.version) +
                                        (is_on_corrected_net(header.version) ? " has" : " has not"));
    return grid_on_net(std::move(*net));
}

Result<RegionOutline> read_outline(const OpenFile& file, const RegionHeader& header) {
    const RegionOffsets offsets = offsets_of(header);
    RegionOutline outline;
    outline.grid = header.grid;
    outline.undulation.lat = header.undulation_lat;
    outline.undulation.lon = header.undulation_lon;
    outline.shape.occluder.radii_m = header.occluder_radii_m;
    outline.lowest_H_m = header.lowest_H_m;
    outline.highest_H_m = header.highest_H_m;
    outline.voids = header.voids;
    outline.triangles = header.triangles;
    const Part text{"description", header_bytes, header.description_bytes, header.description_checksum};
    const Part nodes{"undulation", offsets.undulation, header.undulation_nodes * sizeof(float),
                     header.undulation_checksum};
    ORO_CHECK(check_part(file, text));
    ORO_CHECK(check_part(file, nodes));
    outline.description.resize(header.description_bytes);
    ORO_CHECK(read_part(file, text, [&](std::uint64_t at, std::span<const std::byte> piece) {
        std::memcpy(outline.description.data() + at, piece.data(), piece.size());
    }));
    outline.undulation.N_m.resize(header.undulation_nodes);
    ORO_CHECK(read_part(file, nodes, [&](std::uint64_t at, std::span<const std::byte> piece) {
        for (std::size_t i = 0; i < piece.size(); i += sizeof(float))
            outline.undulation.N_m[(at + i) / sizeof(float)] = from_little_endian<float>(&piece[i]);
    }));
    if (const auto wrong = implausible(outline.undulation.N_m, offsets.undulation))
        return file.damaged(wrong->offset, wrong->what);
    if (is_on_net(header.version)) {
        ORO_TRY(outline.grid, read_net(file, header, offsets.net));
        outline.grid.split = header.grid.split;
    }
    return outline;
}

}  // namespace

PageOrder::PageOrder(const PostGrid& grid) {
    const int levels = level_count(grid);
    for (int level = 0; level < levels; ++level) {
        const PageLayout layout = level_grid(grid, level).pages();
        levels_.push_back({layout, count_});
        count_ += layout.count();
    }
}

bool PageOrder::holds(PageIndex index) const {
    if (index.level < 0 || index.level >= levels()) return false;
    const PageLayout of = layout(index.level);
    return index.row >= 0 && index.row < of.rows && index.column >= 0 && index.column < of.columns;
}

std::uint64_t PageOrder::number(PageIndex index) const {
    assert(holds(index));
    const Level& level = levels_[static_cast<std::size_t>(index.level)];
    return level.first + level.layout.number(index.row, index.column);
}

PageIndex PageOrder::index(std::uint64_t number) const {
    assert(number < count_);
    std::size_t level = levels_.size() - 1;
    while (levels_[level].first > number) --level;
    const auto columns = static_cast<std::uint64_t>(levels_[level].layout.columns);
    const std::uint64_t within = number - levels_[level].first;
    return {static_cast<int>(within / columns), static_cast<int>(within % columns), static_cast<int>(level)};
}

RegionFile::RegionFile(OpenFile file, RegionOutline outline)
    : file_(std::move(file)), outline_(std::move(outline)), order_(outline_.grid) {}

Result<RegionFile> RegionFile::open(const std::string& path) {
    ORO_TRY(OpenFile file, OpenFile::open(path, OpenFile::Use::read));
    return open(std::move(file));
}

Result<RegionFile> RegionFile::open(OpenFile file) {
    ORO_TRY(const std::uint64_t size, file.size());
    HeaderBytes front;
    ORO_TRY(const RegionHeader header, read_header(file, size, front));
    ORO_TRY(RegionOutline outline, read_outline(file, header));
    RegionFile region(std::move(file), std::move(outline));
    region.header_.assign(front.begin(), front.end());
    region.offsets_ = offsets_of(header);
    region.fingerprint_ = header.fingerprint;
    region.bytes_ = header.file_bytes;
    ORO_CHECK(region.check_end());
    return region;
}

// The last page's record says where the file ends. A file of the right size that is mostly holes, a copy that
// was stopped or a forgery, has no such record.
Result<void> RegionFile::check_end() const {
    const std::uint64_t last = order_.count() - 1;
    ORO_TRY(const StoredRecord stored, read_record(file_, offsets_, order_, last, bytes_));
    const std::uint64_t end = stored.payload_offset + stored.payload_bytes;
    if (end == bytes_) return {};
    return file_.damaged(
        offsets_.records + last * record_bytes,
        "its payloads end at byte " + std::to_string(end) + ", expected at byte " + std::to_string(bytes_));
}

// A file that others write into may hold whole pages of another region by now, whose checksums are right.
Result<void> RegionFile::check_unchanged() const {
    HeaderBytes now;
    ORO_CHECK(file_.read(0, now));
    if (std::equal(now.begin(), now.end(), header_.begin(), header_.end())) return {};
    return Error{ErrorKind::failed, file_.path(),
                 "was changed at byte 0, its header, by another program while it was being read"};
}

Result<PageRecord> RegionFile::record(PageIndex index) const {
    const auto stored = read_record(file_, offsets_, order_, order_.number(index), bytes_);
    ORO_CHECK(check_unchanged());
    if (!stored.ok()) return stored.error();
    return stored->page;
}

Result<void> RegionFile::payload(PageIndex index, PagePayload& payload) const {
    const auto stored = read_record(file_, offsets_, order_, order_.number(index), bytes_);
    const Result<void> read =
        stored.ok() ? read_payload(file_, *stored, payload) : Result<void>(stored.error());
    ORO_CHECK(check_unchanged());
    return read;
}

Result<void> RegionFile::verify() const {
    std::uint64_t end = offsets_.payloads;
    const auto payload = std::make_unique<PagePayload>();
    for (std::uint64_t number = 0; number < order_.count(); ++number) {
        ORO_TRY(const StoredRecord stored, read_record(file_, offsets_, order_, number, bytes_));
        if (stored.payload_offset != end)
            return file_.damaged(offsets_.records + number * record_bytes,
                                 "a payload from byte " + std::to_string(stored.payload_offset) +
                                     ", expected from byte " + std::to_string(end));
        ORO_CHECK(read_payload(file_, stored, *payload));
        end += stored.payload_bytes;
    }
    ORO_CHECK(check_unchanged());
    if (end == bytes_) return {};
    return file_.damaged(end, "its payloads end here, expected at byte " + std::to_string(bytes_));
}

bool looks_like_region_file(const std::string& path) {
    const auto file = OpenFile::open(path, OpenFile::Use::read);
    if (!file.ok()) return false;
    std::array<std::byte, magic.size()> bytes;
    return file->read(0, bytes).ok() && begins_with_magic(bytes);
}

}  // namespace oro
