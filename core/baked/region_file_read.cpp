#include <algorithm>
#include <cassert>
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

// The chunks of a grid, and how many bytes they take in a file of their own.
class GridChunks {
  public:
    GridChunks(const Container& container, std::uint32_t grid) : container_(container), grid_(grid) {}
    Result<Chunk> take(ChunkType type) {
        ORO_TRY(const Chunk chunk, container_.chunk(type, grid_));
        bytes_ += ChunkTable::entry_bytes + chunk.bytes;
        return chunk;
    }
    [[nodiscard]] bool has(ChunkType type) const { return container_.find(type, grid_) != nullptr; }
    [[nodiscard]] std::uint64_t bytes() const { return ChunkTable::header_bytes + bytes_; }

  private:
    const Container& container_;
    std::uint32_t grid_;
    std::uint64_t bytes_{};
};

Result<OutlineNumbers> read_numbers(const Container& container, const Chunk& chunk, const Chunk& undulation,
                                    bool on_net) {
    if (chunk.bytes != outline_bytes)
        return container.file().damaged(chunk.offset, "an outline of " + std::to_string(chunk.bytes) +
                                                          " bytes, expected " +
                                                          std::to_string(outline_bytes));
    ORO_TRY(const std::vector<std::byte> bytes, container.read(chunk, outline_bytes));
    const OutlineNumbers numbers = numbers_from_bytes(bytes);
    if (const auto wrong = implausible(numbers, undulation.bytes, on_net))
        return container.file().damaged(chunk.offset + wrong->offset, wrong->what);
    return numbers;
}

Result<std::vector<float>> read_undulation(const Container& container, const Chunk& chunk) {
    ORO_TRY(const std::vector<std::byte> bytes, container.read(chunk, most_undulation_nodes * sizeof(float)));
    std::vector<float> N_m(bytes.size() / sizeof(float));
    NumberReader get(bytes);
    for (float& value : N_m) get(value);
    if (const auto wrong = implausible(N_m))
        return container.file().damaged(chunk.offset + wrong->offset, wrong->what);
    return N_m;
}

Result<std::string> read_description(const Container& container, const Chunk& chunk) {
    ORO_TRY(const std::vector<std::byte> bytes, container.read(chunk, longest_description));
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

Result<PostGrid> read_grid(const Container& container, GridChunks& chunks, const OutlineNumbers& numbers) {
    if (!chunks.has(ChunkType::net)) return PostGrid{numbers.lat, numbers.lon};
    ORO_TRY(const Chunk chunk, chunks.take(ChunkType::net));
    const auto no_net = [&](const std::string& what) {
        return container.file().damaged(chunk.offset, "the net of its posts is none: " + what);
    };
    std::vector<std::byte> front(static_cast<std::size_t>(std::min(chunk.bytes, net_front_bytes)));
    ORO_CHECK(container.file().read(chunk.offset, front));
    const auto most_bytes = most_net_bytes(front, numbers.lat.count, numbers.lon.count);
    // A front that lies may be one that is damaged.
    if (!most_bytes.ok() || chunk.bytes > *most_bytes) ORO_CHECK(container.check(chunk));
    if (!most_bytes.ok()) return no_net(most_bytes.error().what);
    ORO_TRY(const std::vector<std::byte> bytes, container.read(chunk, *most_bytes));
    auto net = net_from_bytes(bytes, numbers.lat.count, numbers.lon.count);
    if (net.ok()) return grid_on_net(std::move(*net));
    return no_net(net.error().what);
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

RegionFile::RegionFile(std::shared_ptr<const Container> container, RegionOutline outline)
    : container_(std::move(container)), outline_(std::move(outline)), order_(outline_.grid) {}

Result<RegionFile> RegionFile::open(const std::string& path) {
    ORO_TRY(std::shared_ptr<const Container> container, Container::open(path));
    const auto grids = std::ranges::count(container->table().chunks, ChunkType::outline, &Chunk::type);
    if (grids > 1)
        return Error{ErrorKind::failed, path,
                     "holds " + std::to_string(grids) + " grids of posts, and this takes one"};
    return open(std::move(container), 0);
}

Result<RegionFile> RegionFile::open(std::shared_ptr<const Container> container, std::uint32_t grid) {
    GridChunks chunks(*container, grid);
    ORO_TRY(const Chunk outline, chunks.take(ChunkType::outline));
    ORO_TRY(const Chunk undulation, chunks.take(ChunkType::undulation));
    ORO_TRY(const Chunk description, chunks.take(ChunkType::description));
    ORO_TRY(const Chunk pages, chunks.take(ChunkType::pages));
    ORO_TRY(const Chunk heights, chunks.take(ChunkType::heights));
    ORO_TRY(const OutlineNumbers numbers,
            read_numbers(*container, outline, undulation, chunks.has(ChunkType::net)));
    RegionOutline found;
    ORO_TRY(found.description, read_description(*container, description));
    ORO_TRY(found.undulation.N_m, read_undulation(*container, undulation));
    ORO_TRY(found.grid, read_grid(*container, chunks, numbers));
    found.undulation.lat = numbers.undulation_lat;
    found.undulation.lon = numbers.undulation_lon;
    found.shape.occluder.radii_m = numbers.occluder_radii_m;
    found.lowest_H_m = numbers.lowest_H_m;
    found.highest_H_m = numbers.highest_H_m;
    found.voids = numbers.voids;
    found.triangles = numbers.triangles;
    const std::uint64_t bytes = chunks.bytes();
    RegionFile file(std::move(container), std::move(found));
    file.pages_ = pages;
    file.heights_ = heights;
    file.offsets_ = {pages.offset, heights.offset, heights.offset + heights.bytes};
    file.fingerprint_ = numbers.fingerprint;
    file.bytes_ = bytes;
    ORO_CHECK(file.check_end());
    return file;
}

// The last page's record says where the payloads end. A file of the right size that is mostly holes, a copy
// that was stopped or a forgery, has no such record.
Result<void> RegionFile::check_end() const {
    const OpenFile& file = container_->file();
    if (pages_.bytes != order_.count() * record_bytes)
        return file.damaged(pages_.offset, "records of pages in " + std::to_string(pages_.bytes) +
                                               " bytes, expected " +
                                               std::to_string(order_.count() * record_bytes));
    const std::uint64_t last = order_.count() - 1;
    ORO_TRY(const StoredRecord stored, read_record(file, offsets_, order_, last));
    const std::uint64_t end = stored.payload_offset + stored.payload_bytes;
    if (end == heights_.bytes) return {};
    return file.damaged(offsets_.records + last * record_bytes,
                        "its payloads end at byte " + std::to_string(end) + " of the heights, which have " +
                            std::to_string(heights_.bytes));
}

Result<PageRecord> RegionFile::record(PageIndex index) const {
    const auto stored = read_record(container_->file(), offsets_, order_, order_.number(index));
    ORO_CHECK(container_->check_unchanged());
    if (!stored.ok()) return stored.error();
    return stored->page;
}

Result<void> RegionFile::payload(PageIndex index, PagePayload& payload) const {
    const OpenFile& file = container_->file();
    const auto read = [&]() -> Result<void> {
        ORO_TRY(const StoredRecord stored, read_record(file, offsets_, order_, order_.number(index)));
        ORO_TRY(const std::vector<std::byte> bytes, read_payload(file, offsets_, stored));
        return decode_payload(file, offsets_, stored, bytes, payload);
    }();
    ORO_CHECK(container_->check_unchanged());
    return read;
}

Result<void> RegionFile::verify() const {
    const OpenFile& file = container_->file();
    std::uint64_t end = 0;
    RunningChecksum sum;
    const auto payload = std::make_unique<PagePayload>();
    for (std::uint64_t number = 0; number < order_.count(); ++number) {
        ORO_TRY(const StoredRecord stored, read_record(file, offsets_, order_, number));
        if (stored.payload_offset != end)
            return file.damaged(offsets_.records + number * record_bytes,
                                "a payload from byte " + std::to_string(stored.payload_offset) +
                                    " of the heights, expected from byte " + std::to_string(end));
        ORO_TRY(const std::vector<std::byte> bytes, read_payload(file, offsets_, stored));
        ORO_CHECK(decode_payload(file, offsets_, stored, bytes, *payload));
        sum.add(bytes);
        end += stored.payload_bytes;
    }
    ORO_CHECK(container_->check_unchanged());
    ORO_CHECK(container_->check(pages_));
    if (sum.sum() == heights_.checksum) return {};
    return file.damaged(heights_.offset,
                        "the chunk of heights " + other_checksum(sum.sum(), heights_.checksum));
}

}  // namespace oro
