#include "core/base/container.h"

#include <algorithm>
#include <numeric>
#include <string_view>
#include <utility>

#include "core/base/checksum.h"
#include "core/base/little_endian.h"

namespace oro {
namespace {

// Region files, cluster files, windows of clusters, and what joined them, before there was one container.
using namespace std::string_view_literals;
constexpr std::array older_beginnings = {"\x89ORO\r\n\x1a\n"sv, "\x89ORC\r\n\x1a\n"sv,
                                         "\x89ORW\r\n\x1a\x04"sv, "OROGRIDS"sv, "OROCLUST"sv};
struct TypeName {
    ChunkType type;
    const char* name;
};
constexpr std::array type_names = {TypeName{ChunkType::outline, "the outline"},
                                   TypeName{ChunkType::description, "the description"},
                                   TypeName{ChunkType::undulation, "the undulation"},
                                   TypeName{ChunkType::net, "the net"},
                                   TypeName{ChunkType::pages, "the table of pages"},
                                   TypeName{ChunkType::heights, "the chunk of heights"},
                                   TypeName{ChunkType::graph, "the outline of clusters"},
                                   TypeName{ChunkType::groups, "the table of groups"},
                                   TypeName{ChunkType::meshes, "the chunk of meshes"},
                                   TypeName{ChunkType::window, "the index of a window"},
                                   TypeName{ChunkType::blocks, "the chunk of a window's groups"},
                                   TypeName{ChunkType::mesh_facts, "the facts of a mesh"},
                                   TypeName{ChunkType::mesh_triangles, "the triangles of a mesh"},
                                   TypeName{ChunkType::mesh_records, "the records of a mesh"},
                                   TypeName{ChunkType::mesh_payloads, "the groups of a mesh"}};

Error refused(const OpenFile& file, const std::string& what) {
    return {ErrorKind::failed, file.path(), what};
}

// Null: no file has such a chunk.
const char* name_of(ChunkType type) {
    const auto found = std::ranges::find(type_names, type, &TypeName::type);
    return found == type_names.end() ? nullptr : found->name;
}

template <class Visit, class Line>
void visit_line(Visit& visit, Line& line, auto& type) {
    visit(type);
    visit(line.grid);
    visit(line.offset);
    visit(line.bytes);
    visit(line.checksum);
}

std::uint64_t checksum_of(std::span<const std::byte> header, std::span<const std::byte> lines) {
    RunningChecksum sum;
    sum.add(header.first(24));
    sum.add(lines);
    return sum.sum();
}

// Reads bytes piece by piece, and hands on each.
template <class Take>
Result<std::uint64_t> read_pieces(const OpenFile& file, const Chunk& chunk, const Take& take) {
    constexpr std::uint64_t piece_bytes = 1U << 20U;
    std::vector<std::byte> buffer(static_cast<std::size_t>(std::min(chunk.bytes, piece_bytes)));
    RunningChecksum sum;
    for (std::uint64_t at = 0; at < chunk.bytes; at += piece_bytes) {
        const auto piece =
            std::span(buffer).first(static_cast<std::size_t>(std::min(chunk.bytes - at, piece_bytes)));
        ORO_CHECK(file.read(chunk.offset + at, piece));
        sum.add(piece);
        ORO_CHECK(take(std::span<const std::byte>(piece)));
    }
    return sum.sum();
}

Result<void> check_sum(const OpenFile& file, const Chunk& chunk, std::uint64_t sum) {
    if (sum == chunk.checksum) return {};
    return file.damaged(chunk.offset,
                        std::string(name_of(chunk.type)) + " " + other_checksum(sum, chunk.checksum));
}

// What a chunk is found by.
std::pair<std::uint32_t, ChunkType> key_of(const Chunk& chunk) {
    return {chunk.grid, chunk.type};
}

// The numbers of the chunks in the order of their keys. Errors: two have the same.
Result<std::vector<std::uint32_t>> numbers_by_key(const OpenFile& file, const std::vector<Chunk>& chunks) {
    std::vector<std::uint32_t> numbers(chunks.size());
    std::iota(numbers.begin(), numbers.end(), std::uint32_t{0});
    const auto key = [&](std::uint32_t number) { return key_of(chunks[number]); };
    std::ranges::sort(numbers, {}, key);
    if (std::ranges::adjacent_find(numbers, {}, key) == numbers.end()) return numbers;
    return file.damaged(ChunkTable::header_bytes, "its table has a chunk twice");
}

// That the chunks are what they may be, and fill the file.
Result<void> check_chunks(const OpenFile& file, const ChunkTable& table) {
    std::uint64_t end = table.bytes();
    for (std::size_t i = 0; i < table.chunks.size(); ++i) {
        const Chunk& chunk = table.chunks[i];
        const std::uint64_t at = ChunkTable::header_bytes + i * ChunkTable::entry_bytes;
        if (!name_of(chunk.type)) return file.damaged(at, "a chunk of a type that no file has");
        const std::string name = name_of(chunk.type);
        if (chunk.offset != end)
            return file.damaged(at + 8, name + " from byte " + std::to_string(chunk.offset) +
                                            ", expected from byte " + std::to_string(end));
        if (end > table.file_bytes || chunk.bytes > table.file_bytes - end)
            return file.damaged(at + 16, name + " of " + std::to_string(chunk.bytes) +
                                             " bytes, expected to end within the file's " +
                                             std::to_string(table.file_bytes));
        end += chunk.bytes;
    }
    if (end != table.file_bytes)
        return file.damaged(16, "a size of " + std::to_string(table.file_bytes) +
                                    " bytes, but its chunks end at byte " + std::to_string(end));
    return {};
}

}  // namespace

std::uint64_t ChunkTable::place() {
    std::uint64_t end = bytes();
    for (Chunk& chunk : chunks) {
        chunk.offset = end;
        end += chunk.bytes;
    }
    return end;
}

std::vector<std::byte> ChunkTable::to_bytes() const {
    NumberWriter lines, header;
    for (const Chunk& chunk : chunks) {
        const auto type = static_cast<std::uint32_t>(chunk.type);
        visit_line(lines, chunk, type);
    }
    for (const unsigned char byte : magic) header(byte);
    header(version);
    header(static_cast<std::uint32_t>(chunks.size()));
    header(file_bytes);
    header(checksum_of(header.bytes, lines.bytes));
    header.bytes.insert(header.bytes.end(), lines.bytes.begin(), lines.bytes.end());
    return std::move(header.bytes);
}

Result<FileBeginning> file_beginning(const OpenFile& file) {
    ORO_TRY(const std::uint64_t size, file.size());
    std::array<std::byte, ChunkTable::magic.size()> bytes;
    const auto there =
        std::span(bytes).first(static_cast<std::size_t>(std::min<std::uint64_t>(size, bytes.size())));
    ORO_CHECK(file.read(0, there));
    const auto begins = [&](std::span<const std::byte> expected) {
        return std::equal(there.begin(), there.end(), expected.begin());
    };
    if (begins(std::as_bytes(std::span(ChunkTable::magic)))) return FileBeginning::container;
    for (const std::string_view older : older_beginnings)
        if (begins(std::as_bytes(std::span(older)))) return FileBeginning::older;
    return FileBeginning::foreign;
}

bool looks_baked(const std::string& path) {
    const auto file = OpenFile::open(path, OpenFile::Use::read);
    if (!file.ok()) return false;
    const auto size = file->size();
    if (!size.ok() || *size < ChunkTable::magic.size()) return false;
    const auto begins = file_beginning(*file);
    return begins.ok() && *begins != FileBeginning::foreign;
}

Result<ChunkTable> read_chunk_table(const OpenFile& file) {
    ORO_TRY(const std::uint64_t size, file.size());
    if (size == 0) return refused(file, "is no region file: it is empty");
    ORO_TRY(const FileBeginning begins, file_beginning(file));
    if (begins == FileBeginning::older)
        return refused(
            file, "was baked by an older Orograph: bake it again (orograph bake PATH... --out FILE.oro)");
    if (begins == FileBeginning::foreign || size < ChunkTable::magic.size())
        return refused(file, "is no region file: it does not begin at byte 0 as one does");
    const Error cut = refused(file, "is cut off at byte " + std::to_string(size) + ", within its header");
    std::array<std::byte, ChunkTable::header_bytes> header;
    if (size < header.size()) return cut;
    ORO_CHECK(file.read(0, header));
    NumberReader numbers(std::span<const std::byte>(header).subspan(ChunkTable::magic.size()));
    std::uint32_t version = 0, count = 0;
    std::uint64_t checksum = 0;
    ChunkTable table;
    numbers(version);
    numbers(count);
    numbers(table.file_bytes);
    numbers(checksum);
    if (version != ChunkTable::version)
        return refused(file, "is of version " + std::to_string(version) +
                                 " of the region format (byte 8), this program reads version " +
                                 std::to_string(ChunkTable::version));
    if (count == 0 || count > ChunkTable::most_chunks)
        return file.damaged(
            12, std::to_string(count) + " chunks, expected 1 to " + std::to_string(ChunkTable::most_chunks));
    table.chunks.resize(count);
    if (size < table.bytes()) return cut;
    std::vector<std::byte> lines(count * ChunkTable::entry_bytes);
    ORO_CHECK(file.read(header.size(), lines));
    if (const std::uint64_t found = checksum_of(header, lines); found != checksum)
        return file.damaged(0, "the header " + other_checksum(found, checksum));
    NumberReader get(lines);
    for (Chunk& chunk : table.chunks) {
        std::uint32_t type = 0;
        visit_line(get, chunk, type);
        chunk.type = static_cast<ChunkType>(type);
    }
    return table;
}

Container::Container(OpenFile file, ChunkTable table, std::vector<std::uint32_t> by_key, const Header& header)
    : file_(std::move(file)), table_(std::move(table)), by_key_(std::move(by_key)), header_(header) {}

Result<std::shared_ptr<const Container>> Container::open(const std::string& path) {
    ORO_TRY(OpenFile file, OpenFile::open(path, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, file.size());
    ORO_TRY(ChunkTable table, read_chunk_table(file));
    if (table.file_bytes == 0)
        return refused(file,
                       "is unfinished: the program that wrote it was stopped (its size at byte 16 is 0)");
    if (size < table.file_bytes)
        return refused(file, "is cut off at byte " + std::to_string(size) + ", expected " +
                                 std::to_string(table.file_bytes) + " bytes");
    if (size > table.file_bytes)
        return refused(file, "goes on after its end at byte " + std::to_string(table.file_bytes) +
                                 ": it has " + std::to_string(size) + " bytes");
    ORO_CHECK(check_chunks(file, table));
    ORO_TRY(std::vector<std::uint32_t> by_key, numbers_by_key(file, table.chunks));
    Header header;
    std::ranges::copy_n(table.to_bytes().begin(), header.size(), header.begin());
    return std::shared_ptr<const Container>(
        new Container(std::move(file), std::move(table), std::move(by_key), header));
}

const Chunk* Container::find(ChunkType type, std::uint32_t grid) const {
    const std::pair key(grid, type);
    const auto found = std::ranges::lower_bound(
        by_key_, key, {}, [&](std::uint32_t number) { return key_of(table_.chunks[number]); });
    if (found == by_key_.end() || key_of(table_.chunks[*found]) != key) return nullptr;
    return &table_.chunks[*found];
}

Result<Chunk> Container::chunk(ChunkType type, std::uint32_t grid) const {
    if (const Chunk* const found = find(type, grid)) return *found;
    return file_.damaged(ChunkTable::header_bytes, "its table of chunks lacks " + std::string(name_of(type)) +
                                                       " of grid " + std::to_string(grid));
}

Result<void> Container::check(const Chunk& chunk) const {
    ORO_TRY(const std::uint64_t sum,
            read_pieces(file_, chunk, [](std::span<const std::byte>) { return Result<void>(); }));
    return check_sum(file_, chunk, sum);
}

Result<std::vector<std::byte>> Container::read(const Chunk& chunk, std::uint64_t most_bytes) const {
    if (chunk.bytes > most_bytes)
        return file_.damaged(chunk.offset, std::string(name_of(chunk.type)) + " of " +
                                               std::to_string(chunk.bytes) + " bytes, expected at most " +
                                               std::to_string(most_bytes));
    // A large chunk that is not what was written, as a hole in the file, takes no memory.
    constexpr std::uint64_t large_bytes = std::uint64_t{16} << 20U;
    if (chunk.bytes > large_bytes) ORO_CHECK(check(chunk));
    std::vector<std::byte> bytes(static_cast<std::size_t>(chunk.bytes));
    const Result<void> read = file_.read(chunk.offset, bytes);
    ORO_CHECK(check_unchanged());
    ORO_CHECK(read);
    ORO_CHECK(check_sum(file_, chunk, xxh64(bytes)));
    return bytes;
}

Result<void> Container::check_unchanged() const {
    Header now;
    ORO_CHECK(file_.read(0, now));
    if (now == header_) return {};
    return refused(file_, "was changed at byte 0, its header, by another program while it was being read");
}

Result<void> join_containers(std::span<const ContainerPart> parts,
                             const std::function<Result<void>(std::span<const std::byte>)>& write) {
    std::vector<std::shared_ptr<const Container>> opened;
    ChunkTable table;
    for (const ContainerPart& part : parts) {
        ORO_TRY(std::shared_ptr<const Container> container, Container::open(part.path));
        for (Chunk chunk : container->table().chunks) {
            chunk.grid = part.grid;
            table.chunks.push_back(chunk);
        }
        opened.push_back(std::move(container));
    }
    if (table.chunks.size() > ChunkTable::most_chunks)
        return Error{ErrorKind::failed, parts.front().path,
                     "is one of " + std::to_string(parts.size()) + " grids, which are too many for one file"};
    table.file_bytes = table.place();
    ORO_CHECK(write(table.to_bytes()));
    for (const auto& container : opened) {
        for (const Chunk& chunk : container->table().chunks) {
            ORO_TRY(const std::uint64_t sum, read_pieces(container->file(), chunk, write));
            ORO_CHECK(check_sum(container->file(), chunk, sum));
        }
    }
    return {};
}

}  // namespace oro
