// Posts of made terrain for tests: one terrain of each kind, and a sum that tells whether all bits are the
// same.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/made/made_heights.h"

namespace oro::test {

// 1000 x 1000 posts a second apart around 46.14 N 8.14 E, from -200 to 4000 m.
inline MadeTerrain made_example(MadeKind kind) {
    MadeTerrain made;
    made.kind = kind;
    made.seed = 7;
    made.low = -200 * 2048;
    made.high = 4000 * 2048;
    made.west = 8 * 3600;
    made.east = made.west + 999;
    made.south = 46 * 3600;
    made.north = made.south + 999;
    made.length_m = 27000;
    made.radius_m = 15000;
    made.azimuth_deg = 30;
    return made;
}

// Heights of all posts, in 2^-11 m, by a rule that may be another terrain's.
inline std::vector<std::int32_t> heights_of(const MadeTerrain& made, const gpu::MadeRule& rule) {
    const std::vector<MadeColumn> columns = made_columns(made, 0, made.columns());
    std::vector<std::int32_t> steps(static_cast<std::size_t>(made.rows()) * columns.size());
    for (int row = 0; row < made.rows(); ++row)
        made_row_heights(
            made, rule, row, 0, columns,
            std::span(steps).subspan(static_cast<std::size_t>(row) * columns.size(), columns.size()));
    return steps;
}
inline std::vector<std::int32_t> heights_of(const MadeTerrain& made) {
    return heights_of(made, made_rule(made));
}

// FNV of whole numbers: one bit that differs changes it.
inline std::uint32_t sum_of(std::span<const std::int32_t> steps) {
    std::uint32_t sum = 0;
    for (const std::int32_t step : steps) sum = (sum ^ static_cast<std::uint32_t>(step)) * 0x01000193U;
    return sum;
}

}  // namespace oro::test
