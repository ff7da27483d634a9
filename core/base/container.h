// The container of every file that the program bakes: a header, a table of typed chunks, and the chunks.
//
//   byte 0      magic, 8 bytes
//   byte 8      version, 4 bytes: 1
//   byte 12     number of chunks, 4 bytes
//   byte 16     size of the file, 8 bytes; 0 while it is unfinished
//   byte 24     checksum of the 24 bytes before it and of the table, 8 bytes
//   byte 32     table, 32 bytes a chunk: type (4 letters), grid (4 bytes), offset, size and checksum (8 each)
//               chunks, in the order of the table, one right after the other, to the end
//
// Numbers are little endian, and checksums are XXH64. No byte is without one. What a chunk holds is said
// where it is written: core/baked/region_format.h, core/cluster_file/cluster_format.h,
// core/cluster_windows/window_file.cpp, core/mesh_file/mesh_bytes.cpp, core/streamed_mesh/mesh_records.cpp.
// Offsets inside a chunk count from where it begins, so that chunks can be copied from file to file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/open_file.h"
#include "core/base/result.h"

namespace oro {

// A chunk's type is four letters; this gives their number, with the first letter in the lowest byte.
constexpr std::uint32_t four_letters(const char (&letters)[5]) {
    std::uint32_t number = 0;
    for (std::size_t i = 4; i-- > 0;) number = number << 8U | static_cast<unsigned char>(letters[i]);
    return number;
}
enum class ChunkType : std::uint32_t {
    outline = four_letters("GRID"),         // of a grid: its numbers
    description = four_letters("DESC"),     // of a grid: text
    undulation = four_letters("GEOI"),      // of a grid: the geoid's undulation at nodes
    net = four_letters("NETP"),             // of a grid whose posts lie in a CRS of their own: where they lie
    pages = four_letters("PAGE"),           // of a grid: the bounds of each page, and where its heights are
    heights = four_letters("HGTS"),         // of a grid: heights and errors, page by page
    graph = four_letters("CLUS"),           // of clusters: the graph's numbers and levels
    groups = four_letters("GRPS"),          // of clusters: the bounds of each group, and where its mesh is
    meshes = four_letters("MESH"),          // of clusters: members and triangles, group by group
    window = four_letters("WIDX"),          // of clusters that are being built: what a window has
    blocks = four_letters("WBLK"),          // of clusters that are being built: what its groups made
    mesh_facts = four_letters("MFCT"),      // of a mesh, by its number: what is known of it
    mesh_triangles = four_letters("MTRI"),  // of a mesh, by its number: its triangles and their graph
    mesh_records = four_letters("MREC"),    // of a mesh, by its number: its graph without triangles
    mesh_payloads = four_letters("MPAY")    // of a mesh, by its number: triangles, group by group
};

// A chunk is one line of the table.
struct Chunk {
    ChunkType type{};
    // The number of the grid that it belongs to. Grids come in the order of the table, and are numbered as
    // they win where several have ground: number 0 wins over all (RegionGrid::rank).
    std::uint32_t grid{};
    std::uint64_t offset{};    // in the file
    std::uint64_t bytes{};     // its size
    std::uint64_t checksum{};  // of all its bytes
};

// A chunk table is what the first bytes of a container say.
struct ChunkTable {
    static constexpr std::array<unsigned char, 8> magic = {0x89, 'O', 'R', 'O', '1', '\r', '\n', 0x1a};
    static constexpr std::uint32_t version = 1;
    static constexpr std::size_t header_bytes = 32, entry_bytes = 32;
    static constexpr std::uint32_t most_chunks = 1U << 16U;

    std::uint64_t file_bytes{};  // 0: unfinished
    std::vector<Chunk> chunks;

    // This is the size of the header and the table.
    [[nodiscard]] std::uint64_t bytes() const { return header_bytes + entry_bytes * chunks.size(); }
    // It puts the chunks one after another, and gives the byte at which the last one ends.
    std::uint64_t place();
    [[nodiscard]] std::vector<std::byte> to_bytes() const;
};
// This reads the table of a file, which may be unfinished. The checksum is right then; whether the table fits
// the file is not asked. Errors: no container, one of another version, cut off within its table, damage.
[[nodiscard]] Result<ChunkTable> read_chunk_table(const OpenFile& file);

// This is a finished container that is read. Opening reads the table and holds it against the file's size;
// chunks are read when they are asked for, by any number of threads at once. Errors name the file and the
// byte.
class Container {
  public:
    // Errors: those of read_chunk_table; unfinished, cut off, longer than it says; chunks that are not one
    // after another, of an unknown type, or twice.
    static Result<std::shared_ptr<const Container>> open(const std::string& path);

    [[nodiscard]] const OpenFile& file() const { return file_; }
    [[nodiscard]] const std::string& path() const { return file_.path(); }
    [[nodiscard]] const ChunkTable& table() const { return table_; }
    // This gives the chunk of that type and grid, owned by the container; null where there is none. It costs
    // a binary search.
    [[nodiscard]] const Chunk* find(ChunkType type, std::uint32_t grid) const;
    // This gives the chunk of that type and grid. Errors: there is none.
    [[nodiscard]] Result<Chunk> chunk(ChunkType type, std::uint32_t grid) const;
    // This reads all of a chunk and holds it against its checksum. most_bytes: no such chunk of this grid has
    // more, by what is known of it: a table may state any size, and a file with holes has it at no cost.
    // Errors: it has more, and no memory is taken; damage; the file was changed meanwhile.
    [[nodiscard]] Result<std::vector<std::byte>> read(const Chunk& chunk, std::uint64_t most_bytes) const;
    // This reads a chunk and holds it against its checksum.
    [[nodiscard]] Result<void> check(const Chunk& chunk) const;
    // A file that others write into may hold whole parts of another one by now, whose checksums are right.
    // This reads the header once more. Errors: it is another.
    [[nodiscard]] Result<void> check_unchanged() const;

  private:
    using Header = std::array<std::byte, ChunkTable::header_bytes>;
    Container(OpenFile file, ChunkTable table, std::vector<std::uint32_t> by_key, const Header& header);
    OpenFile file_;
    ChunkTable table_;
    std::vector<std::uint32_t> by_key_;  // numbers of the chunks in the order of their grids and types
    Header header_;                      // as it was when the file was opened
};

// This says how a file begins, as far as it goes: one of few bytes is what it may become.
enum class FileBeginning {
    foreign,   // as no file that a bake writes
    older,     // as a file that an older Orograph baked
    container  // as a container
};
// This reads the first bytes of a file. Errors: those of reading.
[[nodiscard]] Result<FileBeginning> file_beginning(const OpenFile& file);
// This is true for a plain file that begins as a baked one does, of whatever version and in whatever state.
[[nodiscard]] bool looks_baked(const std::string& path);

// A part is a file whose chunks go into a larger container, as those of the grid of that number.
struct ContainerPart {
    std::string path;
    std::uint32_t grid{};
};
// This writes one container with the chunks of all parts, in their order; `write` appends bytes to it.
// Errors: those of reading the parts and of `write`; more chunks than a table holds.
Result<void> join_containers(std::span<const ContainerPart> parts,
                             const std::function<Result<void>(std::span<const std::byte>)>& write);

}  // namespace oro
