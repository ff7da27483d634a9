// Quick looks at rows of posts, by loops that a compiler turns into vector code. Within geo.
#pragma once

#include <cstdint>
#include <span>

namespace oro {

// What a row of a .hgt tile holds, beside its heights.
struct HgtRow {
    int lowest{};    // of the stored numbers that are no void; above `highest` where there is none
    int highest{};
    std::int64_t voids{};        // posts that hold -32768
    std::int64_t implausible{};  // others whose height no terrain has (geo/sources/source.h)
    // Pairs of neighbours none of which reads -32768 in either order of bytes, and the sums of their steps,
    // in metres: as stored, and with the bytes of each in the other order.
    std::int64_t pairs{}, steps_m{}, swapped_steps_m{};
};

// Takes a row's heights, two bytes each, the high one first, as metres: void_height_m where a post is void or
// implausible. At most 30,000 posts a row.
HgtRow decode_hgt_row(std::span<const unsigned char> bytes, std::span<float> height_m);

[[nodiscard]] bool any_void(std::span<const float> heights_m);
[[nodiscard]] bool all_void(std::span<const float> heights_m);

// True where a height that is not void lies below `low` or above `high`.
[[nodiscard]] bool any_beyond(std::span<const float> heights_m, float low, float high);

// True where a post and the one of the same number in the other row, neither void, are `least_m` apart or more,
// as floats: each pair that is so far apart in double is, and few others.
[[nodiscard]] bool any_step(std::span<const float> heights_m, std::span<const float> others_m, float least_m);

// Adds 1 to the marks of those posts.
void mark_steps(std::span<const float> heights_m, std::span<const float> others_m, float least_m,
                std::span<unsigned char> marks);

}  // namespace oro
