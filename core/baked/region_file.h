// The baked region: a file with all pages of all levels, which are read one by one when they are asked for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/baked/page_compression.h"
#include "core/base/checksum.h"
#include "core/base/container.h"
#include "core/base/open_file.h"
#include "core/base/result.h"
#include "core/lod/pyramid.h"
#include "core/terrain/level_grid.h"
#include "core/terrain/page.h"
#include "core/terrain/post_grid.h"

namespace oro {

// What a region file says of the whole region; with its offsets (core/baked/region_format.h) all that is kept
// of it in memory.
struct RegionOutline {
    PostGrid grid;  // up to 2^31 - 256 posts along an axis
    UndulationField undulation;
    RegionShape shape;  // exaggeration 1
    float lowest_H_m{};
    float highest_H_m{};
    std::uint64_t voids{};      // posts
    std::uint64_t triangles{};  // of the full resolution
    std::string description;    // UTF-8, up to 64 MiB; what it says is the program's business
};

// The order of a region's pages in its file: level by level from the finest, row by row.
class PageOrder {
  public:
    explicit PageOrder(const PostGrid& grid);

    [[nodiscard]] int levels() const { return static_cast<int>(levels_.size()); }
    [[nodiscard]] PageLayout layout(int level) const {
        return levels_[static_cast<std::size_t>(level)].layout;
    }
    [[nodiscard]] std::uint64_t count() const { return count_; }
    [[nodiscard]] bool holds(PageIndex index) const;
    // Number of a page that the region has.
    [[nodiscard]] std::uint64_t number(PageIndex index) const;
    // The inverse; number: below count().
    [[nodiscard]] PageIndex index(std::uint64_t number) const;

  private:
    struct Level {
        PageLayout layout;
        std::uint64_t first;  // number of its first page
    };
    std::vector<Level> levels_;
    std::uint64_t count_{0};
};

// Where the pages' records and payloads lie in the file; see core/baked/region_format.h.
struct RegionOffsets {
    std::uint64_t records;
    std::uint64_t payloads;
    std::uint64_t end;  // of the payloads
};

// A page as it goes into the file. Making one is the costly part of writing.
struct EncodedPage {
    PageRecord record;
    std::vector<std::byte> payload;
    std::uint64_t checksum;  // of the payload
};
// Numbers of the payload must be finite. Safe to call from several threads. Errors: those of encode_payload.
[[nodiscard]] Result<EncodedPage> encode_page(const PageRecord& record, const PagePayload& payload);

// The files that a bake to `path` writes: the region's own, PATH.partial and PATH.partial-stitched; where the
// name is a link, what it leads to and beside that.
[[nodiscard]] std::vector<std::string> files_of_bake(const std::string& path);

// Keeps other bakes of a file out while it lives, for bakes that make it from several files beside it: holds
// the lock that a bake into one file has by writing, that of the .partial, which is empty here and gone
// afterwards. (One with pages in it, that another bake left behind, stays.)
class BakeHold {
  public:
    // Errors: another program writes the file; it is there, and must not be replaced; somebody else's
    // .partial.
    static Result<BakeHold> take(const std::string& path, bool overwrite);
    BakeHold(BakeHold&&) noexcept = default;
    BakeHold& operator=(BakeHold&&) = delete;
    BakeHold(const BakeHold&) = delete;
    BakeHold& operator=(const BakeHold&) = delete;
    ~BakeHold();

  private:
    explicit BakeHold(OpenFile partial) : partial_(std::move(partial)) {}
    OpenFile partial_;
};

// Writes a region file, page after page, so that it can be stopped at any moment, by a kill or a power cut,
// and go on from there: it grows as PATH.partial and takes its real name, whole, in finish(). Beside it grows
// PATH.partial-stitched, which the finished file does not have. The same pages make the same bytes, however
// often the writing was broken off. Keeps no payload in memory.
class RegionFileWriter {
  public:
    // What must hold before anything takes time; changes nothing. The name is free, or may be replaced, and
    // what has the names of its .partial files is what a bake left behind: it begins as one does, is no link,
    // and has no second name. Errors: as check_target; a file that is somebody else's.
    static Result<void> check(const std::string& path, bool overwrite);

    // Goes on with a .partial that was begun with the same outline and fingerprint by the same version of the
    // format, after its last page that is whole (all are read to tell); one of any other bake is started
    // over. `fingerprint` tells one state of the sources and of what is made of them from any other. Errors:
    // those of check(), an outline with a number that no region has, a folder that cannot be written to,
    // another program that is writing the same file.
    static Result<RegionFileWriter> create(const std::string& path, const RegionOutline& outline,
                                           std::uint64_t fingerprint, bool overwrite);

    [[nodiscard]] const PageOrder& order() const { return order_; }
    // Pages that are there already, the first ones of the order.
    [[nodiscard]] std::uint64_t pages_done() const { return pages_done_; }
    // What was appended, also before a break; number: below pages_done(). For any number of threads, also
    // while one appends; all else is for one thread. The stitched deviations are gone once all pages are
    // there and finish() was begun; nobody needs them then.
    [[nodiscard]] Result<PageRecord> record(std::uint64_t number) const;
    Result<void> payload(std::uint64_t number, PagePayload& payload) const;
    Result<void> stitched(std::uint64_t number, StitchedDeviations& stitched) const;

    // Appends the page with the number pages_done(). After an error (a full disk) the page is not there, and
    // may be appended again.
    Result<void> append(const EncodedPage& page, const StitchedDeviations& stitched);
    // When all pages are there: puts everything on the disk, gives the file its name (never, unless
    // overwrite, that of a file which appeared since) and removes what was beside it. The writer is of no use
    // afterwards, except to be destroyed; after an error the .partial is still there.
    Result<void> finish();

  private:
    RegionFileWriter(OpenFile partial, OpenFile stitched, const PostGrid& grid);
    Result<void> start_or_resume(const std::vector<std::byte>& chunks);
    Result<void> find_pages_done(bool needs_stitched);
    void take_sums(std::span<const std::byte> record, std::span<const std::byte> payload);

    std::string path_;
    bool overwrite_{};
    unsigned old_mode_{};  // rights of the file that is replaced, 0 when there is none
    OpenFile partial_;
    OpenFile stitched_;
    PageOrder order_;
    ChunkTable table_;  // as it is while the file is unfinished
    RegionOffsets offsets_{};
    std::uint64_t pages_done_{0};
    std::uint64_t end_{0};               // of the payloads that are there
    RunningChecksum records_, heights_;  // of those
};

// A region file that is read. Opening reads what concerns the whole region, a few KB; a page's record and
// payload are read when they are asked for, from any number of threads at once. Every damage is an Error
// with the name of the file and the byte at which it was found; so is a file that another program writes into
// while it is open. (One that takes its name instead, as a bake does, does no harm.)
//     ORO_TRY(const RegionFile file, RegionFile::open("alps.oro"));
//     ORO_TRY(const PageRecord record, file.record({0, 0, 0}));  // row, column, level: the north-west page
class RegionFile {
  public:
    // Errors: those of Container; several grids in one file; damage, and numbers that no region has.
    static Result<RegionFile> open(const std::string& path);
    // The grid of that number in a file.
    static Result<RegionFile> open(std::shared_ptr<const Container> container, std::uint32_t grid);

    [[nodiscard]] const std::string& path() const { return container_->path(); }
    [[nodiscard]] const RegionOutline& outline() const { return outline_; }
    [[nodiscard]] const PageOrder& order() const { return order_; }
    [[nodiscard]] std::uint64_t fingerprint() const { return fingerprint_; }
    // The size that the grid has in a file of its own.
    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }
    // The size of all that the file holds, as it is when it is whole.
    [[nodiscard]] std::uint64_t file_bytes() const { return container_->table().file_bytes; }
    // Of a page that the region has.
    [[nodiscard]] Result<PageRecord> record(PageIndex index) const;
    // Numbers are finite; some 50 us, 100 us where heights are no whole metres.
    Result<void> payload(PageIndex index, PagePayload& payload) const;
    // Reads all pages and tells the first damage.
    [[nodiscard]] Result<void> verify() const;

  private:
    RegionFile(std::shared_ptr<const Container> container, RegionOutline outline);
    [[nodiscard]] Result<void> check_end() const;

    std::shared_ptr<const Container> container_;
    RegionOutline outline_;
    PageOrder order_;
    Chunk pages_, heights_;
    RegionOffsets offsets_{};
    std::uint64_t fingerprint_{};
    std::uint64_t bytes_{};
};

}  // namespace oro
