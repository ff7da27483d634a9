#include "core/baked/page_compression.h"

#include <zstd.h>
#include <zstd_errors.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <type_traits>
#include <vector>

#include "core/base/little_endian.h"
#include "core/base/zstd_contexts.h"
#include "core/terrain/post_grid.h"

// A payload is one byte that says how the heights are kept, and a zstd frame that holds, in this order: one
// bit a post, set where it is void (when the byte says so); the heights' differences, all lowest bytes first;
// the node numbers in the same way.
namespace oro {
namespace {

enum Kind : unsigned { all_void = 0, whole_metres = 1, floats = 2, with_voids = 4 };

constexpr std::size_t posts = gpu::page_heights;
constexpr std::size_t side = gpu::height_stride;
constexpr std::size_t void_bytes = (posts + 7) / 8;
constexpr std::size_t node_numbers = 2 * std::size_t{gpu::meshlets_per_page};
// On SRTM3 levels 1 and 3 differ by 0.3 % of the size: what is left after the prediction has few repetitions.
constexpr int zstd_level = 1;

constexpr std::size_t unpacked_bytes(unsigned kind) {
    std::size_t bytes = node_numbers * sizeof(float);
    if (kind & with_voids) bytes += void_bytes;
    if (kind & whole_metres) bytes += posts * 2;
    if (kind & floats) bytes += posts * 4;
    return bytes;
}
static_assert(1 + ZSTD_COMPRESSBOUND(unpacked_bytes(floats | with_voids)) <= largest_payload_bytes);

constexpr bool known(unsigned kind) {
    return kind == all_void || (kind & ~unsigned{with_voids}) == whole_metres ||
           (kind & ~unsigned{with_voids}) == floats;
}

// A float's bits as an unsigned number that grows with it; -0 comes just before 0.
constexpr std::uint32_t top_bit = 0x80000000U;
std::uint32_t ordered(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    return bits & top_bit ? ~bits : bits | top_bit;
}
float unordered(std::uint32_t number) {
    return std::bit_cast<float>(number & top_bit ? number & ~top_bit : ~number);
}

// Differences near 0 of either sign as small unsigned numbers.
template <class U>
U folded(U difference) {
    constexpr int last = std::numeric_limits<U>::digits - 1;
    return static_cast<U>((difference << 1) ^ (difference >> last ? std::numeric_limits<U>::max() : 0));
}
template <class U>
U unfolded(U number) {
    return static_cast<U>((number >> 1) ^ (number & 1U ? std::numeric_limits<U>::max() : 0));
}

template <class U>
void write_planes(const U* numbers, std::size_t count, std::byte* to) {
    for (std::size_t plane = 0; plane < sizeof(U); ++plane) {
        for (std::size_t i = 0; i < count; ++i)
            to[plane * count + i] = static_cast<std::byte>((numbers[i] >> (8 * plane)) & 0xffU);
    }
}
template <class U>
void read_planes(const std::byte* from, std::size_t count, U* numbers) {
    std::fill_n(numbers, count, U{0});
    for (std::size_t plane = 0; plane < sizeof(U); ++plane) {
        for (std::size_t i = 0; i < count; ++i)
            numbers[i] = static_cast<U>(numbers[i] | static_cast<U>(from[plane * count + i]) << (8 * plane));
    }
}

// A height as the number whose differences are kept, and back.
template <class U>
U number_of(float H_m) {
    if constexpr (sizeof(U) == 2) {
        return static_cast<U>(static_cast<std::int32_t>(H_m));
    } else {
        return ordered(H_m);
    }
}
template <class U>
float height_of(U number) {
    if constexpr (sizeof(U) == 2) {
        return static_cast<float>(static_cast<std::int16_t>(number));
    } else {
        return unordered(number);
    }
}

// All arithmetic is modulo the range of U, so that no difference is too large. A void counts as what its
// neighbours let expect.
template <class U>
void write_heights(const PagePayload& payload, std::byte* to) {
    constexpr std::size_t stride = side + 1;  // a row and a column of zeros before the first
    std::vector<U> numbers(stride * stride, 0);
    std::vector<U> differences(posts);
    for (std::size_t row = 0; row < side; ++row) {
        const U* const above = &numbers[row * stride + 1];
        U* const here = &numbers[(row + 1) * stride + 1];
        for (std::size_t column = 0; column < side; ++column) {
            const std::size_t i = row * side + column;
            const auto expected =
                static_cast<U>(*(here + column - 1) + above[column] - *(above + column - 1));
            const float H_m = payload.H_m[i];
            here[column] = is_void(H_m) ? expected : number_of<U>(H_m);
            differences[i] = folded(static_cast<U>(here[column] - expected));
        }
    }
    write_planes(differences.data(), posts, to);
}

template <class U>
void read_heights(const std::byte* from, PagePayload& payload) {
    std::vector<U> differences(posts);
    read_planes(from, posts, differences.data());
    std::array<U, side> above{};
    for (std::size_t row = 0; row < side; ++row) {
        U along{0};
        std::array<U, side> slopes;
        for (std::size_t column = 0; column < side; ++column) {
            along = static_cast<U>(along + unfolded(differences[row * side + column]));
            slopes[column] = along;
        }
        for (std::size_t column = 0; column < side; ++column) {
            above[column] = static_cast<U>(above[column] + slopes[column]);
            payload.H_m[row * side + column] = height_of(above[column]);
        }
    }
}

unsigned kind_of(const PagePayload& payload) {
    bool any_void = false, all_whole = true, any_height = false;
    for (const float H_m : payload.H_m) {
        if (is_void(H_m)) {
            any_void = true;
            continue;
        }
        assert(std::isfinite(H_m));
        any_height = true;
        // By the bits: -0 is no whole number here.
        all_whole = all_whole && H_m >= -32768.0F && H_m <= 32767.0F &&
                    std::bit_cast<std::uint32_t>(static_cast<float>(static_cast<std::int32_t>(H_m))) ==
                        std::bit_cast<std::uint32_t>(H_m);
    }
    if (!any_height) return all_void;
    return (all_whole ? whole_metres : floats) | (any_void ? with_voids : 0U);
}

// What zstd found wrong; nothing when all is well. Lack of memory is no fault of the bytes.
std::optional<std::string> fault_of(std::size_t zstd_result) {
    if (ZSTD_isError(zstd_result) == 0) return std::nullopt;
    if (ZSTD_getErrorCode(zstd_result) == ZSTD_error_memory_allocation) throw std::bad_alloc();
    return ZSTD_getErrorName(zstd_result);
}

bool all_finite(std::span<const float> numbers) {
    // Without a branch in the loop: the exponent of all ones is what infinities and NaN share.
    constexpr std::uint32_t exponent = 0x7f800000U;
    bool finite = true;
    for (const float number : numbers)
        finite &= (std::bit_cast<std::uint32_t>(number) & exponent) != exponent;
    return finite;
}

}  // namespace

Result<std::vector<std::byte>> encode_payload(const PagePayload& payload) {
    const unsigned kind = kind_of(payload);
    std::vector<std::byte> unpacked(unpacked_bytes(kind), std::byte{0});
    std::byte* to = unpacked.data();
    if (kind & with_voids) {
        for (std::size_t i = 0; i < posts; ++i) {
            if (is_void(payload.H_m[i])) to[i / 8] |= static_cast<std::byte>(1U << (i % 8));
        }
        to += void_bytes;
    }
    if (kind & whole_metres) {
        write_heights<std::uint16_t>(payload, to);
        to += posts * 2;
    } else if (kind & floats) {
        write_heights<std::uint32_t>(payload, to);
        to += posts * 4;
    }
    assert(all_finite(payload.error_m) && all_finite(payload.lod_radius_m));
    std::array<std::uint32_t, node_numbers> nodes;
    std::memcpy(nodes.data(), payload.error_m.data(), sizeof(payload.error_m));
    std::memcpy(nodes.data() + node_numbers / 2, payload.lod_radius_m.data(), sizeof(payload.lod_radius_m));
    write_planes(nodes.data(), node_numbers, to);

    const ZstdPacker context;
    std::vector<std::byte> packed(largest_payload_bytes);
    packed[0] = static_cast<std::byte>(kind);
    const std::size_t bytes = ZSTD_compressCCtx(context.get(), packed.data() + 1, packed.size() - 1,
                                                unpacked.data(), unpacked.size(), zstd_level);
    if (const auto what = fault_of(bytes))
        return Error{ErrorKind::failed, "zstd", "a page cannot be packed: " + *what};
    packed.resize(1 + bytes);
    packed.shrink_to_fit();
    return packed;
}

std::optional<std::string> decode_payload(std::span<const std::byte> bytes, PagePayload& payload) {
    if (bytes.empty()) return "is empty";
    const auto kind = static_cast<unsigned>(bytes[0]);
    if (!known(kind)) return "is of kind " + std::to_string(kind) + ", which this program does not know";
    std::vector<std::byte> unpacked(unpacked_bytes(kind));
    const ZstdUnpacker context;
    const std::size_t found = ZSTD_decompressDCtx(context.get(), unpacked.data(), unpacked.size(),
                                                  bytes.data() + 1, bytes.size() - 1);
    if (const auto what = fault_of(found)) return "cannot be unpacked: " + *what;
    if (found != unpacked.size())
        return "unpacks to " + std::to_string(found) + " bytes, expected " + std::to_string(unpacked.size());
    const std::byte* const voids = unpacked.data();
    const std::byte* from = voids + (kind & with_voids ? void_bytes : 0);
    if (kind & whole_metres) {
        read_heights<std::uint16_t>(from, payload);
        from += posts * 2;
    } else if (kind & floats) {
        read_heights<std::uint32_t>(from, payload);
        from += posts * 4;
    } else {
        payload.H_m.fill(void_height_m);
    }
    if (kind & with_voids) {
        for (std::size_t i = 0; i < posts; ++i) {
            if ((static_cast<unsigned>(voids[i / 8]) >> (i % 8)) & 1U) payload.H_m[i] = void_height_m;
        }
    }
    std::array<std::uint32_t, node_numbers> nodes;
    read_planes(from, node_numbers, nodes.data());
    std::memcpy(payload.error_m.data(), nodes.data(), sizeof(payload.error_m));
    std::memcpy(payload.lod_radius_m.data(), nodes.data() + node_numbers / 2, sizeof(payload.lod_radius_m));
    if (!all_finite(payload.H_m) || !all_finite(payload.error_m) || !all_finite(payload.lod_radius_m))
        return "holds a number that is not finite";
    return std::nullopt;
}

}  // namespace oro
