#include "core/cluster_windows/window_file.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/checksum.h"
#include "core/base/file_target.h"
#include "core/base/little_endian.h"
#include "core/cluster_windows/window_code.h"

namespace oro {
namespace {

// Header: magic, size of the index, its checksum, their own. Then blocks, and the index.
constexpr std::array<unsigned char, 8> magic = {0x89, 'O', 'R', 'W', '\r', '\n', 0x1a, 4};
constexpr std::size_t header_bytes = 32;
constexpr std::size_t tile_bytes = 16;
constexpr std::uint64_t most_index_bytes = std::uint64_t{1} << 32U;

// Numbers one after another, out and in.
class Putter {
  public:
    static constexpr bool writes = true;
    template <class T>
    void operator()(const T& number) {
        const std::size_t at = bytes.size();
        bytes.resize(at + sizeof(T));
        to_little_endian(number, &bytes[at]);
    }
    std::vector<std::byte> bytes;
};
class Getter {
  public:
    static constexpr bool writes = false;
    explicit Getter(std::span<const std::byte> bytes) : bytes_(bytes) {}
    template <class T>
    void operator()(T& number) {
        if (bytes_.size() < sizeof(T)) {
            ended_ = true;
            number = T{};
            return;
        }
        number = from_little_endian<T>(bytes_.data());
        bytes_ = bytes_.subspan(sizeof(T));
    }
    // How many there are of something of so many bytes; none more than there is room for.
    [[nodiscard]] bool has(std::uint64_t count, std::size_t each) const {
        return count <= bytes_.size() / each;
    }
    [[nodiscard]] bool is_wrong() const { return ended_ || !bytes_.empty(); }
    void fail() { ended_ = true; }

  private:
    std::span<const std::byte> bytes_;
    bool ended_{};
};

template <class Visit, class Each>
void visit_all(Visit& visit, std::vector<Each>& all, std::size_t bytes, const auto& visit_one) {
    std::uint64_t count = all.size();
    visit(count);
    if constexpr (!Visit::writes) {
        if (!visit.has(count, bytes)) return visit.fail();
        all.resize(static_cast<std::size_t>(count));
    }
    for (Each& one : all) visit_one(one);
}

template <class Visit>
void visit_index(Visit& visit, WindowIndex& index) {
    visit(index.plan);
    visit(index.posts.rows);
    visit(index.posts.columns);
    visit(index.first_row);
    visit(index.first_column);
    const auto tile = [&](GroupTile& of) {
        visit(of.row);
        visit(of.column);
    };
    visit_all(visit, index.leaves, 8 + tile_bytes, [&](WindowLeaf& leaf) {
        visit(leaf.row);
        visit(leaf.column);
        tile(leaf.user);
    });
    visit_all(visit, index.groups, 124, [&](WindowGroup& group) {
        visit(group.level);
        tile(group.tile);
        visit(group.made);
        visit(group.triangles_in);
        visit(group.triangles_out);
        for (double* const number :
             {&group.error_m, &group.centre.m.x, &group.centre.m.y, &group.centre.m.z, &group.radius_m})
            visit(*number);
        for (std::int64_t* const place : {&group.extent.first_row, &group.extent.last_row,
                                          &group.extent.first_column, &group.extent.last_column})
            visit(*place);
        visit(group.offset);
        visit(group.bytes);
        visit(group.checksum);
    });
    visit_all(visit, index.locks, 16, [&](WindowLocks& locks) {
        visit(locks.locked);
        visit(locks.twice);
    });
}

}  // namespace

Result<bool> begins_as_window(const OpenFile& file) {
    ORO_TRY(const std::uint64_t size, file.size());
    std::array<std::byte, magic.size()> found{};
    const auto there =
        std::span(found).first(static_cast<std::size_t>(std::min<std::uint64_t>(size, found.size())));
    ORO_CHECK(file.read(0, there));
    return std::equal(there.begin(), there.end(), std::as_bytes(std::span(magic)).begin());
}

Result<WindowFile> WindowFile::open(const std::string& path) {
    ORO_TRY(OpenFile file, OpenFile::open(path, OpenFile::Use::read));
    ORO_TRY(const std::uint64_t size, file.size());
    std::array<std::byte, header_bytes> header;
    const auto damaged = [&](const char* what) { return Error{ErrorKind::failed, path, what}; };
    if (size < header.size()) return damaged("is no window of clusters");
    ORO_CHECK(file.read(0, header));
    const auto begins = std::as_bytes(std::span(magic));
    if (!std::equal(begins.begin(), begins.end(), header.begin()) ||
        xxh64(std::span<const std::byte>(header).first(24)) != from_little_endian<std::uint64_t>(&header[24]))
        return damaged("is no window of clusters");
    const auto bytes = from_little_endian<std::uint64_t>(&header[8]);
    if (bytes > most_index_bytes || bytes > size - header_bytes) return damaged("is cut off");
    std::vector<std::byte> stored(static_cast<std::size_t>(bytes));
    ORO_CHECK(file.read(size - bytes, stored));
    if (xxh64(stored) != from_little_endian<std::uint64_t>(&header[16]))
        return damaged("has a damaged index");
    WindowIndex index;
    Getter get(stored);
    visit_index(get, index);
    if (get.is_wrong()) return damaged("has a damaged index");
    return WindowFile(std::move(file), std::move(index));
}

std::size_t WindowFile::users_bytes(const WindowGroup& group) const {
    return group.level < index_.locks.size() ? group.made * tile_bytes : 0;
}

// Read before the checksum is asked for: read() does.
Result<void> WindowFile::read_users(const WindowGroup& group, std::vector<GroupTile>& users) const {
    std::vector<std::byte> stored(std::min<std::size_t>(group.bytes, users_bytes(group)));
    ORO_CHECK(file_.read(group.offset, stored));
    Getter get(stored);
    users.resize(stored.size() / tile_bytes);
    for (GroupTile& user : users) {
        get(user.row);
        get(user.column);
    }
    if (get.is_wrong()) return file_.damaged(group.offset, "a group of a window is cut off");
    return {};
}

Result<void> WindowFile::read(const WindowGroup& group, const PostCounts& posts, GroupPart& part) const {
    std::vector<std::byte> block(group.bytes);
    ORO_CHECK(file_.read(group.offset, block));
    const auto damaged = [&](const std::string& what) { return file_.damaged(group.offset, what); };
    if (xxh64(block) != group.checksum) return damaged("a group of a window has another checksum");
    const std::size_t first = users_bytes(group);
    if (first > block.size()) return damaged("a group of a window is cut off");
    part.group = {group.level, 0, 0, 0, group.made, group.error_m, group.centre, group.radius_m, true};
    part.members.clear();
    if (!unpack_made(std::span<const std::byte>(block).subspan(first), index_.posts, part))
        return damaged("a group of a window is no clusters");
    for (VertexTriangle& triangle : part.triangles) {
        for (VertexNumber& vertex : triangle) {
            const SurfaceVertex place = index_.posts.place(vertex);
            vertex = posts.number(place.row + index_.first_row, place.column + index_.first_column);
        }
    }
    return {};
}

std::vector<std::byte> window_block(const GroupPart& part, std::span<const GroupTile> users,
                                    const PostCounts& posts) {
    Putter put;
    for (const GroupTile& user : users) {
        put(user.row);
        put(user.column);
    }
    const std::vector<std::byte> made = pack_made(part, posts);
    put.bytes.insert(put.bytes.end(), made.begin(), made.end());
    return std::move(put.bytes);
}

Result<void> write_window(const std::string& path, WindowIndex index,
                          std::span<const std::vector<std::byte>> blocks) {
    ORO_TRY(OpenFile file, OpenFile::open(path + ".partial", OpenFile::Use::write));
    ORO_CHECK(file.resize(0));
    ORO_CHECK(file.write(0, std::as_bytes(std::span(magic))));
    std::uint64_t at = header_bytes;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        WindowGroup& group = index.groups[i];
        group.offset = at;
        group.bytes = static_cast<std::uint32_t>(blocks[i].size());
        group.checksum = xxh64(blocks[i]);
        ORO_CHECK(file.write(at, blocks[i]));
        at += blocks[i].size();
    }
    Putter put;
    visit_index(put, index);
    ORO_CHECK(file.write(at, put.bytes));
    std::vector<std::byte> header(header_bytes);
    std::ranges::copy(std::as_bytes(std::span(magic)), header.begin());
    to_little_endian(std::uint64_t{put.bytes.size()}, &header[8]);
    to_little_endian(xxh64(put.bytes), &header[16]);
    to_little_endian(xxh64(std::span<const std::byte>(header).first(24)), &header[24]);
    ORO_CHECK(file.write(0, header));
    ORO_CHECK(file.sync());
    if (const int why = take_file_name(file.path(), path, true); why != 0)
        return Error{ErrorKind::failed, path, "cannot be written: " + system_reason(why)};
    return {};
}

}  // namespace oro
