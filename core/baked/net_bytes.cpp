#include "core/baked/net_bytes.h"

#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <new>
#include <string>

#include "core/base/little_endian.h"

namespace oro::region_format {
namespace {

// Shows all numbers of the front, in their order.
template <class Visit, class Stored>
void exchange_front(Visit& visit, Stored& stored) {
    for (auto* axis : {&stored.down, &stored.across}) {
        auto& [first, posts, patch_posts, patches] = *axis;
        visit(first);
        visit(posts);
        visit(patch_posts);
        visit(patches);
    }
    visit(stored.error_m);
}

Error wrong_net(const std::string& what) {
    return {ErrorKind::failed, "grid of posts", what};
}

constexpr int patch_posts_max = 64;  // no net that is fit has larger patches with corrections

struct Table {
    std::size_t rows, columns;
    [[nodiscard]] std::size_t posts() const { return rows * columns; }
};
Table table_of(const LatticeGeoreference::Stored& net) {
    return {static_cast<std::size_t>(net.down.patch_posts) + 1,
            static_cast<std::size_t>(net.across.patch_posts) + 1};
}

// The plane through the neighbours before a post: those of `axis`.
int foretold(const std::vector<std::array<std::int16_t, 3>>& posts, const Table& table, std::size_t post,
             std::size_t axis) {
    const bool any_north = post >= table.columns, any_west = post % table.columns > 0;
    const int north = any_north ? posts[post - table.columns][axis] : 0;
    const int west = any_west ? posts[post - 1][axis] : 0;
    const int between = any_north && any_west ? posts[post - table.columns - 1][axis] : 0;
    return north + west - between;
}

// visit(post, axis, number) for all numbers of the frame, in their order.
template <class Corrections, class Visit>
void for_each_number(Corrections& corrections, const Table& table, const Visit& visit) {
    std::size_t number = 0;
    for (auto& correction : corrections)
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t post = 0; post < table.posts(); ++post)
                visit(correction.posts, post, axis, number++);
}

// The corrections of a net: how many there are (4 bytes); the number of the patch of each (4 bytes); a zstd
// frame. It holds what each step differs from the plane through its neighbours before it (west + north -
// north-west), as 0, -1, 1, -2, ...: first the low bytes of all, then the high ones; correction by
// correction, x, y and z of each, row by row.
std::vector<std::byte> pack_corrections(const LatticeGeoreference::Stored& net) {
    const Table table = table_of(net);
    assert(net.down.patch_posts <= patch_posts_max && net.across.patch_posts <= patch_posts_max);
    const std::size_t numbers = net.corrections.size() * table.posts() * 3;
    std::vector<std::byte> planes(numbers * 2);
    for_each_number(
        net.corrections, table,
        [&](const auto& posts, std::size_t post, std::size_t axis, std::size_t number) {
            const unsigned off =
                static_cast<std::uint16_t>(posts[post][axis] - foretold(posts, table, post, axis));
            const auto folded = static_cast<std::uint16_t>((off << 1U) ^ (off >> 15U ? 0xffffU : 0U));
            planes[number] = static_cast<std::byte>(folded & 0xffU);
            planes[numbers + number] = static_cast<std::byte>(folded >> 8U);
        });
    const std::size_t front = 4 + 4 * net.corrections.size();
    std::vector<std::byte> bytes(front + ZSTD_compressBound(planes.size()));
    to_little_endian(static_cast<std::uint32_t>(net.corrections.size()), bytes.data());
    for (std::size_t i = 0; i < net.corrections.size(); ++i)
        to_little_endian(net.corrections[i].patch, &bytes[4 + 4 * i]);
    constexpr int level = 3;
    const std::size_t packed =
        ZSTD_compress(&bytes[front], bytes.size() - front, planes.data(), planes.size(), level);
    if (ZSTD_isError(packed) != 0) throw std::bad_alloc();  // there is room, so nothing else is lacking
    bytes.resize(front + packed);
    return bytes;
}

// `net` has all but its corrections, and its numbers may lie.
Result<void> unpack_corrections(std::span<const std::byte> bytes, LatticeGeoreference::Stored& net) {
    const auto fits = [](const LatticeGeoreference::Stored::Axis& axis) {
        return axis.patch_posts >= 2 && axis.patch_posts <= patch_posts_max;
    };
    if (!fits(net.down) || !fits(net.across))
        return wrong_net("its corrections are of patches that have none");
    const std::size_t count = bytes.size() < 4 ? 0 : from_little_endian<std::uint32_t>(bytes.data());
    const std::size_t patches = net.coefficients.size() / LatticeGeoreference::coefficients_a_patch;
    const std::size_t front = 4 + 4 * count;
    if (count == 0 || count > patches || front > bytes.size())
        return wrong_net("its corrections are " + std::to_string(count) + " in " +
                         std::to_string(bytes.size()) + " bytes, of " + std::to_string(patches) + " patches");
    const Table table = table_of(net);
    const std::size_t numbers = count * table.posts() * 3;
    // Before memory is taken for it.
    if (ZSTD_getFrameContentSize(bytes.data() + front, bytes.size() - front) != numbers * 2)
        return wrong_net("its corrections cannot be unpacked: they are no frame of " +
                         std::to_string(numbers * 2) + " bytes");
    std::vector<std::byte> planes(numbers * 2);
    const std::size_t found =
        ZSTD_decompress(planes.data(), planes.size(), bytes.data() + front, bytes.size() - front);
    if (ZSTD_isError(found) != 0) {
        if (ZSTD_getErrorCode(found) == ZSTD_error_memory_allocation) throw std::bad_alloc();
        return wrong_net("its corrections cannot be unpacked: " + std::string(ZSTD_getErrorName(found)));
    }
    net.corrections.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        net.corrections[i].patch = from_little_endian<std::int32_t>(&bytes[4 + 4 * i]);
        net.corrections[i].posts.resize(table.posts());
    }
    for_each_number(
        net.corrections, table, [&](auto& posts, std::size_t post, std::size_t axis, std::size_t number) {
            const auto folded =
                static_cast<std::uint16_t>(static_cast<unsigned>(planes[number]) |
                                           static_cast<unsigned>(planes[numbers + number]) << 8U);
            const auto off = static_cast<std::uint16_t>((folded >> 1U) ^ (folded & 1U ? 0xffffU : 0U));
            posts[post][axis] = static_cast<std::int16_t>(
                static_cast<std::uint16_t>(foretold(posts, table, post, axis) + off));
        });
    return {};
}

// The front of a net of rows x columns posts.
Result<void> read_front(NumberReader& get, int rows, int columns, LatticeGeoreference::Stored& stored) {
    if (get.rest().size() < net_front_bytes)
        return wrong_net("it has " + std::to_string(get.rest().size()) + " bytes");
    exchange_front(get, stored);
    if (stored.down.posts == rows && stored.across.posts == columns) return {};
    return wrong_net("it has " + std::to_string(stored.down.posts) + " x " +
                     std::to_string(stored.across.posts) + " posts, expected " + std::to_string(rows) +
                     " x " + std::to_string(columns));
}

}  // namespace

Result<std::uint64_t> most_net_bytes(std::span<const std::byte> front, int rows, int columns) {
    LatticeGeoreference::Stored stored;
    NumberReader get(front);
    ORO_CHECK(read_front(get, rows, columns, stored));
    if (!stored.down.fits() || !stored.across.fits())
        return wrong_net("its posts and patches do not fit each other");
    const std::uint64_t patches =
        static_cast<std::uint64_t>(stored.down.patches) * static_cast<std::uint64_t>(stored.across.patches);
    constexpr std::uint64_t most_patches = std::numeric_limits<std::int32_t>::max();
    if (patches > most_patches)
        return wrong_net("it has " + std::to_string(patches) + " patches, expected at most " +
                         std::to_string(most_patches));
    const std::uint64_t without_corrections = net_front_bytes + patches * patch_bytes;
    if (std::max(stored.down.patch_posts, stored.across.patch_posts) > patch_posts_max)
        return without_corrections;
    const std::uint64_t planes = patches * table_of(stored).posts() * 6;
    return without_corrections + 4 + 4 * patches + ZSTD_compressBound(planes);
}

std::vector<std::byte> net_to_bytes(const LatticeGeoreference& net) {
    const LatticeGeoreference::Stored stored = net.stored();
    NumberWriter put;
    exchange_front(put, stored);
    for (const glm::dvec3& coefficient : stored.coefficients)
        for (int axis = 0; axis < 3; ++axis) put(coefficient[axis]);
    if (!stored.corrections.empty()) {
        const std::vector<std::byte> corrections = pack_corrections(stored);
        put.bytes.insert(put.bytes.end(), corrections.begin(), corrections.end());
    }
    return std::move(put.bytes);
}

Result<std::shared_ptr<const LatticeGeoreference>> net_from_bytes(std::span<const std::byte> bytes, int rows,
                                                                  int columns) {
    LatticeGeoreference::Stored stored;
    NumberReader get(bytes);
    ORO_CHECK(read_front(get, rows, columns, stored));
    // As many patches as it says that it has; what is left then are corrections.
    const std::uint64_t found = (bytes.size() - net_front_bytes) / patch_bytes;
    const auto said = [](const LatticeGeoreference::Stored::Axis& axis) {
        return static_cast<std::uint64_t>(std::max(axis.patches, 0));
    };
    const std::uint64_t patches = std::min(said(stored.down) * said(stored.across), found);
    stored.coefficients.resize(patches * LatticeGeoreference::coefficients_a_patch);
    for (glm::dvec3& coefficient : stored.coefficients)
        for (int axis = 0; axis < 3; ++axis) get(coefficient[axis]);
    if (!get.rest().empty()) ORO_CHECK(unpack_corrections(get.rest(), stored));
    return LatticeGeoreference::from(stored);
}

}  // namespace oro::region_format
