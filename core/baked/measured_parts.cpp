#include "core/baked/measured_parts.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <tuple>
#include <utility>

#include "core/base/checksum.h"
#include "core/base/file_target.h"
#include "core/base/little_endian.h"
#include "core/base/parallel.h"
#include "core/lod/levels_gpu.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

// A container (core/base/container.h) of two chunks: rows of nodes one after another, each with its checksum,
// and what tells them from those of anything else.
constexpr std::size_t row_bytes = nodes_per_row * (sizeof(double) + 4 * sizeof(float));
constexpr std::size_t stored_row_bytes = row_bytes + sizeof(std::uint64_t);
// Counted up when the same nodes come to other deviations.
constexpr std::uint64_t rules_of_deviations = 1;

std::uint64_t rows_of_part(std::uint64_t all, const BakePart& part) {
    return all / part.count + (all % part.count >= part.number ? 1 : 0);
}

// What was to be measured, of what.
std::uint64_t plan_of_part(const PostGrid& grid, const BakeOptions& how, const BakePart& part) {
    const std::uint64_t description = xxh64(std::as_bytes(std::span(how.description)));
    const std::array<std::uint64_t, 6> facts{how.fingerprint,
                                             description,
                                             static_cast<std::uint64_t>(grid.rows()),
                                             static_cast<std::uint64_t>(grid.columns()),
                                             part.number,
                                             part.count};
    return xxh64(std::as_bytes(std::span(facts)), rules_of_deviations);
}

std::array<std::byte, stored_row_bytes> stored_row(const RowDeviations& row) {
    std::array<std::byte, stored_row_bytes> bytes{};
    std::size_t at = 0;
    const auto put = [&](auto number) {
        to_little_endian(number, &bytes[at]);
        at += sizeof(number);
    };
    for (const double own_m : row.own_m) put(own_m);
    for (const auto& of_node : row.stitched_m)
        for (const float stitched_m : of_node) put(stitched_m);
    put(xxh64(std::span(bytes).first(row_bytes)));
    return bytes;
}

// False where the bytes are not those that were written.
bool read_stored_row(std::span<const std::byte> bytes, RowDeviations& row) {
    if (wrong_checksum(bytes, 0)) return false;
    NumberReader get(bytes.first(row_bytes));
    for (double& own_m : row.own_m) get(own_m);
    for (auto& of_node : row.stitched_m)
        for (float& stitched_m : of_node) get(stitched_m);
    return true;
}

struct OpenedPart {
    std::shared_ptr<const Container> container;
    std::uint64_t offset{};
};

Result<OpenedPart> open_part(const std::string& path, std::uint64_t plan, std::uint64_t rows) {
    ORO_TRY(std::shared_ptr<const Container> container, Container::open(path));
    ORO_TRY(const Chunk index, container->chunk(ChunkType::window, 0));
    ORO_TRY(const Chunk blocks, container->chunk(ChunkType::blocks, 0));
    ORO_TRY(const std::vector<std::byte> stored, container->read(index, sizeof plan));
    if (stored.size() != sizeof plan || from_little_endian<std::uint64_t>(stored.data()) != plan ||
        blocks.bytes != rows * stored_row_bytes)
        return Error{
            ErrorKind::failed, path,
            "is a part of other data, of another choice of them, or of another version of the program"};
    return OpenedPart{std::move(container), blocks.offset};
}

// What a part that was broken off left behind may be replaced; what anybody else has under that name stays.
Result<void> check_name_of_part(const std::string& path) {
    for (const std::string& name : {path, path + ".partial"}) {
        std::error_code ignored;
        if (!fs::exists(fs::symlink_status(name, ignored))) continue;
        const Result<OpenFile> file = OpenFile::open(name, OpenFile::Use::read_own);
        if (!file.ok()) return file.error();
        ORO_TRY(const FileBeginning begins, file_beginning(*file));
        if (begins == FileBeginning::foreign)
            return Error{ErrorKind::failed, name,
                         "is there already, and no bake has left it behind; move it away, or choose another "
                         "name for the region"};
    }
    return {};
}

// Writes rows one after another, and in the end the table and the name.
class PartWriter {
  public:
    static Result<PartWriter> create(const std::string& path, std::uint64_t rows) {
        ORO_TRY(OpenFile file, OpenFile::open(path + ".partial", OpenFile::Use::write));
        ORO_CHECK(file.resize(0));
        ChunkTable table{0,
                         {{ChunkType::blocks, 0, 0, rows * stored_row_bytes, 0},
                          {ChunkType::window, 0, 0, sizeof(std::uint64_t), 0}}};
        table.place();
        // A file that stays when it is broken off is known for what it is.
        ORO_CHECK(file.write(0, table.to_bytes()));
        return PartWriter(path, std::move(file), std::move(table));
    }
    Result<void> append(const RowDeviations& row) {
        const auto bytes = stored_row(row);
        sum_.add(bytes);
        buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
        return buffer_.size() < std::size_t{1} << 20U ? Result<void>() : write_buffer();
    }
    Result<void> finish(std::uint64_t plan) {
        ORO_CHECK(write_buffer());
        std::array<std::byte, sizeof plan> index{};
        to_little_endian(plan, index.data());
        ORO_CHECK(file_.write(table_.chunks[1].offset, index));
        table_.chunks[0].checksum = sum_.sum();
        table_.chunks[1].checksum = xxh64(index);
        table_.file_bytes = table_.place();
        ORO_CHECK(file_.write(0, table_.to_bytes()));
        ORO_CHECK(file_.sync());
        return give_name(file_.path(), path_, true);
    }

  private:
    PartWriter(std::string path, OpenFile file, ChunkTable table)
        : path_(std::move(path)), file_(std::move(file)), table_(std::move(table)) {}
    Result<void> write_buffer() {
        ORO_CHECK(file_.write(table_.chunks[0].offset + written_, buffer_));
        written_ += buffer_.size();
        buffer_.clear();
        return {};
    }

    std::string path_;
    OpenFile file_;
    ChunkTable table_;
    RunningChecksum sum_;
    std::vector<std::byte> buffer_;
    std::uint64_t written_{};
};

// Rows of nodes of one level that belong to the part, so many at a time.
Result<void> measure_level(const NodeDeviations& deviations, const LevelGrid& level, const PageOrder& order,
                           std::uint64_t first, std::uint64_t end, const BakePart& part, int threads,
                           PartWriter& writer, const BakeProgress& progress) {
    constexpr std::uint64_t at_a_time = 256;
    const std::uint64_t all = order.count() * nodes_per_row;
    std::vector<RowDeviations> some;
    // The first of the part's rows that is not before the level's.
    std::uint64_t next = first + (part.number - 1 + part.count - first % part.count) % part.count;
    while (next < end) {
        const std::uint64_t count = std::min(at_a_time, (end - next + part.count - 1) / part.count);
        some.assign(count, {});
        in_parallel(static_cast<int>(count), threads, [&](int i) {
            const std::uint64_t row = next + static_cast<std::uint64_t>(i) * part.count;
            some[static_cast<std::size_t>(i)] = measured_row(
                deviations, level, order.index(row / nodes_per_row), static_cast<int>(row % nodes_per_row));
        });
        for (const RowDeviations& row : some) ORO_CHECK(writer.append(row));
        next += count * part.count;
        if (progress && !progress(static_cast<double>(std::min(next, all)) / static_cast<double>(all)))
            return Error{ErrorKind::failed, "bake",
                         "was interrupted; the same command begins this part again"};
    }
    return {};
}

bool read_count(std::string_view text, std::uint64_t& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() && number > 0 && text.front() != '0';
}

}  // namespace

std::string path_of_measured_part(const std::string& path, const BakePart& part) {
    return path + ".part-" + std::to_string(part.number) + "of" + std::to_string(part.count);
}

std::vector<BakePart> measured_parts_there(const std::string& path) {
    const fs::path whole(path);
    const std::string begins = whole.filename().string() + ".part-";
    std::vector<BakePart> parts;
    std::error_code failed;
    for (fs::directory_iterator entry(whole.has_parent_path() ? whole.parent_path() : fs::path("."), failed),
         end;
         !failed && entry != end; entry.increment(failed)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with(begins)) continue;
        const std::string_view rest = std::string_view(name).substr(begins.size());
        const std::size_t of = rest.find("of");
        BakePart part;
        if (of != std::string_view::npos && read_count(rest.substr(0, of), part.number) &&
            read_count(rest.substr(of + 2), part.count) && part.number <= part.count)
            parts.push_back(part);
    }
    std::ranges::sort(parts, [](const BakePart& a, const BakePart& b) {
        return std::tie(a.count, a.number) < std::tie(b.count, b.number);
    });
    return parts;
}

Result<std::uint64_t> measure_part(const HeightField& field, const BakeOptions& how, const BakePart& part,
                                   const BakeProgress& progress) {
    const std::string path = path_of_measured_part(how.path, part);
    const PageOrder order(field.grid);
    const std::uint64_t rows = rows_of_part(order.count() * nodes_per_row, part);
    const std::uint64_t plan = plan_of_part(field.grid, how, part);
    ORO_CHECK(check_name_of_part(path));
    if (const auto there = open_part(path, plan, rows); there.ok()) {
        ORO_TRY(const Chunk blocks, there->container->chunk(ChunkType::blocks, 0));
        if (there->container->check(blocks).ok()) return std::uint64_t{0};
    }
    const DrawnHeights heights = drawn_heights(field, 1.0, how.threads);
    ORO_TRY(PartWriter writer, PartWriter::create(path, rows));
    std::uint64_t first = 0;
    for (int level = 0; level < order.levels(); ++level) {
        const std::uint64_t end = first + order.layout(level).count() * nodes_per_row;
        const NodeDeviations deviations(field.grid, heights, level);
        ORO_CHECK(measure_level(deviations, level_grid(field.grid, level), order, first, end, part,
                                how.threads, writer, progress));
        first = end;
    }
    ORO_CHECK(writer.finish(plan));
    return rows;
}

Result<MeasuredParts> MeasuredParts::open(const PostGrid& grid, const BakeOptions& how) {
    const std::vector<BakePart> there = measured_parts_there(how.path);
    if (there.empty())
        return Error{ErrorKind::failed, path_of_measured_part(how.path, {1, 1}),
                     "is not there, nor any other part: bake --shard writes them"};
    const std::uint64_t count = there.front().count;
    if (there.back().count != count)
        return Error{ErrorKind::failed, how.path,
                     "has parts of " + std::to_string(count) + " and of " +
                         std::to_string(there.back().count) + ": remove those that are too many"};
    PageOrder order(grid);
    std::vector<std::shared_ptr<const Container>> parts;
    std::vector<std::uint64_t> offsets;
    for (std::uint64_t number = 1; number <= count; ++number) {
        const BakePart part{number, count};
        const std::string path = path_of_measured_part(how.path, part);
        if (number > there.size() || there[number - 1].number != number)
            return Error{ErrorKind::failed, path,
                         "is not there: bake --shard " + std::to_string(number) + "/" +
                             std::to_string(count) + " writes it"};
        ORO_TRY(OpenedPart opened, open_part(path, plan_of_part(grid, how, part),
                                             rows_of_part(order.count() * nodes_per_row, part)));
        parts.push_back(std::move(opened.container));
        offsets.push_back(opened.offset);
    }
    return MeasuredParts(std::move(order), std::move(parts), std::move(offsets));
}

Result<void> MeasuredParts::row(const PageIndex& page, int row, RowDeviations& deviations) const {
    const std::uint64_t number = order_.number(page) * nodes_per_row + static_cast<std::uint64_t>(row);
    const std::size_t part = number % parts_.size();
    const std::uint64_t offset = offsets_[part] + number / parts_.size() * stored_row_bytes;
    std::array<std::byte, stored_row_bytes> bytes{};
    ORO_CHECK(parts_[part]->file().read(offset, bytes));
    if (!read_stored_row(bytes, deviations))
        return parts_[part]->file().damaged(offset, "a row of nodes has another checksum");
    return {};
}

std::vector<std::string> MeasuredParts::files() const {
    std::vector<std::string> all;
    for (const auto& part : parts_) all.push_back(part->path());
    return all;
}

}  // namespace oro
