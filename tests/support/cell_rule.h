// The rule that splits cells, once more: written from its definition, to hold the program's against.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/terrain/level_grid.h"
#include "core/terrain/post_grid.h"

namespace oro::test {

// Whether a cell of a level is split from its south-west to its north-east post: that diagonal's middle is
// nearer to the smooth surface through the 4 x 4 posts of the level around it. Heights count in steps of
// 2^-11 m. Of regions without a pole, whose first and last column have the same heights where they are one
// meridian.
inline bool sw_ne_by_rule(const HeightField& field, int row, int column, int level = 0) {
    const LevelGrid grid = level_grid(field.grid, level);
    const auto H = [&](int r, int c) -> std::optional<double> {
        if (field.grid.wraps_longitude() && c == -1) c = grid.column.quads - 1;
        if (field.grid.wraps_longitude() && c == grid.column.quads + 1) c = 1;
        if (r < 0 || c < 0 || r > grid.row.quads || c > grid.column.quads) return std::nullopt;
        const float H_m = field.H_at_post_m(grid.row.region_post(r), grid.column.region_post(c));
        if (is_void(H_m)) return std::nullopt;
        return std::floor(static_cast<double>(H_m) * 2048.0 + 0.5);
    };
    constexpr std::array<double, 4> weights{-1.0 / 16.0, 9.0 / 16.0, 9.0 / 16.0, -1.0 / 16.0};
    double smooth = 0.0;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            const auto one = H(row - 1 + i, column - 1 + j);
            if (!one) return false;
            smooth += weights[static_cast<std::size_t>(i)] * weights[static_cast<std::size_t>(j)] * *one;
        }
    }
    const double nw_se = 0.5 * (*H(row, column) + *H(row + 1, column + 1));
    const double sw_ne = 0.5 * (*H(row, column + 1) + *H(row + 1, column));
    return std::abs(sw_ne - smooth) < std::abs(nw_se - smooth);
}

}  // namespace oro::test
