#include "core/cluster_windows/region_windows.h"

#include <algorithm>
#include <cmath>

namespace oro {
namespace {

// A part of a side.
struct Stretch {
    int first{};  // of the window
    int count{};
    int own_first{};
    int own_last{};  // the last one
};

int whole_leaves(double posts) {
    return leaf_side * static_cast<int>(std::ceil(posts / leaf_side));
}

// own: posts of each, whole leaves; the last has the rest. margin: the usual one.
std::vector<Stretch> stretches_of(int posts, int own, int margin, double widened) {
    const int wide = whole_leaves(widened * margin);
    std::vector<Stretch> stretches;
    for (int first = 0; first < posts; first += own) {
        // A rest that is less than a margin goes to the one before.
        const bool is_last = first + own + margin >= posts;
        const int last = is_last ? posts - 1 : first + own - 1;
        const int begin = std::max(0, first - wide), end = std::min(posts - 1, last + 1 + wide);
        stretches.push_back({begin, end - begin + 1, first, last});
        if (is_last) break;
    }
    return stretches;
}

}  // namespace

std::vector<RegionWindow> windows_of(int rows, int columns, const WindowSizes& sizes) {
    double down = 0.0, right = 0.0;
    for (int level = 1; level <= sizes.levels; ++level) {
        const GroupTiling tiling(level, sizes.kept_share);
        const PlaneBox tile = tiling.box_of({0, 0});
        const double last = level == sizes.levels ? 1.5 : 1.0;
        down += last * static_cast<double>(tile.last_row - tile.first_row);
        right += last * static_cast<double>(tile.last_column - tile.first_column);
    }
    const int margin_down = whole_leaves(down), margin_right = whole_leaves(right);
    const double side = std::sqrt(static_cast<double>(sizes.posts));
    const int own_down = whole_leaves(std::max(side - 2.0 * margin_down, 1.0 * margin_down)),
              own_right = whole_leaves(std::max(side - 2.0 * margin_right, 1.0 * margin_right));
    std::vector<RegionWindow> windows;
    for (const Stretch& row : stretches_of(rows, own_down, margin_down, sizes.widened)) {
        for (const Stretch& column : stretches_of(columns, own_right, margin_right, sizes.widened))
            windows.push_back({{row.first, column.first, row.first > 0, column.first + column.count < columns,
                                row.first + row.count<rows, column.first> 0, false},
                               row.count,
                               column.count,
                               {row.own_first, row.own_last, column.own_first, column.own_last}});
    }
    return windows;
}

SurfaceVertex middle_of(const GroupTiling& tiling, const GroupTile& tile, int rows, int columns) {
    const PlaneBox box = tiling.box_of(tile);
    const auto within = [](std::int64_t first, std::int64_t last, int posts) {
        return static_cast<std::int32_t>(
            std::clamp<std::int64_t>((first + last) / 2, 0, std::int64_t{posts} - 1));
    };
    return {within(box.first_row, box.last_row, rows), within(box.first_column, box.last_column, columns), 0};
}

}  // namespace oro
