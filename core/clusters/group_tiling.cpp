#include "core/clusters/group_tiling.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace oro {

// From a place to the nearest of these lines.
std::int64_t GroupTiling::Lines::distance(std::int64_t place) const {
    const std::int64_t beyond = ((place - shift) % period + period) % period;
    return std::min(beyond, period - beyond);
}

// The periods of an axis double on every second level, from `first_doubled` on. Of a level's possible places
// the one that is farthest from the lines of the two levels before.
GroupTiling::Lines GroupTiling::lines_of(int level, int first_doubled) {
    Lines older, last, lines{first_group_side, 0};
    for (int i = 2; i <= level; ++i) {
        older = last;
        last = lines;
        if (i >= first_doubled && (i - first_doubled) % 2 == 0) lines.period *= 2;
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

GroupTiling::GroupTiling(int level) : row_(lines_of(level, 3)), column_(lines_of(level, 2)) {
    assert(level >= 1 && level <= 40);
}

}  // namespace oro
