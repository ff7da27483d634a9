#include "core/packed/packed_heights.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

static_assert(offsetof(gpu::PageBlock, heights) == sizeof(std::uint32_t) * gpu::packed_words_before);
static_assert(sizeof(gpu::PackedBlock) == 4 * sizeof(std::uint32_t));
static_assert(packed_words_max - 4 * gpu::packed_blocks < 1U << gpu::packed_word_bits);

constexpr int side = static_cast<int>(gpu::packed_side);
constexpr int stride = static_cast<int>(gpu::height_stride);
constexpr int blocks_per_side = static_cast<int>(gpu::packed_blocks_per_side);
constexpr double slope_parts = 1U << gpu::packed_slope_bits;
constexpr double unit_parts = 1U << gpu::packed_unit_bits;
// Of slopes, so that their sums stay in 32 bits.
constexpr double steepest = 1 << 27;

struct Post {
    int i{};
    int j{};
    std::int64_t steps{};
};

// The posts of a block that are not void.
struct BlockPosts {
    int rows{};
    int columns{};
    std::array<std::int32_t, side * side> steps{};  // row by row, `columns` a row
    std::array<Post, side * side> there{};
    std::size_t count{};

    [[nodiscard]] bool has_void() const { return static_cast<int>(count) < rows * columns; }
    [[nodiscard]] std::span<const Post> posts() const { return std::span(there).first(count); }
};

BlockPosts block_posts(HeightsOfPage steps, int number) {
    const int first_row = number / blocks_per_side * side, first_column = number % blocks_per_side * side;
    BlockPosts block;
    block.rows = std::min(side, stride - first_row);
    block.columns = std::min(side, stride - first_column);
    for (int i = 0; i < block.rows; ++i) {
        for (int j = 0; j < block.columns; ++j) {
            const std::int32_t height =
                steps[static_cast<std::size_t>((first_row + i) * stride + first_column + j)];
            block.steps[static_cast<std::size_t>(i * block.columns + j)] = height;
            if (height != void_height_steps) block.there[block.count++] = {i, j, height};
        }
    }
    return block;
}

std::int64_t plane_at(const gpu::PackedBlock& block, int i, int j) {
    return (static_cast<std::int32_t>(i) * block.along_rows + j * block.along_columns) >>
           gpu::packed_slope_bits;
}
std::int64_t steps_of(std::uint64_t units, std::uint32_t unit) {
    return static_cast<std::int64_t>(units * unit >> gpu::packed_unit_bits);
}

// A block with its codes.
struct Packed {
    gpu::PackedBlock block{};
    int step_bits{};
    int unit_bits{};
    bool has_void{};
    std::array<std::uint32_t, side * side> codes{};

    [[nodiscard]] int bits() const { return step_bits + unit_bits; }
};

// What slopes leave of a block's heights: whole units and the steps between.
struct Rest {
    std::array<std::uint64_t, side * side> units{};
    std::array<std::int64_t, side * side> steps{};
    std::uint64_t most_units{};
    std::int64_t least_steps{};
    std::int64_t most_steps{};
};

Rest rest_of(const BlockPosts& posts, const gpu::PackedBlock& block, std::uint32_t unit) {
    Rest rest;
    const auto left = [&](const Post& post) { return post.steps - plane_at(block, post.i, post.j); };
    const std::int64_t first = left(posts.there[0]);
    const double of_unit = unit_parts / unit;
    std::array<std::int64_t, side * side> whole{};
    std::int64_t least = 0;
    for (std::size_t k = 0; k < posts.count; ++k) {
        whole[k] = std::llround(static_cast<double>(left(posts.there[k]) - first) * of_unit);
        least = std::min(least, whole[k]);
    }
    rest.least_steps = std::numeric_limits<std::int64_t>::max();
    rest.most_steps = std::numeric_limits<std::int64_t>::min();
    for (std::size_t k = 0; k < posts.count; ++k) {
        rest.units[k] = static_cast<std::uint64_t>(whole[k] - least);
        rest.steps[k] = left(posts.there[k]) - steps_of(rest.units[k], unit);
        rest.most_units = std::max(rest.most_units, rest.units[k]);
        rest.least_steps = std::min(rest.least_steps, rest.steps[k]);
        rest.most_steps = std::max(rest.most_steps, rest.steps[k]);
    }
    return rest;
}

int bits_of(std::uint64_t most) {
    return static_cast<int>(std::bit_width(most));
}

// Codes for what is left of a block; a code has at most 32 bits, or `packed` stays as it is.
void pack_rest(const BlockPosts& posts, const Rest& rest, gpu::PackedBlock block, Packed& packed) {
    int step_bits = bits_of(static_cast<std::uint64_t>(rest.most_steps - rest.least_steps));
    const int unit_bits = bits_of(rest.most_units);
    const auto code = [&](std::size_t k) {
        return rest.units[k] << step_bits | static_cast<std::uint64_t>(rest.steps[k] - rest.least_steps);
    };
    if (posts.has_void()) {
        const std::uint64_t ones = (std::uint64_t{1} << std::min(63, step_bits + unit_bits)) - 1;
        for (std::size_t k = 0; k < posts.count; ++k) {
            if (code(k) != ones) continue;
            ++step_bits;
            break;
        }
    }
    if (step_bits + unit_bits > 32 || step_bits + unit_bits >= packed.bits()) return;
    packed.block = block;
    packed.block.base = static_cast<std::int32_t>(rest.least_steps);
    packed.step_bits = step_bits;
    packed.unit_bits = unit_bits;
    packed.has_void = posts.has_void();
    packed.codes.fill(std::numeric_limits<std::uint32_t>::max());
    for (std::size_t k = 0; k < posts.count; ++k)
        packed.codes[static_cast<std::size_t>(posts.there[k].i * posts.columns + posts.there[k].j)] =
            static_cast<std::uint32_t>(code(k));
}

struct Slopes {
    double along_rows{};
    double along_columns{};
};

// How what is left of whole units changes from post to post: N, whose slope is small.
Slopes slopes_between_units(const BlockPosts& posts, double unit) {
    const auto mean_along = [&](int di, int dj) {
        double sum = 0.0;
        int count = 0;
        for (int i = 0; i + di < posts.rows; ++i) {
            for (int j = 0; j + dj < posts.columns; ++j) {
                const std::int32_t one = posts.steps[static_cast<std::size_t>(i * posts.columns + j)];
                const std::int32_t other =
                    posts.steps[static_cast<std::size_t>((i + di) * posts.columns + j + dj)];
                if (one == void_height_steps || other == void_height_steps) continue;
                const double change = static_cast<double>(std::int64_t{other} - one);
                sum += change - unit * std::nearbyint(change / unit);
                ++count;
            }
        }
        return count > 0 ? sum / count : 0.0;
    };
    return {mean_along(1, 0), mean_along(0, 1)};
}

// The slopes of a plane through them by least squares, where no post is void.
Slopes slopes_of_units(const BlockPosts& posts, const Rest& rest) {
    const double middle_i = 0.5 * (posts.rows - 1), middle_j = 0.5 * (posts.columns - 1);
    double rows = 0.0, columns = 0.0, row_squares = 0.0, column_squares = 0.0;
    for (std::size_t k = 0; k < posts.count; ++k) {
        const double i = posts.there[k].i - middle_i, j = posts.there[k].j - middle_j;
        const double units = static_cast<double>(rest.units[k]);
        rows += i * units;
        columns += j * units;
        row_squares += i * i;
        column_squares += j * j;
    }
    return {row_squares > 0.0 ? rows / row_squares : 0.0,
            column_squares > 0.0 ? columns / column_squares : 0.0};
}

gpu::PackedBlock with_slopes(double along_rows, double along_columns) {
    const auto parts = [](double slope) {
        return static_cast<std::int32_t>(std::clamp(std::round(slope * slope_parts), -steepest, steepest));
    };
    return {0, parts(along_rows), parts(along_columns), 0};
}

Packed pack_block(const BlockPosts& posts, std::uint32_t unit) {
    Packed packed;
    packed.has_void = true;
    if (posts.count == 0) return packed;
    packed.step_bits = 33;
    // As they are, from the lowest on: takes any heights.
    Rest whole = rest_of(posts, {}, std::uint32_t{1} << gpu::packed_unit_bits);
    whole.least_steps = whole.most_steps = posts.there[0].steps;
    for (std::size_t k = 0; k < posts.count; ++k) {
        whole.units[k] = 0;
        whole.steps[k] = posts.there[k].steps;
        whole.least_steps = std::min(whole.least_steps, whole.steps[k]);
        whole.most_steps = std::max(whole.most_steps, whole.steps[k]);
    }
    whole.most_units = 0;
    pack_rest(posts, whole, {}, packed);
    const double unit_steps = unit / unit_parts;
    const Slopes between = slopes_between_units(posts, unit_steps);
    const gpu::PackedBlock level = with_slopes(between.along_rows, between.along_columns);
    const Rest rest = rest_of(posts, level, unit);
    pack_rest(posts, rest, level, packed);
    const Slopes units = slopes_of_units(posts, rest);
    if (std::abs(units.along_rows) < 0.5 && std::abs(units.along_columns) < 0.5) return packed;
    const gpu::PackedBlock steep =
        with_slopes(between.along_rows + unit_steps * std::nearbyint(units.along_rows),
                    between.along_columns + unit_steps * std::nearbyint(units.along_columns));
    pack_rest(posts, rest_of(posts, steep, unit), steep, packed);
    return packed;
}

// Units that sources count in, metres: the last is a step.
constexpr std::array units_m{1.0, 0.3048, 1200.0 / 3937.0, 0.1, 0.01, 0.0};

// The unit by which some blocks of the page take the fewest bits, in parts of a step.
std::uint32_t unit_of(HeightsOfPage steps, double exaggeration) {
    std::uint32_t best = std::uint32_t{1} << gpu::packed_unit_bits;
    int fewest = std::numeric_limits<int>::max();
    for (const double unit_m : units_m) {
        const double parts = unit_m > 0.0 ? unit_m * exaggeration / height_step_m * unit_parts : unit_parts;
        if (!(parts >= 1.0 && parts < 4.0e9)) continue;
        const auto unit = static_cast<std::uint32_t>(std::llround(parts));
        int bits = 0;
        for (int number = 0; number < static_cast<int>(gpu::packed_blocks); number += 19) {
            const BlockPosts posts = block_posts(steps, number);
            bits += pack_block(posts, unit).bits() * posts.rows * posts.columns;
        }
        if (bits < fewest) {
            fewest = bits;
            best = unit;
        }
    }
    return best;
}

void append_codes(const Packed& packed, int count, std::vector<std::uint32_t>& words) {
    std::uint64_t held = 0;
    int held_bits = 0;
    const int bits = packed.bits();
    const std::uint64_t ones = (std::uint64_t{1} << bits) - 1;
    for (int k = 0; k < count; ++k) {
        held |= (packed.codes[static_cast<std::size_t>(k)] & ones) << held_bits;
        held_bits += bits;
        if (held_bits < 32) continue;
        words.push_back(static_cast<std::uint32_t>(held));
        held >>= 32U;
        held_bits -= 32;
    }
    if (held_bits > 0) words.push_back(static_cast<std::uint32_t>(held));
}

constexpr std::size_t first_code = 1 + 4 * gpu::packed_blocks;

}  // namespace

std::vector<std::uint32_t> packed_heights(HeightsOfPage steps, double exaggeration) {
    const std::uint32_t unit = unit_of(steps, exaggeration);
    std::vector<std::uint32_t> words(first_code);
    words[0] = unit;
    for (int number = 0; number < static_cast<int>(gpu::packed_blocks); ++number) {
        const BlockPosts posts = block_posts(steps, number);
        const Packed packed = pack_block(posts, unit);
        const std::size_t at = 1 + 4 * static_cast<std::size_t>(number);
        words[at] = static_cast<std::uint32_t>(packed.block.base);
        words[at + 1] = static_cast<std::uint32_t>(packed.block.along_rows);
        words[at + 2] = static_cast<std::uint32_t>(packed.block.along_columns);
        words[at + 3] = static_cast<std::uint32_t>(words.size() - first_code) |
                        static_cast<std::uint32_t>(packed.step_bits) << gpu::packed_word_bits |
                        static_cast<std::uint32_t>(packed.unit_bits)
                            << (gpu::packed_word_bits + gpu::packed_count_bits) |
                        (packed.has_void ? 1U : 0U) << gpu::packed_void_bit;
        append_codes(packed, posts.rows * posts.columns, words);
    }
    words.push_back(0);
    return words;
}

std::int32_t unpacked_height(std::span<const std::uint32_t> packed, std::size_t row, std::size_t column) {
    const std::size_t block_column = column / gpu::packed_side;
    const std::size_t at = 1 + 4 * (row / gpu::packed_side * gpu::packed_blocks_per_side + block_column);
    const gpu::PackedBlock block{static_cast<std::int32_t>(packed[at]),
                                 static_cast<std::int32_t>(packed[at + 1]),
                                 static_cast<std::int32_t>(packed[at + 2]), packed[at + 3]};
    const auto field = [&](std::uint32_t first, std::uint32_t count) {
        return block.codes >> first & ((1U << count) - 1);
    };
    const std::uint32_t step_bits = field(gpu::packed_word_bits, gpu::packed_count_bits);
    const std::uint32_t unit_bits =
        field(gpu::packed_word_bits + gpu::packed_count_bits, gpu::packed_count_bits);
    const std::uint32_t bits = step_bits + unit_bits;
    const auto i = static_cast<int>(row % gpu::packed_side), j = static_cast<int>(column % gpu::packed_side);
    const int columns = block_column + 1 == gpu::packed_blocks_per_side ? stride % side : side;
    const std::uint32_t bit = static_cast<std::uint32_t>(i * columns + j) * bits;
    const std::size_t word = first_code + field(0, gpu::packed_word_bits) + bit / 32;
    const std::uint64_t two = bits == 0 ? 0 : packed[word] | std::uint64_t{packed[word + 1]} << 32U;
    const std::uint64_t ones = (std::uint64_t{1} << bits) - 1;
    const std::uint64_t code = two >> bit % 32 & ones;
    if (field(gpu::packed_void_bit, 1) != 0 && code == ones) return void_height_steps;
    const std::uint64_t steps = code & ((std::uint64_t{1} << step_bits) - 1);
    return static_cast<std::int32_t>(block.base + plane_at(block, i, j) +
                                     steps_of(code >> step_bits, packed[0]) +
                                     static_cast<std::int64_t>(steps));
}

}  // namespace oro
