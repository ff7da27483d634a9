#include "core/cluster_windows/window_file.h"

#include <algorithm>
#include <utility>

#include "core/base/checksum.h"
#include "core/base/file_target.h"
#include "core/base/little_endian.h"

namespace oro {
namespace {

// A container (core/base/container.h) of two chunks: the groups' blocks one after another, and the index.
constexpr std::size_t tile_bytes = 16;

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

Result<WindowFile> WindowFile::open(const std::string& path) {
    ORO_TRY(std::shared_ptr<const Container> container, Container::open(path));
    ORO_TRY(const Chunk chunk, container->chunk(ChunkType::window, 0));
    ORO_TRY(const Chunk blocks, container->chunk(ChunkType::blocks, 0));
    ORO_TRY(const std::vector<std::byte> stored, container->read(chunk, chunk.bytes));
    WindowIndex index;
    NumberReader get(stored);
    visit_index(get, index);
    if (get.is_wrong())
        return container->file().damaged(chunk.offset, "the index of a window has other bytes than it says");
    for (const WindowGroup& group : index.groups)
        if (group.offset > blocks.bytes || group.bytes > blocks.bytes - group.offset)
            return container->file().damaged(
                chunk.offset, "the index of a window has a group of " + std::to_string(group.bytes) +
                                  " bytes from byte " + std::to_string(group.offset) +
                                  " of its blocks, which have " + std::to_string(blocks.bytes));
    return WindowFile(std::move(container), std::move(index), blocks.offset);
}

std::size_t WindowFile::users_bytes(const WindowGroup& group) const {
    return group.level < index_.locks.size() ? group.made * tile_bytes : 0;
}

// Read before the checksum is asked for: read() does.
Result<void> WindowFile::read_users(const WindowGroup& group, std::vector<GroupTile>& users) const {
    std::vector<std::byte> stored(std::min<std::size_t>(group.bytes, users_bytes(group)));
    ORO_CHECK(container_->file().read(blocks_ + group.offset, stored));
    NumberReader get(stored);
    users.resize(stored.size() / tile_bytes);
    for (GroupTile& user : users) {
        get(user.row);
        get(user.column);
    }
    if (get.is_wrong())
        return container_->file().damaged(blocks_ + group.offset, "a group of a window is cut off");
    return {};
}

Result<void> WindowFile::read(const WindowGroup& group, const PostCounts& posts, GroupPart& part) const {
    std::vector<std::byte> block(group.bytes);
    ORO_CHECK(container_->file().read(blocks_ + group.offset, block));
    const auto damaged = [&](const std::string& what) {
        return container_->file().damaged(blocks_ + group.offset, what);
    };
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
    NumberWriter put;
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
    std::uint64_t at = 0;
    RunningChecksum sum;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        WindowGroup& group = index.groups[i];
        group.offset = at;
        group.bytes = static_cast<std::uint32_t>(blocks[i].size());
        group.checksum = xxh64(blocks[i]);
        sum.add(blocks[i]);
        at += blocks[i].size();
    }
    NumberWriter put;
    visit_index(put, index);
    ChunkTable table{0,
                     {{ChunkType::blocks, 0, 0, at, sum.sum()},
                      {ChunkType::window, 0, 0, put.bytes.size(), xxh64(put.bytes)}}};
    table.file_bytes = table.place();
    ORO_CHECK(file.resize(0));
    ORO_CHECK(file.write(0, table.to_bytes()));
    for (std::size_t i = 0; i < blocks.size(); ++i)
        ORO_CHECK(file.write(table.chunks[0].offset + index.groups[i].offset, blocks[i]));
    ORO_CHECK(file.write(table.chunks[1].offset, put.bytes));
    ORO_CHECK(file.sync());
    return give_name(file.path(), path, true);
}

}  // namespace oro
