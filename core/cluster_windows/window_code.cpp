#include "core/cluster_windows/window_file.h"

#include <zstd.h>
#include <zstd_errors.h>

#include <array>
#include <bit>
#include <new>

#include "core/base/zstd_contexts.h"

// Of each cluster: how many triangles it has; for each corner how many vertices the cluster has had since its
// own was new; for each new vertex how far it is from the one before, down and right. All of it by zstd.
namespace oro {
namespace {

constexpr int zstd_level = 1;
// Of a group: no window keeps more.
constexpr std::size_t most_bytes = std::size_t{16} * most_group_triangles;

// Numbers of a cluster's vertices as they come, found by vertex: a table at most 3/4 full.
class Newcomers {
  public:
    void clear() {
        slots_.fill({});
        count_ = 0;
    }
    // How many there have been since this one; 0: it is new.
    unsigned since(VertexNumber vertex) {
        std::size_t i = (vertex * 2654435761U) >> 23U;
        while (slots_[i].number != 0 && slots_[i].vertex != vertex) i = (i + 1) % slots_.size();
        if (slots_[i].number != 0) return count_ - slots_[i].number + 1;
        slots_[i] = {vertex, ++count_};
        return 0;
    }

  private:
    struct Slot {
        VertexNumber vertex;
        unsigned number;  // from 1; 0: free
    };
    std::array<Slot, 512> slots_{};
    unsigned count_{};
};
static_assert(3 * most_cluster_triangles <= 384);

// Small ones in one byte, of either sign.
void put_step(std::vector<std::byte>& bytes, std::int32_t step) {
    auto rest = (static_cast<std::uint32_t>(step) << 1U) ^ (step < 0 ? ~0U : 0U);
    for (; rest >= 128; rest >>= 7U) bytes.push_back(static_cast<std::byte>((rest & 127U) | 128U));
    bytes.push_back(static_cast<std::byte>(rest));
}

class Reader {
  public:
    explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}
    unsigned byte() {
        if (at_ == bytes_.size()) {
            wrong_ = true;
            return 0;
        }
        return static_cast<unsigned>(bytes_[at_++]);
    }
    std::int32_t step() {
        std::uint32_t folded = 0;
        for (unsigned shift = 0; shift < 35; shift += 7) {
            const unsigned part = byte();
            folded |= (part & 127U) << shift;
            if (part < 128) return static_cast<std::int32_t>((folded >> 1U) ^ (0U - (folded & 1U)));
        }
        wrong_ = true;
        return 0;
    }
    [[nodiscard]] bool is_at_end() const { return !wrong_ && at_ == bytes_.size(); }
    [[nodiscard]] bool is_wrong() const { return wrong_; }

  private:
    std::span<const std::byte> bytes_;
    std::size_t at_{};
    bool wrong_{};
};

bool unpack_cluster(Reader& reader, const PostCounts& posts, SurfaceVertex& last, GroupPart& part) {
    const unsigned triangles = reader.byte();
    if (triangles < 1 || triangles > most_cluster_triangles) return false;
    std::array<VertexNumber, most_cluster_vertices> vertices;
    unsigned count = 0;
    part.made.push_back(
        {static_cast<std::uint32_t>(part.triangles.size()), triangles, 0, no_group, no_group});
    for (unsigned i = 0; i < triangles; ++i) {
        VertexTriangle& triangle = part.triangles.emplace_back();
        for (VertexNumber& vertex : triangle) {
            const unsigned since = reader.byte();
            if (since > count) return false;
            if (since > 0) {
                vertex = vertices[count - since];
                continue;
            }
            const std::int64_t row = std::int64_t{last.row} + reader.step(),
                               column = std::int64_t{last.column} + reader.step();
            if (reader.is_wrong() || count == vertices.size() || row < 0 || row >= posts.rows || column < 0 ||
                column >= posts.columns)
                return false;
            last = {static_cast<std::int32_t>(row), static_cast<std::int32_t>(column), 0};
            vertex = vertices[count++] = posts.number(last.row, last.column);
        }
    }
    part.made.back().vertices = count;
    return true;
}

}  // namespace

std::vector<std::byte> pack_made(const GroupPart& part, const PostCounts& posts) {
    std::vector<std::byte> unpacked;
    unpacked.reserve(6 * part.triangles.size());
    Newcomers newcomers;
    SurfaceVertex last{};
    for (const Cluster& cluster : part.made) {
        newcomers.clear();
        unpacked.push_back(static_cast<std::byte>(cluster.triangles));
        for (const VertexTriangle& triangle :
             std::span(part.triangles).subspan(cluster.first_triangle, cluster.triangles)) {
            for (const VertexNumber vertex : triangle) {
                const unsigned since = newcomers.since(vertex);
                unpacked.push_back(static_cast<std::byte>(since));
                if (since > 0) continue;
                const SurfaceVertex place = posts.place(vertex);
                put_step(unpacked, place.row - last.row);
                put_step(unpacked, place.column - last.column);
                last = place;
            }
        }
    }
    std::vector<std::byte> packed(ZSTD_compressBound(unpacked.size()));
    const ZstdPacker packer;
    const std::size_t bytes = ZSTD_compressCCtx(packer.get(), packed.data(), packed.size(), unpacked.data(),
                                                unpacked.size(), zstd_level);
    if (ZSTD_isError(bytes) != 0) throw std::bad_alloc();  // there is room, so nothing else is lacking
    packed.resize(bytes);
    packed.shrink_to_fit();
    return packed;
}

bool unpack_made(std::span<const std::byte> bytes, const PostCounts& posts, GroupPart& part) {
    part.made.clear();
    part.triangles.clear();
    const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
    if (size > most_bytes) return false;  // or is not told
    std::vector<std::byte> unpacked(static_cast<std::size_t>(size));
    const ZstdUnpacker unpacker;
    const std::size_t found =
        ZSTD_decompressDCtx(unpacker.get(), unpacked.data(), unpacked.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(found) != 0 && ZSTD_getErrorCode(found) == ZSTD_error_memory_allocation)
        throw std::bad_alloc();
    if (found != unpacked.size()) return false;
    Reader reader(unpacked);
    SurfaceVertex last{};
    for (std::uint32_t i = 0; i < part.group.made; ++i)
        if (!unpack_cluster(reader, posts, last, part)) return false;
    return reader.is_at_end();
}

}  // namespace oro
