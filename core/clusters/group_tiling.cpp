#include "core/clusters/group_tiling.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace oro {

// From a place to the nearest of these lines.
std::int64_t GroupTiling::Lines::distance(std::int64_t place) const {
    const std::int64_t beyond = ((place - shift) % period + period) % period;
    return std::min(beyond, period - beyond);
}

// Of a level's possible places the one that is farthest from the lines of the two levels before. The axes
// take turns in doubling; first_doubled: the number of the doubling that is this axis's first.
GroupTiling::Lines GroupTiling::lines_of(int level, double kept_share, int first_doubled) {
    Lines older, last, lines{first_group_side, 0};
    for (int i = 2; i <= level; ++i) {
        older = last;
        last = lines;
        const int doublings = static_cast<int>(std::lround((i - 1) * -std::log2(kept_share)));
        const int of_axis = (doublings + 2 - first_doubled) / 2;
        lines.period = std::int64_t{first_group_side} << std::min(of_axis, 30);
        std::int64_t farthest = -1;
        const Lines before = lines;
        for (std::int64_t part = 0; part < 16; ++part) {
            const std::int64_t shift = before.period * part / 16;
            std::int64_t distance = last.distance(shift);
            if (older.period != 0) distance = std::min(distance, older.distance(shift));
            if (distance <= farthest) continue;
            farthest = distance;
            lines.shift = shift;
        }
    }
    return lines;
}

PlaneBox GroupTiling::box_of(const GroupTile& tile) const {
    const std::int64_t row = tile.row * row_.period + row_.shift;
    const std::int64_t column = tile.column * column_.period + column_.shift;
    return {row, row + row_.period, column, column + column_.period};
}

PlaneBox GroupTiling::widened(const GroupTile& tile) const {
    const PlaneBox box = box_of(tile);
    return {box.first_row - row_.period / 4, box.last_row + row_.period / 4,
            box.first_column - column_.period / 4, box.last_column + column_.period / 4};
}

GroupTiling::GroupTiling(int level, double kept_share)
    : row_(lines_of(level, kept_share, 2)), column_(lines_of(level, kept_share, 1)) {
    assert(level >= 1 && level <= 80);
}

}  // namespace oro
