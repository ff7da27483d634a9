#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <optional>
#include <utility>

#include "core/baked/region_format.h"
#include "core/base/checksum.h"
#include "core/base/file_target.h"
#include "core/base/little_endian.h"

// The order of writing: a page's stitched deviations, its payload, its record. A page is there when all three
// bear their checksums, whatever of them a kill or a power cut has let through. The header names the file's
// size only when all pages are on the disk.
namespace oro {
namespace {

using namespace region_format;

constexpr std::size_t stitched_bytes = sizeof(StitchedDeviations) + 8;  // and a checksum

Error fault(const std::string& path, const std::string& what) {
    return {ErrorKind::failed, path, what};
}

std::string partial_of(const std::string& target) {
    return target + ".partial";
}
std::string stitched_of(const std::string& target) {
    return target + ".partial-stitched";
}

// What was found under a name that a bake uses.
struct Leftover {
    std::uint64_t bytes{};
};

Error no_leftover(const std::string& path, const std::string& what) {
    return fault(path, what + "; move it away, or choose another name for the region");
}

// That an open file has no other name: whoever uses that would find it changed.
Result<Leftover> only_name(const OpenFile& file) {
    struct stat found {};
    if (fstat(file.descriptor(), &found) != 0)
        return fault(file.path(), "cannot be written: " + system_reason(errno));
    if (found.st_nlink > 1)
        return no_leftover(file.path(), "has another name, too (a hard link), and would change there");
    return Leftover{static_cast<std::uint64_t>(found.st_size)};
}

// A .partial that a bake left behind begins as a baked file does, as far as it goes.
Result<Leftover> check_partial(const OpenFile& file) {
    ORO_TRY(const Leftover found, only_name(file));
    ORO_TRY(const FileBeginning begins, file_beginning(file));
    if (begins == FileBeginning::foreign)
        return no_leftover(file.path(), "is there already, and no bake has left it behind");
    return found;
}

// Opens the .partial and keeps other writers out for as long as it is open. One that finishes while this one
// waits takes the file away under its real name: then there must be a new one.
Result<OpenFile> open_alone(const std::string& path) {
    for (int attempt = 0; attempt < 100; ++attempt) {
        ORO_TRY(OpenFile file, OpenFile::open(path, OpenFile::Use::write));
        if (flock(file.descriptor(), LOCK_EX | LOCK_NB) != 0) {
            if (errno == EWOULDBLOCK) return fault(path, "is being written by another program");
            if (errno != ENOLCK && errno != EOPNOTSUPP && errno != EINVAL)
                return fault(path, "cannot be locked: " + system_reason(errno));
        }
        struct stat open_one {
        }, named{};
        if (fstat(file.descriptor(), &open_one) == 0 && lstat(path.c_str(), &named) == 0 &&
            open_one.st_ino == named.st_ino && open_one.st_dev == named.st_dev)
            return file;
    }
    return fault(path, "cannot be written: it is taken away again and again");
}

// The table of a finished file: that of an unfinished one with what is known of the pages in the end.
ChunkTable finished(ChunkTable table, std::uint64_t records_checksum, std::uint64_t heights_bytes,
                    std::uint64_t heights_checksum) {
    table.chunks[table.chunks.size() - 2].checksum = records_checksum;
    table.chunks.back().bytes = heights_bytes;
    table.chunks.back().checksum = heights_checksum;
    table.file_bytes = table.place();
    return table;
}

// Whether a file begins with that table, unfinished or finished.
struct FoundTable {
    bool same{};
    bool is_finished{};
};
FoundTable found_table(const OpenFile& file, const ChunkTable& table) {
    const Result<ChunkTable> found = read_chunk_table(file);
    if (!found.ok() || found->chunks.size() != table.chunks.size()) return {};
    const std::vector<std::byte> bytes = found->to_bytes();
    if (bytes == table.to_bytes()) return {true, false};
    const auto& records = found->chunks[table.chunks.size() - 2];
    const auto& heights = found->chunks.back();
    const ChunkTable whole = finished(table, records.checksum, heights.bytes, heights.checksum);
    return {bytes == whole.to_bytes(), true};
}

Result<void> read_stitched(const OpenFile& file, std::uint64_t number, StitchedDeviations* into) {
    std::array<std::byte, stitched_bytes> bytes;
    const std::uint64_t offset = number * stitched_bytes;
    ORO_CHECK(file.read(offset, bytes));
    if (const auto wrong = wrong_checksum(bytes, number))
        return file.damaged(offset,
                            "the record of errors of page number " + std::to_string(number) + " " + *wrong);
    NumberReader get(bytes);
    for (std::size_t node = 0; into && node < into->size(); ++node)
        for (float& error_m : (*into)[node]) get(error_m);
    return {};
}

// Stitched errors have no magic. Those of a .partial are beside it, in whatever state; alone they are known
// by the checksum of the first.
Result<void> check_stitched(const OpenFile& file, bool partial_has_bytes) {
    ORO_TRY(const Leftover found, only_name(file));
    if (found.bytes == 0 || partial_has_bytes || read_stitched(file, 0, nullptr).ok()) return {};
    return no_leftover(file.path(), "is there already, and no bake has left it behind");
}

// Opens for reading what has a name, if anything has; no link is followed.
Result<std::optional<OpenFile>> open_leftover(const std::string& path) {
    struct stat found {};
    if (lstat(path.c_str(), &found) != 0) {
        if (errno == ENOENT) return std::optional<OpenFile>();
        return fault(path, "cannot be written: " + system_reason(errno));
    }
    if (S_ISLNK(found.st_mode)) return no_leftover(path, "is a link, and no bake has left it behind");
    ORO_TRY(OpenFile file, OpenFile::open(path, OpenFile::Use::read_own));
    return std::optional(std::move(file));
}

}  // namespace

std::vector<std::string> files_of_bake(const std::string& path) {
    std::string target = path;
    (void)check_target(target, true).ok();  // what it finds wrong, others tell
    return {target, partial_of(target), stitched_of(target)};
}

Result<void> RegionFileWriter::check(const std::string& path, bool overwrite) {
    std::string target = path;
    ORO_TRY([[maybe_unused]] const unsigned old_mode, check_target(target, overwrite));
    ORO_TRY(const std::optional<OpenFile> partial, open_leftover(partial_of(target)));
    Leftover found;
    if (partial) {
        ORO_TRY(found, check_partial(*partial));
    }
    ORO_TRY(const std::optional<OpenFile> stitched, open_leftover(stitched_of(target)));
    if (!stitched) return {};
    return check_stitched(*stitched, found.bytes > 0);
}

Result<EncodedPage> encode_page(const PageRecord& record, const PagePayload& payload) {
    EncodedPage page{record, {}, 0};
    ORO_TRY(page.payload, encode_payload(payload));
    page.checksum = xxh64(page.payload);
    return page;
}

Result<BakeHold> BakeHold::take(const std::string& path, bool overwrite) {
    ignore_size_limit_signal();
    std::string target = path;
    ORO_CHECK(RegionFileWriter::check(path, overwrite));
    ORO_TRY([[maybe_unused]] const unsigned old_mode, check_target(target, overwrite));
    ORO_TRY(OpenFile partial, open_alone(partial_of(target)));
    BakeHold hold(std::move(partial));
    ORO_CHECK(check_partial(hold.partial_));
    // Somebody may have finished it before this one came in.
    ORO_CHECK(check_target(target, overwrite));
    return hold;
}

BakeHold::~BakeHold() {
    const Result<std::uint64_t> bytes =
        partial_.descriptor() < 0 ? Result<std::uint64_t>(std::uint64_t{1}) : partial_.size();
    if (bytes.ok() && *bytes == 0) unlink(partial_.path().c_str());
}

RegionFileWriter::RegionFileWriter(OpenFile partial, OpenFile stitched, const PostGrid& grid)
    : partial_(std::move(partial)), stitched_(std::move(stitched)), order_(grid) {}

Result<RegionFileWriter> RegionFileWriter::create(const std::string& path, const RegionOutline& outline,
                                                  std::uint64_t fingerprint, bool overwrite) {
    ignore_size_limit_signal();
    std::string target = path;
    ORO_TRY(const unsigned old_mode, check_target(target, overwrite));
    assert(outline.shape.exaggeration == 1.0);
    if (const auto wrong = implausible(outline))
        return fault(path, "cannot hold this region: " + wrong->what);
    ORO_CHECK(check(path, overwrite));
    ORO_TRY(OpenFile partial, open_alone(partial_of(target)));
    ORO_TRY(OpenFile stitched, OpenFile::open(stitched_of(target), OpenFile::Use::write));
    // Once more of what is open now, whatever has happened to the names.
    ORO_TRY(const Leftover found, check_partial(partial));
    ORO_CHECK(check_stitched(stitched, found.bytes > 0));
    RegionFileWriter writer(std::move(partial), std::move(stitched), outline.grid);
    writer.path_ = target;
    writer.overwrite_ = overwrite;
    writer.old_mode_ = old_mode;
    RegionBeginning begin = beginning_of(outline, fingerprint);
    writer.table_ = std::move(begin.table);
    ORO_CHECK(writer.start_or_resume(begin.chunks));
    return writer;
}

Result<void> RegionFileWriter::start_or_resume(const std::vector<std::byte>& chunks) {
    const std::vector<std::byte> header = table_.to_bytes();
    offsets_ = {header.size() + chunks.size(), table_.chunks.back().offset, largest_file};
    end_ = offsets_.payloads;
    ORO_TRY(const std::uint64_t found_bytes, partial_.size());
    FoundTable front;
    if (found_bytes >= offsets_.records) {
        front = found_table(partial_, table_);
        std::vector<std::byte> found(chunks.size());
        ORO_CHECK(partial_.read(header.size(), found));
        front.same = front.same && found == chunks;
    }
    if (front.same) {
        // Broken off in finish(): then all is there, except perhaps the stitched deviations, which nobody
        // needs any more.
        if (front.is_finished) ORO_CHECK(find_pages_done(false));
        if (!front.is_finished || pages_done_ < order_.count()) {
            ORO_CHECK(partial_.write(0, header));
            ORO_CHECK(find_pages_done(true));
        }
    } else {
        ORO_CHECK(partial_.resize(0));
        ORO_CHECK(partial_.write(0, header));
        ORO_CHECK(partial_.write(header.size(), chunks));
    }
    // What a break has torn.
    ORO_CHECK(partial_.resize(end_));
    ORO_TRY(const std::uint64_t stitched_found, stitched_.size());
    return stitched_.resize(std::min(stitched_found, pages_done_ * stitched_bytes));
}

Result<void> RegionFileWriter::find_pages_done(bool needs_stitched) {
    end_ = offsets_.payloads;
    pages_done_ = 0;
    records_ = RunningChecksum();
    heights_ = RunningChecksum();
    ORO_TRY(const std::uint64_t found_bytes, partial_.size());
    const RegionOffsets there{offsets_.records, offsets_.payloads, std::max(found_bytes, offsets_.payloads)};
    for (; pages_done_ < order_.count(); ++pages_done_) {
        const auto record = read_record(partial_, there, order_, pages_done_);
        if (!record.ok() || record->payload_offset != end_ - offsets_.payloads) break;
        const auto payload = read_payload(partial_, there, *record);
        if (!payload.ok()) break;
        if (needs_stitched && !read_stitched(stitched_, pages_done_, nullptr).ok()) break;
        take_sums(record_to_bytes(*record), *payload);
        end_ += record->payload_bytes;
    }
    return {};
}

void RegionFileWriter::take_sums(std::span<const std::byte> record, std::span<const std::byte> payload) {
    records_.add(record);
    heights_.add(payload);
}

// These read nothing that append() changes, so that they may be called beside it.
Result<PageRecord> RegionFileWriter::record(std::uint64_t number) const {
    ORO_TRY(const StoredRecord stored, read_record(partial_, offsets_, order_, number));
    return stored.page;
}

Result<void> RegionFileWriter::payload(std::uint64_t number, PagePayload& payload) const {
    ORO_TRY(const StoredRecord stored, read_record(partial_, offsets_, order_, number));
    ORO_TRY(const std::vector<std::byte> bytes, read_payload(partial_, offsets_, stored));
    return decode_payload(partial_, offsets_, stored, bytes, payload);
}

Result<void> RegionFileWriter::stitched(std::uint64_t number, StitchedDeviations& stitched) const {
    return read_stitched(stitched_, number, &stitched);
}

Result<void> RegionFileWriter::append(const EncodedPage& page, const StitchedDeviations& stitched) {
    if (pages_done_ == order_.count()) return fault(partial_.path(), "has all its pages already");
    if (const auto what = implausible(page.record, order_.index(pages_done_)))
        return fault(partial_.path(), "cannot take " + *what);
    assert(!page.payload.empty() && page.payload.size() <= largest_payload_bytes);
    if (page.payload.size() > largest_file - end_) return fault(partial_.path(), "would exceed 2^63 bytes");
    NumberWriter errors;
    for (const auto& node : stitched)
        for (const float error_m : node) errors(error_m);
    errors(xxh64(errors.bytes, pages_done_));
    ORO_CHECK(stitched_.write(pages_done_ * stitched_bytes, errors.bytes));
    ORO_CHECK(partial_.write(end_, page.payload));
    const auto bytes = static_cast<std::uint32_t>(page.payload.size());
    const std::vector<std::byte> record =
        record_to_bytes({page.record, end_ - offsets_.payloads, bytes, page.checksum});
    ORO_CHECK(partial_.write(offsets_.records + pages_done_ * record_bytes, record));
    take_sums(record, page.payload);
    end_ += bytes;
    ++pages_done_;
    return {};
}

Result<void> RegionFileWriter::finish() {
    if (pages_done_ != order_.count())
        return fault(partial_.path(), "has " + std::to_string(pages_done_) + " pages, expected " +
                                          std::to_string(order_.count()));
    ORO_CHECK(partial_.resize(end_));  // a failed append may have left something behind
    // A file that its owner had closed to others stays closed to them when it is replaced.
    if (old_mode_ != 0) (void)fchmod(partial_.descriptor(), old_mode_);
    ORO_CHECK(partial_.sync());
    const ChunkTable whole = finished(table_, records_.sum(), end_ - offsets_.payloads, heights_.sum());
    ORO_CHECK(partial_.write(0, whole.to_bytes()));
    ORO_CHECK(partial_.sync());
    unlink(stitched_.path().c_str());
    return give_name(partial_.path(), path_, overwrite_);
}

}  // namespace oro
