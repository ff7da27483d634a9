#include "geo/sources/row_scans.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>

#include "core/terrain/post_grid.h"
#include "geo/sources/source.h"

namespace oro {
namespace {

constexpr int hgt_no_height = -32768;
constexpr std::size_t piece_posts = 256;  // so few that the first that decides ends a scan soon

using Numbers = std::array<std::int16_t, piece_posts + 1>;

// Sums of steps between neighbours, of `count` pairs.
void add_steps(const Numbers& stored, const Numbers& swapped, std::size_t count, HgtRow& row) {
    int pairs = 0, steps = 0, swapped_steps = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const int a = stored[i], b = stored[i + 1], c = swapped[i], d = swapped[i + 1];
        const int holds = -static_cast<int>((a != hgt_no_height) & (b != hgt_no_height) &
                                            (c != hgt_no_height) & (d != hgt_no_height));
        pairs -= holds;
        steps += std::abs(a - b) & holds;
        swapped_steps += std::abs(c - d) & holds;
    }
    row.pairs += pairs;
    row.steps_m += steps;
    row.swapped_steps_m += swapped_steps;
}

// Heights of `count` numbers. (By masks: of a choice GCC 12 makes no vector code.)
void add_heights(const std::int16_t* stored, std::size_t count, float* height_m, HgtRow& row) {
    constexpr auto low = static_cast<int>(lowest_plausible_m), high = static_cast<int>(highest_plausible_m);
    constexpr auto void_bits = std::bit_cast<std::uint32_t>(void_height_m);
    int lowest = std::numeric_limits<int>::max(), highest = hgt_no_height, voids = 0, beyond = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const int value = stored[i], is_none = -static_cast<int>(value == hgt_no_height);
        const int of_others = value + (is_none & std::numeric_limits<std::uint16_t>::max());
        lowest = std::min(lowest, of_others);
        highest = std::max(highest, value);
        voids -= is_none;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const int value = stored[i];
        const auto out = static_cast<std::uint32_t>(-static_cast<int>((value < low) | (value > high)));
        beyond -= static_cast<int>(out);
        const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
        height_m[i] = std::bit_cast<float>((bits & ~out) | (void_bits & out));
    }
    row.lowest = std::min(row.lowest, lowest);
    row.highest = std::max(row.highest, highest);
    row.voids += voids;
    row.implausible += beyond - voids;
}

}  // namespace

HgtRow decode_hgt_row(std::span<const unsigned char> bytes, std::span<float> height_m) {
    HgtRow row;
    row.lowest = std::numeric_limits<int>::max();
    row.highest = hgt_no_height;
    Numbers stored{}, swapped{};
    const std::size_t posts = height_m.size();
    for (std::size_t first = 0; first < posts; first += piece_posts) {
        // With the first post of the next piece, for the step to it.
        const std::size_t count = std::min(piece_posts, posts - first),
                          with_next = std::min(piece_posts + 1, posts - first);
        const unsigned char* const from = bytes.data() + 2 * first;
        for (std::size_t i = 0; i < with_next; ++i) {
            stored[i] = static_cast<std::int16_t>(from[2 * i] << 8 | from[2 * i + 1]);
            swapped[i] = static_cast<std::int16_t>(from[2 * i + 1] << 8 | from[2 * i]);
        }
        add_steps(stored, swapped, with_next - 1, row);
        add_heights(stored.data(), count, height_m.data() + first, row);
    }
    return row;
}

bool any_void(std::span<const float> heights_m) {
    int found = 0;
    for (const float height_m : heights_m) found |= static_cast<int>(height_m == void_height_m);
    return found != 0;
}

bool all_void(std::span<const float> heights_m) {
    int found = 0;
    for (const float height_m : heights_m) found |= static_cast<int>(height_m != void_height_m);
    return found == 0;
}

bool any_beyond(std::span<const float> heights_m, float low, float high) {
    for (std::size_t first = 0; first < heights_m.size(); first += piece_posts) {
        const std::size_t end = std::min(first + piece_posts, heights_m.size());
        int found = 0;
        for (std::size_t i = first; i < end; ++i)
            found |= (heights_m[i] != void_height_m) & !((heights_m[i] >= low) & (heights_m[i] <= high));
        if (found != 0) return true;
    }
    return false;
}

bool any_step(std::span<const float> heights_m, std::span<const float> others_m, float least_m) {
    for (std::size_t first = 0; first < heights_m.size(); first += piece_posts) {
        const std::size_t end = std::min(first + piece_posts, heights_m.size());
        int found = 0;
        for (std::size_t i = first; i < end; ++i)
            found |= (heights_m[i] != void_height_m) & (others_m[i] != void_height_m) &
                     (std::abs(heights_m[i] - others_m[i]) >= least_m);
        if (found != 0) return true;
    }
    return false;
}

void mark_steps(std::span<const float> heights_m, std::span<const float> others_m, float least_m,
                std::span<unsigned char> marks) {
    for (std::size_t i = 0; i < heights_m.size(); ++i) {
        const bool is_step = (heights_m[i] != void_height_m) & (others_m[i] != void_height_m) &
                             (std::abs(heights_m[i] - others_m[i]) >= least_m);
        marks[i] = static_cast<unsigned char>(marks[i] + is_step);
    }
}

}  // namespace oro
